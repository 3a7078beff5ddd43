#pragma once

#include <string>
#include <string_view>

#include "scene/scene.h"

/// How the field table (scene/fields.h) and its values are said in the window.
namespace glimt {

/// A key or value in words: "shadow_rays" becomes "Shadow rays", "oren-nayar" "Oren-Nayar".
std::string label_of(std::string_view key);

/// A line of documentation with a capital letter at its start.
std::string sentence(std::string_view doc);

/// The unit of a field's value, or nothing. A roughness is in radians only where its documentation says so.
std::string_view unit_of(std::string_view key, std::string_view doc);

/// "400 × 300".
std::string size_text(const ImageSize& size);

}  // namespace glimt
