#include "viewer/state/window_settings.h"

#include <toml++/toml.h>
#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "film/file_bytes.h"
#include "scene/file/text.h"

namespace glimt {
namespace fs = std::filesystem;
namespace {

constexpr int smallest = 320, largest = 16384;

/// Reads the value of a key, if the table has it; throws where it has another type.
template <class T>
void take(const toml::table& table, std::string_view key, T& value) {
  const toml::node* node = table.get(key);
  if (!node) return;
  const auto found = node->value_exact<T>();
  if (!found) throw std::runtime_error(std::string(key) + " is of another kind");
  value = *found;
}

void take_side(const toml::table& table, std::string_view key, int& side) {
  auto value = std::int64_t{side};
  take(table, key, value);
  if (value < smallest || value > largest)
    throw std::runtime_error(std::string(key) + " is not " + range_text(smallest, largest, false));
  side = static_cast<int>(value);
}

WindowSettings read_table(const toml::table& table) {
  WindowSettings settings;
  take_side(table, "width", settings.width);
  take_side(table, "height", settings.height);
  take(table, "hint_seen", settings.hint_seen);
  take(table, "chart", settings.chart.shown);
  take(table, "picture_fits_window", settings.fits_window);
  bool by_samples = false;
  take(table, "chart_by_samples", by_samples);
  if (by_samples) settings.chart.across = Across::samples;
  if (std::string drag_view; table.contains("drag_view")) {
    take(table, "drag_view", drag_view);
    const auto* const name = std::ranges::find(drag_view_names, drag_view);
    if (name == drag_view_names.end()) throw std::runtime_error("drag_view is not one of auto, turn, orbit");
    settings.drag_view = static_cast<DragView>(name - drag_view_names.begin());
  }
  std::string folder;
  take(table, "folder", folder);
  settings.folder = folder;
  std::map<std::string, std::string> texts;
  for (const auto& field : display_fields())
    if (const std::string key(field.key); table.contains(key)) take(table, key, texts[key]);
  settings.display = read_display(texts);
  return settings;
}

}  // namespace

fs::path window_settings_file() {
  for (const auto& [variable, below] : {std::pair{"XDG_CONFIG_HOME", ""}, std::pair{"HOME", ".config"}})
    if (const char* value = std::getenv(variable); value && *value)
      return fs::path(value) / below / "glimt" / "window.toml";
  return {};
}

WindowSettings read_window_settings(const fs::path& file, std::string& note) {
  std::error_code missing;
  if (!fs::exists(file, missing)) return {};
  try {
    return read_table(toml::parse(read_file(file)));
  } catch (const std::exception& error) {
    note = "The window's settings are damaged and were left aside (" + file.string() + ": " + error.what() + ")";
    return {};
  }
}

void write_window_settings(const fs::path& file, const WindowSettings& settings) {
  const auto truth = [](bool value) { return value ? "true" : "false"; };
  std::string text = "width = " + std::to_string(settings.width) + "\nheight = " + std::to_string(settings.height) +
                     "\nhint_seen = " + truth(settings.hint_seen) + "\nchart = " + truth(settings.chart.shown) +
                     "\nchart_by_samples = " + truth(settings.chart.across == Across::samples) +
                     "\ndrag_view = " + toml_string(drag_view_names[static_cast<std::size_t>(settings.drag_view)]) +
                     "\npicture_fits_window = " + truth(settings.fits_window) +
                     "\nfolder = " + toml_string(settings.folder.string()) + "\n";
  for (const auto& [key, value] : display_texts(settings.display)) text += key + " = " + toml_string(value) + "\n";
  std::error_code failed;  // writing says what is wrong
  fs::create_directories(file.parent_path(), failed);
  replace_file(file, text);
}

}  // namespace glimt
