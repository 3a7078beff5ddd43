#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "import/import_parts.h"
#include "import/mitsuba_xml.h"

namespace glimt {

/// An import of a Mitsuba scene as it goes on.
struct MitsubaImport {
  const MitsubaFile& file;
  ImportedScene result{};
  std::map<std::string, std::string> materials{};  ///< ours by the place of a BSDF
  std::set<std::string> noted{};

  Scene& scene() { return result.scene; }
  /// Once for each place.
  void note(pugi::xml_node node, const std::string& what, const std::string& instead);
};

/// An rgb, spectrum or texture as three numbers.
glm::dvec3 colour_of(MitsubaImport& in, pugi::xml_node object, std::string_view name, const glm::dvec3& otherwise);

/// The name of the material that stands for a BSDF.
std::string import_bsdf(MitsubaImport& in, pugi::xml_node bsdf);
/// For a shape without a BSDF.
std::string default_bsdf(MitsubaImport& in);

void import_shape(MitsubaImport& in, pugi::xml_node shape);

/// Camera, image and samples.
void import_sensor(MitsubaImport& in, pugi::xml_node sensor);

}  // namespace glimt
