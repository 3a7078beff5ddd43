#pragma once

#include <string>
#include <string_view>

#include "scene/scene.h"

/// The window's words for fields (scene/fields.h) and their values.
namespace glimt {

/// A key or value in words: "shadow_rays" becomes "Shadow rays", "oren-nayar" "Oren-Nayar".
std::string label_of(std::string_view key);

/// A field's documentation, beginning with a capital letter.
std::string sentence(std::string_view doc);

/// The unit of a field's value, empty where it has none. A roughness is in radians only if its documentation says so.
std::string_view unit_of(std::string_view key, std::string_view doc);

/// "400 × 300".
std::string size_text(const ImageSize& size);

}  // namespace glimt
