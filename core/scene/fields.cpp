#include "scene/fields.h"

#include <array>

namespace glimt {
namespace {

constexpr std::array<std::string_view, 3> method_names{"path", "naive", "report"};
constexpr std::array<std::string_view, 4> light_sampling_names{"none", "area", "solid-angle", "auto"};
constexpr std::array<std::string_view, 5> sampler_names{"independent", "stratified", "lattice", "sobol", "centres"};
constexpr std::array<std::string_view, 2> switch_names{"off", "on"};
constexpr std::array<std::string_view, 3> caustics_names{"off", "on", "only"};
constexpr std::array<std::string_view, 2> roulette_names{"throughput", "constant"};

// The method comes before what it sets, so that what a file or command line says beside it holds.
const std::array<Field<Settings>, 16> settings_table{{
    {"spp", "samples per pixel to stop at", value<&Settings::spp>(), 1, max_spp},
    {"target_error", "estimated relative mean squared error to stop at in place of spp; 0: stop at spp",
     value<&Settings::target_error>(), 0, 1e6},
    {"shadow_rays", "shadow rays per diffuse hit", value<&Settings::shadow_rays>(), 1, 64},
    {"seed", "seed of the random numbers", value<&Settings::seed>(), 0, 2147483647},
    {"method",
     "what the settings below begin from: path, the best measured; naive, lamps by chance; the course report's",
     Choice<Settings>{method_names, [](const Settings& s) { return static_cast<int>(s.method); },
                      [](Settings& s, int value) { set_method(s, static_cast<Method>(value)); }}},
    {"light_sampling", "points on lamps: none; by area; by solid angle; auto, which chooses for each lamp",
     choice<&Settings::light_sampling>(light_sampling_names)},
    {"mis", "lamps found by chance and by light sampling share the work (multiple importance sampling)",
     choice<&Settings::mis>(switch_names)},
    {"roulette", "probability of survival: the path's throughput, or constant 0.75 at diffuse hits",
     choice<&Settings::roulette>(roulette_names)},
    {"roulette_depth", "surface hits before roulette by throughput begins", value<&Settings::roulette_depth>(), 0, 64},
    {.key = "roulette_below",
     .doc = "throughput below which it is played, with the chance throughput / roulette_below",
     .member = value<&Settings::roulette_below>(),
     .min = 0,
     .max = 1,
     .min_excluded = true},
    {"sampler", "random numbers: independent, stratified 4x4, lattice, Owen-scrambled Sobol, or sub-pixel centres",
     choice<&Settings::sampler>(sampler_names)},
    {"caustics", "light that reaches a diffuse surface by way of mirrors or glass: off, on, or nothing else",
     choice<&Settings::caustics>(caustics_names)},
    {"light_paths", "paths from lamps to mirrors and glass for each path from the camera; 0: caustics by chance alone",
     value<&Settings::light_paths>(), 0, 16},
    {"sphere_connections", "caustics seen in mirrors and through glass: connections to lamps over single spheres",
     choice<&Settings::sphere_connections>(switch_names)},
    {"path_sharing", "the four pixels of a square share the ends of their paths",
     choice<&Settings::path_sharing>(switch_names)},
    {"max_depth", "surfaces that a path may meet, its lamp included; 0 for no limit", value<&Settings::max_depth>(), 0,
     1000},
}};

const std::array<Field<Camera>, 5> camera_table{{
    {.key = "eye",
     .doc = "position, metres",
     .member = value<&Camera::eye>(),
     .min = -max_coordinate,
     .max = max_coordinate,
     .required = true},
    {.key = "look_at",
     .doc = "point in the middle of the image, metres",
     .member = value<&Camera::look_at>(),
     .min = -max_coordinate,
     .max = max_coordinate,
     .required = true},
    {.key = "up",
     .doc = "direction that is up in the image",
     .member = value<&Camera::up>(),
     .min = -max_coordinate,
     .max = max_coordinate},
    {.key = "fov_y",
     .doc = "vertical field of view, degrees",
     .member = value<&Camera::fov_y>(),
     .min = 0.001,
     .max = 179,
     .required = true},
    {.key = "cutaway",
     .doc = "outside view: the camera looks through surfaces that turn their back to it; light does not",
     .member = choice<&Camera::cutaway>(switch_names)},
}};

const std::array<Field<ImageSize>, 2> image_table{{
    {.key = "width",
     .doc = "width, pixels",
     .member = value<&ImageSize::width>(),
     .min = 1,
     .max = 16384,
     .required = true},
    {.key = "height",
     .doc = "height, pixels",
     .member = value<&ImageSize::height>(),
     .min = 1,
     .max = 16384,
     .required = true},
}};

const std::array<Field<Sphere>, 2> sphere_table{{
    {.key = "center",
     .doc = "centre, metres",
     .member = value<&Sphere::center>(),
     .min = -max_coordinate,
     .max = max_coordinate,
     .required = true},
    {.key = "radius",
     .doc = "radius, metres",
     .member = value<&Sphere::radius>(),
     .min = 0,
     .max = max_coordinate,
     .min_excluded = true,
     .required = true},
}};

const std::array<Field<Placement>, 3> placement_table{{
    {.key = "scale",
     .doc = "size over the file's, one number or three",
     .member = value<&Placement::scale>(),
     .min = -max_coordinate,
     .max = max_coordinate},
    {.key = "rotate",
     .doc = "turn about x, then y, then z, degrees",
     .member = value<&Placement::rotate>(),
     .min = -max_coordinate,
     .max = max_coordinate},
    {.key = "translate",
     .doc = "where the file's origin is, metres",
     .member = value<&Placement::translate>(),
     .min = -max_coordinate,
     .max = max_coordinate},
}};

}  // namespace

void set_method(Settings& settings, Method method) {
  const Settings other = settings;
  settings = {};
  settings.spp = other.spp;
  settings.target_error = other.target_error;
  settings.shadow_rays = other.shadow_rays;
  settings.seed = other.seed;
  settings.method = method;
  if (method == Method::path) return;
  settings.light_paths = 0;
  settings.sphere_connections = SphereConnections::off;
  settings.path_sharing = PathSharing::off;
  if (method == Method::naive) settings.light_sampling = LightSampling::none;
  if (method != Method::report) return;
  settings.light_sampling = LightSampling::area;
  settings.mis = Mis::off;
  settings.roulette = Roulette::constant;
  settings.sampler = Sampler::centres;
  settings.caustics = Caustics::off;
}

std::span<const Field<Settings>> settings_fields() { return settings_table; }
std::span<const Field<Camera>> camera_fields() { return camera_table; }
std::span<const Field<ImageSize>> image_fields() { return image_table; }
std::span<const Field<Sphere>> sphere_fields() { return sphere_table; }
std::span<const Field<Placement>> placement_fields() { return placement_table; }

}  // namespace glimt
