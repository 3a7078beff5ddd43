#include "viewer/widgets/labels.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace glimt {
namespace {

struct Wording {
  std::string_view key, label, unit;
};

/// Keys that need other words or have a unit.
constexpr std::array wordings{
    Wording{"spp", "Samples / pixel", ""},
    Wording{"seed", "Random seed", ""},
    Wording{"ior", "Refractive index", ""},
    Wording{"center", "Centre", "m"},
    Wording{"radius", "Radius", "m"},
    Wording{"size", "Size", "m"},
    Wording{"eye", "Eye", "m"},
    Wording{"look_at", "Looks at", "m"},
    Wording{"fov_y", "Field of view", "\u00B0"},
    Wording{"cutaway", "Outside view", ""},
    Wording{"target_error", "Error", ""},
    Wording{"image", "Image", ""},
    Wording{"error", "Standard error", ""},
    Wording{"samples", "Samples per pixel", ""},
    Wording{"eon", "EON", ""},
    Wording{"mis", "MIS", ""},
    Wording{"radiance", "Radiance", "W/(m\u00B2 sr)"},
    Wording{"emission", "Glow", "W/(m\u00B2 sr)"},
};

const Wording* wording(std::string_view key) {
  const auto* found = std::find_if(wordings.begin(), wordings.end(), [&](const Wording& w) { return w.key == key; });
  return found == wordings.end() ? nullptr : found;
}

}  // namespace

std::string label_of(std::string_view key) {
  if (const Wording* known = wording(key)) return std::string(known->label);
  std::string words(key);
  bool name_part = true;
  for (char& c : words) {
    if (name_part) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    name_part = c == '-';
    if (c == '_') c = ' ';
  }
  return words;
}

std::string sentence(std::string_view doc) {
  std::string text(doc);
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

std::string_view unit_of(std::string_view key, std::string_view doc) {
  if (doc.ends_with("radians")) return "rad";
  const Wording* known = wording(key);
  return known != nullptr ? known->unit : std::string_view();
}

std::string size_text(const ImageSize& size) {
  return std::to_string(size.width) + " \u00D7 " + std::to_string(size.height);
}

}  // namespace glimt
