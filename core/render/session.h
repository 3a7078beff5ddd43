#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "film/checkpoint.h"
#include "film/film.h"
#include "film/statistics.h"
#include "render/anchor.h"
#include "render/film_cache.h"
#include "render/render.h"
#include "scene/scene.h"

namespace glimt {

/// A finished state of the image. It never changes, so the window may keep and show it as long as it likes.
struct Frame {
  std::uint64_t version = 0;    ///< version of the scene that it shows, as returned by Session::post
  ImageSize size;               ///< of the image, pixels
  Image mean;                   ///< radiance, linear RGB; smaller than `size` in the coarse preview
  Image error;                  ///< standard error of `mean`; empty if not wanted, and in the preview
  int samples = 0;              ///< per pixel; 0 in the coarse preview that answers an edit of a large image
  double seconds = 0;           ///< rendering time since the last restart, without pauses
  double paths_per_second = 0;  ///< over the same time
  ErrorEstimate estimate;       ///< error of `mean`; infinite below two samples
  bool finished = false;        ///< the target is reached
  int continued_from = 0;       ///< samples of the scene before the edit, which the picture goes on from; 0: of none
};

/// A worker that keeps adding samples while a window edits the scene. The window's thread may call all functions; none
/// waits for rendering.
class Session {
 public:
  /// Calls `on_frame` on the worker's thread after each new frame; it must only wake the window. Keeps films of scenes
  /// that were shown before, up to `kept_bytes`.
  explicit Session(Execution execution = {}, std::function<void()> on_frame = {},
                   std::size_t kept_bytes = std::size_t{512} << 20);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Shows this scene from now on and returns the version of its frames. If only the target changed, rendering goes on
  /// with the samples there are. A scene whose film is still kept goes on with that film. Throws SceneError for a scene
  /// that cannot be rendered, and then keeps the last one.
  std::uint64_t post(const Scene& scene);
  /// The same with samples that were taken elsewhere, to go on from. Throws SceneError too where they are not of its
  /// scene.
  std::uint64_t post(std::shared_ptr<const Checkpoint> begun);
  /// From now on `write` gets what there is, on the worker's thread: every so many seconds, if anything is new.
  void keep(double every, std::function<void(const Checkpoint&)> write);
  /// Begins again at zero samples.
  void restart();
  /// A paused session uses no CPU.
  void set_paused(bool paused);
  bool paused() const;
  /// Sets whether frames hold the standard error. If so, a frame with it follows at once.
  void set_error_wanted(bool wanted);
  /// The newest frame, or null before the first.
  std::shared_ptr<const Frame> frame() const;
  /// The compiled scene of the last post, or null before the first.
  std::shared_ptr<const CompiledScene> compiled() const;

 private:
  struct Job;
  std::shared_ptr<const Job> last_job() const;
  void start(std::shared_ptr<const Job> job, bool cancel);
  void work();
  void keep_now(const Job& job, Accumulation& accumulation);
  bool superseded_soon(const Job& job);
  /// Whether the next edit has come, whose preview is more urgent than another image of this job.
  bool unwanted(const Job& job) const;
  void render_some(const Job& job, Accumulation& accumulation);
  void show_preview(const Job& job);
  void show(const Job& job, const Accumulation& accumulation, bool with_error);
  void show(std::shared_ptr<const Frame> frame);

  Execution execution_;
  std::function<void()> on_frame_;
  FilmCache kept_;                          ///< of the worker
  Anchor anchor_;                           ///< of the worker
  std::optional<Anchor::Picture> picture_;  ///< of the worker: what is shown in place of the film
  mutable std::mutex mutex_;  ///< held for assignments only, never while rendering, copying pixels or uploading
  std::condition_variable wake_;
  std::shared_ptr<const Job> job_;      ///< what to render
  std::shared_ptr<const Frame> frame_;  ///< what to show
  bool paused_ = false;
  bool error_wanted_ = false;
  bool quit_ = false;
  std::function<void(const Checkpoint&)> write_;  ///< see keep()
  std::chrono::duration<double> every_{};
  std::chrono::steady_clock::time_point due_;  ///< no sooner is it called; of the worker but for the first time
  std::atomic<bool> cancel_{false};            ///< the running pass is of no use any more
  std::thread worker_;
};

}  // namespace glimt
