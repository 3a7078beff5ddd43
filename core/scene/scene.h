#pragma once

#include <array>
#include <filesystem>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mesh/place_mesh.h"
#include "scene/material.h"
#include "scene/settings.h"
#include "scene/shared.h"

/// The scene as a person edits it: plain structs with names. World space is left-to-right, y up, right-handed, in
/// metres. Angles are in degrees here, as in files; radiance is linear RGB in W/(m^2 sr).
namespace glimt {

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

/// Its front is the side from which the vertices run counter-clockwise. What is not flat and convex is rendered in
/// pieces (scene/geometry/mend.h).
struct Polygon {
  std::string name;
  std::string material;
  std::vector<glm::dvec3> vertices;

  bool operator==(const Polygon&) const = default;
};

/// The file that a mesh's geometry comes from.
struct MeshFile {
  std::filesystem::path path;  ///< absolute
  Placement placement;
  std::map<std::string, std::string> materials{};  ///< the scene's by the file's
  std::shared_ptr<const MeshData> data{};          ///< what the file holds; never null

  bool operator==(const MeshFile& other) const {
    return path == other.path && placement == other.placement && materials == other.materials &&
           data->hash == other.data->hash;
  }
};

/// Triangles in a row of one material.
struct MeshPart {
  std::string material;
  int first = 0;
  int count = 0;

  bool operator==(const MeshPart&) const = default;
};

struct Mesh {
  std::string name;
  std::string material;
  Shared<std::vector<glm::dvec3>> vertices{};
  Shared<std::vector<std::array<int, 3>>> triangles{};  ///< indices into `vertices`, counter-clockwise from the front
  Shared<std::vector<glm::dvec3>> normals{};            ///< one a vertex, of any length above 0, or none
  bool smooth = false;                                  ///< shaded with normals between those of its vertices
  std::vector<MeshPart> parts{};   ///< of all triangles, where not all are of `material`; otherwise none
  std::optional<MeshFile> file{};  ///< where the geometry comes from, which is placed in the world here

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
