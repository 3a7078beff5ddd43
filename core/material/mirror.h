#pragma once

#include "material/shared.h"

namespace glimt {

struct Mirror : Reflecting {
  static constexpr std::string_view name = "mirror", doc = "perfect mirror", feature = "mirror reflection";
  static constexpr LobeClass lobe_class = LobeClass::delta;
  static std::vector<Field<Material>> fields() { return {field<reflectance>()}; }
};

}  // namespace glimt
