// Scenes in which a chosen method cannot hold say so, and scenes in which it can do not.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "compile/compiled_scene.h"
#include "scene/file/scene_file.h"
#include "scene_parts.h"

using namespace glimt;

namespace {

/// A white box with a lamp below its ceiling, far from everything.
Scene lit_box() {
  Scene scene;
  scene.materials = {lambertian("white", dvec3{0.7}), light("lamp", dvec3{5}), mirror("mirror", dvec3{1})};
  scene.polygons = box({-2, 0, -2}, {2, 3, 2}, "white");
  scene.polygons.push_back({"lamp", "lamp", {{-0.5, 2.9, -0.5}, {0.5, 2.9, -0.5}, {0.5, 2.9, 0.5}, {-0.5, 2.9, 0.5}}});
  scene.camera = {{0, 1.5, 1.9}, {0, 1.5, 0}, {0, 1, 0}, 60};
  scene.image = {8, 8};
  return scene;
}

std::vector<std::string> warnings_after(const std::function<void(Scene&)>& edit) {
  Scene scene = lit_box();
  edit(scene);
  return compile(scene).warnings;
}

testing::AssertionResult warns(const std::string& about, const std::function<void(Scene&)>& edit) {
  const std::vector<std::string> all = warnings_after(edit);
  std::string said;
  for (const std::string& w : all) {
    if (w.find(about) != std::string::npos) return testing::AssertionSuccess() << w;
    said += "\n  " + w;
  }
  return testing::AssertionFailure() << "no warning with \"" << about << "\" but:" << said;
}

void move_lamp(Scene& scene, const dvec3& by) {
  for (dvec3& v : scene.polygons[6].vertices) v += by;
}

// Failure: warnings that come with every scene are not read.
TEST(Warnings, ShippedScenesHaveNoneWithDefaultsAndWithTheReportsMethod) {
  for (const std::string name : {"cornell", "furnace", "hexagon", "hexagon_diffuse", "hexagon_empty", "report"}) {
    Scene scene = read_scene(GLIMT_SCENES "/" + name + ".toml");
    for (const Method method : {Method::path, Method::naive, Method::report}) {
      set_method(scene.render, method);
      for (const std::string& w : compile(scene).warnings) ADD_FAILURE() << name << ": " << w;
    }
  }
  EXPECT_TRUE(warnings_after([](Scene&) {}).empty());
}

// Failure: a corner full of bright dots (NearLamp shows it) and nobody knows why.
TEST(Warnings, LampSampledByAreaThatTouchesAReflectingSurface) {
  const auto warns_by_area = [](const std::function<void(Scene&)>& edit) {
    return warns("touches or nearly touches", [&](Scene& s) {
      s.render.light_sampling = LightSampling::area;
      edit(s);
    });
  };
  const auto to_the_wall = [](Scene& s) { move_lamp(s, {1.5, 0, 0}); };
  EXPECT_TRUE(warns_by_area(to_the_wall));
  EXPECT_TRUE(warns_by_area([](Scene& s) { move_lamp(s, {1.495, 0, 0}); })) << "5 mm are too near for 1 m";
  EXPECT_FALSE(warns_by_area([](Scene& s) { move_lamp(s, {1.45, 0, 0}); }));
  EXPECT_TRUE(warns_by_area([](Scene& s) {
    s.spheres.push_back({"ball", "white", {0, 2.6, 0}, 0.299});
  })) << "a ball below it";
  EXPECT_FALSE(warns_by_area([](Scene& s) { s.spheres.push_back({"ball", "white", {0, 2.6, 0}, 0.2}); }));
  EXPECT_TRUE(warns_by_area([](Scene& s) { s.polygons[1].material = "lamp"; })) << "the whole ceiling";
  EXPECT_TRUE(warns_by_area([](Scene& s) {
    s.meshes.push_back(tetrahedron("block", "white", {0, 2.9 - 0.5 / std::sqrt(3.0), 0}, 0.5));
  })) << "a block with an edge on it";
  EXPECT_TRUE(warns_by_area([](Scene& s) {
    s.spheres.push_back({"bulb", "lamp", {0, 0.3, 0}, 0.3});
  })) << "a bulb on the floor";
  // What cannot be lit, or is not next to it, or is sampled otherwise.
  EXPECT_FALSE(warns_by_area([](Scene& s) { move_lamp(s, {0, 0.0999, 0}); })) << "its back to the ceiling";
  EXPECT_FALSE(warns_by_area([&](Scene& s) {
    to_the_wall(s);
    s.polygons[5].material = "mirror";
  }));
  EXPECT_FALSE(warns_by_area([&](Scene& s) {
    to_the_wall(s);
    s.render.light_sampling = LightSampling::solid_angle;
  }));
  EXPECT_FALSE(warns_by_area([&](Scene& s) {
    to_the_wall(s);
    s.render.mis = Mis::on;
  }));
}

// What is near to a lamp is sampled by solid angle without being asked for, rectangles or not, and `info` says so;
// elsewhere nothing changes.
TEST(Warnings, NoneWhereAutomaticSamplingChoosesTheSolidAngle) {
  const auto chooses = [](const std::function<void(Scene&)>& edit) {
    Scene scene = lit_box();
    edit(scene);
    const CompiledScene c = compile(scene);
    for (const std::string& w : c.warnings) ADD_FAILURE() << w;
    const bool told = std::ranges::any_of(
        c.compiled_in, [](const std::string& line) { return line.find("MIS and solid-angle sampling") == 0; });
    EXPECT_EQ(told, c.settings.mis != scene.render.mis);
    EXPECT_TRUE(told || !c.has_lamp<RectangleLamp>());
    return told;
  };
  EXPECT_FALSE(chooses([](Scene&) {}));
  EXPECT_TRUE(chooses([](Scene& s) { move_lamp(s, {1.5, 0, 0}); })) << "a wall";
  EXPECT_TRUE(chooses([](Scene& s) {
    s.spheres.push_back({"ball", "white", {0, 2.6, 0}, 0.29});
  })) << "a ball below it";
  EXPECT_FALSE(chooses([](Scene& s) { s.spheres.push_back({"ball", "white", {0, 2.4, 0}, 0.2}); }));
  EXPECT_FALSE(chooses([](Scene& s) {
    move_lamp(s, {1.5, 0, 0});
    s.render.mis = Mis::on;
  })) << "bounded already";
  EXPECT_TRUE(chooses([](Scene& s) {
    move_lamp(s, {1.5, 0, 0});
    s.polygons[6].vertices[0].z -= 0.1;
  })) << "no rectangle";
}

// Failure: a dark picture with a few bright dots, which looks finished (TinyLamp shows it).
TEST(Warnings, TinyLampsFoundByChanceAlone) {
  const std::string tiny = "hardly ever found";
  const auto shrink = [](Scene& s, double to) {
    for (dvec3& v : s.polygons[6].vertices) v.x *= to, v.z *= to;
  };
  const auto naive = [&](double to) {
    return [=](Scene& s) {
      set_method(s.render, Method::naive);
      shrink(s, to);
    };
  };
  EXPECT_TRUE(warns(tiny, naive(0.05))) << "25 cm^2 of 80 m^2";
  EXPECT_FALSE(warns(tiny, naive(0.1))) << "100 cm^2 of 80 m^2";
  EXPECT_FALSE(warns(tiny, [&](Scene& s) { shrink(s, 0.05); }));
}

// Failure: noise that grows with the number of samples.
TEST(Warnings, RouletteInBrightRooms) {
  const std::string infinite = "infinite variance";
  const auto bright = [](double reflectance, Roulette roulette) {
    return [=](Scene& s) {
      s.materials[0].set(Matt::reflectance, dvec3{reflectance});
      s.render.roulette = roulette;
    };
  };
  EXPECT_TRUE(warns(infinite, bright(0.87, Roulette::constant)));
  EXPECT_FALSE(warns(infinite, bright(0.86, Roulette::constant)));
  EXPECT_TRUE(warns(infinite, bright(0.999, Roulette::throughput)));
  EXPECT_FALSE(warns(infinite, bright(0.99, Roulette::throughput)));
  EXPECT_FALSE(warns(infinite, [](Scene& s) {
    s.spheres.push_back({"ball", "mirror", {0, 1, 0}, 0.5});
  })) << "one thing that keeps all light is no room that does";
}

// Failure: a setting is changed and nothing happens, or a part of each pixel is left out.
TEST(Warnings, SettingsThatDoNotGoTogether) {
  EXPECT_TRUE(warns("changes nothing", [](Scene& s) {
    set_method(s.render, Method::naive);
    s.render.mis = Mis::on;
  }));
  EXPECT_FALSE(warns("changes nothing", [](Scene& s) { s.render.mis = Mis::on; }));
  const auto centres = [](int spp) {
    return [=](Scene& s) {
      s.render.sampler = Sampler::centres;
      s.render.spp = spp;
    };
  };
  EXPECT_TRUE(warns("sub-pixels", centres(60)));
  EXPECT_FALSE(warns("sub-pixels", centres(64)));
}

}  // namespace
