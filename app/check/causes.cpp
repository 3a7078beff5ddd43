#include "check/causes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "scene/file/scene_file.h"

namespace glimt {
namespace {

using Change = std::function<float(float)>;

Image each_value(Image image, const Change& change) {
  for (float& value : image.rgb) value = change(value);
  return image;
}

/// The picture whose pixel (x, y) is that of `source` at from(x, y).
template <class From>
Image moved(const Image& source, From from) {
  Image image = source;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const auto [sx, sy] = from(x, y);
      std::copy_n(source.pixel(sx, sy), 3, image.pixel(x, y));
    }
  return image;
}

/// Mistakes of what is done with the finished picture.
std::vector<std::pair<std::string, Image>> made_of(const Image& reference) {
  constexpr auto pi = std::numbers::pi_v<float>;
  const auto times = [&](float factor) { return each_value(reference, [=](float v) { return v * factor; }); };
  const auto power = [&](float exponent) {
    return each_value(reference, [=](float v) { return std::pow(std::max(v, 0.0F), exponent); });
  };
  const int last_x = reference.width - 1, last_y = reference.height - 1;
  Image swapped = reference;
  for (std::size_t i = 0; i < swapped.rgb.size(); i += 3) std::swap(swapped.rgb[i], swapped.rgb[i + 2]);
  return {{"everything is pi times as bright", times(pi)},
          {"everything is divided by pi", times(1 / pi)},
          {"everything is twice as bright", times(2)},
          {"everything is half as bright", times(0.5F)},
          {"gamma 2.2 was applied: values are not linear", power(1 / 2.2F)},
          {"gamma 2.2 was removed from linear values", power(2.2F)},
          {"values are cut off at 1", each_value(reference, [](float v) { return std::min(v, 1.0F); })},
          {"rows are upside down", moved(reference, [=](int x, int y) { return std::pair(x, last_y - y); })},
          {"left and right are exchanged", moved(reference, [=](int x, int y) { return std::pair(last_x - x, y); })},
          {"it is turned by half a turn",
           moved(reference, [=](int x, int y) { return std::pair(last_x - x, last_y - y); })},
          {"red and blue are exchanged", std::move(swapped)}};
}

/// A mistake of the rendering, as a change of the scene.
struct SceneMistake {
  std::string name;
  std::function<void(Scene&)> make;
};

/// Sets a parameter of all materials of a type, by its text as --set takes it.
void set_in_all(Scene& scene, const std::string& type, const std::string& setting) {
  std::vector<std::string> overrides;
  for (const Material& material : scene.materials)
    if (material.type == type) overrides.push_back("material." + material.name + "." + setting);
  if (!overrides.empty()) scene = parse_scene(write_scene(scene), "the scene", overrides);
}

std::vector<SceneMistake> scene_mistakes() {
  std::vector<SceneMistake> mistakes{
      {"caustics are missing", [](Scene& s) { s.render.caustics = Caustics::off; }},
      {"only direct light is there", [](Scene& s) { s.render.max_depth = 2; }},
      {"Schlick's formula stands for Fresnel's equations", [](Scene& s) { set_in_all(s, "glass", "fresnel=schlick"); }},
      {"glass has the index 1.33 of water", [](Scene& s) { set_in_all(s, "glass", "ior=1.33"); }},
      {"Oren-Nayar has sin for tan, as in the course report",
       [](Scene& s) { set_in_all(s, "oren-nayar", "formula=report"); }},
      {"Oren-Nayar is Lambertian", [](Scene& s) { set_in_all(s, "oren-nayar", "roughness=0"); }},
      {"rough metal has alpha = roughness", [](Scene& s) {
         for (Material& m : s.materials)
           if (const auto found = m.values.find("roughness"); m.type == "conductor" && found != m.values.end())
             found->second = std::sqrt(std::get<double>(found->second));
       }}};
  for (const int depth : {3, 4, 5, 6, 8, 11, 16})
    mistakes.push_back(
        {"paths end at surface " + std::to_string(depth), [depth](Scene& s) { s.render.max_depth = depth; }});
  return mistakes;
}

}  // namespace

std::vector<Cause> likely_causes(const Image& picture, const Scene& scene, const Image& reference,
                                 const RenderScene& render) {
  std::vector<Cause> causes;
  for (const auto& [name, made] : made_of(reference)) causes.push_back({name, difference_of(picture, made)});
  for (const SceneMistake& mistake : scene_mistakes()) {
    Scene changed = scene;
    mistake.make(changed);
    if (changed != scene) causes.push_back({mistake.name, difference_of(picture, render(changed))});
  }
  std::ranges::sort(causes, {}, [](const Cause& cause) { return cause.left.mean_square_z; });
  return causes;
}

}  // namespace glimt
