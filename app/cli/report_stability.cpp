#include <algorithm>
#include <cmath>

#include "chart/runs.h"
#include "chart/svg_chart.h"
#include "cli/report_parts.h"
#include "compile/compiled_scene.h"
#include "film/statistics.h"
#include "material/conductor.h"
#include "material/glass.h"
#include "material/light.h"
#include "material/oren_nayar.h"

namespace glimt {
namespace {

struct Difficulty {
  std::string title;
  ChartAxis axis;
  const char* material;  ///< of the sphere
  std::vector<double> values;
  void (*set)(Scene&, double);
};

Polygon& lamp_of(Scene& scene) {
  return *std::ranges::find_if(scene.polygons, [](const Polygon& p) { return p.material == "lamp"; });
}

glm::dvec3 middle_of(const Polygon& polygon) {
  glm::dvec3 sum{0};
  for (const auto& v : polygon.vertices) sum += v;
  return sum / static_cast<double>(polygon.vertices.size());
}

Material& material(Scene& scene, const std::string& name) {
  return *std::ranges::find(scene.materials, name, &Material::name);
}

/// Gives the square lamp another side and the same flux.
void set_lamp_side(Scene& scene, double side) {
  Polygon& lamp = lamp_of(scene);
  const glm::dvec3 middle = middle_of(lamp);
  const double scale = side / std::abs(lamp.vertices[1].x - lamp.vertices[0].x);
  for (auto& v : lamp.vertices) v = middle + scale * (v - middle);
  Material& light = material(scene, "lamp");
  light.set(Light::radiance, light.get(Light::radiance) / (scale * scale));
}

/// Makes the sphere smaller and puts it below the lamp, with this gap between them.
void set_gap(Scene& scene, double gap) {
  Sphere& sphere = scene.spheres.front();
  sphere.radius = 0.8;
  sphere.center = middle_of(lamp_of(scene)) - glm::dvec3{0, sphere.radius + gap, 0};
}

void set_roughness(Scene& scene, double roughness) { material(scene, "clay").set(OrenNayar::roughness, roughness); }
void set_ior(Scene& scene, double ior) { material(scene, "glass").set(Glass::ior, ior); }

/// Gold of this roughness under a small lamp, whose highlight is a few pixels wide where the metal is smooth.
void set_metal(Scene& scene, double roughness) {
  set_lamp_side(scene, 0.2);
  material(scene, "gold").set(Conductor::roughness, roughness);
}

/// Two metal walls meet behind the sphere, so light goes back and forth between them.
void set_metal_corner(Scene& scene, double roughness) {
  set_metal(scene, roughness);
  for (Polygon& p : scene.polygons)
    if (p.name == "wall 3" || p.name == "wall 4") p.material = "gold";
}

/// The left wall is a mirror in which the sphere is seen.
void set_metal_in_mirror(Scene& scene, double roughness) {
  set_metal(scene, roughness);
  std::ranges::find(scene.polygons, "wall 2", &Polygon::name)->material = "mirror";
}

/// The eye at this height above a metal floor.
void set_grazing_eye(Scene& scene, double height) {
  set_metal(scene, 0.2);
  Polygon& floor = *std::ranges::find(scene.polygons, "floor", &Polygon::name);
  floor.material = "gold";
  scene.camera.eye.y = floor.vertices.front().y + height;
  scene.camera.look_at.y = scene.camera.eye.y;
}

void set_reflectance(Scene& scene, double reflectance) {
  for (Material& m : scene.materials)
    if (is_diffuse(m)) m.set(Matt::reflectance, glm::dvec3{reflectance});
}

const std::vector<Difficulty>& difficulties() {
  const ChartAxis roughness_of_metal{"roughness of the metal; the lamp is 0.2 m wide", true};
  const std::vector<double> roughnesses{0.001, 0.03, 0.1, 0.2, 0.3, 0.5, 1};
  static const std::vector<Difficulty> list{
      {"Size of the lamp",
       {"side of the square lamp of constant power, metres", true},
       "clay",
       {0.02, 0.1, 0.5, 1, 2, 4},
       set_lamp_side},
      {"Distance to the lamp",
       {"gap between sphere and lamp, metres", true},
       "clay",
       {0.003, 0.01, 0.03, 0.1, 0.3, 1, 3},
       set_gap},
      {"Roughness",
       {"roughness of the Oren-Nayar sphere, radians", false},
       "clay",
       {0, 0.25, 0.5, 0.75, 1, 1.25, 1.5},
       set_roughness},
      {"Refractive index", {"index of the glass sphere", false}, "glass", {1, 1.1, 1.25, 1.5, 2, 2.5}, set_ior},
      {"Reflectance",
       {"reflectance of all diffuse surfaces", false},
       "clay",
       {0.1, 0.3, 0.5, 0.7, 0.85, 0.95},
       set_reflectance},
      {"Roughness of metal", roughness_of_metal, "gold", roughnesses, set_metal},
      {"A corner of metal", roughness_of_metal, "gold", roughnesses, set_metal_corner},
      {"Metal in a mirror", roughness_of_metal, "gold", roughnesses, set_metal_in_mirror},
      {"A highlight at grazing angles",
       {"height of the eye above a floor of metal, metres", true},
       "gold",
       {0.05, 0.1, 0.3, 1, 3},
       set_grazing_eye},
  };
  return list;
}

struct Way {
  const char *label, *method;
  Mis mis;
};
constexpr std::array ways{Way{"report", "report", Mis::off}, Way{"naive", "naive", Mis::off},
                          Way{"path", "path", Mis::off}, Way{"path, mis on", "path", Mis::on}};

Scene scene_at(const ReportPlan& plan, const Difficulty& difficulty, double value, const Way& way) {
  Scene scene = report_scene(
      plan, "sphere",
      {std::string("sphere.sphere.material=") + difficulty.material, std::string("render.method=") + way.method});
  scene.image = {plan.side() / 4, plan.side() / 4};
  scene.render.mis = way.mis;
  difficulty.set(scene, value);
  return scene;
}

/// Adds, for each way to render, the median and quartiles over seeds of its error at one value.
void add_value(std::vector<ChartCurve>& curves, const ReportPlan& plan, const Difficulty& difficulty, double value) {
  const int seeds = plan.quick ? 2 : 5;
  const CompiledScene truth = compile(scene_at(plan, difficulty, value, ways.back()));
  Film reference = make_film(truth);
  render_pass(truth, reference, plan.spp(4096), plan.execution);
  const Image image = reference.mean();
  for (std::size_t i = 0; i < ways.size(); ++i) {
    CompiledScene scene = compile(scene_at(plan, difficulty, value, ways[i]));
    std::vector<double> errors;
    for (int seed = 0; seed < seeds; ++seed) {
      scene.settings.seed = 100 + seed;
      Film film = make_film(scene);
      render_pass(scene, film, plan.spp(64), plan.execution);
      errors.push_back(compare(film.mean(), image).relmse_scaled);
    }
    curves[i].points.push_back({value, quantile(errors, 0.5), quantile(errors, 0.25), quantile(errors, 0.75)});
  }
}

}  // namespace

void add_stability(Page& page, const ReportPlan& plan) {
  page.heading("Stability: where methods fail");
  page.paragraph(
      "One sphere in the room; in each chart one thing goes from easy to hard. Errors are relmse_scaled at " +
      std::to_string(plan.spp(64)) + " spp against a picture of " + std::to_string(plan.spp(4096)) +
      " spp by path with multiple importance sampling. A black picture's error is below 1, so a method "
      "that never meets the lamp looks better than one that meets it now and then.");
  for (const Difficulty& difficulty : difficulties()) {
    plan.say("stability: " + difficulty.title);
    const ChartAxis error{"error: relmse_scaled at " + std::to_string(plan.spp(64)) + " spp"};
    Chart chart{difficulty.title, difficulty.axis, error, {}, {}, {}};
    for (const Way& way : ways) chart.curves.push_back({way.label, {}, {}});
    for (const double value : difficulty.values) add_value(chart.curves, plan, difficulty, value);
    page.chart(svg_chart(chart), "Median and quartiles over seeds.");
  }
}

}  // namespace glimt
