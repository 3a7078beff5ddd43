#include "viewer/picture/outline.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <utility>

#include "scene/camera_view.h"
#include "scene/geometry/geometry_cache.h"
#include "scene/geometry/mesh_measures.h"

namespace glimt {
namespace {

using glm::dvec3;

constexpr int circle_pieces = 128, edge_pieces = 32;
constexpr double in_front = 1 - 1e-4;  ///< share of the way to the outline; a surface nearer than this hides it

struct Edge {
  dvec3 from, to;
};

class Outline {
 public:
  Outline(const Scene& scene, const ObjectId& object)
      : scene_(scene), object_(object), view_(scene.camera, scene.image) {}

  const CameraView& view() const { return view_; }

  void add(Edge edge, int pieces) {
    // Only points in front of the camera have a place in the image.
    const double near = 1e-3 * glm::length(scene_.camera.look_at - view_.eye);
    const double d0 = view_.depth(edge.from), d1 = view_.depth(edge.to);
    if (d0 < near && d1 < near) return;
    if (d0 < near) edge.from = mix(edge.from, edge.to, (near - d0) / (d1 - d0));
    if (d1 < near) edge.to = mix(edge.to, edge.from, (near - d1) / (d0 - d1));
    dvec3 from = edge.from;
    for (int i = 1; i <= pieces; ++i) {
      const dvec3 to = mix(edge.from, edge.to, static_cast<double>(i) / pieces);
      const auto a = view_.project(from), b = view_.project(to);
      if (a && b) pieces_.push_back({*a, *b, is_hidden((from + to) * 0.5)});
      from = to;
    }
  }

  std::vector<OutlinePiece> take() { return std::move(pieces_); }

 private:
  bool is_hidden(const dvec3& point) const {
    const auto first = pick_seen(scene_, {view_.eye, point - view_.eye}, object_);
    return first && first->distance < in_front;
  }

  const Scene& scene_;
  ObjectId object_;
  CameraView view_;
  std::vector<OutlinePiece> pieces_;
};

void add_sphere(Outline& outline, const Sphere& sphere) {
  const CameraView& view = outline.view();
  const dvec3 to_centre = sphere.center - view.eye;
  const double distance = length(to_centre), share = sphere.radius / distance;
  if (share >= 1) return;
  const dvec3 axis = to_centre / distance;
  const dvec3 middle = sphere.center - axis * (sphere.radius * share);
  const double radius = sphere.radius * std::sqrt(1 - share * share);
  const dvec3 u = normalize(cross(axis, std::abs(axis.x) < 0.9 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
  const dvec3 v = cross(axis, u);
  const auto at = [&](int i) {
    const double angle = 2 * std::numbers::pi * i / circle_pieces;
    return middle + (u * std::cos(angle) + v * std::sin(angle)) * radius;
  };
  for (int i = 0; i < circle_pieces; ++i) outline.add({at(i), at(i + 1)}, 1);
}

void add_polygon(Outline& outline, const Polygon& polygon) {
  const auto& v = polygon.vertices;
  for (std::size_t i = 0; i < v.size(); ++i) outline.add({v[i], v[(i + 1) % v.size()]}, edge_pieces);
}

void add_box(Outline& outline, const Box& box) {
  const auto corner = [&](int i) {
    return dvec3{(i & 1) != 0 ? box.high.x : box.low.x, (i & 2) != 0 ? box.high.y : box.low.y,
                 (i & 4) != 0 ? box.high.z : box.low.z};
  };
  for (int i = 0; i < 8; ++i)
    for (const int side : {1, 2, 4})
      if ((i & side) == 0) outline.add({corner(i), corner(i | side)}, 1);
}

void add_mesh(Outline& outline, const Mesh& mesh) {
  if (is_large(mesh)) {
    add_box(outline, box_of(mesh));
    return;
  }
  const auto vertex = [&](int i) { return mesh.vertices[static_cast<std::size_t>(i)]; };
  // For each edge, how many triangles face the camera and how many do not.
  std::map<std::pair<int, int>, std::pair<int, int>> sides;
  for (const auto& t : mesh.triangles) {
    const dvec3 normal = cross(vertex(t[1]) - vertex(t[0]), vertex(t[2]) - vertex(t[0]));
    const bool faces = dot(normal, vertex(t[0]) - outline.view().eye) < 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(t[k], t[(k + 1) % 3]);
      auto& [front, back] = sides[{a, b}];
      ++(faces ? front : back);
    }
  }
  const int pieces = sides.size() > 100 ? 1 : edge_pieces;
  for (const auto& [edge, side] : sides)
    if (side.first + side.second == 1 || (side.first > 0 && side.second > 0))
      outline.add({vertex(edge.first), vertex(edge.second)}, pieces);
}

}  // namespace

std::vector<OutlinePiece> outline_of(const Scene& scene, const ObjectId& object) {
  Outline outline(scene, object);
  switch (object.kind) {
    case ObjectKind::sphere:
      add_sphere(outline, scene.spheres[object.index]);
      break;
    case ObjectKind::polygon:
      add_polygon(outline, scene.polygons[object.index]);
      break;
    case ObjectKind::mesh:
      add_mesh(outline, scene.meshes[object.index]);
      break;
  }
  return outline.take();
}

}  // namespace glimt
