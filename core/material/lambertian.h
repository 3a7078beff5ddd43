#pragma once

#include "material/shared.h"

namespace glimt {

/// f = reflectance / pi.
struct Lambertian : Matt {
  static constexpr std::string_view name = "lambertian", doc = "matt, equally bright from everywhere";
  static std::vector<Field<Material>> fields() { return {field<reflectance>(), field<emission>()}; }
};

}  // namespace glimt
