#pragma once

#include "scene/scene.h"

namespace glimt {

/// Gives a mesh that has a file its geometry, in world space, and its parts: of the materials that `materials` names,
/// or of those of the scene that have the file's names, or else of the mesh's own. A placement out of range, which
/// validate() refuses, is not calculated with.
void place_from_file(Mesh& mesh, const Scene& scene);

/// Its parts alone, after materials of the scene or the mesh's own have changed.
void name_parts(Mesh& mesh, const Scene& scene);

}  // namespace glimt
