#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/file/text.h"
#include "scene/scene.h"
#include "scene/validate/validate.h"

/// The parts that validate() is made of. Each adds what it finds.
namespace glimt {

using Problems = std::vector<Problem>;

/// sphere "glass", or sphere[3] for one without a name.
inline std::string called(std::string_view kind, const std::string& name, std::size_t index) {
  return name.empty() ? std::string(kind) + "[" + std::to_string(index) + "]"
                      : std::string(kind) + " " + toml_string(name);
}

/// sphere[3], as in paths.
inline std::string element(std::string_view array, std::size_t index) {
  return std::string(array) + "[" + std::to_string(index) + "]";
}

/// Vertices that are missing, not finite or far from a common plane, and outlines without area or that cross
/// themselves.
void check_polygon(const Polygon& polygon, std::size_t index, Problems& problems);

/// Vertices that are not finite, indices out of range, no triangle with an area.
void check_mesh(const Mesh& mesh, std::size_t index, Problems& problems);

/// Glass on open shapes; glass solids that neither stay apart nor lie one within the other. The scene is otherwise
/// valid, and mended but for its polygons.
void check_glass(const Scene& scene, Problems& problems);

}  // namespace glimt
