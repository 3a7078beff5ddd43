#pragma once

#include "scene_parts.h"

namespace glimt {

/// What surrounds the objects and the camera of a random scene.
enum class Surroundings { nothing, box, mesh, prism, shell };
inline constexpr int surroundings_count = 5;

/// Objects of every shape within [-4, 4]^3, each with its own material. Material i has reflectance.r (i + 1) / 256; a
/// lamp has radiance.r i + 1, glass has ior 1.2 + i / 64. There are lambertian, Oren-Nayar (both formulas), mirror and
/// glass surfaces (both Fresnel formulas), up to four lamps, and in half of the scenes a glass sphere in another.
/// The camera is at (0, 0, 3.5).
class RandomScene {
 public:
  explicit RandomScene(unsigned seed) : random_(seed) {
    const auto around = static_cast<Surroundings>(seed % surroundings_count);
    scene.name = "random scene " + std::to_string(seed);
    scene.camera = {{0, 0, 3.5}, {0.1, 0, -1}, {0, 1, 0}, 75};
    scene.image = {24, 18};
    scene.render.seed = static_cast<int>(seed);
    scene.render.shadow_rays = 1 + static_cast<int>(seed % 3);
    surround(around);
    const int lamps = static_cast<int>(seed / 5 % 5);
    for (int k = 0; k < lamps; ++k) add_lamp(k);
    for (int k = 0; k < 4; ++k) add_opaque_sphere();
    for (int k = 0; k < 4; ++k)
      scene.polygons.push_back(
          disk(name(), reflecting(), place(), direction(), number(0.3, 1), 3 + static_cast<int>(random_() % 6)));
    const dvec3 p = place(), e1 = direction() * number(0.3, 1), e2 = cross(e1, direction());
    scene.polygons.push_back({name(), reflecting(), {p, p + e1, p + e1 + e2, p + e2}});
    scene.meshes.push_back(tetrahedron(name(), reflecting(), place(), number(0.3, 0.8)));
    scene.meshes.push_back(dented(name(), reflecting(), place(), number(0.3, 0.8)));
    // Glass has its own places, because glass solids must not intersect.
    const double r = number(0.5, 0.9);
    scene.spheres.push_back({name(), any_glass(), {-3, 2.5, 0}, r});
    if (seed % 2 == 0) scene.spheres.push_back({name(), any_glass(), {-3, 2.5, 0.1}, 0.6 * r});
    scene.spheres.push_back({name(), any_glass(), {2.8, -2, 1}, number(0.3, 0.7)});
    scene.meshes.push_back(tetrahedron(name(), any_glass(), {2.5, 2.5, -1}, number(0.5, 1)));
    scene.meshes.push_back(dented(name(), any_glass(), {-2.5, -2.5, -1}, number(0.5, 1)));
  }

  Scene scene;

 private:
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  dvec3 direction() {
    std::normal_distribution<double> gauss;
    const double x = gauss(random_), y = gauss(random_);
    return normalize(dvec3{x, y, gauss(random_)});
  }
  /// A place away from the camera.
  dvec3 place() {
    const double x = number(-3, 3), y = number(-3, 3);
    return {x, y, number(-3.2, 1.5)};
  }
  std::string name() { return "object " + std::to_string(names_++); }

  std::string add(Material m) {
    const auto index = static_cast<double>(scene.materials.size());
    m.name = "material " + std::to_string(scene.materials.size());
    if (m.type == "light") {
      const dvec3 radiance = m.get(Light::radiance);
      m.set(Light::radiance, {index + 1, radiance.g, radiance.b});
    } else if (m.type == "glass") {
      m.set(Glass::ior, 1.2 + index / 64);
    } else {
      m.set(Reflecting::reflectance, {(index + 1) / 256, number(0.2, 0.9), number(0, 1)});
    }
    scene.materials.push_back(m);
    return m.name;
  }
  std::string reflecting() {
    Material m;
    const unsigned kind = random_() % 8;
    if (kind < 3) {
      m.type = "oren-nayar";
      m.set(OrenNayar::roughness, number(0, 1));
      m.set(OrenNayar::formula, kind == 0 ? OrenNayarFormula::report : OrenNayarFormula::published);
    } else if (kind == 3) {
      m.type = "mirror";
    }
    if (kind % 4 == 2) m.set(Matt::emission, {number(0, 0.3), 0.1, 0});
    return add(m);
  }
  std::string any_glass() { return add(glass("", 1, random_() % 3 == 0 ? Fresnel::schlick : Fresnel::exact)); }
  std::string lamp() { return add(light("", {1, number(1, 30), number(1, 30)})); }

  void add_opaque_sphere() {
    const dvec3 p = place();
    scene.spheres.push_back({name(), reflecting(), p, number(0.2, 0.8)});
  }

  void add_lamp(int k) {
    switch (k) {
      case 0: {
        const dvec3 p{number(-1, 1), 3.2, number(-1, 1)};
        scene.polygons.push_back(
            {name(), lamp(), {p, p + dvec3{1, 0, 0}, p + dvec3{1, 0.1, 0.7}, p + dvec3{0, 0.1, 0.7}}});
        break;
      }
      case 1:
        scene.spheres.push_back({name(), lamp(), {number(-3, 3), -3, 1}, number(0.1, 0.5)});
        break;
      case 2:
        scene.meshes.push_back(tetrahedron(name(), lamp(), {number(-3, 3), number(-2, 2), 1.2}, 0.3));
        break;
      default:
        scene.polygons.push_back(disk(name(), lamp(), {-3.5, number(-2, 2), 0}, {1, 0, 0}, 0.5, 5));
        break;
    }
  }

  void surround(Surroundings around) {
    auto walls = [&](const std::vector<Polygon>& polygons) {
      for (Polygon wall : polygons) {
        wall.material = reflecting();
        scene.polygons.push_back(wall);
      }
    };
    switch (around) {
      case Surroundings::nothing:
        break;
      case Surroundings::box:
        walls(box(dvec3{-4}, dvec3{4}, ""));
        break;
      case Surroundings::mesh:
        scene.meshes.push_back(box_mesh(dvec3{-4}, dvec3{4}, reflecting(), true));
        break;
      case Surroundings::prism: {
        std::vector<Polygon> sides;
        Polygon floor{"floor", "", {}}, ceiling{"ceiling", "", {}};
        for (int i = 0; i < 6; ++i) {
          auto corner = [&](int k, double y) {
            return dvec3{5 * std::cos(k * std::numbers::pi / 3), y, -5 * std::sin(k * std::numbers::pi / 3)};
          };
          sides.push_back(
              {"wall " + std::to_string(i), "", {corner(i, -4), corner(i, 4), corner(i + 1, 4), corner(i + 1, -4)}});
          floor.vertices.push_back(corner(i, -4));
          ceiling.vertices.insert(ceiling.vertices.begin(), corner(i, 4));
        }
        sides.push_back(floor), sides.push_back(ceiling);
        walls(sides);
        break;
      }
      case Surroundings::shell:
        scene.spheres.push_back({"shell", reflecting(), {0, 0, 0}, 7});
        break;
    }
  }

  std::mt19937 random_;
  int names_ = 0;
};

}  // namespace glimt
