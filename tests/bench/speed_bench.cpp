#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <chrono>
#include <string>
#include <thread>

#include "film/statistics.h"
#include "material/oren_nayar.h"
#include "render/render.h"
#include "render/session.h"
#include "scene/file/scene_file.h"

/// How fast the core is, and how soon an edit shows. Wall-clock time, for the machine it runs on; nothing here fails on
/// time.
namespace {

using namespace glimt;

Scene load(const std::string& name) { return read_scene(std::string(GLIMT_SCENES) + "/" + name + ".toml"); }

/// Millions of paths a second at the scene's own size, one shadow ray, 16 samples per pixel and pass.
void render(benchmark::State& state, const std::string& name, int threads, Lanes lanes) {
  const CompiledScene scene = compile(load(name));
  const int spp = lanes == Lanes::scalar ? 2 : 16;
  Film film = make_film(scene);
  render_pass(scene, film, 1, {threads, lanes});
  for (auto _ : state) render_pass(scene, film, spp, {threads, lanes});
  const double paths = static_cast<double>(state.iterations()) * spp * scene.width * scene.height;
  state.counters["Mpaths/s"] = benchmark::Counter(paths * 1e-6, benchmark::Counter::kIsRate);
}

/// Milliseconds from Session::post to the first frame of that edit, while the session renders on all cores; the worst
/// of all is reported too.
void edit_to_image(benchmark::State& state, int width, int height) {
  Scene scene = load("report");
  scene.image = {width, height};
  scene.render.spp = 1 << 20;
  Session session;
  double worst = 0;
  for (auto _ : state) {
    Material& clay = scene.materials.back();
    clay.set(OrenNayar::roughness, clay.get(OrenNayar::roughness) > 0.5 ? 0.4 : 0.6);
    const auto start = std::chrono::steady_clock::now();
    const std::uint64_t version = session.post(scene);
    while (!session.frame() || session.frame()->version != version)
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    worst = std::max(worst, seconds);
    state.SetIterationTime(seconds);
    std::this_thread::sleep_for(std::chrono::milliseconds(30));  // let it render, so that there is a pass to cancel
  }
  state.counters["worst_ms"] = worst * 1e3;
}

void film_memory(benchmark::State& state) {
  for (auto _ : state) {
    const Film film(1920, 1080, 20);
    benchmark::DoNotOptimize(film.bytes());
    state.counters["MB"] = static_cast<double>(film.bytes()) * 1e-6;
  }
}

void register_all() {
  for (const char* scene : {"hexagon", "hexagon_diffuse", "hexagon_empty", "report", "cornell"})
    for (int threads : {1, hardware_threads()})
      benchmark::RegisterBenchmark(("render/" + std::string(scene) + "/threads:" + std::to_string(threads)).c_str(),
                                   render, scene, threads, Lanes::native)
          ->UseRealTime()
          ->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("render/hexagon/one lane", render, "hexagon", hardware_threads(), Lanes::scalar)
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("edit to first image/800x600", edit_to_image, 800, 600)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond)
      ->Iterations(60);
  benchmark::RegisterBenchmark("edit to first image/1920x1080", edit_to_image, 1920, 1080)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond)
      ->Iterations(30);
  benchmark::RegisterBenchmark("memory of a film/1920x1080", film_memory)->Iterations(1);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  benchmark::AddCustomContext("lanes", std::to_string(glimt::native_lane_count()));
  register_all();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
