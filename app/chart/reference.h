#pragma once

#include <filesystem>

#include "film/film.h"
#include "scene/scene.h"

namespace glimt {

/// Whether the scenes should give the same picture: only settings and name may differ.
bool same_picture(const Scene& a, const Scene& b);

/// Reads an EXR or PFM to measure the scene's pictures against. Throws std::runtime_error with the reason where the
/// file cannot be read, has another size, or names another scene.
Image read_reference(const std::filesystem::path& file, const Scene& scene);

}  // namespace glimt
