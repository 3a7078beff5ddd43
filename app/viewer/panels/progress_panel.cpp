#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "viewer/panels/panels.h"
#include "viewer/widgets/style.h"
#include "viewer/widgets/widgets.h"

namespace glimt {
namespace {

std::string number(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string duration(double seconds) {
  if (seconds < 60) return number("%.1f s", seconds);
  const int whole = static_cast<int>(seconds);
  char text[64];
  if (whole < 3600) {
    std::snprintf(text, sizeof text, "%d min %02d s", whole / 60, whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%d h %02d min", whole / 3600, whole / 60 % 60);
  }
  return text;
}

constexpr const char* dash = "\u2013";

/// Why the error is only a lower bound; empty where it is not.
std::string unseen_text(const Unseen& unseen) {
  if (unseen.light.empty()) return {};
  return number("\n\nUp to %.2g %% of the light may be missing.", 100 * unseen.flux) +
         " Chance alone finds it, and has found too little so far: " + unseen.light + ".";
}

/// Share of the way to the target, 0..1. The error falls as 1 / samples.
double share_done(const Settings& settings, const Frame& frame) {
  if (frame.finished) return 1;
  if (settings.target_error == 0) return std::min(1.0, static_cast<double>(frame.samples) / settings.spp);
  return frame.samples > 1 ? std::min(1.0, settings.target_error / frame.estimate.at_most()) : 0;
}

/// Draws the picture's error against time, both logarithmic, in the rest of the row. An error that falls as 1 / time is
/// a straight line. Where there is a target, the share of the way to it is filled.
void draw_trend(const ViewerState& state, const Frame& frame, bool ends, double share) {
  ImGui::SameLine(0, style::scaled(8));
  const float width = ImGui::GetContentRegionAvail().x, height = ImGui::GetTextLineHeight();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, {at.x + width, at.y + height}, style::well, style::scaled(3));
  const float filled = ends ? static_cast<float>(share) * width : 0;
  if (filled > 0)
    list.AddRectFilled(at, {at.x + filled, at.y + height}, ImGui::GetColorU32(ImGuiCol_FrameBgActive),
                       style::scaled(3));
  ImGui::Dummy({width, height});
  note_widget(ends ? "progress" : "trend");
  tooltip(
      "The estimated error so far against time, both logarithmic. A straight line down is an error that falls as "
      "1 / time. What is filled is the way to where rendering stops.");
  const Curve* curve = state.chart.curves.current();
  std::vector<ImVec2> logs;
  if (curve && frame.samples > 1)
    for (const RunPoint& p : curve->points)
      if (const auto error = error_of(p, ErrorKind::estimate); error && p.seconds > 0)
        logs.emplace_back(static_cast<float>(std::log(p.seconds)), static_cast<float>(std::log(*error)));
  if (logs.size() < 2) return;
  const auto [low, high] = std::ranges::minmax(logs, {}, &ImVec2::y);
  const float left = logs.front().x, across = std::max(logs.back().x - left, 1e-3F);
  const float up = std::max(high.y - low.y, 1e-3F), pad = style::scaled(3);
  for (ImVec2& p : logs)
    p = {at.x + pad + (p.x - left) / across * (width - 2 * pad), at.y + pad + (high.y - p.y) / up * (height - 2 * pad)};
  list.AddPolyline(logs.data(), static_cast<int>(logs.size()), ImGui::GetColorU32(ImGuiCol_PlotHistogram),
                   ImDrawFlags_None, style::scaled(1.5F));
  list.AddCircleFilled(logs.back(), style::scaled(2.5F), ImGui::GetColorU32(ImGuiCol_PlotHistogram));
}

bool choose_stop(StopAt& stop) {
  constexpr std::array labels{"Never", "Samples", "Error"};
  const auto chosen = static_cast<std::size_t>(stop);
  const bool open = ImGui::BeginCombo("##choice", labels.at(chosen));
  note_widget("stop_at");
  if (!open) return false;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (ImGui::Selectable(labels.at(i), i == chosen)) stop = static_cast<StopAt>(i);
    note_widget("stop_at." + std::string(stop_at_names.at(i)));
  }
  ImGui::EndCombo();
  return static_cast<std::size_t>(stop) != chosen;
}

/// Where to stop: never, or at the number beside the choice.
void edit_goal(const ViewerState& state, Edits& edits) {
  RenderGoal goal = state.goal;
  begin_row("Stop at",
            "What ends the rendering in this window. Never: it goes on until it is paused. A new end goes on with the "
            "samples there are. The target in the scene's file stays as it is.\nDrag the number, or Ctrl+click to type "
            "it.");
  ImGui::PushID("stop_at");
  const StopAt before = goal.stop_at;
  if (before != StopAt::never) ImGui::SetNextItemWidth(style::scaled(92));
  bool changed = choose_stop(goal.stop_at);
  if (before != StopAt::never) {
    ImGui::SameLine(0, style::scaled(6));
    ImGui::SetNextItemWidth(-FLT_MIN);
  }
  if (before == StopAt::samples) {
    if (slider(goal.samples, 1, max_spp, true)) {
      changed = true;
      // The mouse chooses powers of two; other numbers can be typed.
      if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) goal.samples = 1 << std::lround(std::log2(goal.samples));
    }
    note_widget("stop_at.number");
  } else if (before == StopAt::error) {
    changed |= logarithmic_slider(goal.error, least_error, most_error, " relMSE");
    note_widget("stop_at.number");
  }
  ImGui::PopID();
  if (changed) edits.goal = goal;
}

const char* condition(const ViewerState& state) {
  if (state.frame && state.frame->finished) return "done";
  return state.paused ? "paused" : "rendering";
}

}  // namespace

void draw_progress_panel(const ViewerState& state, Edits& edits) {
  ImGui::PushFont(style::heading_font());
  const std::string right = condition(state);
  const float right_width = ImGui::CalcTextSize(right.c_str()).x;
  const float width = ImGui::GetContentRegionAvail().x;
  const std::string name = state.scene.name.empty() ? "Scene" : state.scene.name;
  ImGui::TextUnformatted(fit_text(name, width - right_width - style::scaled(12)).c_str());
  ImGui::SameLine(ImGui::GetCursorPosX() + width - right_width);
  ImGui::TextDisabled("%s", right.c_str());
  ImGui::PopFont();

  const Frame none;
  const Frame& frame = state.frame ? *state.frame : none;
  const Settings& settings = state.scene.render;
  const bool ends = has_target(settings), by_error = settings.target_error > 0;
  const double share = share_done(settings, frame);
  std::string of = ends && !by_error ? " of " + std::to_string(settings.spp) : "";
  if (frame.continued_from > 0) of += " on " + std::to_string(frame.continued_from);
  text_row("Samples / pixel", std::to_string(frame.samples) + of,
           std::string("Paths traced so far through each pixel. Four times as many halve the noise.") +
               (frame.continued_from > 0 ? "\n\nThe picture goes on from the one before the edit: what the same paths "
                                           "find in both scenes tells the difference. Restart begins anew."
                                         : ""));
  const std::string aim = by_error ? number(" of %.2g relMSE", settings.target_error) : " relMSE";
  text_row("Estimated error",
           std::isfinite(frame.estimate.relmse_scaled) && frame.samples > 1
               ? (frame.estimate.is_bound() ? "at least " : "") + number("%.3g", frame.estimate.relmse_scaled) + aim
               : dash,
           "Mean squared relative error of the picture, estimated from two independent halves of its samples. It falls "
           "as 1 / samples." +
               unseen_text(frame.estimate.unseen));
  draw_trend(state, frame, ends, share);
  text_row("Speed", number("%.1f Mpaths/s", frame.paths_per_second / 1e6),
           "Millions of paths from the camera in a second.");
  const bool to_come = ends && share > 0 && share < 1;
  text_row("Time",
           duration(frame.seconds) + (to_come ? ", " + duration(frame.seconds * (1 / share - 1)) + " to go" : ""),
           "Spent rendering since the last change, pauses left out, and what the target will take from here.");
  edit_goal(state, edits);
}

}  // namespace glimt
