// How soon the picture after an edit is right: relmse999 against a reference, a tenth and four tenths of a second after
// the edit of a picture of many samples. In the window's worker, so with all that it does beside tracing.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "film/statistics.h"
#include "render/session.h"
#include "scene/file/scene_file.h"

namespace {

using namespace glimt;
using Clock = std::chrono::steady_clock;

struct Edit {
  const char* name;
  std::vector<std::string> overrides;
};

/// Those of hexagon.toml that people make.
const std::vector<Edit> edits{
    {"clay .75 -> .80", {"material.clay.reflectance=[0.8,0.8,0.8]"}},
    {"clay .75 -> .30", {"material.clay.reflectance=[0.3,0.3,0.3]"}},
    {"white .75 -> .70", {"material.white.reflectance=[0.7,0.7,0.7]"}},
    {"white .75 -> .50", {"material.white.reflectance=[0.5,0.5,0.5]"}},
    {"lamp 20 -> 24", {"material.lamp.radiance=[24,24,24]"}},
    {"roughness 0 -> 0.5", {"material.clay.type=oren-nayar", "material.clay.roughness=0.5"}},
    {"clay ball moved 5 cm", {"sphere.oren-nayar.center.move=[0.05,0,0]"}},
    {"clay ball moved 1 m", {"sphere.oren-nayar.center.move=[0,0,1]"}},
    {"glass ball moved 5 cm", {"sphere.glass.center.move=[0.05,0,0]"}},
    {"index 1.5 -> 1.45", {"material.glass.ior=1.45"}},
    {"red walls -> blue", {"material.red.reflectance=[0.15,0.15,0.75]"}},
};

/// The scene with an edit; a ball is moved by "sphere.NAME.center.move=[x,y,z]".
Scene edited(const std::string& file, const Edit& edit, int spp) {
  std::vector<std::string> overrides{"render.spp=" + std::to_string(spp)};
  Scene scene = read_scene(file);
  for (const std::string& text : edit.overrides) {
    const std::size_t move = text.find(".center.move=");
    if (move == std::string::npos) {
      overrides.push_back(text);
      continue;
    }
    const std::string name = text.substr(7, move - 7);
    glm::dvec3 by{};
    std::sscanf(text.c_str() + move, ".center.move=[%lf,%lf,%lf]", &by.x, &by.y, &by.z);
    for (const Sphere& sphere : scene.spheres)
      if (sphere.name == name) {
        const glm::dvec3 to = sphere.center + by;
        overrides.push_back("sphere." + name + ".center=[" + std::to_string(to.x) + "," + std::to_string(to.y) + "," +
                            std::to_string(to.z) + "]");
      }
  }
  return read_scene(file, overrides);
}

using FramePtr = std::shared_ptr<const Frame>;

/// The newest frame of that version after so many seconds, or null.
FramePtr frame_after(const Session& session, std::uint64_t version, Clock::time_point start, double seconds) {
  std::this_thread::sleep_until(start +
                                std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds)));
  const FramePtr frame = session.frame();
  return frame && frame->version >= version ? frame : nullptr;
}

void wait_for_samples(const Session& session, std::uint64_t version, int samples) {
  for (;; std::this_thread::sleep_for(std::chrono::milliseconds(5)))
    if (const FramePtr frame = session.frame(); frame && frame->version >= version && frame->samples >= samples) return;
}

std::string error_text(const FramePtr& frame, const Image& reference) {
  if (!frame || frame->mean.width != reference.width) return "       -  ";
  char text[64];
  std::snprintf(text, sizeof text, "%9.2e%c", compare(frame->mean, reference).relmse999,
                frame->samples == 0 ? '*' : ' ');
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string file = argc > 1 ? argv[1] : GLIMT_SCENES "/hexagon.toml";
  const int samples = argc > 2 ? std::atoi(argv[2]) : 4096, reference_samples = argc > 3 ? std::atoi(argv[3]) : 4096;
  Session session;
  const Scene before = edited(file, {"", {}}, max_spp);
  wait_for_samples(session, session.post(before), samples);
  session.set_paused(true);
  std::printf("%s, %dx%d, from a picture of %d samples per pixel; relmse999 (* is the preview)\n", file.c_str(),
              before.image.width, before.image.height, session.frame()->samples);
  std::printf("%-24s %10s %10s %10s %6s | %10s %10s %10s %6s\n", "", "first", "0.1 s", "0.4 s", "spp", "anew first",
              "0.1 s", "0.4 s", "spp");
  for (const Edit& edit : edits) {
    const Scene after = edited(file, edit, max_spp);
    Scene other_seed = after;
    other_seed.render.seed = 77'777;
    const CompiledScene compiled = compile(other_seed);
    Film film = make_film(compiled);
    render_pass(compiled, film, reference_samples, {});
    const Image reference = film.mean();
    std::printf("%-24s", edit.name);
    for (const bool anew : {false, true}) {
      session.set_paused(false);
      auto start = Clock::now();
      std::uint64_t version = 0;
      if (anew) {
        session.restart();
        version = session.frame()->version + 1;
      } else {
        version = session.post(after);
      }
      FramePtr first;
      while (!first || first->version < version) first = session.frame();
      const double first_at = std::chrono::duration<double>(Clock::now() - start).count();
      const FramePtr tenth = frame_after(session, version, start, 0.1),
                     fourth = frame_after(session, version, start, 0.4);
      std::printf(" %s(%3.0f ms) %s %s %5d %s", error_text(first, reference).c_str(), 1000 * first_at,
                  error_text(tenth, reference).c_str(), error_text(fourth, reference).c_str(),
                  fourth ? fourth->samples : 0, anew ? "\n" : "|");
      std::fflush(stdout);
    }
    wait_for_samples(session, session.post(before), samples);
    session.set_paused(true);
  }
}
