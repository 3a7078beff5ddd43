#pragma once

#include <memory>

#include "film/display.h"
#include "render/session.h"

namespace glimt {

/// The image that a view shows of the frame, for to_srgb8; null where the frame does not hold it.
std::shared_ptr<const Image> shown_image(const std::shared_ptr<const Frame>& frame, View view);

}  // namespace glimt
