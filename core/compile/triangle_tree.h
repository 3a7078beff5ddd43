#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

/// Many triangles in compiled space, in a tree of boxes that rays walk down.
namespace glimt {

/// Eight boxes, which hold what is below them.
struct alignas(32) TreeNode {
  static constexpr std::size_t width = 8;
  /// [low or high][axis][box], metres. A box that is not used has its low side at infinity.
  std::array<std::array<std::array<float, width>, 3>, 2> bounds;
  std::array<std::int32_t, width> below;  ///< a node, or ~number of a packet
};

/// Eight triangles or fewer, which are tested at once.
struct alignas(32) TrianglePacket {
  /// [corner][axis][triangle], metres; NaN where there is no triangle.
  std::array<std::array<std::array<float, TreeNode::width>, 3>, 3> corner;
};

/// The same for the normals at corners, to the front; NaN where the triangle is flat.
struct alignas(32) NormalPacket {
  std::array<std::array<std::array<float, TreeNode::width>, 3>, 3> corner;
};

/// A triangle has a place: its packet's number times eight, and its place there.
struct TriangleTree {
  std::vector<TreeNode> nodes;  ///< the root first
  std::vector<TrianglePacket> packets;
  std::vector<NormalPacket> normals;   ///< of the packets; empty where all is flat
  std::vector<std::int32_t> part;      ///< by place, the object that the triangle is of; -1: there is none
  std::vector<std::int32_t> triangle;  ///< by place, its number in that object
  std::size_t triangles = 0;
  double build_seconds = 0;
  float reach = 0;  ///< the largest coordinate, metres
  float unit = 1;   ///< a power of two; times the scene's lengths about 1

  std::size_t bytes() const {
    return nodes.size() * sizeof(TreeNode) + packets.size() * sizeof(TrianglePacket) +
           normals.size() * sizeof(NormalPacket) + (part.size() + triangle.size()) * sizeof(std::int32_t);
  }
};

/// Surfaces from this number on are triangles of the tree, by their places.
inline constexpr std::int32_t first_tree_surface = 1 << 24;

}  // namespace glimt
