// glimt check: pictures with known mistakes, made on purpose.
#include <cmath>

#include "app/cli/cli_test.h"
#include "check/block_difference.h"
#include "film/image_file.h"
#include "pictures.h"
#include "scene/file/scene_file.h"

using namespace glimt;

namespace {

class Check : public CommandLine {
 protected:
  /// A picture of the scene, with other random numbers than those of the check.
  Image rendered(const Arguments& options = {}) const {
    Arguments all{"render", scene, "-o", "made.pfm", "--size", "96x96", "--spp", "128", "--seed", "99"};
    all.insert(all.end(), options.begin(), options.end());
    const Result result = glimt(all);
    EXPECT_EQ(result.status, 0) << result.err;
    return read_image(folder / "made.pfm");
  }
  Result check(const Image& image, const std::string& what = GLIMT_SCENES "/hexagon.toml") const {
    write_exr(folder / "mine.exr", image, image, {});
    return glimt({"check", "mine.exr", what, "--seconds", "2", "--html", "page.html"});
  }
  static Image changed(Image image, float (*change)(float)) {
    for (float& value : image.rgb) value = change(value);
    return image;
  }
  /// The first explanation is the one, and the exit status says that the picture is wrong.
  static void expect_cause(const Result& result, const std::string& cause) {
    EXPECT_EQ(result.status, 1) << result.out << result.err;
    EXPECT_TRUE(has(result.out, "likely: " + cause)) << result.out;
  }
};

TEST_F(Check, ARightPictureIsRight) {
  const Result result = check(rendered());
  EXPECT_EQ(result.status, 0) << result.out << result.err;
  EXPECT_TRUE(has(result.out, "no difference but noise")) << result.out;
}

TEST_F(Check, MistakesOfTheFinishedPictureAreNamed) {
  const Image image = rendered();
  expect_cause(check(changed(image, [](float v) { return v * 3.14159265F; })), "everything is pi times as bright");
  expect_cause(check(changed(image, [](float v) { return std::pow(v, 1 / 2.2F); })), "gamma 2.2 was applied");
  Image upside_down = image;
  for (int y = 0; y < image.height; ++y)
    std::copy_n(image.pixel(0, y), 3 * image.width, upside_down.pixel(0, image.height - 1 - y));
  expect_cause(check(upside_down), "rows are upside down");
}

TEST_F(Check, MistakesOfTheRenderingAreNamed) {
  expect_cause(check(rendered({"--caustics", "off"})), "caustics are missing");
  expect_cause(check(rendered({"--max-depth", "4"})), "paths end at surface 4");
  expect_cause(check(rendered({"--set", "material.glass.ior=1.33"})), "glass has the index 1.33 of water");
  EXPECT_TRUE(has(read("page.html"), "Schlick")) << "the page lists all that was tried";
}

TEST_F(Check, WhatNoKnownMistakeExplainsIsSaid) {
  Image image = rendered();
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) image.pixel(x, y)[0] += 0.5F;
  const Result result = check(image);
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(has(result.out, "no mistake that glimt knows explains it")) << result.out;
}

TEST_F(Check, PicturesOfAnotherShapeAreRefused) {
  const Result result = check({2, 1, std::vector<float>(6, 1.0F)});
  EXPECT_EQ(result.status, 2);
  EXPECT_TRUE(has(result.err, "which is not the shape of the scene's 400x400")) << result.err;
}

// Pairs of pictures that differ by noise alone: at most 1 in 1000 has a block beyond it, so of 40 none has (a false
// alarm in 4 of 100 choices of seeds, were the spread within a block all that there is).
TEST(BlockDifference, NoiseIsNoDifference) {
  Scene scene = read_scene(GLIMT_SCENES "/hexagon.toml");
  scene.image = {96, 96};
  int beyond = 0;
  double squares = 0;
  constexpr int pairs = 40;
  for (int pair = 0; pair < pairs; ++pair) {
    const auto picture = [&](int seed, int samples) {
      scene.render.seed = seed;
      return render(compile(scene), samples).mean();
    };
    const PictureDifference d = difference_of(picture(2 * pair, 4), picture(2 * pair + 1, 16));
    beyond += d.beyond > 0 ? 1 : 0;
    squares += d.mean_square_z / pairs;
  }
  EXPECT_EQ(beyond, 0);
  EXPECT_NEAR(squares, 1, 0.15);
}

}  // namespace
