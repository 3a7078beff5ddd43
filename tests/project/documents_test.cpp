// What the documents say exists: their links lead somewhere, every scene, setting and material is described in
// docs/scene-files.md, README.md is short, and third_party/ describes what it installs.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "scene/fields.h"

namespace fs = std::filesystem;

namespace {

const fs::path root = fs::path(GLIMT_TESTS_DIR).parent_path();

std::string read(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<fs::path> documents() {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(root)) {
    const fs::path& path = entry.path();
    if (path.extension() == ".md") found.push_back(path);
    if (!entry.is_directory() || path.filename() == "build" || path.filename().string().starts_with('.')) continue;
    for (const auto& below : fs::recursive_directory_iterator(path))
      if (below.path().extension() == ".md") found.push_back(below.path());
  }
  return found;
}

/// Targets of the links and images of a Markdown document that are not on the web: "[x](docs/a.png#b)" gives
/// "docs/a.png".
std::vector<std::string> local_links(const std::string& markdown) {
  static const std::regex link(R"(\]\(([^)#\s]+)[^)]*\))");
  std::vector<std::string> found;
  for (std::sregex_iterator i(markdown.begin(), markdown.end(), link), end; i != end; ++i)
    if (const std::string target = (*i)[1]; target.find("://") == std::string::npos) found.push_back(target);
  return found;
}

std::vector<std::string> packages() {
  std::istringstream lines(read(root / "third_party/packages.txt"));
  std::vector<std::string> found;
  for (std::string line; std::getline(lines, line);)
    if (!line.empty() && line[0] != '#' && line[0] != '[') found.push_back(line.substr(0, line.find(' ')));
  return found;
}

bool names(const std::string& text, std::string_view word) {
  return std::regex_search(
      text, std::regex("(^|[^\\w-])" + std::regex_replace(std::string(word), std::regex(R"([+.])"), R"(\$&)") +
                       "($|[^\\w-])"));
}

TEST(Documents, LinksLeadSomewhere) {
  EXPECT_EQ(local_links("[a](b.md#c) ![d](e/f.png) [g](https://h.org/i) [j](#k)"),
            (std::vector<std::string>{"b.md", "e/f.png"}));
  const auto all = documents();
  EXPECT_GE(all.size(), 3U) << "README.md, third_party/README.md, tests/README.md";
  for (const fs::path& document : all)
    for (const std::string& target : local_links(read(document)))
      EXPECT_TRUE(fs::exists(document.parent_path() / target)) << document << " links to " << target;
}

TEST(Documents, ReadmeIsShort) {
  const std::string text = read(root / "README.md");
  EXPECT_LE(std::ranges::count(text, '\n'), 150) << "README.md: what is longer belongs in docs/";
}

TEST(Documents, EveryPackageIsExplained) {
  EXPECT_TRUE(names("| libgl-dev, libx |", "libgl-dev"));
  EXPECT_FALSE(names("| libgl-devel |", "libgl-dev"));
  const std::string text = read(root / "third_party/README.md");
  EXPECT_GT(packages().size(), 15U);
  for (const std::string& package : packages())
    EXPECT_TRUE(names(text, package)) << package << " in third_party/README.md";
}

TEST(Documents, EverySettingAndMaterialIsDescribed) {
  const std::string text = read(root / "docs/scene-files.md");
  const auto expect_fields = [&](const auto& fields) {
    for (const auto& field : fields) EXPECT_TRUE(names(text, field.key)) << field.key << " in docs/scene-files.md";
  };
  expect_fields(glimt::settings_fields());
  expect_fields(glimt::camera_fields());
  expect_fields(glimt::image_fields());
  expect_fields(glimt::sphere_fields());
  expect_fields(glimt::placement_fields());
  for (const auto& material : glimt::material_infos()) {
    EXPECT_TRUE(names(text, material.name)) << material.name << " in docs/scene-files.md";
    expect_fields(material.fields);
  }
}

TEST(Documents, EverySceneIsDescribed) {
  const std::string text = read(root / "docs/scene-files.md");
  for (const auto& entry : fs::directory_iterator(root / "scenes"))
    EXPECT_TRUE(names(text, entry.path().filename().string())) << entry.path().filename() << " in docs/scene-files.md";
}

}  // namespace
