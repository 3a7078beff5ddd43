#pragma once

#include "film/image_file.h"
#include "scene/scene.h"

namespace glimt {

/// What an image of this scene says of its making: "scene" is the scene file's text, with the sample count as its spp
/// so that rendering it gives this image again; "samples"; "seconds" of rendering; "version" of glimt; and every
/// setting by its key.
Metadata render_metadata(const Scene& scene, int samples, double seconds);

/// The same with "sample_ranges", which samples of each pixel there are: "0:64" is 64 from sample 0 on.
Metadata render_metadata(const Scene& scene, const Film& film, double seconds);

}  // namespace glimt
