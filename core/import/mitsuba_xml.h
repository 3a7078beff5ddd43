#pragma once

#include <filesystem>
#include <functional>
#include <glm/mat4x4.hpp>
#include <map>
#include <memory>
#include <pugixml.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace glimt {

/// A scene of Mitsuba as XML, with what it includes and its parameters filled in. Throws SceneError.
class MitsubaFile {
 public:
  explicit MitsubaFile(const std::filesystem::path& file);

  /// Calls with each object at the top of the scene, those of included files in their place.
  void for_each(const std::function<void(pugi::xml_node)>& visit) const;

  /// An attribute's value, "" where there is none.
  std::string attribute(pugi::xml_node node, const char* name) const;
  /// The object's property of that name, in the spelling of Mitsuba 3, or a null node.
  pugi::xml_node property(pugi::xml_node object, std::string_view name) const;
  /// Its property's value as text.
  std::string text(pugi::xml_node object, std::string_view name, std::string_view otherwise = {}) const;
  bool boolean(pugi::xml_node object, std::string_view name, bool otherwise) const;
  double number(pugi::xml_node object, std::string_view name, double otherwise) const;
  int integer(pugi::xml_node object, std::string_view name, int otherwise) const;
  /// Three numbers: "x", "y" and "z", or "value".
  glm::dvec3 vector(pugi::xml_node property, double otherwise) const;
  std::vector<double> numbers(pugi::xml_node node, const char* attribute) const;
  /// The matrix of a transform; the identity where there is none.
  glm::dmat4 transform(pugi::xml_node object, std::string_view name) const;
  /// What `node` refers to, or itself.
  pugi::xml_node resolved(pugi::xml_node node) const;

  std::filesystem::path path_of(const std::string& filename, pugi::xml_node node) const;
  std::string place(pugi::xml_node node) const;  ///< "room.xml:12"
  [[noreturn]] void fail(pugi::xml_node node, const std::string& what) const;

 private:
  struct Document {
    std::filesystem::path file;
    std::string text;
    pugi::xml_document xml;
  };
  void load(const std::filesystem::path& file, int depth);
  void visit_children(const Document& document, std::set<const Document*>& visited,
                      const std::function<void(pugi::xml_node)>& visit) const;
  const Document& document_of(pugi::xml_node node) const;
  void collect_ids(pugi::xml_node node, int depth);

  std::vector<std::unique_ptr<Document>> documents_;
  std::map<std::filesystem::path, std::size_t> by_path_;
  std::map<std::string, std::string> parameters_;
  std::map<std::string, pugi::xml_node> ids_;
};

}  // namespace glimt
