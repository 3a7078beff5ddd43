#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

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

/// Of the way to the target, 0..1; the error falls as 1 / samples.
double share_done(const Settings& settings, const Frame& frame) {
  if (frame.finished) return 1;
  if (settings.target_error == 0) return std::min(1.0, static_cast<double>(frame.samples) / settings.spp);
  return frame.samples > 1 ? std::min(1.0, settings.target_error / frame.relmse_estimate) : 0;
}

const char* condition(const ViewerState& state) {
  if (state.frame && state.frame->finished) return "done";
  return state.paused ? "paused" : "rendering";
}

}  // namespace

void draw_progress_panel(const ViewerState& state) {
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
  const double share = share_done(settings, frame);
  ImGui::ProgressBar(static_cast<float>(share), {-FLT_MIN, style::scaled(6)}, "");
  const std::string of = settings.target_error > 0 ? "" : " of " + std::to_string(settings.spp);
  text_row("Samples / pixel", std::to_string(frame.samples) + of,
           "Paths traced so far through each pixel, and where rendering stops. Four times as many halve the noise.");
  const std::string aim = settings.target_error > 0 ? number(" of %.2g relMSE", settings.target_error) : " relMSE";
  text_row(
      "Estimated error",
      std::isfinite(frame.relmse_estimate) && frame.samples > 1 ? number("%.3g", frame.relmse_estimate) + aim : dash,
      "Mean squared relative error of the picture, estimated from two independent halves of its samples. It falls "
      "as 1 / "
      "samples.");
  text_row("Speed", number("%.1f Mpaths/s", frame.paths_per_second / 1e6),
           "Millions of paths from the camera in a second.");
  const bool to_come = share > 0 && share < 1;
  text_row("Time",
           duration(frame.seconds) + (to_come ? ", " + duration(frame.seconds * (1 / share - 1)) + " to go" : ""),
           "Spent rendering since the last change, pauses left out, and what the target will take from here.");
}

}  // namespace glimt
