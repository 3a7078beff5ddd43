#pragma once

#include <functional>
#include <string>
#include <vector>

#include "check/block_difference.h"
#include "scene/scene.h"

/// Known mistakes of renderers, each as the picture that it makes.
namespace glimt {

struct Cause {
  std::string name;        ///< "caustics are missing"
  PictureDifference left;  ///< of the checked picture from the one that the mistake makes
};

/// Renders a scene to some error that is small beside the noise of the checked picture.
using RenderScene = std::function<Image(const Scene&)>;

/// Compares the picture with what every mistake makes of the scene whose right picture is `reference`. The best
/// explanation comes first. Mistakes that cannot show in the scene are left out.
std::vector<Cause> likely_causes(const Image& picture, const Scene& scene, const Image& reference,
                                 const RenderScene& render);

}  // namespace glimt
