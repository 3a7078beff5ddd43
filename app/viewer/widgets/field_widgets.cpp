#include "viewer/widgets/field_widgets.h"

#include <imgui.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/trigonometric.hpp>
#include <numeric>

#include "viewer/widgets/colour.h"
#include "viewer/widgets/labels.h"
#include "viewer/widgets/style.h"
#include "viewer/widgets/widgets.h"

namespace glimt {
namespace {

constexpr double widest_linear_slider = 100;  ///< integers over more than this get a logarithmic slider
constexpr double widest_slider = 1 << 25;     ///< integers over more than this are typed
constexpr double widest_real_slider = 4;      ///< reals over more than this are dragged; a step is a share of the value
constexpr const char* typing_hint = "\nDrag, or Ctrl+click to type a number.";

constexpr std::string_view degree_sign = "\u00B0";

/// The least value allowed: just above an excluded limit.
double lowest(const FieldText& field) {
  return field.min_excluded ? field.min + std::min(field.max - field.min, 1.0) * 1e-4 : field.min;
}

void begin_field_row(const FieldText& field, bool typed = true) {
  begin_row(label_of(field.key), sentence(field.doc) + (typed ? typing_hint : ""));
  ImGui::PushID(field.name.c_str());
}

bool end_field_row(const FieldText& field, bool changed) {
  note_widget(field.name);
  ImGui::PopID();
  return changed;
}

/// printf format that shows a number with its unit; angles in degrees too.
std::string format_of(const FieldText& field, double value) {
  const auto unit = unit_of(field.key, field.doc);
  if (unit == "rad") {
    char degrees[32];
    std::snprintf(degrees, sizeof degrees, " (%.1f\u00B0)", glm::degrees(value));
    return "%.3f rad" + std::string(degrees);
  }
  if (unit == degree_sign) return "%.1f" + std::string(degree_sign);
  return unit.empty() ? "%.3f" : "%.3g " + std::string(unit);
}

/// A number without a slider: each pixel of a drag changes it by a share of its value.
bool drag_real(const FieldText& field, double& value) {
  const double low = lowest(field), high = field.max;
  const auto speed = static_cast<float>(std::max(value, 0.1) * 0.005);
  const bool changed = ImGui::DragScalar("##value", ImGuiDataType_Double, &value, speed, &low, &high,
                                         format_of(field, value).c_str(), ImGuiSliderFlags_AlwaysClamp);
  if (ImGui::IsItemHovered()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (changed) value = std::clamp(value, low, high);
  return changed;
}

/// A square in this colour (linear, 0..1) that opens a picker.
bool edit_swatch(glm::dvec3& colour) {
  const glm::vec3 shown = srgb_from_linear(colour);
  const float side = ImGui::GetFrameHeight();
  if (ImGui::ColorButton("##swatch", {shown.r, shown.g, shown.b, 1}, ImGuiColorEditFlags_NoTooltip, {side, side})) {
    ImGui::OpenPopup("picker");
  }
  place_beside_controls();
  if (!ImGui::BeginPopup("picker")) return false;
  glm::vec3 picked = shown;
  constexpr auto flags = ImGuiColorEditFlags_NoSidePreview | ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_NoAlpha;
  ImGui::SetNextItemWidth(style::scaled(200));
  const bool changed = ImGui::ColorPicker3("##picker", glm::value_ptr(picked), flags);
  if (changed) colour = glm::clamp(linear_from_srgb(glm::dvec3(picked)), 0.0, 1.0);
  ImGui::EndPopup();
  return changed;
}

}  // namespace

bool edit_value(const FieldText& field, int& value) {
  begin_field_row(field);
  const int low = static_cast<int>(field.min), high = static_cast<int>(field.max);
  const double range = field.max - field.min;
  bool changed = false;
  if (range > widest_slider) {
    changed = ImGui::InputInt("##value", &value, 1, 100);
  } else if (range > widest_linear_slider) {
    changed = slider(value, low, high, true);
    // The mouse chooses powers of two; other numbers can be typed.
    if (changed && ImGui::IsMouseDown(ImGuiMouseButton_Left)) value = 1 << std::lround(std::log2(std::max(value, 1)));
  } else {
    changed = slider(value, low, high, false);
  }
  value = std::clamp(value, low, high);
  return end_field_row(field, changed);
}

bool edit_value(const FieldText& field, double& value) {
  begin_field_row(field);
  const double low = lowest(field), high = field.max;
  bool changed = false;
  if (high - low > widest_real_slider && unit_of(field.key, field.doc) != degree_sign) {
    changed = drag_real(field, value);
  } else {
    changed = slider(value, low, high, format_of(field, value).c_str());
  }
  return end_field_row(field, changed);
}

bool edit_value(const FieldText& field, glm::dvec3& value) {
  begin_field_row(field);
  bool changed = false;
  if (field.min < 0) {
    const double low = field.min, high = field.max;
    changed = ImGui::DragScalarN("##value", ImGuiDataType_Double, glm::value_ptr(value), 3, 0.02F, &low, &high, "%.2f",
                                 ImGuiSliderFlags_AlwaysClamp);
  } else if (field.max <= 1) {
    changed = edit_swatch(value);
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-FLT_MIN);
    changed |= ImGui::DragScalarN("##value", ImGuiDataType_Double, glm::value_ptr(value), 3, 0.002F, &field.min,
                                  &field.max, "%.2f", ImGuiSliderFlags_AlwaysClamp);
  } else {
    const double brightest = std::max({value.r, value.g, value.b});
    glm::dvec3 hue = brightest > 0 ? value / brightest : glm::dvec3(1);
    double strength = brightest;
    if (edit_swatch(hue)) {
      changed = true;
      if (strength == 0) strength = 1;
    }
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-FLT_MIN);
    changed |= drag_real(field, strength);
    if (changed) value = hue * strength;
  }
  return end_field_row(field, changed);
}

bool edit_choice(const FieldText& field, std::span<const std::string_view> names, int& value) {
  begin_field_row(field, false);
  const int before = value;
  const auto name = [&](int i) { return label_of(names[static_cast<std::size_t>(i)]); };
  const bool open = ImGui::BeginCombo("##value", name(value).c_str());
  note_widget(field.name);
  if (open) {
    for (int i = 0; i < static_cast<int>(names.size()); ++i) {
      if (ImGui::Selectable(name(i).c_str(), i == before)) value = i;
      note_widget(field.name + "." + std::string(names[static_cast<std::size_t>(i)]));
    }
    ImGui::EndCombo();
  }
  ImGui::PopID();
  return value != before;
}

}  // namespace glimt
