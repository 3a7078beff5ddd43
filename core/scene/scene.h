#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "scene/settings.h"

/// The scene as a person edits it: plain structs with names. World space is left-to-right, y up, right-handed, in
/// metres. Angles are in degrees here, as in files; radiance is linear RGB in W/(m^2 sr).
namespace glimt {

enum class MaterialType { lambertian, oren_nayar, eon, mirror, glass, light };

/// Scatters light in all directions.
inline bool is_diffuse(MaterialType type) {
  return type == MaterialType::lambertian || type == MaterialType::oren_nayar || type == MaterialType::eon;
}

/// Which of the two printed forms of the Oren-Nayar model is meant.
enum class OrenNayarFormula {
  published,  ///< sin(alpha) tan(beta): Oren and Nayar 1994, eq. 30
  report,     ///< sin(alpha) sin(beta): the course report's eq. 7
};

enum class Fresnel { exact, schlick };

/// A material with the parameters of every type, so that switching the type back and forth loses nothing. Which of them
/// a type reads is declared in fields.cpp.
struct Material {
  std::string name;
  MaterialType type = MaterialType::lambertian;
  glm::dvec3 reflectance{0.75};  ///< per channel, 0..1
  double roughness = 0.6;        ///< sigma, standard deviation of the facet slope angle, radians
  double eon_roughness = 0.6;    ///< of the energy-preserving Oren-Nayar model, 0..1
  OrenNayarFormula formula = OrenNayarFormula::published;
  double ior = 1.5;  ///< absolute refractive index; 1 outside everything
  Fresnel fresnel = Fresnel::exact;
  glm::dvec3 radiance{20.0};  ///< emitted by a light from its front side, W/(m^2 sr)
  glm::dvec3 emission{0.0};   ///< glow of a reflecting surface, not sampled by next-event estimation, W/(m^2 sr)

  bool operator==(const Material&) const = default;
};

/// Glass, or a mirror that is not black.
inline bool is_specular(const Material& material) {
  return material.type == MaterialType::glass ||
         (material.type == MaterialType::mirror && material.reflectance != glm::dvec3{0});
}

/// Whether the camera looks through surfaces that turn their back to it.
enum class Cutaway { off, on };

struct Camera {
  glm::dvec3 eye{0, 0, 5};
  glm::dvec3 look_at{0, 0, 0};
  glm::dvec3 up{0, 1, 0};
  double fov_y = 45;  ///< vertical field of view, degrees
  Cutaway cutaway = Cutaway::off;

  bool operator==(const Camera&) const = default;
};

struct ImageSize {
  int width = 400;
  int height = 400;

  bool operator==(const ImageSize&) const = default;
};

struct Sphere {
  std::string name;
  std::string material;
  glm::dvec3 center{0};
  double radius = 1;

  bool operator==(const Sphere&) const = default;
};

/// A planar convex polygon. Its front is the side from which the vertices run counter-clockwise.
struct Polygon {
  std::string name;
  std::string material;
  std::vector<glm::dvec3> vertices;

  bool operator==(const Polygon&) const = default;
};

struct Mesh {
  std::string name;
  std::string material;
  std::vector<glm::dvec3> vertices;
  std::vector<std::array<int, 3>> triangles;  ///< indices into `vertices`, counter-clockwise from the front

  bool operator==(const Mesh&) const = default;
};

struct Scene {
  std::string name;
  Camera camera;
  ImageSize image;
  Settings render;
  std::vector<Material> materials;
  std::vector<Sphere> spheres;
  std::vector<Polygon> polygons;
  std::vector<Mesh> meshes;

  bool operator==(const Scene&) const = default;
};

/// The material of that name, or null.
const Material* find_material(const Scene& scene, const std::string& name);

}  // namespace glimt
