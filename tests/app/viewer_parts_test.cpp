#include <gtest/gtest.h>

#include <string>

#include "film/display.h"
#include "film/image_file.h"
#include "viewer/colour.h"
#include "viewer/edit.h"
#include "viewer/labels.h"
#include "viewer/layout.h"
#include "viewer/snapshot.h"

/// The parts of the window that need no OpenGL.
namespace glimt {
namespace {

TEST(Snapshot, NamesTheFolderThatCannotBeWritten) {
  try {
    reserve_snapshot_file("/proc/nowhere", "picture", "png");
    FAIL() << "nothing can be written there";
  } catch (const ImageFileError& error) {
    EXPECT_NE(std::string(error.what()).find("/proc/nowhere"), std::string::npos) << error.what();
  }
}

TEST(Edit, SharedMaterialIsCopiedUnderAnUnusedName) {
  Scene scene;
  scene.materials = {Material{.name = "white"}, Material{.name = "ball"}};
  scene.spheres = {Sphere{.name = "ball", .material = "white"}, Sphere{.name = "other", .material = "white"}};
  Material glass{.name = "any", .type = MaterialType::glass};
  set_material(scene, {ObjectKind::sphere, 0}, glass);
  ASSERT_EQ(scene.spheres[0].material, "ball-2") << "\"ball\" is taken";
  EXPECT_EQ(find_material(scene, "ball-2")->type, MaterialType::glass);
  EXPECT_EQ(find_material(scene, "white")->type, MaterialType::lambertian);

  set_material(scene, {ObjectKind::sphere, 0}, Material{.name = "any", .type = MaterialType::mirror});
  EXPECT_EQ(scene.materials.size(), 3U) << "its own by now";
  EXPECT_EQ(find_material(scene, "ball-2")->type, MaterialType::mirror);
}

TEST(Layout, PicturesAreMagnifiedByWholeNumbersWhereThatCostsLittle) {
  const Placement doubled = place_image(400, 400, {0, 0, 960, 800}, 1);
  EXPECT_EQ(doubled.zoom, 2);
  EXPECT_TRUE(doubled.whole);
  EXPECT_EQ(doubled.rect.x, 80);
  const Placement uneven = place_image(400, 400, {0, 0, 600, 600}, 1);  // 1 instead of 1.5 would cost a third
  EXPECT_EQ(uneven.zoom, 1.5F);
  EXPECT_FALSE(uneven.whole);
  const Placement shrunk = place_image(1920, 1080, {0, 0, 960, 800}, 1);
  EXPECT_EQ(shrunk.zoom, 0.5F);
  EXPECT_FALSE(shrunk.whole);
  EXPECT_EQ(place_image(400, 400, {0, 0, 400, 400}, 2).zoom, 2) << "framebuffer pixels count";
}

TEST(Colour, SwatchesLookAsInThePicture) {
  for (int code = 0; code < 256; ++code) {
    const double linear = linear_from_srgb(code / 255.0);
    EXPECT_NEAR(255 * srgb_from_linear(linear), code, 1e-9);
    const auto value = static_cast<float>(linear);
    EXPECT_EQ(to_srgb8(Image{1, 1, {value, value, value}}, {})[0], code);
  }
}

TEST(Labels, AreWords) {
  EXPECT_EQ(label_of("shadow_rays"), "Shadow rays");
  EXPECT_EQ(label_of("oren-nayar"), "Oren-Nayar");
  EXPECT_EQ(label_of("ior"), "Refractive index");
  EXPECT_EQ(unit_of("roughness"), "rad");
  EXPECT_EQ(unit_of("shadow_rays"), "");
}

}  // namespace
}  // namespace glimt
