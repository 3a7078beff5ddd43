#include "compile/build_tree.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>

namespace glimt {
namespace {

using glm::dvec3;

constexpr std::size_t node_width = TreeNode::width;
constexpr float no_distance = std::numeric_limits<float>::infinity();

/// What Embree's builder calls back makes of these: a node of the tree before it is put into arrays.
struct BuiltNode {
  bool leaf;
  unsigned count;  ///< children, or triangles
};
struct BuiltInner : BuiltNode {
  std::array<RTCBounds, node_width> bounds;
  std::array<BuiltNode*, node_width> children;
};
struct BuiltLeaf : BuiltNode {
  std::array<unsigned, node_width> triangles;
};

void* create_node(RTCThreadLocalAllocator allocator, unsigned count, void*) {
  auto* node = static_cast<BuiltInner*>(rtcThreadLocalAlloc(allocator, sizeof(BuiltInner), alignof(BuiltInner)));
  node->leaf = false;
  node->count = count;
  return static_cast<BuiltNode*>(node);
}

void set_children(void* node, void** children, unsigned count, void*) {
  auto* inner = static_cast<BuiltInner*>(static_cast<BuiltNode*>(node));
  for (unsigned i = 0; i < count; ++i) inner->children[i] = static_cast<BuiltNode*>(children[i]);
}

void set_bounds(void* node, const RTCBounds** bounds, unsigned count, void*) {
  auto* inner = static_cast<BuiltInner*>(static_cast<BuiltNode*>(node));
  for (unsigned i = 0; i < count; ++i) inner->bounds[i] = *bounds[i];
}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, std::size_t count, void*) {
  auto* leaf = static_cast<BuiltLeaf*>(rtcThreadLocalAlloc(allocator, sizeof(BuiltLeaf), alignof(BuiltLeaf)));
  leaf->leaf = true;
  leaf->count = static_cast<unsigned>(count);
  for (std::size_t i = 0; i < count; ++i) leaf->triangles[i] = primitives[i].primID;
  // The builder's threads leave them in any order.
  std::sort(leaf->triangles.begin(), leaf->triangles.begin() + static_cast<std::ptrdiff_t>(count));
  return static_cast<BuiltNode*>(leaf);
}

/// Embree's device and the memory of its builder.
struct Builder {
  RTCDevice device = rtcNewDevice(nullptr);
  RTCBVH bvh = device ? rtcNewBVH(device) : nullptr;

  Builder() {
    if (bvh == nullptr) throw std::runtime_error("Embree cannot be started");
  }
  Builder(const Builder&) = delete;
  Builder& operator=(const Builder&) = delete;
  ~Builder() {
    rtcReleaseBVH(bvh);
    rtcReleaseDevice(device);
  }

  BuiltNode* build(std::vector<RTCBuildPrimitive>& primitives) const {
    RTCBuildArguments args = rtcDefaultBuildArguments();
    args.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
    args.maxBranchingFactor = node_width;
    args.sahBlockSize = node_width;
    args.minLeafSize = node_width;
    args.maxLeafSize = node_width;
    args.bvh = bvh;
    args.primitives = primitives.data();
    args.primitiveCount = primitives.size();
    args.primitiveArrayCapacity = primitives.size();
    args.createNode = create_node;
    args.setNodeChildren = set_children;
    args.setNodeBounds = set_bounds;
    args.createLeaf = create_leaf;
    auto* root = static_cast<BuiltNode*>(rtcBuildBVH(&args));
    if (root == nullptr) throw std::runtime_error("there is not enough memory for the tree of triangles");
    return root;
  }
};

/// The mean of the normals around each vertex, by the angles there (Thuermer and Wuethrich, "Computing vertex normals
/// from polygonal facets", 1998).
std::vector<dvec3> find_normals(const TreePart& part) {
  std::vector<dvec3> normals(part.vertices.size(), dvec3{0});
  for (const auto& t : part.triangles)
    for (std::size_t c = 0; c < 3; ++c) {
      const auto vertex = [&](std::size_t k) { return part.vertices[static_cast<std::size_t>(t[(c + k) % 3])]; };
      const dvec3 a = vertex(1) - vertex(0), b = vertex(2) - vertex(0), n = cross(a, b);
      const double twice_area = length(n);
      if (twice_area > 0)
        normals[static_cast<std::size_t>(t[c])] += n * (std::atan2(twice_area, dot(a, b)) / twice_area);
    }
  return normals;
}

/// All parts as one list of triangles, in compiled space.
class Triangles {
 public:
  Triangles(const std::vector<TreePart>& parts, const dvec3& origin) : parts_(parts), origin_(origin) {
    for (const TreePart& part : parts) {
      begin_.push_back(begin_.back() + part.triangles.size());
      found_normals_.push_back(part.smooth && part.normals.empty() ? find_normals(part) : std::vector<dvec3>{});
    }
  }

  std::size_t count() const { return begin_.back(); }
  std::size_t part_of(std::size_t i) const {
    return static_cast<std::size_t>(std::ranges::upper_bound(begin_, i) - begin_.begin()) - 1;
  }
  std::size_t begin(std::size_t part) const { return begin_[part]; }

  /// [corner][axis]
  std::array<std::array<float, 3>, 3> corners(std::size_t part, std::size_t triangle) const {
    const TreePart& p = parts_[part];
    std::array<int, 3> t = p.triangles[triangle];
    if (p.inside_out) std::swap(t[1], t[2]);
    std::array<std::array<float, 3>, 3> result;
    for (std::size_t c = 0; c < 3; ++c) {
      const dvec3 v = p.vertices[static_cast<std::size_t>(t[c])] - origin_;
      result[c] = {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
    }
    return result;
  }

  bool any_smooth() const { return std::ranges::any_of(parts_, &TreePart::smooth); }

  /// The normals at the corners, to the front; none where the part is flat.
  std::optional<std::array<std::array<float, 3>, 3>> normals(std::size_t part, std::size_t triangle) const {
    const TreePart& p = parts_[part];
    if (!p.smooth) return {};
    std::array<int, 3> t = p.triangles[triangle];
    const auto vertex = [&](std::size_t c) { return p.vertices[static_cast<std::size_t>(t[c])]; };
    if (p.inside_out) std::swap(t[1], t[2]);
    const dvec3 front = cross(vertex(1) - vertex(0), vertex(2) - vertex(0));
    const std::vector<dvec3>& normals = p.normals.empty() ? found_normals_[part] : p.normals.get();
    std::array<std::array<float, 3>, 3> result;
    for (std::size_t c = 0; c < 3; ++c) {
      dvec3 n = normals[static_cast<std::size_t>(t[c])];
      n = length(n) > 0 ? normalize(n) : normalize(front);
      if (dot(n, front) < 0) n = -n;
      result[c] = {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
    }
    return result;
  }

  std::vector<RTCBuildPrimitive> primitives() const {
    std::vector<RTCBuildPrimitive> all;
    all.reserve(count());
    for (std::size_t part = 0; part < parts_.size(); ++part)
      for (std::size_t t = 0; t < parts_[part].triangles.size(); ++t) {
        const auto v = corners(part, t);
        const auto low = [&](std::size_t axis) { return std::min({v[0][axis], v[1][axis], v[2][axis]}); };
        const auto high = [&](std::size_t axis) { return std::max({v[0][axis], v[1][axis], v[2][axis]}); };
        all.push_back({low(0), low(1), low(2), 0, high(0), high(1), high(2), static_cast<unsigned>(all.size())});
      }
    return all;
  }

 private:
  const std::vector<TreePart>& parts_;
  dvec3 origin_;
  std::vector<std::size_t> begin_{0};
  std::vector<std::vector<dvec3>> found_normals_;  ///< of smooth parts that have none
};

/// Puts what was built into the tree's arrays.
class Packer {
 public:
  Packer(const Triangles& triangles, TriangleTree& tree) : triangles_(triangles), tree_(tree) {}

  /// The number of a node, or ~number of a packet.
  std::int32_t pack(const BuiltNode* node) {
    return node->leaf ? ~pack_leaf(*static_cast<const BuiltLeaf*>(node))
                      : pack_inner(*static_cast<const BuiltInner*>(node));
  }

 private:
  std::int32_t pack_inner(const BuiltInner& inner) {
    const std::size_t number = tree_.nodes.size();
    tree_.nodes.push_back(empty_node());
    for (std::size_t i = 0; i < inner.count; ++i) {
      const RTCBounds& b = inner.bounds[i];
      const std::int32_t below = pack(inner.children[i]);
      TreeNode& node = tree_.nodes[number];
      const std::array<std::array<float, 3>, 2> sides{
          {{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}}};
      for (std::size_t side = 0; side < 2; ++side)
        for (std::size_t axis = 0; axis < 3; ++axis) node.bounds[side][axis][i] = sides[side][axis];
      node.below[i] = below;
    }
    return static_cast<std::int32_t>(number);
  }

  std::int32_t pack_leaf(const BuiltLeaf& leaf) {
    const std::size_t number = tree_.packets.size();
    TrianglePacket& packet = tree_.packets.emplace_back();
    for (std::size_t i = 0; i < node_width; ++i) {
      const bool used = i < leaf.count;
      const std::size_t part = used ? triangles_.part_of(leaf.triangles[i]) : 0;
      const std::size_t triangle = used ? leaf.triangles[i] - triangles_.begin(part) : 0;
      std::array<std::array<float, 3>, 3> v;
      for (auto& corner : v) corner.fill(std::numeric_limits<float>::quiet_NaN());
      if (used) v = triangles_.corners(part, triangle);
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t axis = 0; axis < 3; ++axis) packet.corner[c][axis][i] = v[c][axis];
      if (triangles_.any_smooth()) {
        if (i == 0) tree_.normals.emplace_back();
        for (auto& corner : v) corner.fill(std::numeric_limits<float>::quiet_NaN());
        if (const auto normals = used ? triangles_.normals(part, triangle) : std::nullopt) v = *normals;
        for (std::size_t c = 0; c < 3; ++c)
          for (std::size_t axis = 0; axis < 3; ++axis) tree_.normals.back().corner[c][axis][i] = v[c][axis];
      }
      tree_.part.push_back(used ? static_cast<std::int32_t>(part) : -1);
      tree_.triangle.push_back(static_cast<std::int32_t>(triangle));
    }
    return static_cast<std::int32_t>(number);
  }

 public:
  static TreeNode empty_node() {
    TreeNode node;
    for (auto& axis : node.bounds[0]) axis.fill(no_distance);
    for (auto& axis : node.bounds[1]) axis.fill(-no_distance);
    node.below.fill(0);
    return node;
  }

 private:
  const Triangles& triangles_;
  TriangleTree& tree_;
};

std::shared_ptr<const TriangleTree> build(const std::vector<TreePart>& parts, const dvec3& origin) {
  const Triangles triangles(parts, origin);
  const auto start = std::chrono::steady_clock::now();
  auto tree = std::make_shared<TriangleTree>();
  tree->triangles = triangles.count();
  const Builder builder;
  {
    std::vector<RTCBuildPrimitive> primitives = triangles.primitives();
    for (const RTCBuildPrimitive& p : primitives)
      for (const float x : {p.lower_x, p.lower_y, p.lower_z, p.upper_x, p.upper_y, p.upper_z})
        tree->reach = std::max(tree->reach, std::abs(x));
    tree->unit = std::exp2(-std::round(std::log2(std::max(tree->reach, std::numeric_limits<float>::min()))));
    const BuiltNode* root = builder.build(primitives);
    primitives = {};
    tree->nodes.reserve(triangles.count() / 16 + 1);
    tree->packets.reserve(triangles.count() / 4 + 1);
    if (root->leaf) {
      BuiltInner above{{false, 1}, {}, {const_cast<BuiltNode*>(root)}};
      above.bounds[0] = {-tree->reach, -tree->reach, -tree->reach, 0, tree->reach, tree->reach, tree->reach, 0};
      Packer(triangles, *tree).pack(&above);
    } else {
      Packer(triangles, *tree).pack(root);
    }
  }
  tree->nodes.shrink_to_fit();
  tree->packets.shrink_to_fit();
  tree->normals.shrink_to_fit();
  tree->part.shrink_to_fit();
  tree->triangle.shrink_to_fit();
  tree->build_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return tree;
}

}  // namespace

std::shared_ptr<const TriangleTree> tree_of(const std::vector<TreePart>& parts, const dvec3& origin) {
  struct Known {
    std::vector<TreePart> parts;
    dvec3 origin{0};
    std::shared_ptr<const TriangleTree> tree;
  };
  static std::mutex mutex;
  static Known last;
  const std::lock_guard lock(mutex);
  if (last.tree == nullptr || last.origin != origin || last.parts != parts) {
    last = {};
    last = {parts, origin, build(parts, origin)};
  }
  return last.tree;
}

}  // namespace glimt
