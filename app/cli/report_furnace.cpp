#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "chart/svg_chart.h"
#include "cli/report_parts.h"
#include "kernel/scattering/albedo.h"
#include "material/conductor.h"
#include "material/glass.h"

namespace glimt {
namespace {

constexpr std::array angles{0, 45, 75};  ///< between the light's direction and the normal, degrees

/// A metal that reflects all light: its Fresnel factor is 1.
Material white_metal(double roughness) {
  return Material{.name = "white metal", .type = "conductor"}
      .with(Conductor::preset, Metal::given)
      .with(Conductor::eta, glm::dvec3{0})
      .with(Conductor::k, glm::dvec3{1})
      .with(Conductor::roughness, roughness);
}

Material frosted_glass(double roughness) {
  return Material{.name = "glass", .type = "glass"}.with(Glass::ior, 1.5).with(Glass::roughness, roughness);
}

double kept(Material (*material)(double), double roughness, int degrees) {
  return directional_albedo(material(roughness), degrees * std::numbers::pi / 180);
}

std::string losses_of(Material (*material)(double)) {
  std::string text;
  for (const int degrees : angles) {
    const double loss = std::max(0.0, 1 - kept(material, 1, degrees));
    text += (text.empty()               ? ""
             : degrees == angles.back() ? " and "
                                        : ", ") +
            figure_text(100 * loss) + " % at " + std::to_string(degrees) + "°";
  }
  return text;
}

void add_albedo(Page& page, const std::string& title, Material (*material)(double)) {
  Chart chart;
  chart.title = title;
  chart.x = {"roughness", false};
  chart.y = {"share of the light that is sent on", false};
  constexpr int steps = 20;
  for (const int degrees : angles) {
    ChartCurve curve{"light at " + std::to_string(degrees) + "° to the normal", {}, {}};
    for (int i = 0; i <= steps; ++i) {
      const double roughness = static_cast<double>(i) / steps, share = kept(material, roughness, degrees);
      curve.points.push_back({roughness, share, share, share});
    }
    chart.curves.push_back(std::move(curve));
  }
  page.chart(svg_chart(chart), "Lost at roughness 1: " + losses_of(material) + ".");
}

}  // namespace

void add_furnace(Page& page, const ReportPlan& plan) {
  plan.say("light that rough surfaces lose");
  page.heading("Light that rough metal and glass lose");
  page.paragraph(
      "A metal that reflects all light and a glass of index 1.5, under light from one direction. Neither absorbs, so "
      "all "
      "of the light should go on: reflected, or refracted too in glass. But light that one facet sends to another is "
      "left out, so the surface is too dark where it is rough. An all-white room, a white furnace, would show it.");
  add_albedo(page, "White metal", white_metal);
  add_albedo(page, "Glass", frosted_glass);
}

}  // namespace glimt
