#pragma once

#include <array>
#include <map>
#include <memory>
#include <mutex>

#include "scene/scene.h"

namespace glimt {

/// Meshes of more triangles are large. What is found out of one triangle by triangle is kept, and what costs too long
/// even once is left out.
inline constexpr std::size_t most_small_triangles = 4096;

inline bool is_large(const Mesh& mesh) { return mesh.triangles.size() > most_small_triangles; }

/// What follows from the vertices, triangles and normals of meshes alone, kept while some copy of them lives. A value
/// must not hold them itself.
template <class Value>
class GeometryCache {
 public:
  /// What make() gives, or has given before for the same geometry.
  template <class Make>
  std::shared_ptr<const Value> get(const Mesh& mesh, Make make) {
    const std::array parts{mesh.vertices.identity(), mesh.triangles.identity(), mesh.normals.identity()};
    const std::array key{parts[0].get(), parts[1].get(), parts[2].get()};
    const std::lock_guard lock(mutex_);
    if (const auto known = entries_.find(key); known != entries_.end() && is_alive(*known)) return known->second.value;
    std::erase_if(entries_, [](const auto& entry) { return !is_alive(entry); });
    auto value = std::make_shared<const Value>(make());
    entries_[key] = {{parts[0], parts[1], parts[2]}, value};
    return value;
  }

 private:
  using Key = std::array<const void*, 3>;
  struct Kept {
    std::array<std::weak_ptr<const void>, 3> parts;
    std::shared_ptr<const Value> value;
  };
  using Entry = typename std::map<Key, Kept>::value_type;

  static bool is_alive(const Entry& entry) {
    for (std::size_t i = 0; i < entry.first.size(); ++i)
      if (entry.first[i] != nullptr && entry.second.parts[i].expired()) return false;
    return true;
  }

  std::mutex mutex_;
  std::map<Key, Kept> entries_;
};

}  // namespace glimt
