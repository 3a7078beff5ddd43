#include "viewer/screen.h"

#include <GL/gl.h>
#include <backends/imgui_impl_opengl2.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "scene/fields.h"
#include "viewer/chart_view/chart_panel.h"
#include "viewer/keys.h"
#include "viewer/picture/notice.h"
#include "viewer/state/compare_actions.h"
#include "viewer/widgets/labels.h"
#include "viewer/widgets/layout.h"
#include "viewer/widgets/style.h"

namespace glimt {
namespace {

constexpr float worst_pixel_zoom = 16;  ///< framebuffer pixels per picture pixel

/// All that decides what the window looks like, except the contents of textures.
std::string bytes_of(const ImDrawData& data) {
  std::string bytes;
  const auto add = [&bytes](const auto* first, int count) {
    bytes.append(reinterpret_cast<const char*>(first), static_cast<std::size_t>(count) * sizeof *first);
  };
  add(&data.DisplaySize, 1);
  add(&data.FramebufferScale, 1);
  for (const ImDrawList* list : std::span(data.CmdLists, static_cast<std::size_t>(data.CmdListsCount))) {
    add(list->CmdBuffer.Data, list->CmdBuffer.Size);
    add(list->VtxBuffer.Data, list->VtxBuffer.Size);
    add(list->IdxBuffer.Data, list->IdxBuffer.Size);
  }
  return bytes;
}

ImageSize room_of(const Layout& layout, float ratio) {
  const auto side = [ratio](float length) {
    return std::clamp(static_cast<int>(length * ratio), 1, static_cast<int>(image_fields()[0].max));
  };
  return {side(layout.image.width), side(layout.image.height)};
}

}  // namespace

Screen::Screen() {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.UserData = &widgets_;
  ImGui_ImplOpenGL2_Init();
  image_ = std::make_unique<ImageView>();
  compare_ = std::make_unique<CompareLayer>();
}

Screen::~Screen() {
  image_.reset();
  compare_.reset();
  ImGui_ImplOpenGL2_Shutdown();
  ImGui::DestroyContext();
}

void Screen::set_scale(float scale, float ratio) {
  if (scale == scale_ && ratio == ratio_) return;
  scale_ = scale;
  ratio_ = ratio;
  style::apply(scale, ratio);
  ImGui_ImplOpenGL2_DestroyFontsTexture();
  ImGui_ImplOpenGL2_CreateFontsTexture();
}

ImageSize room_in_window(int width, int height) {
  const Layout layout = make_layout(static_cast<float>(width), static_cast<float>(height), 1);
  return room_of(layout, 1);
}

void Screen::lay_out(const ViewerState& state, float scale, Edits& edits) {
  const ImGuiIO& io = ImGui::GetIO();
  const float ratio = io.DisplayFramebufferScale.x;
  set_scale(scale, ratio);
  ImGui_ImplOpenGL2_NewFrame();
  ImGui::NewFrame();
  widgets_.clear();

  follow_gesture(edits);
  const ImageSize& size = state.scene.image;
  Layout layout = make_layout(io.DisplaySize.x, io.DisplaySize.y, scale);
  const Rect sheets = layout.image;  // may cover the chart
  // The chart only shrinks the picture on the screen. The image keeps its size, and so its samples.
  edits.room = room_of(layout, ratio);
  if (state.chart.view.shown) layout = with_chart(layout, size.width, size.height, scale);
  chart_ = layout.chart;
  const PicturePlace picture = place_image(size.width, size.height, layout.image, ratio, tool_.zoom());
  image_->draw(state.frame, state.display, layout.image, picture);
  compare_->draw(state, layout.image, picture);
  tool_.draw_outline(state, layout.image, picture);
  widgets_["image"] = picture.rect;
  tool_.take_mouse(state, layout.image, picture, edits);
  inspector_.draw(state, layout.image, picture);
  draw_hint(state, layout.image);
  draw_notice(state, layout.image, edits);
  compare_->draw_line(state, layout.image, picture, edits);
  draw_column(state, layout.column, edits);
  if (state.chart.view.shown) draw_chart_panel(state, layout.chart, edits);
  carry_out(state, edits);
  draw_status(state, layout.status, picture);
  files_.draw(sheets, edits);
  if (help_ && draw_help_panel(sheets)) help_ = false;
  selected_ = state.selected;

  ImGui::Render();
}

bool Screen::paint() {
  const ImDrawData& data = *ImGui::GetDrawData();
  std::string lists = bytes_of(data);
  const bool new_picture = image_->prepare(), new_comparison = compare_->prepare();
  if (!new_picture && !new_comparison && lists == painted_) return false;
  painted_ = std::move(lists);

  const ImVec4 backdrop = ImColor(style::backdrop);
  glViewport(0, 0, static_cast<int>(data.DisplaySize.x * data.FramebufferScale.x),
             static_cast<int>(data.DisplaySize.y * data.FramebufferScale.y));
  glClearColor(backdrop.x, backdrop.y, backdrop.z, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL2_RenderDrawData(ImGui::GetDrawData());
  return true;
}

void Screen::follow_gesture(Edits& edits) {
  constexpr double pause_between_scrolls = 0.5;  // seconds
  const ImGuiIO& io = ImGui::GetIO();
  const unsigned active = ImGui::GetCurrentContext()->ActiveId;
  const double now = ImGui::GetTime();
  bool other = active != active_ || ImGui::IsMouseClicked(ImGuiMouseButton_Left) ||
               ImGui::IsMouseClicked(ImGuiMouseButton_Middle) || ImGui::IsMouseClicked(ImGuiMouseButton_Right);
  if (io.MouseWheel != 0) other |= now - std::exchange(last_scroll_, now) > pause_between_scrolls;
  active_ = active;
  if (other) ++gesture_;
  edits.gesture = gesture_;
}

void Screen::carry_out(const ViewerState& state, Edits& edits) {
  if (edits.toggle_help) help_ = !help_;
  if (edits.escape && (help_ || files_.is_open())) {
    help_ = false;
    files_.close();
  } else if (edits.escape) {
    edits.select = std::optional<ObjectId>();
  }
  if (edits.choose_file) files_.show(*edits.choose_file, state);
  if (edits.zoom == PictureZoom::fitted) tool_.fit();
  if (edits.zoom == PictureZoom::pixel_by_pixel) tool_.set_zoom({.zoom = 1});
  if (edits.worst_pixel) go_to_worst_pixel(state, edits);
}

void Screen::go_to_worst_pixel(const ViewerState& state, Edits& edits) {
  const Held b = picture_b(state);
  if (!state.frame || !obstacle_to_compare(state).empty() || !same_size(state.frame->mean, b.frame->mean)) return;
  const Pixel worst = worst_pixel(state.frame->mean, b.frame->mean);
  const auto share = [](int pixel, int pixels) {
    return (static_cast<float>(pixel) + 0.5F) / static_cast<float>(pixels);
  };
  tool_.set_zoom({worst_pixel_zoom, share(worst.x, b.frame->size.width), share(worst.y, b.frame->size.height)});
  inspector_.mark(worst);
  edits.inspect = true;
}

void Screen::drop(const std::filesystem::path& file, Edits& edits) const {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const bool picture = file.extension() == ".exr";
  if (file.extension() == ".pfm" || (picture && is_inside(chart_, mouse.x, mouse.y)))
    edits.load_reference = file;
  else
    edits.open = file;
}

void Screen::draw_column(const ViewerState& state, const Rect& place, Edits& edits) {
  begin_fixed_window("controls", place, 16, 14);
  draw_progress_panel(state, edits);
  draw_actions_panel(state, edits);
  ImGui::Dummy({0, style::scaled(2)});
  draw_display_panel(state, edits);
  draw_compare_panel(state, edits);
  ImGui::Dummy({0, style::scaled(4)});
  draw_tabs(state, edits);
  ImGui::End();
}

void Screen::draw_tabs(const ViewerState& state, Edits& edits) {
  struct Tab {
    const char *label, *name;
    void (*draw)(const ViewerState&, Edits&);
  };
  static constexpr Tab tabs[]{
      {"Objects", "tab.objects", draw_objects_panel},
      {"Lamp", "tab.lamp", draw_lamp_panel},
      {"Camera", "tab.camera", draw_camera_panel},
      {"Estimator", "tab.estimator", draw_estimator_panel},
      {"Scene", "tab.scene", [](const ViewerState& s, Edits&) { draw_scene_panel(s); }},
  };
  // A click on an object in the picture opens the objects' tab.
  const bool to_objects = state.selected && state.selected != selected_;
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {style::scaled(7), style::scaled(5)});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemInnerSpacing, {style::scaled(2), style::scaled(4)});
  const bool bar = ImGui::BeginTabBar("tabs", ImGuiTabBarFlags_FittingPolicyResizeDown);
  ImGui::PopStyleVar(2);
  if (!bar) return;
  for (const Tab& tab : tabs) {
    const bool bring_up = to_objects && &tab == tabs;
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {style::scaled(7), style::scaled(5)});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemInnerSpacing, {style::scaled(2), style::scaled(4)});
    const bool open = ImGui::BeginTabItem(tab.label, nullptr, bring_up ? ImGuiTabItemFlags_SetSelected : 0);
    ImGui::PopStyleVar(2);
    note_widget(tab.name);
    if (!open) continue;
    // Only the tab's contents scroll. Progress and buttons stay above.
    ImGui::BeginChild("knobs");
    ImGui::Dummy({0, style::scaled(1)});
    tab.draw(state, edits);
    ImGui::EndChild();
    ImGui::EndTabItem();
  }
  ImGui::EndTabBar();
}

void Screen::draw_hint(const ViewerState& state, const Rect& area) const {
  std::string line;
  if (tool_.flying()) {
    line =
        "Flying at " + short_number(tool_.speed(state)) + " m/s.  W A S D or arrows, Q down, E up, the wheel for speed";
  } else if (state.hint && state.frame) {
    line = "Click an object, drag to look around, scroll to come closer. F1 for more.";
  }
  if (line.empty()) return;
  const std::string text = fit_text(line, area.width - style::scaled(48));
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 at{area.x + (area.width - size.x) / 2, area.y + area.height - size.y - style::scaled(24)};
  const ImVec2 pad{style::scaled(14), style::scaled(8)};
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddRectFilled({at.x - pad.x, at.y - pad.y}, {at.x + size.x + pad.x, at.y + size.y + pad.y},
                     IM_COL32(15, 16, 18, 205), style::scaled(6));
  list.AddText(at, ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
}

void Screen::draw_status(const ViewerState& state, const Rect& place, const PicturePlace& picture) {
  begin_fixed_window("status", place, 12, 5, ImGuiWindowFlags_NoNav);
  std::string size;
  if (state.frame) {
    size = size_text(state.frame->size) + " at " + std::to_string(std::lround(picture.zoom * 100)) + " %";
  }
  const float width = ImGui::GetContentRegionAvail().x;
  const float size_width = ImGui::CalcTextSize(size.c_str()).x;
  const bool hint = state.message.text.empty();
  const std::string line = hint ? status_keys() : state.message.text;
  const ImU32 colour = hint ? style::muted : state.message.error ? style::error : ImGui::GetColorU32(ImGuiCol_Text);
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::TextUnformatted(fit_text(line, width - size_width - style::scaled(16)).c_str());
  ImGui::PopStyleColor();
  note_widget("message");
  note_widget("says." + line);
  if (!hint) tooltip(line);
  ImGui::SameLine(ImGui::GetCursorPosX() + width - size_width);
  ImGui::TextDisabled("%s", size.c_str());
  ImGui::End();
}

}  // namespace glimt
