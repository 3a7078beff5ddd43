#pragma once

#include <cstdio>
#include <string>

#include "mesh/mesh_data.h"

namespace glimt {

/// As scene texts in pictures and checkpoints have it: 16 hexadecimal digits.
inline std::string hash_text(const MeshData& data) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(data.hash));
  return text;
}

}  // namespace glimt
