#include "kernel/geometry/intersect.h"
#include "material/lobes.h"

#include <gtest/gtest.h>

#include <map>
#include <optional>

#include "random_scene.h"
#include "scene/file/scene_file.h"

using namespace glimt;

// The compiled scene's hits against those of the scene as it was written, found in double precision by other means:
// quadratic equations for spheres, crossing numbers for polygons, barycentric volumes for triangles; no planes of rooms
// or solids, no lists by kind.
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// A place where a ray may meet an object.
struct Candidate {
  double t;
  double t_error;  ///< of single precision, given the error of positions
  int object;      ///< number of its material
  bool sure;       ///< false where that error decides whether there is a hit
};

struct Line {
  dvec3 origin, direction;
  int from = -1;         ///< object it starts on
  dvec3 from_normal{0};  ///< of the plane it starts on, which it does not meet again; 0 for a sphere or none
};

class Reference {
 public:
  explicit Reference(const Scene& scene) : scene_(scene) {
    dvec3 low{infinite}, high{-infinite};
    auto include = [&](const dvec3& v) { low = min(low, v), high = max(high, v); };
    for (const Polygon& p : scene.polygons)
      for (const dvec3& v : p.vertices) include(v);
    for (const Mesh& m : scene.meshes)
      for (const dvec3& v : m.vertices) include(v);
    for (const Sphere& s : scene.spheres) include(s.center - s.radius), include(s.center + s.radius);
    error_ = length(high - low) * 0x1p-20;
  }

  double error() const { return error_; }

  std::vector<Candidate> candidates(const Line& line) const {
    std::vector<Candidate> found;
    for (const Sphere& s : scene_.spheres) meet_sphere(s, line, found);
    for (const Polygon& p : scene_.polygons) meet_flat(p.vertices, object(p.material), line, found);
    for (const Mesh& m : scene_.meshes)
      for (const auto& t : m.triangles) {
        auto v = [&](int i) { return m.vertices[static_cast<std::size_t>(t[static_cast<std::size_t>(i)])]; };
        meet_flat({v(0), v(1), v(2)}, object(m.material), line, found);
      }
    std::ranges::sort(found, {}, &Candidate::t);
    return found;
  }

  /// Whether a point is where paths may be: in no opaque sphere but around the camera's, in no opaque solid.
  bool is_free(const dvec3& point) const {
    for (const Sphere& s : scene_.spheres)
      if (!is_glass(s.material) && (length(point - s.center) < s.radius + 0.01) != around_eye(s)) return false;
    for (const Sphere& s : scene_.spheres)
      if (around_eye(s) && !is_glass(s.material) && length(point - s.center) > s.radius - 0.01) return false;
    // The way from the camera crosses each closed opaque mesh an even number of times; a line that grazes an edge is no
    // evidence.
    const dvec3 eye = scene_.camera.eye;
    const Line way{eye, normalize(point - eye)};
    for (const Mesh& m : scene_.meshes) {
      if (is_glass(m.material)) continue;
      int crossings = 0;
      for (const Candidate& c : candidates(way))
        if (c.object == object(m.material) && c.t > 0 && c.t < length(point - eye) + 0.01) {
          if (!c.sure || std::abs(c.t - length(point - eye)) < 0.01) return false;
          ++crossings;
        }
      if (crossings % 2 != 0) return false;
    }
    return true;
  }

  int object(const std::string& material) const {
    for (std::size_t i = 0; i < scene_.materials.size(); ++i)
      if (scene_.materials[i].name == material) return static_cast<int>(i);
    return -1;
  }

 private:
  bool is_glass(const std::string& material) const { return find_material(scene_, material)->type == "glass"; }
  bool around_eye(const Sphere& s) const { return length(scene_.camera.eye - s.center) < s.radius; }

  void meet_sphere(const Sphere& s, const Line& line, std::vector<Candidate>& found) const {
    const dvec3 f = line.origin - s.center;
    const double b = dot(f, line.direction), c = dot(f, f) - s.radius * s.radius;
    const double square = b * b - c;  // of half the chord
    const double off_axis = length(f - b * line.direction);
    if (off_axis > s.radius + 4 * error_) return;
    const double half = std::sqrt(std::max(square, 0.0));
    const double graze = std::sqrt(8 * s.radius * error_) + error_;
    const double t_error = half > graze ? 4 * error_ * s.radius / half : graze + error_;
    const bool touches = std::abs(off_axis - s.radius) <= 4 * error_;
    const bool starts_on = line.from == object(s.material);
    const bool is_shell = around_eye(s) && !is_glass(s.material);
    for (const bool enters : {true, false}) {
      const double t = enters ? -b - half : -b + half;
      if (!is_glass(s.material) && enters == is_shell)
        continue;  // opaque spheres are met from outside, shells from inside
      if (t < -t_error) continue;
      found.push_back({t, t_error, object(s.material), !touches && t > t_error && !(starts_on && t < 2 * graze)});
    }
  }

  /// A convex polygon, or a triangle of a mesh.
  void meet_flat(const std::vector<dvec3>& v, int object, const Line& line, std::vector<Candidate>& found) const {
    dvec3 n{0};
    for (std::size_t i = 0; i < v.size(); ++i) n += cross(v[i], v[(i + 1) % v.size()]);
    n = normalize(n);
    const double cos = dot(n, line.direction);
    if (std::abs(cos) < 1e-7) return;
    const double t = dot(n, v[0] - line.origin) / cos;
    const double t_error = 4 * error_ / std::abs(cos);
    if (t < -t_error) return;
    const bool starts_on =
        line.from == object && std::abs(dot(n, line.from_normal)) > 1 - 1e-6 && std::abs(t) <= t_error;
    if (starts_on) return;
    // Crossing number in the plane of the two axes that n is least along; the distance to the outline says how sure
    // that is.
    const dvec3 p = line.origin + t * line.direction;
    const int drop = std::abs(n.x) > std::abs(n.y) ? (std::abs(n.x) > std::abs(n.z) ? 0 : 2)
                                                   : (std::abs(n.y) > std::abs(n.z) ? 1 : 2);
    const int x = (drop + 1) % 3, y = (drop + 2) % 3;
    bool inside = false;
    double to_outline = infinite;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const dvec3 &a = v[i], &b = v[(i + 1) % v.size()];
      if ((a[y] > p[y]) != (b[y] > p[y]) && p[x] < a[x] + (p[y] - a[y]) / (b[y] - a[y]) * (b[x] - a[x]))
        inside = !inside;
      const double along = std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
      to_outline = std::min(to_outline, length(p - a - along * (b - a)));
    }
    const bool near_outline = to_outline <= 2 * t_error;
    if (inside || near_outline) found.push_back({t, t_error, object, inside && !near_outline && t > t_error});
  }

  const Scene& scene_;
  double error_ = 0;
};

/// Which object a row of the surface table belongs to, by the values that RandomScene made different.
int object_of(const CompiledScene& compiled, const Scene& scene, int surface) {
  const auto row = static_cast<std::size_t>(surface);
  const auto kind = std::bit_cast<std::int32_t>(compiled.surfaces[Column::kind][row]);
  if (kind == lobe_kind<LampLobe>) return static_cast<int>(std::lround(compiled.surfaces[Column::emission_r][row])) - 1;
  if (kind != lobe_kind<SmoothGlassLobe>)
    return static_cast<int>(std::lround(compiled.surfaces[Column::reflectance_r][row] * 256)) - 1;
  const float eta = compiled.surfaces[Column::eta][row],
              inverse_radius = compiled.surfaces[Column::inverse_radius][row];
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& m = scene.materials[i];
    if (m.type != "glass") continue;
    const auto sphere = std::ranges::find(scene.spheres, m.name, &Sphere::material);
    if (sphere != scene.spheres.end()
            ? static_cast<float>(1 / sphere->radius) == inverse_radius
            : inverse_radius == 0 && std::abs(static_cast<float>(m.get(Glass::ior)) - eta) < 1e-4f)
      return static_cast<int>(i);
  }
  return -1;
}

/// A ray in compiled space, as the kernel takes it.
struct KernelRay {
  std::array<float, 3> origin, direction;
  std::int32_t from = -1;
};

struct KernelHit {
  float t;
  std::int32_t surface;
};

struct ShadowTest {
  float distance;
  std::int32_t first, last;  ///< the lamp's own surfaces
};

constexpr Features any_scene{};

/// Rays side by side, filled up with the last one.
template <class F>
struct Batches {
  static constexpr auto width = static_cast<std::size_t>(lane_count<F>);

  template <class Function>
  static void for_each(const std::vector<KernelRay>& rays, Function function) {
    for (std::size_t first = 0; first < rays.size(); first += width) {
      std::array<float, width> o[3], d[3];
      std::array<std::int32_t, width> from;
      for (std::size_t i = 0; i < width; ++i) {
        const KernelRay& r = rays[std::min(first + i, rays.size() - 1)];
        for (std::size_t k = 0; k < 3; ++k) o[k][i] = r.origin[k], d[k][i] = r.direction[k];
        from[i] = r.from;
      }
      const Ray<F> ray{{load<F>(o[0].data()), load<F>(o[1].data()), load<F>(o[2].data())},
                       {load<F>(d[0].data()), load<F>(d[1].data()), load<F>(d[2].data())},
                       load<Int<F>>(from.data())};
      function(first, std::min(width, rays.size() - first), ray);
    }
  }

  static std::vector<KernelHit> closest(const CompiledScene& scene, const std::vector<KernelRay>& rays) {
    std::vector<KernelHit> hits;
    for_each(rays, [&](std::size_t, std::size_t count, const Ray<F>& ray) {
      const Hit<F> hit = closest_hit<F, any_scene>(scene, ray);
      std::array<float, width> t;
      std::array<std::int32_t, width> surface;
      store(hit.t, t.data()), store(hit.surface, surface.data());
      for (std::size_t i = 0; i < count; ++i) hits.push_back({t[i], surface[i]});
    });
    return hits;
  }

  static std::vector<bool> hidden(const CompiledScene& scene, const std::vector<KernelRay>& rays,
                                  const std::vector<ShadowTest>& tests) {
    std::vector<bool> result;
    for_each(rays, [&](std::size_t start, std::size_t count, const Ray<F>& ray) {
      std::array<float, width> distance;
      std::array<std::int32_t, width> first, last;
      for (std::size_t i = 0; i < width; ++i) {
        const ShadowTest& test = tests[std::min(start + i, tests.size() - 1)];
        distance[i] = test.distance, first[i] = test.first, last[i] = test.last;
      }
      const std::uint32_t lanes = bits(occluded<F, any_scene>(scene, ray, load<F>(distance.data()),
                                                              load<Int<F>>(first.data()), load<Int<F>>(last.data())));
      for (std::size_t i = 0; i < count; ++i) result.push_back((lanes >> i & 1) != 0);
    });
    return result;
  }
};

/// Rays through a random scene: from places where paths may be, and from where those arrive.
struct Probe {
  explicit Probe(unsigned seed)
      : generated(seed), scene(generated.scene), compiled(compile(scene)), reference(scene), random(seed) {
    while (rays.size() < first_rays) {
      const dvec3 p = place();
      if (reference.is_free(p)) add({p, direction(), -1}, -1);
    }
    hits = Batches<float>::closest(compiled, rays);
    for (std::size_t i = 0; i < first_rays; ++i) {
      if (!std::isfinite(hits[i].t)) continue;
      const Line& in = lines[i];
      const auto surface = static_cast<std::size_t>(hits[i].surface);
      dvec3 n = column(Column::normal_x, surface);
      const double inverse_radius = static_cast<double>(compiled.surfaces[Column::inverse_radius][surface]);
      // Where the kernel puts the hit point, rounded as it rounds.
      std::array<float, 3> p;
      for (std::size_t k = 0; k < 3; ++k) p[k] = std::fma(rays[i].direction[k], hits[i].t, rays[i].origin[k]);
      const dvec3 point{p[0], p[1], p[2]};
      dvec3 side = inverse_radius > 0 ? (point - n) * inverse_radius : n;
      if (dot(side, in.direction) > 0) side = -side;
      dvec3 d = direction();
      const bool is_glass =
          std::bit_cast<std::int32_t>(compiled.surfaces[Column::kind][surface]) == lobe_kind<SmoothGlassLobe>;
      if (dot(d, side) < 0 && !is_glass) d = -d;
      Line out{point + origin(), d, object_of(compiled, scene, hits[i].surface)};
      if (inverse_radius == 0) out.from_normal = n;
      add(out, hits[i].surface);
    }
    const std::vector<KernelRay> second(rays.begin() + first_rays, rays.end());
    const std::vector<KernelHit> second_hits = Batches<float>::closest(compiled, second);
    hits.insert(hits.end(), second_hits.begin(), second_hits.end());
  }

  dvec3 origin() const { return {compiled.origin[0], compiled.origin[1], compiled.origin[2]}; }

  std::string describe(std::size_t i) const {
    std::ostringstream out;
    out.precision(17);
    const auto& [o, d, from] = rays[i];
    out << scene.name << ", ray " << i << ": compiled origin {" << o[0] << ", " << o[1] << ", " << o[2]
        << "}, direction {" << d[0] << ", " << d[1] << ", " << d[2] << "}, from surface " << from;
    return out.str();
  }

  static constexpr std::size_t first_rays = 1500;
  RandomScene generated;
  const Scene& scene;
  CompiledScene compiled;
  Reference reference;
  std::mt19937 random;
  std::vector<Line> lines;
  std::vector<KernelRay> rays;
  std::vector<KernelHit> hits;

  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  /// Within all surroundings.
  dvec3 place() {
    const double x = number(-3.1, 3.1), y = number(-3.8, 3.8);
    return {x, y, number(-3.1, 3.1)};
  }
  dvec3 direction() {
    std::normal_distribution<double> gauss;
    const double x = gauss(random), y = gauss(random);
    return normalize(dvec3{x, y, gauss(random)});
  }

 private:
  dvec3 column(Column first, std::size_t row) const {
    auto value = [&](int k) {
      return static_cast<double>(compiled.surfaces[static_cast<Column>(static_cast<int>(first) + k)][row]);
    };
    return {value(0), value(1), value(2)};
  }

  void add(const Line& line, int from) {
    KernelRay ray;
    ray.from = from;
    for (int k = 0; k < 3; ++k) {
      ray.origin[static_cast<std::size_t>(k)] = static_cast<float>(line.origin[k] - origin()[k]);
      ray.direction[static_cast<std::size_t>(k)] = static_cast<float>(line.direction[k]);
    }
    lines.push_back(line);
    rays.push_back(ray);
  }
};

constexpr unsigned scenes = 30;  ///< each of the five surroundings with none to four lamps, and a few more

TEST(ClosestHit, IsTheReferencesUpToItsError) {
  std::size_t single = 0, all = 0;
  for (unsigned seed = 0; seed < scenes; ++seed) {
    const Probe probe(seed);
    for (std::size_t i = 0; i < probe.rays.size(); ++i) {
      const std::vector<Candidate> candidates = probe.reference.candidates(probe.lines[i]);
      // What comes no later than the first sure hit may be what single precision finds.
      const auto sure = std::ranges::find(candidates, true, &Candidate::sure);
      const double limit = sure == candidates.end() ? infinite : sure->t + sure->t_error;
      const KernelHit& hit = probe.hits[i];
      const int object = std::isfinite(hit.t) ? object_of(probe.compiled, probe.scene, hit.surface) : -1;
      int allowed = 0;
      bool right = !std::isfinite(hit.t) && sure == candidates.end();
      for (const Candidate& c : candidates) {
        if (c.t - c.t_error > limit) continue;
        ++allowed;
        right |= object == c.object && std::abs(static_cast<double>(hit.t) - c.t) <= c.t_error;
      }
      ++all;
      if (allowed <= 1) ++single;
      std::ostringstream wanted;
      for (const Candidate& c : candidates)
        if (c.t - c.t_error <= limit)
          wanted << "\n  t " << c.t << " +- " << c.t_error << ", object " << c.object << (c.sure ? "" : ", unsure");
      ASSERT_TRUE(right) << probe.describe(i) << "\n found t " << hit.t << ", object " << object << ", surface "
                         << hit.surface << "; by the reference" << wanted.str();
    }
  }
  EXPECT_GT(static_cast<double>(single), 0.98 * static_cast<double>(all)) << "the reference decides nearly every ray";
}

TEST(ClosestHit, OfAPlaneIsNeverWhereTheRayStarts) {
  for (unsigned seed = 0; seed < scenes; ++seed) {
    const Probe probe(seed);
    for (std::size_t i = Probe::first_rays; i < probe.rays.size(); ++i) {
      const auto from = static_cast<std::size_t>(probe.rays[i].from);
      if (probe.compiled.surfaces[Column::inverse_radius][from] > 0 || !std::isfinite(probe.hits[i].t)) continue;
      ASSERT_NE(probe.hits[i].surface, probe.rays[i].from) << probe.describe(i);
    }
  }
}

TEST(ClosestHit, IsTheSameInEveryLane) {
  for (unsigned seed = 0; seed < scenes; ++seed) {
    const Probe probe(seed);
    const std::vector<KernelHit> lanes = Batches<KernelLanes>::closest(probe.compiled, probe.rays);
    for (std::size_t i = 0; i < probe.rays.size(); ++i) {
      ASSERT_EQ(std::bit_cast<std::uint32_t>(lanes[i].t), std::bit_cast<std::uint32_t>(probe.hits[i].t))
          << probe.describe(i);
      ASSERT_TRUE(!std::isfinite(lanes[i].t) || lanes[i].surface == probe.hits[i].surface) << probe.describe(i);
    }
  }
}

// Shadow rays to points in free space, a random one of the lamps being their own.
TEST(Occluded, IsTheReferencesUpToItsError) {
  std::size_t decided = 0, hidden_count = 0, all = 0;
  for (unsigned seed = 0; seed < scenes; ++seed) {
    Probe probe(seed);
    std::vector<KernelRay> rays;
    std::vector<ShadowTest> tests;
    std::vector<Line> lines;
    std::vector<std::size_t> numbers;
    std::vector<int> own;
    for (std::size_t i = Probe::first_rays; i < probe.rays.size(); ++i) {
      KernelRay ray = probe.rays[i];
      Line line = probe.lines[i];
      const auto from = static_cast<std::size_t>(ray.from);
      const auto kind = std::bit_cast<std::int32_t>(probe.compiled.surfaces[Column::kind][from]);
      if (kind >= first_kind(LobeClass::delta)) continue;
      const dvec3 goal = probe.place();
      const dvec3 way = goal - line.origin;
      // To the side that the first direction was on.
      if (!probe.reference.is_free(goal)) continue;
      const dvec3 side = line.from_normal != dvec3{0}
                             ? line.from_normal * (dot(line.from_normal, line.direction) > 0 ? 1.0 : -1.0)
                             : line.direction;
      if (dot(side, way) <= 0.01 * length(way)) continue;
      if (line.from_normal == dvec3{0}) continue;
      line.direction = normalize(way);
      for (int k = 0; k < 3; ++k) ray.direction[static_cast<std::size_t>(k)] = static_cast<float>(line.direction[k]);
      const int lamps = probe.compiled.lamps.rows();
      ShadowTest test{static_cast<float>(length(way)), -1, -1};
      int lamp_object = -1;
      if (lamps > 0) {
        const auto row = static_cast<std::size_t>(probe.random() % static_cast<unsigned>(lamps));
        test.first = std::bit_cast<std::int32_t>(probe.compiled.lamps[LampColumn::first_surface][row]);
        test.last = std::bit_cast<std::int32_t>(probe.compiled.lamps[LampColumn::last_surface][row]);
        lamp_object = object_of(probe.compiled, probe.scene, test.first);
      }
      rays.push_back(ray), tests.push_back(test), lines.push_back(line), numbers.push_back(i),
          own.push_back(lamp_object);
    }
    ASSERT_FALSE(rays.empty());
    const std::vector<bool> hidden = Batches<float>::hidden(probe.compiled, rays, tests);
    EXPECT_EQ(Batches<KernelLanes>::hidden(probe.compiled, rays, tests), hidden) << probe.scene.name;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      bool must = false, may = false;
      for (const Candidate& c : probe.reference.candidates(lines[i])) {
        if (c.object == own[i]) continue;
        const double distance = static_cast<double>(tests[i].distance);
        must |= c.sure && c.t + c.t_error < distance;
        may |= c.t - c.t_error < distance;
      }
      ++all;
      if (must == may) ++decided;
      if (hidden[i]) ++hidden_count;
      ASSERT_TRUE(must == may ? hidden[i] == must : true)
          << probe.describe(numbers[i]) << ", then to " << tests[i].distance << " along {" << lines[i].direction.x
          << ", " << lines[i].direction.y << ", " << lines[i].direction.z << "}, own object " << own[i]
          << ": by the reference it is " << (must ? "hidden" : "free");
    }
  }
  EXPECT_GT(static_cast<double>(decided), 0.97 * static_cast<double>(all));
  EXPECT_GT(hidden_count, all / 20);
  EXPECT_LT(hidden_count, all * 19 / 20);
}

// A box seen from inside is three pairs of planes, seen from outside six polygons. Rays inside it meet the same wall at
// the same t, but for rays to an edge.
TEST(ClosestHit, OfARoomIsThatOfItsPolygons) {
  Scene scene;
  scene.materials = {lambertian("white", dvec3{0.5})};
  scene.polygons = box({-1, -2, -3}, {3, 2, 1}, "white");
  for (std::size_t i = 0; i < 6; ++i) {
    scene.materials.push_back(lambertian("wall " + std::to_string(i), dvec3{static_cast<double>(i + 2) / 256}));
    scene.polygons[i].material = scene.materials.back().name;
  }
  scene.camera = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 60};
  const CompiledScene inside = compile(scene);
  scene.camera.eye = {0, 0, 10};
  const CompiledScene outside = compile(scene);
  ASSERT_EQ(inside.room.size(), 3u);
  ASSERT_EQ(outside.polygons.size(), 6u);
  std::mt19937 random(1);
  std::normal_distribution<float> gauss;
  std::uniform_real_distribution<float> place(-1.9f, 1.9f);
  std::vector<KernelRay> rays;
  for (int i = 0; i < 20000; ++i) {
    const auto d = normalize(Vec3<float>{gauss(random), gauss(random), gauss(random)});
    rays.push_back({{place(random), place(random), place(random)}, {d.x, d.y, d.z}, -1});
  }
  const auto a = Batches<float>::closest(inside, rays), b = Batches<float>::closest(outside, rays);
  int different = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ASSERT_NEAR(a[i].t, b[i].t, 2e-5) << i;
    different += object_of(inside, scene, a[i].surface) != object_of(outside, scene, b[i].surface) ? 1 : 0;
  }
  EXPECT_LE(different, 2) << "rays to an edge";
}

}  // namespace
