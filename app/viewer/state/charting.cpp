#include "viewer/state/charting.h"

#include <sys/resource.h>

#include <limits>
#include <stdexcept>
#include <utility>

#include "chart/reference.h"
#include "viewer/state/state.h"

namespace glimt {
namespace {

/// Far from seeds that people type, so that a reference shares no random numbers with what is measured against it.
constexpr int reference_seed = 1'618'033'988;

RunPoint point_of(const Frame& frame) {
  return {frame.samples,       frame.seconds, frame.estimate.relmse_scaled, {}, frame.estimate.is_bound(),
          frame.continued_from};
}

/// The scene with default settings, which render all of its light.
Scene reference_scene(Scene scene, double target) {
  scene.render = {};
  scene.render.seed = reference_seed;
  scene.render.target_error = target;
  return scene;
}

struct Stopped : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace

Charting::Charting(ChartState& state, const std::function<void()>& wake, Execution execution)
    : state_(state), wake_(wake), execution_(execution), meter_(wake), loader_(wake), finder_(wake) {}

Charting::~Charting() { stop_ = true; }

void Charting::show(std::shared_ptr<const Scene> scene, std::uint64_t gesture) {
  state_.curves.edited(gesture);
  scene_ = std::move(scene);
  newest_.reset();
  waiting_.reset();
  state_.reference_fits = state_.reference && same_picture(*state_.reference->scene, *scene_);
}

void Charting::add(const std::shared_ptr<const Frame>& frame) {
  if (frame->samples < 2) return;
  newest_ = waiting_ = frame;
  measure();
}

void Charting::measure() {
  if (!waiting_ || meter_.busy()) return;
  const auto frame = std::exchange(waiting_, nullptr);
  if (!state_.reference_fits) {
    state_.curves.add(scene_, point_of(*frame));
    return;
  }
  meter_.start([frame, scene = scene_, reference = state_.reference] {
    Measured measured{scene, reference, point_of(*frame)};
    measured.point.error = compare(frame->mean, reference->frame->mean);
    return measured;
  });
}

bool Charting::poll(std::string& error) {
  bool news = false;
  if (auto measured = meter_.take()) {
    news = true;
    if (measured->scene == scene_) {
      if (measured->reference != state_.reference) measured->point.error.reset();
      state_.curves.add(scene_, measured->point);
    }
    measure();
  }
  if (auto loaded = loader_.take()) {
    news = true;
    if (loaded->reference)
      set_reference(loaded->reference);
    else
      error = loaded->error;
  }
  if (const auto found = finder_.take()) {
    news = true;
    state_.measuring.reset();
    (*found)(state_, error);
  }
  if (finder_.busy() && state_.measuring != found_share_) {
    news = true;
    state_.measuring = found_share_.load();
  }
  return poll_making() || news;
}

void Charting::apply(const Edits& edits) {
  Curves& curves = state_.curves;
  if (edits.chart_view) state_.view = *edits.chart_view;
  if (edits.show_curve) curves.set_shown(*edits.show_curve, true);
  if (edits.hide_curve) curves.set_shown(*edits.hide_curve, false);
  if (edits.base_curve) curves.set_base(*edits.base_curve);
  if (edits.remove_curve) curves.remove(*edits.remove_curve);
  if (edits.clear_chart) curves.clear();
  if (edits.reference_target) state_.target = *edits.reference_target;
  if (edits.load_reference) load(*edits.load_reference);
  if (edits.make_reference && !busy()) make_reference();
  if (edits.use_reference_now && state_.making) use_made();
  if (edits.stop_reference) end_making();
  if (edits.drop_reference) set_reference(nullptr);
  if (edits.advise && !busy()) find(&ChartState::advice, advise_shadow_rays);
  if (edits.measure_families && !busy()) find(&ChartState::families, measure_families);
  if (edits.stop_measuring) stop_ = true;
}

void Charting::load(const std::filesystem::path& file) {
  if (loader_.busy()) return;
  loader_.start([file, scene = scene_]() -> Loaded {
    try {
      auto frame = std::make_shared<Frame>();
      frame->mean = read_reference(file, *scene);
      frame->size = scene->image;
      frame->estimate.relmse = frame->estimate.relmse_scaled = std::numeric_limits<double>::quiet_NaN();
      return {std::make_shared<const Reference>(Reference{file.filename().string(), frame, scene}), {}};
    } catch (const std::exception& problem) {
      return {nullptr, problem.what()};
    }
  });
}

void Charting::make_reference() {
  making_ = std::make_unique<Session>(execution_, wake_, 0);
  made_scene_ = scene_;
  making_->post(reference_scene(*scene_, state_.target));
}

void Charting::end_making() {
  making_.reset();
  state_.making.reset();
}

void Charting::use_made() {
  set_reference(std::make_shared<const Reference>(Reference{"made here", state_.making, made_scene_}));
  end_making();
}

bool Charting::poll_making() {
  if (!making_) return false;
  const auto frame = making_->frame();
  if (!frame || frame == state_.making || frame->samples == 0) return false;
  state_.making = frame;
  if (frame->finished) use_made();
  return true;
}

void Charting::set_reference(std::shared_ptr<const Reference> reference) {
  state_.reference = std::move(reference);
  state_.reference_fits = state_.reference && same_picture(*state_.reference->scene, *scene_);
  state_.curves.forget_errors();
  waiting_ = newest_;
  measure();
}

template <class T, class How>
void Charting::find(std::optional<Finding<T>> ChartState::*finding, How how) {
  stop_ = false;
  found_share_ = 0;
  state_.measuring = 0;
  finder_.start([this, finding, how, scene = scene_, execution = execution_]() -> Found {
    setpriority(PRIO_PROCESS, 0, 10);  // the window's thread comes first
    try {
      const Plan plan{.seeds = 5, .seconds = 0.5, .execution = execution};
      const Finding<T> found{how(*scene, plan,
                                 [this](double share) {
                                   found_share_ = share;
                                   wake_();
                                   if (stop_) throw Stopped("");
                                 }),
                             *scene};
      return [finding, found](ChartState& state, std::string&) { state.*finding = found; };
    } catch (const std::exception& problem) {
      return [text = std::string(problem.what())](ChartState&, std::string& error) { error = text; };
    }
  });
}

}  // namespace glimt
