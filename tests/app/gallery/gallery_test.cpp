// The pictures in docs/gallery, which README.md and docs/ show. Each holds what it is of: the scene, the version and
// the names of the controls in it. The tests draw the same views, quickly and so with much noise, and fail where a
// picture is of something else. `tests/gallery` makes the pictures anew: this program with GLIMT_GALLERY=FOLDER.
#include <algorithm>
#include <set>

#include "app/chart_view/chart_window.h"

namespace glimt {
namespace {

namespace fs = std::filesystem;
using testing::Offscreen;

const fs::path gallery = fs::path(GLIMT_TESTS_DIR).parent_path() / "docs/gallery";

/// A picture of the window: the scene, the samples that it is rendered to, and what a person then does.
struct View {
  const char* name;
  const char* scene;
  int spp;
  void (*doings)(Offscreen& window);
};

void press(Offscreen& window, char key) { window.key({key}); }

/// A setting of the display as its control changes it.
void show(Offscreen& window, ::glimt::View view) {
  Edits edits;
  edits.display = window.state().display;
  edits.display->view = view;
  window.apply(edits);
}

void compare_with_another_sampler(Offscreen& window) {
  press(window, 'h');
  window.edit([](Scene& scene) { scene.render.sampler = Sampler::sobol; });
  ASSERT_TRUE(window.draw_until_finished());
  press(window, 'i');
  Edits edits;
  edits.compare = window.state().compare;
  edits.compare->view = CompareView::relative;
  window.apply(edits);
  const ImageSize size = window.state().scene.image;
  ImGui::GetIO().MousePos =
      window.in_window(static_cast<float>(size.width) * 0.7F, static_cast<float>(size.height) / 2);
}

void select_a_metal_ball(Offscreen& window) {
  Edits edits;
  edits.select = ObjectId{ObjectKind::sphere, 0};
  window.apply(edits);
}

constexpr View views[]{
    {"window", "report.toml", 160, [](Offscreen&) {}},
    {"window-glossy", "glossy.toml", 64, select_a_metal_ball},
    {"window-estimator", "report.toml", 64, [](Offscreen& window) { window.press("tab.estimator"); }},
    {"window-error", "report.toml", 64, [](Offscreen& window) { show(window, ::glimt::View::error); }},
    {"window-chart", "report.toml", 24,
     [](Offscreen& window) {
       window.press("tab.estimator");
       testing::show_chart(window);
       testing::visit(window);
     }},
    {"window-compare", "report.toml", 64, compare_with_another_sampler},
    {"window-help", "report.toml", 64, [](Offscreen& window) { window.key({key_f1}); }},
    {"window-scene", "report.toml", 64, [](Offscreen& window) { window.press("tab.scene"); }},
    {"window-outside", "report.toml", 64,
     [](Offscreen& window) {
       window.press("tab.camera");
       window.edit([](Scene& scene) {
         scene.camera.cutaway = Cutaway::on;
         scene.camera.eye = {-7, 5, 4};
         scene.camera.look_at = {5, 0, 0};
       });
     }},
};

/// What a view's picture says that it is of. The controls of the chart's curves are named by number, and there may be
/// more or fewer of them.
Metadata shown_in(const View& view, const Offscreen& window) {
  std::set<std::string> names;
  for (const auto& [name, rect] : window.widgets())
    if (!name.starts_with("curve.")) names.insert(name);
  std::string controls;
  for (const std::string& name : names) controls += name + '\n';
  return {{"scene", write_scene(read_scene(fs::path(GLIMT_SCENES) / view.scene))},
          {"version", GLIMT_VERSION},
          {"controls", controls}};
}

class Gallery : public ::testing::TestWithParam<View> {};

TEST_P(Gallery, PicturesAreOfTheWindowAsItIs) {
  const View& view = GetParam();
  const char* folder = std::getenv("GLIMT_GALLERY");
  const std::vector<std::string> samples{"render.spp=" + std::to_string(folder != nullptr ? view.spp : 2)};
  Offscreen window(read_scene(fs::path(GLIMT_SCENES) / view.scene, samples), 1120, 700);
  window.draw();
  Edits fit;
  fit.fits_window = true;
  fit.display = Display{.dither = Dither::off};  // which would make the files twice as large
  window.apply(fit);
  ASSERT_TRUE(window.draw_until_finished());
  view.doings(window);
  ASSERT_TRUE(window.draw_until_finished());
  window.draw(10);
  const Metadata now = shown_in(view, window);
  const std::string file = std::string(view.name) + ".png";
  if (folder != nullptr) {
    window.save(fs::path(folder) / file, now);
    return;
  }
  Metadata then = read_metadata(gallery / file);
  for (const auto& [key, value] : now)
    EXPECT_EQ(then[key], value) << "docs/gallery/" << file << " is older than what it shows: run tests/gallery";
}

INSTANTIATE_TEST_SUITE_P(Views, Gallery, ::testing::ValuesIn(views), [](const auto& view) {
  std::string name = view.param.name;
  std::ranges::replace(name, '-', '_');
  return name;
});

TEST(GalleryChart, IsOfTheSceneAsItIs) {
  if (std::getenv("GLIMT_GALLERY") != nullptr) return;
  const std::string svg = read_file(gallery / "chart.svg");
  const std::size_t begin = svg.find("<metadata>") + 10, end = svg.find("</metadata>");
  ASSERT_LT(begin, end) << "docs/gallery/chart.svg does not say what it is of: run tests/gallery";
  EXPECT_EQ(svg.substr(begin, end - begin),
            "glimt " GLIMT_VERSION "\n" + write_scene(read_scene(GLIMT_SCENES "/hexagon.toml")))
      << "docs/gallery/chart.svg is older than what it shows: run tests/gallery";
}

TEST(Gallery, HasNoOtherPictures) {
  if (std::getenv("GLIMT_GALLERY") != nullptr) return;
  std::set<std::string> made{"chart.svg"}, there;
  for (const View& view : views) made.insert(std::string(view.name) + ".png");
  for (const auto& entry : fs::directory_iterator(gallery)) there.insert(entry.path().filename().string());
  EXPECT_EQ(there, made);
}

}  // namespace
}  // namespace glimt
