#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "compile/triangle_tree.h"
#include "lamp/shapes.h"
#include "math/table.h"
#include "scene/scene.h"

/// What the kernel reads: flat arrays of floats in compiled space (world space moved so that the scene is centred on
/// the origin, which keeps the precision of a scene far away), with everything left out that the scene does not need.
namespace glimt {

struct Rgb {
  float r = 0, g = 0, b = 0;
};

/// Columns of the surface table that all surfaces have; those of the lobes follow (material/lobes.h). A surface is what
/// a ray can hit: a face, a triangle or a sphere.
enum class Column {
  normal_x,
  normal_y,
  normal_z,        ///< outward or front unit normal of a plane; the centre of a sphere
  inverse_radius,  ///< of a sphere; 0 for a plane
  kind,            ///< of its lobe, as an int32; see material/lobes.h
  reflectance_r,
  reflectance_g,
  reflectance_b,
  emission_r,
  emission_g,
  emission_b,  ///< radiance of a light, or glow
  eta,         ///< glass: index behind the surface over index in front of it
  lamp,        ///< first row of the lamp table that is a piece of this light, as int32; -1: none is
  chain,       ///< of a sphere that connections pass over, as int32: 1 by reflection, 2 by refraction too; else 0
  target,      ///< number of the mirror or glass that light paths may be aimed at, as int32; -1: none
  emitter,     ///< of a surface that emits, its row in CompiledScene::emitters, as int32; -1: not watched
  count
};

/// One of the columns that belong to lobes.
constexpr Column lobe_column(int number) { return static_cast<Column>(static_cast<int>(Column::count) + number); }

/// Columns of the table that light paths begin from: a piece of a lamp and a mirror or glass that it is aimed at, by
/// way of the sphere around it.
enum class AimColumn {
  lamp,  ///< row of the lamp table, as int32
  center_x,
  center_y,
  center_z,
  radius,
  target,  ///< what Column::target of the first surface on the way must be, as int32
  weight_r,
  weight_g,
  weight_b,         ///< radiance * area of the lamp / probability of choice / light paths of a pass
  alias_threshold,  ///< see math/alias.h
  alias_other,
  count
};

/// A pair of parallel faces of the closed convex room around the camera: |n.x - middle| <= half inside.
struct Slab {
  float nx, ny, nz;
  float middle, half;  ///< metres
  std::int32_t surface_lo, surface_hi;
};

/// n.x <= d inside a convex solid.
struct SolidPlane {
  float nx, ny, nz, d;
  std::int32_t surface;
};

/// A closed convex mesh as planes [first, last). Opaque ones are hit from outside only, which is where paths are.
struct Solid {
  std::int32_t first, last;
  std::int32_t first_surface, last_surface;
  bool glass;
};

struct SphereShape {
  float cx, cy, cz, r2;  ///< centre, square of the radius
  std::int32_t surface;
};

/// A flat convex piece: n.x = d, and every bound holds.
struct PolygonShape {
  float nx, ny, nz, d;
  std::int32_t first_bound, last_bound;
  std::int32_t surface;
};

/// lo <= b.x <= hi. A parallelogram has two, other polygons one (hi infinite) an edge.
struct PolygonBound {
  float bx, by, bz, lo, hi;
};

struct TriangleShape {
  std::array<float, 3> v, e1, e2;
  std::int32_t surface;
};

/// Film position (x, y) in pixels from the upper left, both continuous, sends a ray along corner + x * right + y *
/// down.
struct PinholeCamera {
  std::array<float, 3> eye, corner, right, down;
  std::array<float, 3> forward;  ///< unit, to the middle of the image
  float pixel_area;              ///< of a pixel on the plane at distance 1, m^2
};

/// A sphere over which diffuse surfaces are connected to lamps; see kernel/caustics/connect.h.
struct ChainSphere {
  std::array<float, 3> center;
  float radius;
  std::int32_t surface;
  bool glass, refracts;  ///< refracts: with nothing inside
};

/// A rectangle of the image, pixels from its upper left corner, where a small lamp is seen, straight or by way of
/// mirrors and glass; see kernel/lamps/lamp_images.h.
struct LampImage {
  double x0, y0, x1, y1;
};

/// How a path comes from the camera to an emitter. What a technique samples is not left to chance; the rest is.
enum class ChanceWay {
  straight,          ///< at once
  mirrored,          ///< by way of smooth mirrors and glass alone
  lit,               ///< the first surface was matt or glossy
  lit_and_mirrored,  ///< the first surface was a smooth mirror or glass, and a later one matt or glossy
  count
};
inline constexpr auto chance_ways = static_cast<std::size_t>(ChanceWay::count);

/// A lamp, or an object that glows, some of whose light is left to chance; see film/unseen.h.
struct Emitter {
  double radiance = 0;     ///< mean of its channels, W/(m^2 sr)
  std::uint64_t ways = 0;  ///< those left to chance: bit k is ChanceWay k

  bool is_left(std::size_t way) const { return (ways >> way & 1) != 0; }
  void leave(ChanceWay way, bool left) { ways |= std::uint64_t{left} << static_cast<int>(way); }
};

struct CompiledScene {
  Settings settings;
  int width = 0, height = 0;
  PinholeCamera camera{};
  std::array<double, 3> origin{};  ///< compiled space's origin in world space
  double max_radiance = 0;         ///< brightest emission, for the film's scale

  Table<Column> surfaces;
  std::vector<Slab> room;  ///< the closed convex room, or empty
  std::vector<Solid> solids;
  std::vector<SolidPlane> solid_planes;
  std::vector<SphereShape> spheres;  ///< opaque, hit from outside
  std::vector<SphereShape> shells;   ///< opaque, around the camera or the room, hit from inside
  std::vector<SphereShape> glass_spheres;
  std::vector<PolygonShape> polygons;
  std::vector<PolygonBound> polygon_bounds;
  std::vector<TriangleShape> triangles;
  std::shared_ptr<const TriangleTree> tree;  ///< of many triangles; null where there are few
  std::vector<std::int32_t> tree_rows;       ///< of the tree's parts in the surface table
  std::vector<std::int32_t>
      tree_lamps;  ///< by place in the tree, the triangle's row of the lamp table or -1; empty without lamps

  Table<LampColumn> lamps;
  int light_paths = 0;         ///< of every pass, from lamps to mirrors and glass; 0: caustics are found by chance
  float light_path_noise = 0;  ///< see kernel/geometry/pinhole.h
  Table<AimColumn> aims;
  std::vector<int> lamp_edges;  ///< pixels that edges of lamps come near, in order; see kernel/lamps/lamp_edges.h
  std::vector<LampImage> lamp_images;  ///< disjoint
  std::vector<ChainSphere> chain_spheres;
  std::vector<Emitter> emitters;  ///< those of which something is left to chance
  std::uint32_t lobes = 0;        ///< that some surface has; a LobeSet of material/lobes.h
  bool has_glass = false;         ///< light goes on behind some surface
  bool has_glow = false;          ///< reflecting surfaces with emission
  bool cutaway = false;           ///< camera rays look through backs; see kernel/geometry/cutaway.h
  int room_surfaces = 0;          ///< how many there are; they come first
  bool camera_outside = false;    ///< there is a closed room, and the eye is not in it
  bool room_hides_lamps = false;  ///< a lamp is partly outside the room, so shadow rays test the room too
  std::array<bool, lamp_shapes> has_lamp_shape{};  ///< by place in the list of shapes

  // For people: what the kernel will and will not do in this scene, and what they should know about it.
  std::vector<std::string> compiled_in, left_out, warnings;

  template <class Shape>
  bool has_lamp() const {
    return has_lamp_shape[static_cast<std::size_t>(lamp_shape_number<Shape>)];
  }
};

/// Of polygons and triangles: with more, a tree is faster than lists. Measured by tests/bench/scaling.
inline constexpr std::size_t tree_crossing = 96;

/// Lowers a valid scene (validate.h); throws SceneError for one that is not, naming the first problem. Objects and
/// lamps that paths from the camera cannot reach are left out, so the result depends on where the camera is.
/// With more than `most_listed` polygons and triangles there is a tree.
CompiledScene compile(const Scene& scene, std::size_t most_listed = tree_crossing);

}  // namespace glimt
