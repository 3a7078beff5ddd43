// Includes point one way: math <- mesh <- scene <- import <- material <- lamp <- compile <- kernel <- film <- render <-
// app. Only core/math/lanes.h names xsimd. Core knows no window, no OpenGL and no command line. The maps in
// core/README.md and app/README.md name every folder. No two headers give two types the same name. Only the list of
// materials includes a material.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 10> core_layers = {"math", "mesh",    "scene",  "import", "material",
                                                          "lamp", "compile", "kernel", "film",   "render"};

const fs::path root = fs::path(GLIMT_TESTS_DIR).parent_path();

std::string first_folder(const std::string& path) { return path.substr(0, path.find('/')); }

/// Place of a folder of core/ in the order of the layers; -1 for any other.
int layer(const std::string& folder) {
  const auto place = std::ranges::find(core_layers, folder);
  return place == core_layers.end() ? -1 : static_cast<int>(place - core_layers.begin());
}

std::string without_comments(const std::string& text) {
  return std::regex_replace(text, std::regex(R"(//[^\n]*|/\*[^]*?\*/)"), "");
}

/// What is wrong with the includes of a file. `path` is relative to the root: "core/film/film.h".
std::vector<std::string> violations(const std::string& path, const std::string& text) {
  static const std::regex quoted(R"(^[ \t]*#[ \t]*include[ \t]*"([^"]*)\")", std::regex::multiline);
  static const std::regex window_library(
      R"(^[ \t]*#[ \t]*include[ \t]*[<"]((GLFW|GL|GLES\d?|EGL|CLI|backends)/|imgui|imgui_|implot|X11/))",
      std::regex::multiline);
  static const std::regex xsimd(R"(\bxsimd\b)");

  const bool in_core = path.starts_with("core/");
  const int own = in_core ? layer(first_folder(path.substr(5))) : static_cast<int>(core_layers.size());
  const std::string code = without_comments(text);
  std::vector<std::string> found;

  if (own < 0) found.push_back(path + ": is in no layer of core/");
  for (std::sregex_iterator i(code.begin(), code.end(), quoted), end; i != end; ++i) {
    const std::string name = (*i)[1];
    if (fs::exists(root / "core" / name)) {
      if (layer(first_folder(name)) > own) found.push_back(path + ": includes " + name + ", which is above it");
    } else if (fs::exists(root / "app" / name)) {
      if (in_core) found.push_back(path + ": core includes " + name + " of app");
    } else {
      found.push_back(path + ": no " + name + " relative to core/ or app/");
    }
  }
  if (in_core && std::regex_search(code, window_library))
    found.push_back(path + ": core includes a library of the program");
  if (path != "core/math/lanes.h" && std::regex_search(code, xsimd)) found.push_back(path + ": names xsimd");
  return found;
}

std::string read(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(IncludeDirection, HoldsInTheSources) {
  int files = 0;
  for (const char* part : {"core", "app"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / part)) {
      const std::string ending = entry.path().extension().string();
      if (ending != ".h" && ending != ".cpp") continue;
      ++files;
      for (const std::string& what : violations(fs::relative(entry.path(), root).generic_string(), read(entry.path())))
        ADD_FAILURE() << what;
    }
  }
  EXPECT_GT(files, 20) << "the sources were not found under " << root;
}

/// Folders below `part` that hold sources, relative to it, with a slash at the end.
std::set<std::string> rooms(const fs::path& part) {
  std::set<std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(part)) {
    const std::string ending = entry.path().extension().string();
    if (ending != ".h" && ending != ".cpp") continue;
    const std::string room = fs::relative(entry.path().parent_path(), part).generic_string();
    if (room != ".") found.insert(room + "/");
  }
  return found;
}

/// The folders that the table below the heading "Map" names: its first cells, in backquotes.
std::set<std::string> mapped_rooms(const std::string& document) {
  const std::size_t begin = document.find("## Map\n");
  if (begin == std::string::npos) return {};
  const std::string map = document.substr(begin, document.find("\n## ", begin + 1) - begin);
  static const std::regex row(R"(^\| `([^`]+/)` \|)", std::regex::multiline);
  std::set<std::string> found;
  for (std::sregex_iterator i(map.begin(), map.end(), row), end; i != end; ++i) found.insert((*i)[1]);
  return found;
}

TEST(Map, NamesEveryFolderOfSourcesAndNoOther) {
  for (const char* part : {"core", "app"}) {
    const std::set<std::string> there = rooms(root / part);
    EXPECT_GT(there.size(), 2u) << "the sources were not found under " << root;
    EXPECT_EQ(mapped_rooms(read(root / part / "README.md")), there) << part << "/README.md";
  }
}

/// Types that a file defines at the top of its namespace, which have no indentation.
std::vector<std::string> types_of(const std::string& text) {
  static const std::regex type(R"(^(?:struct|class|enum class|enum|union) (\w+)(?: : [^;{]*)? \{)",
                               std::regex::multiline);
  std::vector<std::string> found;
  for (std::sregex_iterator i(text.begin(), text.end(), type), end; i != end; ++i) found.push_back((*i)[1]);
  return found;
}

// The linker joins what both define, a constructor say, and takes either: no compiler warns of it.
TEST(Headers, NoTwoDefineATypeOfTheSameName) {
  std::map<std::string, std::string> defined_in;
  for (const char* part : {"core", "app"})
    for (const auto& entry : fs::recursive_directory_iterator(root / part)) {
      if (entry.path().extension() != ".h") continue;
      const std::string path = fs::relative(entry.path(), root).generic_string();
      for (const std::string& type : types_of(read(entry.path()))) {
        const auto [place, is_new] = defined_in.emplace(type, path);
        EXPECT_TRUE(is_new) << type << " is defined in " << path << " and in " << place->second;
      }
    }
  EXPECT_GT(defined_in.size(), 100u) << "the headers were not found under " << root;
  EXPECT_EQ(types_of("struct Box : Shape {\n  struct Inner {\n};\nenum class Kind : int {\n"),
            (std::vector<std::string>{"Box", "Kind"}));
}

/// Names of the headers that a text includes from core/material/.
std::set<std::string> materials_in(const std::string& text) {
  static const std::regex include("^#include \"material/(\\w+\\.h)\"", std::regex::multiline);
  std::set<std::string> found;
  for (std::sregex_iterator i(text.begin(), text.end(), include), end; i != end; ++i) found.insert((*i)[1]);
  return found;
}

// So a new material is its own file and a line in the list. The report page has scenes of its own to change.
TEST(Materials, AreKnownByTheirListAlone) {
  const std::set<std::string> materials = materials_in(read(root / "core/material/list.h"));
  EXPECT_GT(materials.size(), 5u);
  for (const char* part : {"core", "app"})
    for (const auto& entry : fs::recursive_directory_iterator(root / part)) {
      const std::string path = fs::relative(entry.path(), root).generic_string();
      const std::string ending = entry.path().extension().string();
      if ((ending != ".h" && ending != ".cpp") || path.starts_with("core/material/") ||
          path.starts_with("app/cli/report_"))
        continue;
      for (const std::string& name : materials_in(read(entry.path())))
        EXPECT_FALSE(materials.contains(name)) << path << " includes material/" << name;
    }
}

TEST(IncludeDirection, AllowsIncludesFromBelowAndBeside) {
  EXPECT_TRUE(
      violations("core/film/x.cpp", "#include <glm/vec3.hpp>\n#include \"scene/scene.h\"\n#include \"film/film.h\"\n")
          .empty());
  EXPECT_TRUE(
      violations("app/viewer/x.cpp", "#include <GLFW/glfw3.h>\n#include <imgui.h>\n#include \"render/session.h\"\n")
          .empty());
  EXPECT_TRUE(violations("core/math/lanes.h", "#include <xsimd/xsimd.hpp>\nusing B = xsimd::batch<float>;\n").empty());
  EXPECT_TRUE(
      violations("core/film/x.cpp", "// \"render/render.h\" and xsimd in a comment\n/*\n#include <imgui.h>\n*/\n")
          .empty());
}

TEST(IncludeDirection, FindsEveryKindOfViolation) {
  const auto one = [](const std::string& path, const std::string& text) { return violations(path, text).size() == 1; };
  EXPECT_TRUE(one("core/math/x.h", "#include \"scene/scene.h\"\n"));
  EXPECT_TRUE(one("core/kernel/x.cpp", "\n  #  include \"film/film.h\"\n"));
  EXPECT_TRUE(one("core/film/x.cpp", "#include \"render/render.h\"\n"));
  EXPECT_TRUE(one("core/scene/x.cpp", "#include \"scene.h\"\n")) << "not relative to core/";
  EXPECT_TRUE(one("core/scene/x.cpp", "#include \"scene/no_such_file.h\"\n"));
  EXPECT_TRUE(one("core/x.cpp", "")) << "a file outside the layers";
  EXPECT_TRUE(one("core/kernel/x.h", "#include <xsimd/xsimd.hpp>\n"));
  EXPECT_TRUE(one("app/cli/x.cpp", "using B = xsimd::batch<float>;\n"));
  for (const char* name : {"GLFW/glfw3.h", "GL/gl.h", "imgui.h", "backends/imgui_impl_glfw.h", "CLI/CLI.hpp"})
    EXPECT_TRUE(one("core/render/x.cpp", "#include <" + std::string(name) + ">\n")) << name;
}

}  // namespace
