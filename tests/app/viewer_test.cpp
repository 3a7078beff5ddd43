#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <ostream>
#include <set>

#include "app/offscreen.h"
#include "film/display.h"
#include "film/image_file.h"
#include "scene/fields.h"
#include "scene/scene_file.h"
#include "viewer/layout.h"

namespace glimt {
namespace {

using testing::Offscreen;

constexpr int image_width = 96, image_height = 72, zoom = 6;
constexpr int window_width = image_width * zoom + 320, window_height = image_height * zoom + 400;

/// The report's room, small, with the Oren-Nayar sphere at its roughness of 0.6.
Scene small_room(int spp = 4) {
  const std::vector<std::string> small{"image.width=96", "image.height=72", "render.spp=" + std::to_string(spp)};
  return read_scene(std::filesystem::path(GLIMT_SCENES) / "report.toml", small);
}

std::size_t sphere_index(const Scene& scene, const std::string& name) {
  for (std::size_t i = 0; i < scene.spheres.size(); ++i) {
    if (scene.spheres[i].name == name) return i;
  }
  throw std::runtime_error("no sphere called " + name);
}

const Material& material_of(const Scene& scene, const std::string& sphere) {
  return *find_material(scene, scene.spheres[sphere_index(scene, sphere)].material);
}

/// The picture's pixels as they are on the screen, one of each magnified square.
std::vector<std::array<int, 3>> picture(const Offscreen& window) {
  const Rect r = window.widget("image");
  const float size = r.width / image_width;
  std::vector<std::array<int, 3>> pixels;
  for (int y = 0; y < image_height; ++y) {
    for (int x = 0; x < image_width; ++x) {
      pixels.push_back(window.pixel(static_cast<int>(r.x + (static_cast<float>(x) + 0.5F) * size),
                                    static_cast<int>(r.y + (static_cast<float>(y) + 0.5F) * size)));
    }
  }
  return pixels;
}

/// The same from the rendered frame, without any window.
std::vector<std::array<int, 3>> expected_picture(const ViewerState& state) {
  const auto bytes = to_srgb8(state.frame->mean, state.display);
  std::vector<std::array<int, 3>> pixels;
  for (std::size_t i = 0; i < bytes.size(); i += 3) pixels.push_back({bytes[i], bytes[i + 1], bytes[i + 2]});
  return pixels;
}

double mean_brightness(const std::vector<std::array<int, 3>>& pixels) {
  double sum = 0;
  for (const auto& p : pixels) sum += p[0] + p[1] + p[2];
  return sum / static_cast<double>(3 * pixels.size());
}

TEST(Viewer, ShowsTheRenderedPicturePixelByPixel) {
  Offscreen window(small_room(), window_width, window_height);
  ASSERT_TRUE(window.draw_until_finished());
  EXPECT_EQ(window.state().frame->samples, 4);
  EXPECT_EQ(window.widget("image").width, image_width * zoom);
  const auto shown = picture(window);
  EXPECT_EQ(shown, expected_picture(window.state()));
  EXPECT_GT(std::set(shown.begin(), shown.end()).size(), 500U) << "a picture of the room has many colours";
}

TEST(Viewer, ExposureBrightensWithoutRestart) {
  Offscreen window(small_room(), window_width, window_height);
  ASSERT_TRUE(window.draw_until_finished());
  const auto frame = window.state().frame;
  const double before = mean_brightness(picture(window));
  window.drag("exposure", 0.75F);
  EXPECT_NEAR(window.state().display.exposure, 4, 0.3);  // three quarters of the way from -8 to 8
  EXPECT_GT(mean_brightness(picture(window)), 1.5 * before);
  EXPECT_EQ(picture(window), expected_picture(window.state()));
  EXPECT_EQ(window.state().frame, frame) << "exposure must not render anything anew";
}

TEST(Viewer, RoughnessSliderRendersAnew) {
  Offscreen window(small_room(16), window_width, window_height);
  ASSERT_TRUE(window.draw_until_finished());
  const auto before = picture(window);
  const auto version = window.state().version;
  window.drag("sphere.oren-nayar.material.roughness", 1);
  EXPECT_NEAR(material_of(window.state().scene, "oren-nayar").roughness, std::numbers::pi / 2, 0.02);
  EXPECT_GT(window.state().version, version);
  ASSERT_TRUE(window.draw_until_finished());
  EXPECT_EQ(picture(window), expected_picture(window.state()));

  // A path that misses the sphere is the same as before, bit for bit, so the picture of the sphere itself must change
  // most.
  const Scene& scene = window.state().scene;
  const Sphere& sphere = scene.spheres[sphere_index(scene, "oren-nayar")];
  const glm::dvec3 seen = sphere.center - scene.camera.eye;  // the camera looks along x, with z to its right
  const double pixels = image_height / 2.0 / std::tan(scene.camera.fov_y * std::numbers::pi / 360);
  const int x = static_cast<int>(image_width / 2.0 + seen.z / seen.x * pixels);
  const int y = static_cast<int>(image_height / 2.0 - seen.y / seen.x * pixels);
  const auto after = picture(window);
  const auto mean_change = [&](int x0, int y0, int size) {
    double sum = 0;
    for (int v = y0; v < y0 + size; ++v) {
      for (int u = x0; u < x0 + size; ++u) {
        const auto i = static_cast<std::size_t>(v * image_width + u);
        for (std::size_t c = 0; c < 3; ++c) sum += std::abs(after[i][c] - before[i][c]);
      }
    }
    return sum / (3.0 * size * size);
  };
  EXPECT_GT(mean_change(x - 2, y - 2, 5), 4 * mean_change(2, 2, 15))
      << "middle of the sphere against a corner of the room";
}

TEST(Viewer, MenuSwitchesTheMaterialOfOneSphere) {
  Offscreen window(small_room(), window_width, window_height);
  ASSERT_TRUE(window.draw_until_finished());
  const Scene before = window.state().scene;
  const auto shown_before = picture(window);
  const std::string shared = material_of(before, "lambertian").name;

  window.press("sphere.lambertian.material");
  window.press("sphere.lambertian.material.mirror");
  const Scene& after = window.state().scene;
  EXPECT_EQ(material_of(after, "lambertian").type, MaterialType::mirror);
  EXPECT_EQ(material_of(after, "lambertian").name, "lambertian") << "a copy of its own, named after the sphere";
  EXPECT_EQ(*find_material(after, shared), *find_material(before, shared)) << "others wear it too";
  EXPECT_EQ(after.polygons, before.polygons);
  EXPECT_EQ(after.meshes, before.meshes);

  ASSERT_TRUE(window.draw_until_finished());
  EXPECT_NE(picture(window), shown_before);
  EXPECT_EQ(picture(window), expected_picture(window.state()));
}

TEST(Viewer, EveryTypeShowsItsParameters) {
  Offscreen window(small_room(), window_width, window_height + 400);
  window.draw();
  for (const auto& info : material_infos()) {
    if (info.type == MaterialType::lambertian) continue;
    window.press("sphere.lambertian.material");
    window.press("sphere.lambertian.material." + std::string(info.name));
    EXPECT_EQ(material_of(window.state().scene, "lambertian").type, info.type);
    for (const auto& field : info.fields) {
      EXPECT_TRUE(window.widgets().contains("sphere.lambertian.material." + std::string(field.key)))
          << info.name << " " << field.key;
    }
  }
}

TEST(Viewer, SampleTargetGoesOnAndShadowRaysRestart) {
  Offscreen window(small_room(), window_width, window_height);
  ASSERT_TRUE(window.draw_until_finished());
  const auto version = window.state().frame->version;
  window.press("render.spp", 5.0F / 24);  // logarithmic to 2^24: 2^5
  EXPECT_EQ(window.state().scene.render.spp, 32);
  ASSERT_TRUE(window.draw_until([&] { return window.state().frame->samples == 32; }));
  EXPECT_EQ(window.state().frame->version, version) << "a new target goes on with the samples there are";

  window.press("render.shadow_rays", 0.5F);
  EXPECT_NEAR(window.state().scene.render.shadow_rays, 32, 2);
  EXPECT_GT(window.state().version, version);
}

TEST(Viewer, PauseAndRestart) {
  Offscreen window(small_room(1 << 20), window_width, window_height);
  ASSERT_TRUE(window.draw_until([&] { return window.state().frame && window.state().frame->samples > 2; }));
  window.press("pause");
  EXPECT_TRUE(window.state().paused);
  window.press("pause");
  EXPECT_FALSE(window.state().paused);
  const auto version = window.state().frame->version;
  window.press("restart");
  EXPECT_TRUE(window.draw_until([&] { return window.state().frame->version > version; }));
}

TEST(Viewer, RefusedEditSaysWhyAndLosesNothing) {
  Scene scene = small_room();
  Sphere intruder = scene.spheres[sphere_index(scene, "glass")];  // overlaps the glass sphere
  intruder.name = "intruder";
  intruder.center.x += intruder.radius;
  intruder.material = material_of(scene, "lambertian").name;
  scene.spheres.push_back(intruder);
  Offscreen window(scene, window_width, window_height);
  ASSERT_TRUE(window.draw_until_finished());
  const auto frame = window.state().frame;

  window.press("sphere.intruder.material");
  window.press("sphere.intruder.material.glass");
  EXPECT_TRUE(window.state().message.error);
  EXPECT_NE(window.state().message.text, "");
  EXPECT_EQ(window.state().message.text.find('\n'), std::string::npos);
  EXPECT_EQ(window.state().scene, scene);
  EXPECT_EQ(window.state().frame, frame);
  const Rect line = window.widget("message");
  bool red = false;
  for (int y = static_cast<int>(line.y); y < static_cast<int>(line.y + line.height); ++y) {
    for (int x = 12; x < 200; ++x) {
      const auto [r, g, b] = window.pixel(x, y);
      red |= r > 180 && r > g + 60;
    }
  }
  EXPECT_TRUE(red) << "the message stands in red below the picture";

  window.press("sphere.intruder.material");
  window.press("sphere.intruder.material.mirror");
  EXPECT_EQ(window.state().message.text, "") << "an edit that is accepted clears it";
}

TEST(Viewer, SceneFileThatCannotBeReadLosesNothing) {
  Offscreen window(small_room(), window_width, window_height);
  ASSERT_TRUE(window.draw_until_finished());
  const Scene before = window.state().scene;
  const auto file = std::filesystem::path(::testing::TempDir()) / ("glimt_bad_" + std::to_string(getpid()) + ".toml");
  std::ofstream(file) << "name = 1\n";
  Edits edits;
  edits.open = file;
  window.controller().apply(edits);
  EXPECT_TRUE(window.state().message.error);
  EXPECT_TRUE(window.state().message.text.starts_with(file.string() + ":1:")) << window.state().message.text;
  EXPECT_EQ(window.state().scene, before);

  edits.open = std::filesystem::path(GLIMT_SCENES) / "cornell.toml";
  window.controller().apply(edits);
  EXPECT_FALSE(window.state().message.error);
  EXPECT_NE(window.state().scene, before);
  std::filesystem::remove(file);
}

/// Window sizes, scales and framebuffer ratios.
struct Size {
  int width, height;
  float scale;
  int ratio;
};

void PrintTo(const Size& size, std::ostream* out) {
  *out << size.width << "x" << size.height << ", scale " << size.scale << ", ratio " << size.ratio;
}

class Fit : public ::testing::TestWithParam<Size> {};

TEST_P(Fit, NothingOverlapsOrSticksOut) {
  const auto [width, height, scale, ratio] = GetParam();
  Offscreen window(small_room(), width, height, scale, ratio);
  ASSERT_TRUE(window.draw_until_finished());
  const Layout layout = make_layout(static_cast<float>(width), static_cast<float>(height), scale);
  const Rect image = window.widget("image");
  EXPECT_GE(image.x, 0);
  EXPECT_GE(image.y, 0);
  EXPECT_LE(image.x + image.width, layout.column.x);
  EXPECT_LE(image.y + image.height, layout.status.y);
  EXPECT_NEAR(image.width / image.height, 96.0 / 72, 1e-3);
  EXPECT_TRUE(image.width > 0.89F * layout.image.width || image.height > 0.89F * layout.image.height)
      << "fills the space";

  const auto& widgets = window.widgets();
  for (const auto& [name, r] : widgets) {
    if (name == "image" || name == "message") continue;
    EXPECT_GE(r.x, layout.column.x) << name;
    EXPECT_LE(r.x + r.width, static_cast<float>(width)) << name;
    EXPECT_GT(r.width, 15 * scale) << name << " is too narrow to be used";
    for (const auto& [other, s] : widgets) {
      if (other <= name || other == "image" || other == "message") continue;
      const bool apart = r.x + r.width <= s.x || s.x + s.width <= r.x || r.y + r.height <= s.y || s.y + s.height <= r.y;
      EXPECT_TRUE(apart) << name << " and " << other;
    }
  }
  EXPECT_LE(window.widget("snapshot").y, static_cast<float>(height));
}

INSTANTIATE_TEST_SUITE_P(Sizes, Fit,
                         ::testing::Values(Size{1280, 800, 1, 1}, Size{800, 600, 1, 1}, Size{2560, 1600, 2, 1},
                                           Size{1600, 1200, 2, 1}, Size{1280, 800, 1, 2}));

TEST(Snapshot, HoldsWhatTheWindowShowedAndReplacesNothing) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / ("glimt_snapshot_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const auto old_folder = std::filesystem::current_path();
  std::filesystem::current_path(folder);
  std::ofstream("picture-001.png") << "precious";
  {
    Offscreen window(small_room(), window_width, window_height);
    ASSERT_TRUE(window.draw_until_finished());
    window.drag("sphere.oren-nayar.material.roughness", 0.25F);
    ASSERT_TRUE(window.draw_until_finished());
    window.press("snapshot");
    ASSERT_TRUE(window.draw_until([&] { return !window.state().message.text.empty(); }));
    EXPECT_FALSE(window.state().message.error) << window.state().message.text;
    EXPECT_NE(window.state().message.text.find("picture-002.png"), std::string::npos) << window.state().message.text;

    const Metadata data = read_metadata("picture-002.png");
    EXPECT_EQ(parse_scene(data.at("scene"), "snapshot"), window.state().scene);
    EXPECT_EQ(data.at("samples"), "4");
    EXPECT_EQ(data.at("seed"), "1");
    EXPECT_EQ(data.at("version"), GLIMT_VERSION);
  }
  std::string kept;
  std::ifstream("picture-001.png") >> kept;
  EXPECT_EQ(kept, "precious");
  std::filesystem::current_path(old_folder);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace glimt
