#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cli/report_page.h"
#include "render/render.h"
#include "scene/scene.h"

/// The parts of the page that `glimt report` writes. Each measures its own figures when it is called.
namespace glimt {

struct ReportPlan {
  bool quick = false;  ///< small pictures and few samples, only to see the page
  Execution execution;
  std::function<void(const std::string&)> say;  ///< is told what is measured now

  int side() const { return quick ? 40 : 400; }  ///< of the report's square pictures, pixels
  int spp(int wanted) const { return quick ? std::max(2, wanted / 32) : wanted; }
};

/// A scene of scenes/report/ at the plan's size, with overrides.
Scene report_scene(const ReportPlan& plan, const std::string& name, std::vector<std::string> overrides = {});

void add_room(Page& page, const ReportPlan& plan);         ///< Figure 1
void add_samples(Page& page, const ReportPlan& plan);      ///< Figure 2, Table 1
void add_roughness(Page& page, const ReportPlan& plan);    ///< Figure 3
void add_materials(Page& page, const ReportPlan& plan);    ///< Figure 4, Table 2
void add_shadow_rays(Page& page, const ReportPlan& plan);  ///< Figure 5, Table 3
void add_balance(Page& page,
                 const ReportPlan& plan);  ///< load balance of the cores, with glass and with diffuse surfaces
void add_errors(Page& page, const ReportPlan& plan);     ///< where the report errs, and by how much
void add_chart(Page& page, const ReportPlan& plan);      ///< error against time
void add_stability(Page& page, const ReportPlan& plan);  ///< error against each thing that makes methods fail
void add_furnace(Page& page, const ReportPlan& plan);    ///< light that rough metal and glass lose

}  // namespace glimt
