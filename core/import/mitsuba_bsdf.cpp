#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "import/mitsuba_parts.h"
#include "scene/file/text.h"

namespace glimt {
namespace {

using glm::dvec3;

constexpr int most_nested_bsdfs = 16;

double linear(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// "#rrggbb" in sRGB.
dvec3 hex_colour(const MitsubaFile& file, pugi::xml_node node, std::string_view text) {
  unsigned value = 0;
  const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), value, 16);
  if (text.size() != 7 || error != std::errc{} || end != text.data() + text.size())
    file.fail(node, "has \"" + std::string(text) + "\" where a colour is due");
  const auto channel = [&](unsigned shift) { return linear(((value >> shift) & 255) / 255.0); };
  return {channel(16), channel(8), channel(0)};
}

/// The mean over wavelengths of "400:0.1, 500:0.3".
double mean_of_spectrum(const MitsubaFile& file, pugi::xml_node node, std::string text) {
  std::ranges::replace(text, ',', ' ');
  double sum = 0;
  int count = 0;
  for (std::size_t at = text.find(':'); at != std::string::npos; at = text.find(':', at + 1)) {
    const std::size_t begin = text.find_first_not_of(' ', at + 1);
    double value = 0;
    if (begin == std::string::npos ||
        std::from_chars(text.data() + begin, text.data() + text.size(), value).ec != std::errc{})
      file.fail(node, "is a spectrum that is not understood");
    sum += value, ++count;
  }
  return sum / count;
}

/// Refractive indices that have names.
double index_of(MitsubaImport& in, pugi::xml_node bsdf, std::string_view name, double otherwise) {
  struct Named {
    std::string_view name;
    double index;
  };
  constexpr std::array<Named, 18> known{{{"vacuum", 1.0},
                                         {"helium", 1.00004},
                                         {"hydrogen", 1.00013},
                                         {"air", 1.00028},
                                         {"carbon dioxide", 1.00045},
                                         {"water", 1.3330},
                                         {"acetone", 1.36},
                                         {"ethanol", 1.361},
                                         {"carbon tetrachloride", 1.461},
                                         {"glycerol", 1.4729},
                                         {"benzene", 1.501},
                                         {"water ice", 1.31},
                                         {"fused quartz", 1.458},
                                         {"pyrex", 1.470},
                                         {"acrylic glass", 1.49},
                                         {"bk7", 1.5046},
                                         {"sodium chloride", 1.544},
                                         {"diamond", 2.419}}};
  const pugi::xml_node node = in.file.property(bsdf, name);
  if (!node || std::string_view(node.name()) != "string") return in.file.number(bsdf, name, otherwise);
  const std::string text = in.file.attribute(node, "value");
  const auto found = std::ranges::find(known, std::string_view(text), &Named::name);
  if (found != known.end()) return found->index;
  in.note(node, "refractive index of \"" + text + "\"", number_text(otherwise));
  return otherwise;
}

double alpha_of(MitsubaImport& in, pugi::xml_node bsdf) {
  if (const std::string facets = in.file.text(bsdf, "distribution", "beckmann"); facets != "ggx")
    in.note(bsdf, "distribution " + facets, "ggx of the same alpha");
  if (!in.file.property(bsdf, "alpha_u")) return in.file.number(bsdf, "alpha", 0.1);
  const double u = in.file.number(bsdf, "alpha_u", 0.1), v = in.file.number(bsdf, "alpha_v", 0.1);
  if (u != v) in.note(bsdf, "roughness that differs along and across", "the mean of the two");
  return std::sqrt(std::max(u * v, 0.0));
}

Material conductor(MitsubaImport& in, pugi::xml_node bsdf, const std::string& name, double alpha) {
  const dvec3 tint = colour_of(in, bsdf, "specular_reflectance", dvec3{1});
  const std::string metal = in.file.text(bsdf, "material", in.file.property(bsdf, "eta") ? "" : "Cu");
  if (metal == "none" && alpha < 1e-3) {
    Material mirror{.name = name, .type = "mirror"};
    set_parameter(mirror, "reflectance", tint);
    return mirror;
  }
  if (tint != dvec3{1}) in.note(bsdf, "specular_reflectance of a metal", "the metal as it is");
  // All light is reflected where the index is imaginary.
  if (metal == "none") return make_conductor(name, dvec3{0}, dvec3{1}, alpha);
  if (metal.empty())
    return make_conductor(name, colour_of(in, bsdf, "eta", dvec3{0}), colour_of(in, bsdf, "k", dvec3{1}), alpha);
  constexpr std::array<std::array<std::string_view, 2>, 5> presets{
      {{"Au", "gold"}, {"Ag", "silver"}, {"Cu", "copper"}, {"Al", "aluminium"}, {"Fe", "iron"}}};
  const auto known = std::ranges::find(presets, std::string_view(metal), [](const auto& p) { return p[0]; });
  if (known == presets.end()) in.note(bsdf, "metal \"" + metal + "\"", "iron");
  Material material = make_conductor(name, dvec3{1}, dvec3{1}, alpha);
  set_choice(material, "preset", known == presets.end() ? "iron" : (*known)[1]);
  return material;
}

Material glass(MitsubaImport& in, pugi::xml_node bsdf, const std::string& name, double alpha) {
  for (const char* tint : {"specular_reflectance", "specular_transmittance"})
    if (in.file.property(bsdf, tint)) in.note(bsdf, tint + std::string(" of glass"), "clear glass");
  return make_glass(name, index_of(in, bsdf, "int_ior", 1.5046) / index_of(in, bsdf, "ext_ior", 1.000277), alpha);
}

pugi::xml_node inner_bsdf(const MitsubaImport& in, pugi::xml_node bsdf) {
  for (const pugi::xml_node child : bsdf.children())
    if (const pugi::xml_node inner = in.file.resolved(child); std::string_view(inner.name()) == "bsdf") return inner;
  in.file.fail(bsdf, "holds no bsdf");
}

Material material_of(MitsubaImport& in, pugi::xml_node bsdf, const std::string& name, int depth) {
  if (depth > most_nested_bsdfs) in.file.fail(bsdf, "is nested too deep");
  const std::string type = in.file.attribute(bsdf, "type");
  const auto instead = [&](std::string_view colour, const char* what) {
    in.note(bsdf, "bsdf " + type, what);
    return make_lambertian(name, colour_of(in, bsdf, colour, dvec3{0.5}));
  };
  if (type == "diffuse") return make_lambertian(name, colour_of(in, bsdf, "reflectance", dvec3{0.5}));
  if (type == "twosided") return material_of(in, inner_bsdf(in, bsdf), name, depth + 1);
  if (type == "conductor") return conductor(in, bsdf, name, 0);
  if (type == "roughconductor") return conductor(in, bsdf, name, alpha_of(in, bsdf));
  if (type == "dielectric") return glass(in, bsdf, name, 0);
  if (type == "roughdielectric") return glass(in, bsdf, name, alpha_of(in, bsdf));
  if (type == "plastic" || type == "roughplastic")
    return instead("diffuse_reflectance", "lambertian of its diffuse_reflectance");
  if (type == "principled") return instead("base_color", "lambertian of its base_color");
  if (type == "mask" || type == "bumpmap" || type == "normalmap") {
    in.note(bsdf, "bsdf " + type, "the bsdf within it");
    return material_of(in, inner_bsdf(in, bsdf), name, depth + 1);
  }
  return instead("reflectance", "lambertian of its reflectance, or of 0.5");
}

}  // namespace

void MitsubaImport::note(pugi::xml_node node, const std::string& what, const std::string& instead) {
  const std::string place = file.place(node);
  if (noted.insert(place + what).second) result.notes.push_back({place, what, instead});
}

dvec3 colour_of(MitsubaImport& in, pugi::xml_node object, std::string_view name, const dvec3& otherwise) {
  const pugi::xml_node node = in.file.resolved(in.file.property(object, name));
  if (!node) return otherwise;
  const std::string_view kind = node.name();
  if (kind == "texture") {
    const std::string type = in.file.attribute(node, "type");
    if (type == "checkerboard") {
      in.note(node, "texture checkerboard", "the mean of its two colours");
      const dvec3 first = colour_of(in, node, "color0", dvec3{0.4}), second = colour_of(in, node, "color1", dvec3{0.2});
      return 0.5 * (first + second);
    }
    in.note(node, "texture " + type, "a colour of 0.5");
    return dvec3{0.5};
  }
  const std::string text = in.file.attribute(node, "value");
  if (text.starts_with('#')) return hex_colour(in.file, node, text);
  if (kind == "spectrum" && node.attribute("filename")) {
    in.note(node, "spectrum of a file", "a colour of 0.5");
    return dvec3{0.5};
  }
  if (text.find(':') != std::string::npos) {
    in.note(node, "spectrum", "its mean");
    return dvec3{mean_of_spectrum(in.file, node, text)};
  }
  return in.file.vector(node, 0);
}

std::string import_bsdf(MitsubaImport& in, pugi::xml_node bsdf) {
  const std::string place = in.file.place(bsdf) + std::to_string(bsdf.offset_debug());
  if (const auto known = in.materials.find(place); known != in.materials.end()) return known->second;
  const std::string id = in.file.attribute(bsdf, "id"), type = in.file.attribute(bsdf, "type");
  const std::string name = unused_material_name(in.scene(), id.empty() ? type : id);
  in.scene().materials.push_back(material_of(in, bsdf, name, 0));
  return in.materials[place] = name;
}

std::string default_bsdf(MitsubaImport& in) {
  std::string& name = in.materials[""];
  if (name.empty()) {
    name = unused_material_name(in.scene(), "default");
    in.scene().materials.push_back(make_lambertian(name, dvec3{0.5}));
  }
  return name;
}

}  // namespace glimt
