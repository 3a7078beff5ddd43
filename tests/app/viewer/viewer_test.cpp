#include <stb_image.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <numbers>
#include <ostream>
#include <set>

#include "app/own_folder.h"
#include "app/viewer/offscreen.h"
#include "film/display.h"
#include "film/image_file.h"
#include "material/oren_nayar.h"
#include "scene/fields.h"
#include "scene/file/scene_file.h"
#include "viewer/state/edit.h"
#include "viewer/widgets/layout.h"

namespace glimt {
namespace {

using testing::apart;
using testing::Offscreen;
using testing::small_room;

constexpr int image_width = 96, image_height = 72, zoom = 6;
constexpr int window_width = image_width * zoom + 352, window_height = image_height * zoom + 400;

std::size_t sphere_index(const Scene& scene, const std::string& name) {
  for (std::size_t i = 0; i < scene.spheres.size(); ++i) {
    if (scene.spheres[i].name == name) return i;
  }
  throw std::runtime_error("no sphere called " + name);
}

const Material& material_of(const Scene& scene, const std::string& sphere) {
  return *find_material(scene, scene.spheres[sphere_index(scene, sphere)].material);
}

/// Selects an object, or none: no outline is then on the picture.
void select(Offscreen& window, const std::optional<ObjectId>& object) {
  Edits edits;
  edits.select = object;
  window.apply(edits);
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

// Whatever is in the framebuffer stays there.
TEST(Viewer, PicturesThatLookTheSameArePaintedOnce) {
  Offscreen window(small_room(), window_width, window_height);
  ASSERT_TRUE(window.draw_until_finished());
  const auto before = picture(window);
  const std::vector<std::array<int, 3>> black(before.size());
  ASSERT_NE(before, black);
  glClearColor(0, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  window.draw();
  EXPECT_EQ(picture(window), black);
  window.screen().forget_picture();
  window.draw();
  EXPECT_EQ(picture(window), before);
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
  window.press("object.oren-nayar");
  window.drag("object.roughness", 1);
  select(window, std::nullopt);
  EXPECT_NEAR(material_of(window.state().scene, "oren-nayar").get(OrenNayar::roughness), std::numbers::pi / 2, 0.02);
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

  window.press("object.lambertian");
  window.press("object.type");
  window.press("object.type.mirror");
  select(window, std::nullopt);
  const Scene& after = window.state().scene;
  EXPECT_EQ(material_of(after, "lambertian").type, "mirror");
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
  window.press("object.lambertian");
  for (const auto& info : material_infos()) {
    if (info.name == "lambertian") continue;
    window.press("object.type");
    window.press("object.type." + std::string(info.name));
    EXPECT_EQ(material_of(window.state().scene, "lambertian").type, info.name);
    for (const auto& field : info.fields) {
      EXPECT_TRUE(window.widgets().contains("object." + std::string(field.key))) << info.name << " " << field.key;
    }
  }
}

TEST(Viewer, SampleTargetGoesOnAndShadowRaysRestart) {
  Offscreen window(small_room(), window_width, window_height);
  ASSERT_TRUE(window.draw_until_finished());
  const auto version = window.state().frame->version;
  window.press("stop_at.number", 0.23F);  // logarithmic from 1 to 2^24 between the ends of the grab: 2^5
  EXPECT_EQ(window.state().scene.render.spp, 32);
  ASSERT_TRUE(window.draw_until([&] { return window.state().frame->samples == 32; }));
  EXPECT_EQ(window.state().frame->version, version) << "a new target goes on with the samples there are";

  window.press("tab.estimator");
  window.press("render.shadow_rays", 0.5F);
  EXPECT_NEAR(window.state().scene.render.shadow_rays, 32, 2);
  EXPECT_GT(window.state().version, version);
}

TEST(Viewer, PictureFollowsTheWindow) {
  const Scene room = small_room(2);
  Offscreen window(room, window_width, window_height);
  Edits fit;
  fit.fits_window = true;
  window.apply(fit);
  const auto is_pixel_by_pixel = [&] {
    const Rect r = window.widget("image");
    const ImageSize size = window.state().frame->size;
    return size == window.state().room && r.width == static_cast<float>(size.width) &&
           r.height == static_cast<float>(size.height);
  };
  ASSERT_TRUE(window.draw_until_finished());
  EXPECT_TRUE(is_pixel_by_pixel());
  EXPECT_EQ(*window.state().filed, room) << "the file's size stays";
  EXPECT_FALSE(window.state().can_undo);

  // While the window is dragged larger and smaller nothing is rendered anew; once it rests, the picture is.
  const auto version = window.state().version;
  for (int k = 1; k <= 10; ++k) {
    ImGui::GetIO().DisplaySize = {static_cast<float>(window_width - 10 * k), static_cast<float>(window_height - k)};
    window.draw(1);
  }
  EXPECT_EQ(window.state().version, version);
  ASSERT_TRUE(window.draw_until([&] { return window.state().version != version; }));
  ASSERT_TRUE(window.draw_until_finished());
  EXPECT_TRUE(is_pixel_by_pixel());

  fit.fits_window = false;
  window.apply(fit);
  EXPECT_EQ(window.state().scene.image, room.image) << "as in the file";
}

// The file's target is for the command line: the window renders past it, and leaves it as it is.
TEST(Viewer, GoesOnPastTheFilesTargetUntilATargetIsSet) {
  const Scene room = small_room(4);
  Offscreen window(room, window_width, window_height);
  window.set_goal([](RenderGoal& goal) { goal = {}; });
  ASSERT_TRUE(window.draw_until([&] { return window.state().frame && window.state().frame->samples > 8; }));
  EXPECT_FALSE(window.state().frame->finished);
  EXPECT_TRUE(window.widgets().contains("trend")) << "no bar, as there is no end";
  EXPECT_EQ(*window.state().filed, room);

  window.press("stop_at");
  window.press("stop_at.samples");
  EXPECT_FALSE(window.widgets().contains("trend"));
  ASSERT_TRUE(window.draw_until([&] { return window.state().frame->finished; }));
  EXPECT_EQ(*window.state().filed, room);
  window.press("undo");
  EXPECT_EQ(window.state().goal.stop_at, StopAt::never);
  EXPECT_TRUE(window.draw_until([&] { return !window.state().frame->finished; })) << "and it goes on";
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

/// The colour of an error is somewhere in the status line.
bool says_error(const Offscreen& window) {
  const Rect line = window.widget("message");
  for (int y = static_cast<int>(line.y); y < static_cast<int>(line.y + line.height); ++y) {
    for (int x = 12; x < 200; ++x) {
      const auto [r, g, b] = window.pixel(x, y);
      if (r > 180 && r > g + 60) return true;
    }
  }
  return false;
}

TEST(Viewer, RefusedEditSaysWhyAndLosesNothing) {
  const Scene scene = small_room();
  Offscreen window(scene, window_width, window_height);
  ASSERT_TRUE(window.draw_until_finished());
  const auto frame = window.state().frame;

  Edits edits;
  edits.edit(window.state()).camera.look_at = scene.camera.eye;
  window.apply(edits);
  EXPECT_TRUE(window.state().message.error);
  EXPECT_NE(window.state().message.text.find("look_at"), std::string::npos) << window.state().message.text;
  EXPECT_EQ(window.state().scene, scene);
  EXPECT_FALSE(window.state().can_undo);
  EXPECT_EQ(window.state().frame, frame);
  EXPECT_TRUE(says_error(window));

  window.press("object.lambertian");
  window.press("object.type");
  window.press("object.type.mirror");
  EXPECT_EQ(window.state().message.text, "") << "an edit that is accepted clears it";
}

TEST(Viewer, MaterialThatAShapeCannotBeIsGreyed) {
  Offscreen window(small_room(), window_width, window_height);
  ASSERT_TRUE(window.draw_until_finished());
  const ObjectId lamp = lamps_of(window.state().scene).at(0);
  select(window, lamp);
  const Scene before = window.state().scene;
  window.press("object.type");
  window.press("object.type.glass");
  EXPECT_EQ(window.state().scene, before) << "a polygon is open";
  EXPECT_FALSE(window.state().message.error) << "it was not even tried";
  window.press("object.type.mirror");  // the menu is still there
  EXPECT_EQ(find_material(window.state().scene, material_name_of(window.state().scene, lamp))->type, "mirror");
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

/// Not in the column of controls.
bool is_elsewhere(const std::string& name) { return name == "image" || name == "message" || name.starts_with("says."); }

/// All that is drawn now lies in its part of the window, whole, and touches nothing else.
void expect_fit(const Offscreen& window, const Layout& layout, float scale) {
  const float right = layout.column.x + layout.column.width, bottom = layout.column.y + layout.column.height;
  const auto& widgets = window.widgets();
  for (const auto& [name, r] : widgets) {
    EXPECT_FALSE(name.starts_with("cut.")) << name;
    if (is_elsewhere(name)) continue;
    EXPECT_GE(r.x, layout.column.x) << name;
    EXPECT_LE(r.x + r.width, right) << name;
    EXPECT_LE(r.y + r.height, bottom) << name << " sticks out below";
    EXPECT_GT(r.width, 15 * scale) << name << " is too narrow to be used";
    for (const auto& [other, s] : widgets)
      EXPECT_TRUE(other <= name || is_elsewhere(other) || apart(r, s)) << name << " and " << other;
  }
}

void save_screenshot(const Offscreen& window, const std::string& name, const Size& size) {
  testing::save_screenshot(window, name + "-" + std::to_string(size.width) + "x" + std::to_string(size.height) + "-" +
                                       std::to_string(static_cast<int>(size.scale) * size.ratio) +
                                       (size.ratio > 1 ? "r" : ""));
}

TEST_P(Fit, NothingOverlapsOrSticksOut) {
  const Size size = GetParam();
  const auto [width, height, scale, ratio] = size;
  const bool pictures = std::getenv("GLIMT_SCREENSHOTS") != nullptr;
  const std::vector<std::string> large{"image.width=768", "image.height=768", "render.spp=64"};
  Offscreen window(pictures ? read_scene(GLIMT_SCENES "/report.toml", large) : small_room(), width, height, scale,
                   ratio);
  ASSERT_TRUE(window.draw_until_finished());
  const Layout layout = make_layout(static_cast<float>(width), static_cast<float>(height), scale);
  const Rect image = window.widget("image");
  EXPECT_GE(image.x, 0);
  EXPECT_GE(image.y, 0);
  EXPECT_LE(image.x + image.width, layout.column.x);
  EXPECT_LE(image.y + image.height, layout.status.y);
  EXPECT_TRUE(image.width > 0.89F * layout.image.width || image.height > 0.89F * layout.image.height)
      << "fills the space";
  expect_fit(window, layout, scale);
  save_screenshot(window, "start", size);
  for (std::size_t i = 0; i < window.state().scene.spheres.size(); ++i) {
    select(window, ObjectId{ObjectKind::sphere, i});
    expect_fit(window, layout, scale);
    save_screenshot(window, "sphere" + std::to_string(i), size);
  }
  for (const char* tab : {"lamp", "camera", "estimator", "scene"}) {
    window.press(std::string("tab.") + tab);
    expect_fit(window, layout, scale);
    save_screenshot(window, tab, size);
  }
  Edits edits;
  edits.display = Display{.view = View::error};
  window.apply(edits);
  ASSERT_TRUE(window.draw_until([&] { return !window.state().frame->error.rgb.empty(); }));
  expect_fit(window, layout, scale);
  save_screenshot(window, "error", size);
}

TEST_P(Fit, SheetsLieOnThePicture) {
  const Size size = GetParam();
  Offscreen window(small_room(), size.width, size.height, size.scale, size.ratio);
  ASSERT_TRUE(window.draw_until_finished());
  window.key({key_f1});
  save_screenshot(window, "help", size);
  window.key({key_f1});
  for (const auto purpose : {FilePurpose::open, FilePurpose::save}) {
    Edits edits;
    edits.folder = GLIMT_SCENES;
    window.apply(edits);
    edits.choose_file = purpose;
    window.ask(edits);
    save_screenshot(window, purpose == FilePurpose::open ? "open" : "save", size);
    const Rect cancel = window.widget("files.cancel");
    EXPECT_LE(cancel.x + cancel.width, make_layout(static_cast<float>(size.width), 0, size.scale).column.x);
    EXPECT_LE(cancel.y + cancel.height, static_cast<float>(size.height));
    EXPECT_TRUE(window.widgets().contains("files.cornell.toml"));
    window.press("files.cancel");
    EXPECT_FALSE(window.widgets().contains("files.cancel"));
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Fit,
                         ::testing::Values(Size{1280, 800, 1, 1}, Size{1920, 1080, 1, 1}, Size{2560, 1600, 2, 1},
                                           Size{3840, 2160, 2, 1}, Size{1280, 800, 1, 2}));

using WindowSnapshot = testing::OwnFolder;

/// Colours of a picture of image_width x image_height pixels.
std::vector<std::array<int, 3>> png_picture(const std::filesystem::path& file) {
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> bytes(
      stbi_load(file.c_str(), &width, &height, &channels, 3), &stbi_image_free);
  EXPECT_TRUE(bytes && width == image_width && height == image_height) << file;
  std::vector<std::array<int, 3>> pixels;
  for (int i = 0; bytes && i < 3 * width * height; i += 3)
    pixels.push_back({bytes.get()[i], bytes.get()[i + 1], bytes.get()[i + 2]});
  return pixels;
}

TEST_F(WindowSnapshot, IsWhatIsOnTheScreenDitheredOrNot) {
  Offscreen window(small_room(), window_width, window_height);
  ASSERT_TRUE(window.draw_until_finished());
  const auto dithered = picture(window);
  for (const bool dither : {true, false}) {
    if (!dither) window.press("display.dither");
    const auto shown = picture(window);
    EXPECT_EQ(shown == dithered, dither);
    const std::string file = dither ? "picture-001.png" : "picture-002.png";
    window.press("snapshot");
    ASSERT_TRUE(window.draw_until([&] { return window.state().message.text.find(file) != std::string::npos; }));
    EXPECT_EQ(png_picture(file), shown);
  }
}

TEST_F(WindowSnapshot, HoldsWhatTheWindowShowedAndReplacesNothing) {
  std::ofstream("picture-001.png") << "precious";
  {
    Offscreen window(small_room(), window_width, window_height);
    ASSERT_TRUE(window.draw_until_finished());
    window.press("object.oren-nayar");
    window.drag("object.roughness", 0.25F);
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
}

}  // namespace
}  // namespace glimt
