#pragma once

#include "film/image_file.h"
#include "scene/scene.h"

namespace glimt {

/// How an image of this scene was made: "samples", "seconds" of rendering, "version" of glimt, every setting by its
/// key, and "scene", the scene file's text. Its spp is the sample count, so that rendering it gives this image again.
Metadata render_metadata(const Scene& scene, int samples, double seconds);

/// The same with "sample_ranges", the samples that each pixel has: "0:64" is 64 from sample 0 on.
Metadata render_metadata(const Scene& scene, const Film& film, double seconds);

}  // namespace glimt
