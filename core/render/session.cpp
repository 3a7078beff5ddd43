#include "render/session.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

#include "film/statistics.h"

namespace glimt {

namespace {

constexpr double pass_seconds = 0.04;  ///< between new images; edits do not wait for it
constexpr int preview_paths =
    60'000;  ///< of the coarse image that answers an edit within a frame: about 10 ms on two cores

using Clock = std::chrono::steady_clock;

/// Pixels of the image, along x and y, that one pixel of the preview stands for.
int preview_step(const ImageSize& image) {
  int step = 1;
  while (image.width / step * (image.height / step) > preview_paths) ++step;
  return step;
}

/// Each pixel of the small image over a block of a large one; the last column and row reach to the border.
Image enlarged(const Image& small, int width, int height, int step) {
  Image large{width, height,
              std::vector<float>(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height))};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float* from = small.pixel(std::min(x / step, small.width - 1), std::min(y / step, small.height - 1));
      std::copy(from, from + 3, large.pixel(x, y));
    }
  return large;
}

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

}  // namespace

struct Session::Job {
  std::shared_ptr<const CompiledScene> compiled;
  std::shared_ptr<const CompiledScene>
      preview;  ///< the same at a size that is rendered at once; null where that is its own
  Scene scene;
  std::uint64_t version = 0;  ///< a new one means a new film
};

Session::Session(Execution execution, std::function<void()> on_frame)
    : execution_(execution), on_frame_(std::move(on_frame)), worker_([this] { work(); }) {}

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
  std::shared_ptr<const Job> last;
  {
    const std::lock_guard lock(mutex_);
    last = job_;
  }
  auto job = std::make_shared<Job>();
  job->scene = scene;
  Scene same = scene;
  if (last) same.render.spp = last->scene.render.spp;
  const bool new_target_only = last && same == last->scene;
  if (new_target_only) {
    job->compiled = last->compiled;
    job->preview = last->preview;
    job->version = last->version;
  } else {
    job->compiled = std::make_shared<const CompiledScene>(compile(scene));
    if (const int step = preview_step(scene.image); step > 1) {
      Scene coarse = scene;
      coarse.image = {scene.image.width / step, scene.image.height / step};
      job->preview = std::make_shared<const CompiledScene>(compile(coarse));
    }
    job->version = last ? last->version + 1 : 1;
  }
  start(job, !new_target_only);
  return job->version;
}

void Session::restart() {
  std::shared_ptr<const Job> last;
  {
    const std::lock_guard lock(mutex_);
    last = job_;
  }
  if (!last) return;
  auto job = std::make_shared<Job>(*last);
  ++job->version;
  start(job, true);
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

std::shared_ptr<const Frame> Session::frame() const {
  const std::lock_guard lock(mutex_);
  return frame_;
}

void Session::work() {
  // The window's thread comes first when all cores are busy. The render threads inherit this.
  setpriority(PRIO_PROCESS, 0, 10);
  std::shared_ptr<const Job> job;
  Film film;
  double seconds = 0;
  bool shown_finished = false;
  for (;;) {
    bool new_film = false;
    bool paused = false;
    int target = 0;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] {
        if (quit_ || !job_) return quit_;
        if (!job || job_->version != job->version) return true;
        const bool finished = film.samples() >= job_->scene.render.spp;
        return finished != shown_finished || (!finished && (!paused_ || film.samples() == 0));
      });
      if (quit_) return;
      new_film = !job || job_->version != job->version;
      job = job_;
      target = job->scene.render.spp;
      paused = paused_;
      cancel_ = false;
    }
    if (new_film) {
      if (job->preview && !show_preview(*job)) {
        job.reset();
        continue;
      }
      film = make_film(*job->compiled);
      seconds = 0;
      shown_finished = false;
    }
    if (film.samples() < target && (!paused || film.samples() == 0)) {
      const double per_sample = film.samples() > 0 ? seconds / film.samples() : pass_seconds;
      const int count = std::clamp(static_cast<int>(pass_seconds / per_sample), 1, target - film.samples());
      const Clock::time_point start = Clock::now();
      const bool done = render_pass(*job->compiled, film, count, execution_, &cancel_);
      if (!done) {
        job.reset();  // part of a pass is in the film
        continue;
      }
      seconds += seconds_since(start);
    }
    auto frame = std::make_shared<Frame>();
    frame->version = job->version;
    frame->mean = film.mean();
    frame->samples = film.samples();
    frame->seconds = seconds;
    frame->paths_per_second = static_cast<double>(film.samples()) * film.width() * film.height() / seconds;
    frame->relmse_estimate = relmse_estimate(film);
    frame->finished = shown_finished = film.samples() >= target;
    show(std::move(frame));
  }
}

bool Session::show_preview(const Job& job) {
  Film film = make_film(*job.preview);
  if (!render_pass(*job.preview, film, 1, execution_, &cancel_)) return false;
  auto frame = std::make_shared<Frame>();
  frame->version = job.version;
  frame->mean = enlarged(film.mean(), job.compiled->width, job.compiled->height, preview_step(job.scene.image));
  frame->relmse_estimate = std::numeric_limits<double>::infinity();
  show(std::move(frame));
  return true;
}

void Session::show(std::shared_ptr<const Frame> frame) {
  {
    const std::lock_guard lock(mutex_);
    frame_ = std::move(frame);
  }
  if (on_frame_) on_frame_();
}

}  // namespace glimt
