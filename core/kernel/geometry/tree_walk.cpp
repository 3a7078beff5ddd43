#include "kernel/geometry/tree_walk.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <utility>

#include "math/twice.h"

namespace glimt {
namespace {

using E = EightLanes;
using M = Mask<E>;
static_assert(lane_count<E> == TreeNode::width);

/// Embree builds no tree deeper than this.
constexpr std::size_t deepest = 64;

/// The largest coordinate that is reckoned with.
float largest_of(const TriangleTree& tree, const TreeRay& ray) {
  float largest = tree.reach;
  for (const float x : ray.origin) largest = std::max(largest, std::abs(x));
  return largest;
}

/// What a ray that starts on a triangle may meet as long as it is near to that triangle's plane. Its origin is off all
/// planes by rounding, so there the sides decide, not distances: the ray meets only what reaches over the triangle on
/// the side that it leaves to. Near to another plane it meets fronts if it leaves a front, and backs if it leaves a
/// back.
class Start {
 public:
  Start(const TriangleTree& tree, const TreeRay& ray)
      : tree_(tree), origin_(doubles(ray.origin)), direction_(doubles(ray.direction)), from_(ray.from) {
    if (from_ < 0) return;
    own_ = corners(from_);
    own_normal_ = normal(own_);
    const double along = dot(own_normal_, direction_);
    to_front_ = along > 0;
    margin_ = off * static_cast<double>(largest_of(tree, ray));
    end_ = static_cast<float>(std::max(16 * margin_, 2 * margin_ / std::abs(along)));
  }

  /// Where it is over, metres along the ray; and where hits may begin, before the origin.
  float end() const { return end_; }
  float begin() const { return static_cast<float>(-16 * margin_); }

  /// Whether the ray meets the triangle in that place, from begin() to end().
  bool meets(std::int32_t place, float t) const {
    if (from_ < 0) return true;
    const Corners other = corners(place);
    const bool reaches_over = std::ranges::any_of(other, [&](const glm::dvec3& corner) {
      const double height = dot(own_normal_, corner - own_[0]);
      return (to_front_ ? height : -height) > margin_;
    });
    if (!reaches_over) return false;
    const glm::dvec3 n = normal(other);
    if (std::abs(dot(n, origin_ - other[0])) > margin_) return t >= 0;
    return (dot(n, direction_) > 0) != to_front_;
  }

 private:
  using Corners = std::array<glm::dvec3, 3>;

  static glm::dvec3 doubles(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }
  static glm::dvec3 normal(const Corners& v) { return normalize(cross(v[1] - v[0], v[2] - v[0])); }

  Corners corners(std::int32_t place) const {
    const std::size_t packet = static_cast<std::size_t>(place) / TreeNode::width;
    const std::size_t lane = static_cast<std::size_t>(place) % TreeNode::width;
    const auto corner = [&](std::size_t c) {
      const auto& axes = tree_.packets[packet].corner[c];
      return glm::dvec3(axes[0][lane], axes[1][lane], axes[2][lane]);
    };
    return {corner(0), corner(1), corner(2)};
  }

  static constexpr double off = 0x1p-21;  ///< of the largest coordinate: what a hit may be off a plane

  const TriangleTree& tree_;
  glm::dvec3 origin_, direction_;
  std::int32_t from_;
  Corners own_{};
  glm::dvec3 own_normal_{0};
  bool to_front_ = false;
  double margin_ = 0;
  float end_ = 0;
};

/// A ray made ready for boxes.
class BoxRay {
 public:
  BoxRay(const TriangleTree& tree, const TreeRay& ray, float begin) : begin_(begin) {
    const float largest = largest_of(tree, ray);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float d = ray.direction[axis];
      const float inverse = 1 / (std::abs(d) < along ? std::copysign(along, d) : d);
      const float at_origin = -(ray.origin[axis] * inverse), margin = widening * largest * std::abs(inverse);
      back_[axis] = d < 0 ? 1 : 0;
      inverse_[axis] = E(inverse);
      near_[axis] = E(at_origin - margin);
      far_[axis] = E(at_origin + margin);
    }
  }

  /// Where the ray enters the boxes of a node, and the mask of those that it meets nearer than `farthest`.
  std::uint32_t meet(const TreeNode& node, float farthest, E& enters) const {
    enters = E(begin_);
    E leaves(farthest);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      enters = max(fma(load<E>(node.bounds[back_[axis]][axis].data()), inverse_[axis], near_[axis]), enters);
      leaves = min(fma(load<E>(node.bounds[1 - back_[axis]][axis].data()), inverse_[axis], far_[axis]), leaves);
    }
    return bits(enters <= leaves);
  }

 private:
  static constexpr float along = 1e-18f;       ///< for directions along a side of the boxes
  static constexpr float widening = 0x1p-20f;  ///< of the largest coordinate: eight times what single precision is off

  float begin_;
  std::array<std::size_t, 3> back_;  ///< 1 where the ray comes from the high side
  std::array<E, 3> inverse_, near_, far_;
};

/// A ray made ready for triangles: the axis that it runs along most becomes z, and shears put it onto that axis.
class ShearedRay {
 public:
  explicit ShearedRay(const TreeRay& ray) {
    const auto size = [&](std::size_t axis) { return std::abs(ray.direction[axis]); };
    z_ = size(0) >= size(1) ? (size(0) >= size(2) ? 0 : 2) : (size(1) >= size(2) ? 1 : 2);
    x_ = (z_ + 1) % 3;
    y_ = (x_ + 1) % 3;
    // The order of corners stays.
    if (ray.direction[z_] < 0) std::swap(x_, y_);
    scale_ = E(1 / ray.direction[z_]);
    shear_x_ = E(ray.direction[x_] / ray.direction[z_]);
    shear_y_ = E(ray.direction[y_] / ray.direction[z_]);
    origin_x_ = E(ray.origin[x_]);
    origin_y_ = E(ray.origin[y_]);
    origin_z_ = E(ray.origin[z_]);
  }

  /// The mask of triangles that the ray meets at `begin` or beyond.
  std::uint32_t meet(const TrianglePacket& packet, float begin, E& t) const {
    const Sheared a = shear(packet, 0), b = shear(packet, 1), c = shear(packet, 2);
    // Not fused, so that the neighbour at an edge has the same value with the other sign.
    E u = c.x * b.y - c.y * b.x, v = a.x * c.y - a.y * c.x, w = b.x * a.y - b.y * a.x;
    const E zero(0.0f);
    const auto is_zero = [&](const E& x) { return (x >= zero) & (x <= zero); };
    const std::uint32_t on_edge = bits(is_zero(u) | is_zero(v) | is_zero(w));
    if (on_edge != 0) decide(on_edge, a, b, c, u, v, w);
    const E determinant = u + v + w;
    const M one_side = ((u >= zero) & (v >= zero) & (w >= zero)) | ((u <= zero) & (v <= zero) & (w <= zero));
    const M seen = one_side & ((determinant > zero) | (determinant < zero));
    if (!any(seen)) return 0;
    t = fma(u, a.z, fma(v, b.z, w * c.z)) * scale_ / determinant;
    return bits(seen & (t >= E(begin)));
  }

 private:
  struct Sheared {
    E x, y, z;
  };
  Sheared shear(const TrianglePacket& packet, std::size_t corner) const {
    const auto& v = packet.corner[corner];
    const E z = load<E>(v[z_].data()) - origin_z_;
    return {fnma(shear_x_, z, load<E>(v[x_].data()) - origin_x_), fnma(shear_y_, z, load<E>(v[y_].data()) - origin_y_),
            z};
  }

  /// The edges that rounding leaves in doubt, in double precision, which holds the products exactly.
  [[gnu::noinline]] static void decide(std::uint32_t lanes, const Sheared& a, const Sheared& b, const Sheared& c, E& u,
                                       E& v, E& w) {
    using Eight = std::array<float, TreeNode::width>;
    Eight ax, ay, bx, by, cx, cy, su, sv, sw;
    store(a.x, ax.data()), store(a.y, ay.data()), store(b.x, bx.data()), store(b.y, by.data());
    store(c.x, cx.data()), store(c.y, cy.data()), store(u, su.data()), store(v, sv.data()), store(w, sw.data());
    const auto edge = [](float px, float qy, float py, float qx) {
      return static_cast<float>(static_cast<double>(px) * qy - static_cast<double>(py) * qx);
    };
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(lanes));
      su[i] = edge(cx[i], by[i], cy[i], bx[i]);
      sv[i] = edge(ax[i], cy[i], ay[i], cx[i]);
      sw[i] = edge(bx[i], ay[i], by[i], ax[i]);
    }
    u = load<E>(su.data()), v = load<E>(sv.data()), w = load<E>(sw.data());
  }

  std::size_t x_, y_, z_;
  E scale_, shear_x_, shear_y_, origin_x_, origin_y_, origin_z_;
};

/// What is left to be visited, the nearest on top.
class Stack {
 public:
  struct Entry {
    float enters;
    std::int32_t below;
  };

  bool empty() const { return count_ == 0; }
  Entry pop() { return entries_[--count_]; }
  void push(float enters, std::int32_t below) { entries_[count_++] = {enters, below}; }

  /// The boxes in the mask.
  void push(const TreeNode& node, std::uint32_t met, const E& enters) {
    std::array<float, TreeNode::width> distance;
    store(enters, distance.data());
    const std::size_t first = count_;
    for (; met != 0; met &= met - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(met));
      std::size_t place = count_++;
      for (; place > first && entries_[place - 1].enters < distance[i]; --place) entries_[place] = entries_[place - 1];
      entries_[place] = {distance[i], node.below[i]};
    }
  }

 private:
  std::array<Entry, deepest*(TreeNode::width - 1) + 1> entries_;
  std::size_t count_ = 0;
};

/// Lanes of a packet without those of its triangles that have places from `first` to `last`.
std::uint32_t without(std::uint32_t lanes, std::int32_t packet, std::int32_t first, std::int32_t last) {
  const std::int32_t begin = packet * static_cast<std::int32_t>(TreeNode::width);
  const std::int32_t low = std::max(first - begin, 0), high = std::min(last - begin, 7);
  if (low > high) return lanes;
  return lanes & ~((0xffu >> (7 - (high - low))) << low);
}

/// A hit so far, and whether another one comes before it.
bool comes_first(const TriangleTree& tree, float t, std::int32_t place, const TreeHit& hit) {
  if (t != hit.t || hit.place < 0) return t < hit.t;
  const auto number = [&](std::int32_t p) {
    return std::pair(tree.part[static_cast<std::size_t>(p)], tree.triangle[static_cast<std::size_t>(p)]);
  };
  return number(place) < number(hit.place);
}

}  // namespace

TreeHit first_in_tree(const TriangleTree& tree, const TreeRay& ray, float farthest) {
  const Start start(tree, ray);
  const BoxRay box_ray(tree, ray, start.begin());
  const ShearedRay sheared(ray);
  TreeHit hit{farthest, -1};
  Stack stack;
  stack.push(0, 0);
  while (!stack.empty()) {
    const auto [enters, below] = stack.pop();
    if (enters > hit.t) continue;
    if (below >= 0) {
      const TreeNode& node = tree.nodes[static_cast<std::size_t>(below)];
      E distance;
      const std::uint32_t met = box_ray.meet(node, hit.t, distance);
      stack.push(node, met, distance);
      continue;
    }
    const std::int32_t packet = ~below;
    E t;
    std::uint32_t met = sheared.meet(tree.packets[static_cast<std::size_t>(packet)], start.begin(), t);
    met = without(met, packet, ray.from, ray.from);
    if (met == 0) continue;
    std::array<float, TreeNode::width> distance;
    store(t, distance.data());
    for (; met != 0; met &= met - 1) {
      const int lane = std::countr_zero(met);
      const std::int32_t place = packet * static_cast<std::int32_t>(TreeNode::width) + lane;
      float at = distance[static_cast<std::size_t>(lane)];
      if (at <= start.end()) {
        if (!start.meets(place, at)) continue;
        at = std::max(at, 0.0f);
      }
      if (comes_first(tree, at, place, hit)) hit = {at, place};
    }
  }
  return hit;
}

bool hidden_in_tree(const TriangleTree& tree, const TreeRay& ray, float distance, std::int32_t first,
                    std::int32_t last) {
  const Start start(tree, ray);
  const BoxRay box_ray(tree, ray, start.begin());
  const ShearedRay sheared(ray);
  Stack stack;
  stack.push(0, 0);
  while (!stack.empty()) {
    const std::int32_t below = stack.pop().below;
    if (below >= 0) {
      const TreeNode& node = tree.nodes[static_cast<std::size_t>(below)];
      E enters;
      for (std::uint32_t met = box_ray.meet(node, distance, enters); met != 0; met &= met - 1)
        stack.push(0, node.below[static_cast<std::size_t>(std::countr_zero(met))]);
      continue;
    }
    const std::int32_t packet = ~below;
    E t;
    std::uint32_t met = sheared.meet(tree.packets[static_cast<std::size_t>(packet)], start.begin(), t);
    if (met == 0) continue;
    met &= bits(t < E(distance));
    met = without(without(met, packet, ray.from, ray.from), packet, first, last);
    if (met == 0) continue;
    const std::uint32_t at_start = met & bits(t <= E(start.end()));
    if (met != at_start) return true;
    std::array<float, TreeNode::width> along;
    store(t, along.data());
    for (; met != 0; met &= met - 1) {
      const int lane = std::countr_zero(met);
      if (start.meets(packet * static_cast<std::int32_t>(TreeNode::width) + lane,
                      along[static_cast<std::size_t>(lane)]))
        return true;
    }
  }
  return false;
}

}  // namespace glimt
