#include "viewer/screen.h"

#include <GL/gl.h>
#include <backends/imgui_impl_opengl2.h>
#include <imgui.h>

#include <cmath>
#include <string>

#include "viewer/layout.h"
#include "viewer/panels.h"
#include "viewer/style.h"

namespace glimt {
namespace {

constexpr auto fixed_window = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                              ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;

void place_window(const Rect& place) {
  ImGui::SetNextWindowPos({place.x, place.y});
  ImGui::SetNextWindowSize({place.width, place.height});
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
}

Screen::~Screen() {
  image_.reset();
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

void Screen::draw(const ViewerState& state, float scale, Edits& edits) {
  const ImGuiIO& io = ImGui::GetIO();
  const float ratio = io.DisplayFramebufferScale.x;
  set_scale(scale, ratio);
  ImGui_ImplOpenGL2_NewFrame();
  ImGui::NewFrame();
  widgets_.clear();

  const Layout layout = make_layout(io.DisplaySize.x, io.DisplaySize.y, scale);
  const Placement picture = image_->draw(state.frame, state.display, layout.image, ratio);
  widgets_["image"] = picture.rect;
  draw_column(state, layout.column, edits);
  draw_status(state, layout.status, picture);

  ImGui::Render();
  const ImVec4 backdrop = ImColor(style::backdrop);
  glViewport(0, 0, static_cast<int>(io.DisplaySize.x * ratio), static_cast<int>(io.DisplaySize.y * ratio));
  glClearColor(backdrop.x, backdrop.y, backdrop.z, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL2_RenderDrawData(ImGui::GetDrawData());
}

void Screen::draw_column(const ViewerState& state, const Rect& place, Edits& edits) {
  place_window(place);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {style::scaled(16), style::scaled(14)});
  ImGui::Begin("controls", nullptr, fixed_window);
  ImGui::PopStyleVar();
  draw_progress_panel(state);
  ImGui::Dummy({0, style::scaled(2)});
  draw_actions_panel(state, edits);
  ImGui::Dummy({0, style::scaled(2)});
  ImGui::Separator();

  // What does not fit scrolls, below progress and buttons, which stay.
  ImGui::BeginChild("knobs");
  ImGui::Dummy({0, style::scaled(1)});
  draw_display_panel(state, edits);
  draw_spheres_panel(state, edits);
  draw_settings_panel(state, edits);
  ImGui::EndChild();
  ImGui::End();
}

void Screen::draw_status(const ViewerState& state, const Rect& place, const Placement& picture) {
  place_window(place);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {style::scaled(12), style::scaled(5)});
  ImGui::Begin("status", nullptr, fixed_window | ImGuiWindowFlags_NoNav);
  ImGui::PopStyleVar();

  std::string size;
  if (state.frame) {
    size = std::to_string(state.frame->size.width) + " \u00D7 " + std::to_string(state.frame->size.height) + " at " +
           std::to_string(std::lround(picture.zoom * 100)) + " %";
  }
  const float width = ImGui::GetContentRegionAvail().x;
  const float size_width = ImGui::CalcTextSize(size.c_str()).x;
  const bool hint = state.message.text.empty();
  const std::string line = hint ? "space  pause     R  restart     S  snapshot     Esc  quit" : state.message.text;
  const ImU32 colour = hint ? style::muted : state.message.error ? style::error : ImGui::GetColorU32(ImGuiCol_Text);
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::TextUnformatted(fit_text(line, width - size_width - style::scaled(16)).c_str());
  ImGui::PopStyleColor();
  note_widget("message");
  if (!hint) tooltip(line);
  ImGui::SameLine(ImGui::GetCursorPosX() + width - size_width);
  ImGui::TextDisabled("%s", size.c_str());
  ImGui::End();
}

}  // namespace glimt
