#include "viewer/panels/files_panel.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "import/import.h"
#include "viewer/widgets/style.h"
#include "viewer/widgets/widgets.h"

namespace glimt {
namespace fs = std::filesystem;
namespace {

constexpr float sheet_width = 460, list_height = 320;
constexpr std::size_t longest_name = 256;

bool is_wanted(const fs::path& file, FilePurpose purpose) {
  const fs::path ending = file.extension();
  if (purpose == FilePurpose::reference) return ending == ".exr" || ending == ".pfm";
  return ending == ".toml" || ending == ".png" || ending == ".exr" || ending == ".ckpt" || is_importable(file);
}

}  // namespace

void FilesPanel::show(FilePurpose purpose, const ViewerState& state) {
  purpose_ = purpose;
  name_ = state.file.empty() ? "scene.toml" : state.file.filename().string();
  look_into(state.folder.empty() ? fs::path(".") : state.folder);
}

void FilesPanel::look_into(const fs::path& folder) {
  std::error_code failed;
  const fs::path whole = fs::canonical(folder, failed);
  folder_ = failed ? fs::current_path(failed) : whole;
  entries_.clear();
  if (folder_.has_parent_path() && folder_ != folder_.root_path()) entries_.push_back({"..", true});
  const std::size_t first = entries_.size();
  for (fs::directory_iterator it(folder_, fs::directory_options::skip_permission_denied, failed), end;
       !failed && it != end; it.increment(failed)) {
    std::error_code ignored;
    const bool is_folder = it->is_directory(ignored);
    const std::string name = it->path().filename().string();
    if (!name.starts_with('.') && (is_folder || is_wanted(it->path(), purpose_))) entries_.push_back({name, is_folder});
  }
  std::sort(entries_.begin() + static_cast<std::ptrdiff_t>(first), entries_.end(), [](const Entry& a, const Entry& b) {
    return std::pair(!a.is_folder, a.name) < std::pair(!b.is_folder, b.name);
  });
}

void FilesPanel::draw(const Rect& area, Edits& edits) {
  if (!is_open()) return;
  ImGui::SetNextWindowPos({area.x + area.width / 2, area.y + area.height / 2}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSize({std::min(style::scaled(sheet_width), area.width), 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {style::scaled(20), style::scaled(16)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, style::scaled(8));
  ImGui::PushStyleColor(ImGuiCol_WindowBg, style::sheet);
  ImGui::Begin("files", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(2);
  constexpr std::array titles{"", "Open a scene, or a picture with its scene", "Save the scene",
                              "Open a reference: EXR or PFM of this scene and size"};
  heading(titles.at(static_cast<std::size_t>(purpose_)));
  ImGui::PushStyleColor(ImGuiCol_Text, style::muted);
  ImGui::TextUnformatted(fit_text(folder_.string(), ImGui::GetContentRegionAvail().x).c_str());
  ImGui::PopStyleColor();
  tooltip(folder_.string());
  draw_entries(edits);
  draw_name(edits);
  ImGui::End();
}

void FilesPanel::draw_entries(Edits& edits) {
  ImGui::PushStyleColor(ImGuiCol_ChildBg, style::well);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {style::scaled(8), style::scaled(6)});
  ImGui::BeginChild("entries", {0, style::scaled(list_height)}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
  std::string into;
  for (const Entry& entry : entries_) {
    const bool chosen = ImGui::Selectable((entry.name + (entry.is_folder ? "/" : "")).c_str(), entry.name == name_);
    if (ImGui::IsItemVisible()) note_widget("files." + entry.name);
    if (!chosen) continue;
    if (entry.is_folder) {
      into = entry.name;
    } else {
      name_ = entry.name;
      if (purpose_ != FilePurpose::save) choose(edits);
    }
  }
  ImGui::EndChild();
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
  if (into.empty()) return;
  look_into(folder_ / into);
  edits.folder = folder_;
}

void FilesPanel::draw_name(Edits& edits) {
  const float button = style::scaled(88), gap = ImGui::GetStyle().ItemSpacing.x;
  bool chosen = false, possible = true;
  const char* label = "Save";
  if (purpose_ == FilePurpose::save) {
    name_.resize(longest_name);
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - 2 * (button + gap));
    chosen = ImGui::InputText("##name", name_.data(), longest_name, ImGuiInputTextFlags_EnterReturnsTrue);
    note_widget("files.name");
    name_.resize(std::strlen(name_.c_str()));
    std::error_code missing;
    const bool there = !name_.empty() && fs::exists(folder_ / name_, missing);
    if (there) label = "Replace";
    possible = !name_.empty() && fs::path(name_).extension() == ".toml";
    ImGui::SameLine();
    ImGui::BeginDisabled(!possible);
    chosen |= ImGui::Button((std::string(label) + "##save").c_str(), {button, 0});
    ImGui::EndDisabled();
    note_widget("files.save");
    if (!possible) tooltip("A scene file's name ends in .toml");
    ImGui::SameLine();
  } else {
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - button);
  }
  if (ImGui::Button("Cancel", {button, 0})) close();
  note_widget("files.cancel");
  if (chosen && possible && is_open()) choose(edits);
}

void FilesPanel::choose(Edits& edits) {
  auto& wanted = purpose_ == FilePurpose::reference ? edits.load_reference
                 : purpose_ == FilePurpose::open    ? edits.open
                                                    : edits.save;
  wanted = folder_ / name_;
  close();
}

}  // namespace glimt
