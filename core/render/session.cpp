#include "render/session.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "film/statistics.h"
#include "render/limits.h"
#include "scene/file/scene_file.h"

namespace glimt {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double pass_seconds = 0.04;  ///< time between new images; edits do not wait for it
constexpr int preview_paths =
    60'000;  ///< paths of the coarse image that answers an edit at once: about 10 ms on two cores
/// How long the session waits for the next edit after a preview, before it makes a film. So while a slider is dragged
/// it shows only previews.
constexpr auto edit_pause = std::chrono::milliseconds(20);
constexpr int first_estimate = 8;  ///< samples before the estimated error is trusted as a target

/// Side of the square of image pixels that one pixel of the preview stands for.
int preview_step(const ImageSize& image) {
  int step = 1;
  while (image.width / step * (image.height / step) > preview_paths) ++step;
  return step;
}

Scene coarse(Scene scene, int step) {
  scene.image = {scene.image.width / step, scene.image.height / step};
  return scene;
}

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Samples per pixel at which the target should be reached, by the present estimate.
int target_samples(const Settings& settings, const Accumulation& accumulation) {
  if (settings.target_error == 0) return settings.spp;
  const int samples = accumulation.film.samples();
  if (samples < first_estimate) return first_estimate;
  const double share = accumulation.estimate.at_most() / settings.target_error;
  return share <= 1 ? samples : static_cast<int>(std::clamp(std::ceil(samples * share), samples + 1.0, 1.0 * max_spp));
}

bool finished(const Settings& settings, const Accumulation& accumulation) {
  return accumulation.pass == 0 && accumulation.film.samples() >= target_samples(settings, accumulation);
}

/// Throws SceneError where a large image does not fit; small ones need no look.
void check_memory(const ImageSize& image) {
  const std::uint64_t pixels = static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
  if (pixels < (1u << 22)) return;
  constexpr std::uint64_t frame_bytes = 2 * 3 * sizeof(float);                    // of a pixel: its mean and its error
  const std::string obstacle = memory_obstacle(image, 2 * frame_bytes * pixels);  // the next frame and the shown one
  if (!obstacle.empty()) throw SceneError(obstacle);
}

}  // namespace

struct Session::Job {
  std::shared_ptr<const CompiledScene> compiled;
  std::shared_ptr<const CompiledScene>
      preview;  ///< the same at a smaller size for the preview; null if the image is small enough
  Scene scene;
  std::uint64_t version = 0;                ///< a new one means another film
  bool from_zero = false;                   ///< whatever is kept
  std::shared_ptr<const Checkpoint> begun;  ///< what to go on from, whatever is kept; or null
};

Session::Session(Execution execution, std::function<void()> on_frame, std::size_t kept_bytes)
    : execution_(execution), on_frame_(std::move(on_frame)), kept_(kept_bytes), worker_([this] { work(); }) {}

Session::~Session() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
  }
  cancel_ = true;
  wake_.notify_all();
  worker_.join();
}

std::uint64_t Session::post(const Scene& scene) {
  check_memory(scene.image);
  const auto last = last_job();
  auto job = std::make_shared<Job>();
  Scene same = scene;
  if (last && without_target(scene.render) == without_target(last->scene.render)) same.render = last->scene.render;
  const bool new_target_only = last && same == last->scene;
  if (new_target_only) {
    *job = *last;
  } else {
    job->compiled = std::make_shared<const CompiledScene>(compile(scene));
    if (const int step = preview_step(scene.image); step > 1)
      job->preview = std::make_shared<const CompiledScene>(compile(coarse(scene, step)));
    job->version = last ? last->version + 1 : 1;
  }
  job->scene = scene;
  start(job, !new_target_only);
  return job->version;
}

std::uint64_t Session::post(std::shared_ptr<const Checkpoint> begun) {
  const auto last = last_job();
  auto job = std::make_shared<Job>();
  job->compiled = std::make_shared<const CompiledScene>(compile(begun->scene));
  const Film empty = make_film(*job->compiled);
  if (empty.scale() != begun->film.scale() || empty.by_chance().size() != begun->film.by_chance().size() ||
      empty.width() != begun->film.width() || empty.height() != begun->film.height())
    throw SceneError("the checkpoint counts light in other units than its scene");
  job->version = last ? last->version + 1 : 1;
  job->scene = begun->scene;
  job->begun = std::move(begun);
  const std::uint64_t version = job->version;
  start(std::move(job), true);
  return version;
}

void Session::keep(double every, std::function<void(const Checkpoint&)> write) {
  {
    const std::lock_guard lock(mutex_);
    every_ = std::chrono::duration<double>(every);
    due_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(every_);
    write_ = std::move(write);
  }
  wake_.notify_all();
}

void Session::keep_now(const Job& job, Accumulation& now) {
  const auto start = Clock::now();
  Checkpoint checkpoint{job.scene, std::move(now.film), now.seconds};
  write_(checkpoint);
  now.film = std::move(checkpoint.film);
  // However large the film and slow the disk, hardly any time goes into this.
  const auto pause = std::max(every_, 100 * std::chrono::duration<double>(Clock::now() - start));
  due_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(pause);
}

void Session::restart() {
  const auto last = last_job();
  if (!last) return;
  auto job = std::make_shared<Job>(*last);
  ++job->version;
  job->from_zero = true;
  job->begun.reset();
  start(job, true);
}

std::shared_ptr<const Session::Job> Session::last_job() const {
  const std::lock_guard lock(mutex_);
  return job_;
}

void Session::start(std::shared_ptr<const Job> job, bool cancel) {
  {
    const std::lock_guard lock(mutex_);
    job_ = std::move(job);
    // Set under the lock, so that the worker cannot take the new job and then have it cancelled.
    if (cancel) cancel_ = true;
  }
  wake_.notify_all();
}

void Session::set_paused(bool paused) {
  {
    const std::lock_guard lock(mutex_);
    paused_ = paused;
  }
  wake_.notify_all();
}

bool Session::paused() const {
  const std::lock_guard lock(mutex_);
  return paused_;
}

void Session::set_error_wanted(bool wanted) {
  {
    const std::lock_guard lock(mutex_);
    if (error_wanted_ == wanted) return;
    error_wanted_ = wanted;
  }
  wake_.notify_all();
}

std::shared_ptr<const Frame> Session::frame() const {
  const std::lock_guard lock(mutex_);
  return frame_;
}

std::shared_ptr<const CompiledScene> Session::compiled() const {
  const auto last = last_job();
  return last ? last->compiled : nullptr;
}

void Session::work() {
  // The window's thread goes first when all cores are busy. Render threads inherit this priority.
  setpriority(PRIO_PROCESS, 0, 10);
  std::shared_ptr<const Job> job;
  Accumulation now;
  bool shown = false, shown_finished = false, shown_error = false;  // what the newest frame holds of `now`
  bool kept_it = true;                                              // what `now` holds
  for (;;) {
    std::shared_ptr<const Job> before = job;
    bool more = false, with_error = false;
    {
      std::unique_lock lock(mutex_);
      const auto unfinished = [&] {
        return now.film.samples() == 0 || now.pass > 0 || (!paused_ && !finished(job_->scene.render, now));
      };
      const auto called = [&] {
        if (quit_ || !job_) return quit_;
        return !job || job_->version != job->version || !shown || unfinished() ||
               finished(job_->scene.render, now) != shown_finished || (error_wanted_ && !shown_error);
      };
      while (!called()) {
        if (!write_ || kept_it || now.pass > 0)
          wake_.wait(lock);
        else if (wake_.wait_until(lock, due_) == std::cv_status::timeout)
          break;
      }
      if (quit_) return;
      // A cancelled pass is in the film in part.
      if (write_ && !kept_it && now.pass == 0 && job_->version == job->version && Clock::now() >= due_) {
        lock.unlock();
        keep_now(*job, now);
        kept_it = true;
        continue;
      }
      job = job_;
      cancel_ = false;
      with_error = error_wanted_;
      more = unfinished();
    }
    if (!before || before->version != job->version) {
      const bool again = before && before->scene == job->scene;
      if (before) anchor_.leave(before->scene, now);
      anchor_.show(job->scene, job->from_zero || job->begun);
      picture_.reset();
      if (before && !(job->from_zero && again)) kept_.put(before->scene, std::move(now));
      auto kept = kept_.take(job->scene);
      if (job->from_zero) kept.reset();
      if (job->begun) kept = Accumulation{.film = job->begun->film, .seconds = job->begun->seconds, .progress = {}};
      kept_it = true;
      shown = shown_finished = shown_error = false;
      now = {};
      if (job->preview && !(kept && kept->pass == 0)) {
        show_preview(*job);
        if (superseded_soon(*job)) {
          if (kept) kept_.put(job->scene, std::move(*kept));
          continue;
        }
      }
      now = kept ? std::move(*kept) : Accumulation{.film = make_film(*job->compiled), .progress = {}};
      if (now.pass == 0) now.estimate = estimate_error(now.film);  // the kept estimate may be of fewer samples
      more = now.film.samples() == 0 || now.pass > 0;
    }
    if (more) render_some(*job, now);
    if (now.pass > 0 || unwanted(*job)) continue;
    kept_it = kept_it && !more;
    shown = true;
    shown_finished = finished(job->scene.render, now);
    shown_error = with_error;
    show(*job, now, with_error);
  }
}

bool Session::superseded_soon(const Job& job) {
  std::unique_lock lock(mutex_);
  return wake_.wait_for(lock, edit_pause, [&] { return quit_ || job_->version != job.version; });
}

bool Session::unwanted(const Job& job) const { return job.preview && cancel_; }

void Session::render_some(const Job& job, Accumulation& now) {
  const int samples = now.film.samples();
  if (now.pass == 0) {
    const double per_sample = samples > 0 ? now.seconds / samples : pass_seconds;
    const int left = target_samples(job.scene.render, now) - samples;
    now.pass = anchor_.pass(now, std::clamp(static_cast<int>(pass_seconds / per_sample), 1, std::max(left, 1)));
  }
  // The first image of a small size is not cancelled, so that something is shown however fast edits come. For a large
  // size the preview does that.
  const bool first_image = samples == 0 && !job.preview;
  const Clock::time_point start = Clock::now();
  const bool done =
      render_pass(*job.compiled, now.film, now.pass, execution_, first_image ? nullptr : &cancel_, &now.progress);
  now.seconds += seconds_since(start);
  if (!done) return;
  now.pass = 0;
  Anchor::look_at(now);
  if (unwanted(job)) return;
  picture_ = anchor_.picture(now);
  now.estimate = picture_ ? picture_->estimate : estimate_error(now.film);
}

void Session::show(const Job& job, const Accumulation& now, bool with_error) {
  const Film& film = picture_ ? picture_->film : now.film;
  auto frame = std::make_shared<Frame>();
  frame->version = job.version;
  frame->size = {film.width(), film.height()};
  frame->mean = film.mean();
  if (with_error) frame->error = film.standard_error();
  frame->samples = film.samples();
  frame->seconds = now.seconds;
  frame->paths_per_second = static_cast<double>(film.samples()) * film.width() * film.height() / now.seconds;
  frame->estimate = now.estimate;
  frame->finished = finished(job.scene.render, now);
  frame->continued_from = anchor_.continued_from();
  show(std::move(frame));
}

void Session::show_preview(const Job& job) {
  const auto render_one = [this](const CompiledScene& scene) {
    Film film = make_film(scene);
    render_pass(scene, film, 1, execution_);
    return film.mean();
  };
  const int step = preview_step(job.scene.image);
  auto frame = std::make_shared<Frame>();
  frame->version = job.version;
  frame->size = job.scene.image;
  frame->mean = render_one(*job.preview);
  // An edit is mostly small beside the picture, and so is the noise of the difference.
  const auto picture =
      anchor_.preview(frame->mean, step, [&](const Scene& scene) { return render_one(compile(coarse(scene, step))); });
  if (picture) frame->mean = *picture;
  show(std::move(frame));
}

void Session::show(std::shared_ptr<const Frame> frame) {
  {
    const std::lock_guard lock(mutex_);
    frame_ = std::move(frame);
  }
  if (on_frame_) on_frame_();
}

}  // namespace glimt
