#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace glimt {

/// A setting's key in words: "shadow_rays" becomes "shadow rays".
inline std::string words(std::string_view key) {
  std::string text(key);
  std::ranges::replace(text, '_', ' ');
  return text;
}

}  // namespace glimt
