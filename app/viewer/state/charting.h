#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "chart/advisor.h"
#include "chart/families.h"
#include "render/session.h"
#include "viewer/state/background.h"
#include "viewer/state/curves.h"

namespace glimt {

/// How the chart is looked at. The window remembers it.
struct ChartView {
  bool shown = false;
  Across across = Across::seconds;

  bool operator==(const ChartView&) const = default;
};

/// A picture to measure errors against.
struct Reference {
  std::string name;
  std::shared_ptr<const Frame> frame;  ///< its number of samples is 0 where unknown
  std::shared_ptr<const Scene> scene;  ///< that it shows
};

/// What was measured on a scene.
template <class T>
struct Finding {
  T what;
  Scene scene;
};

/// All that the chart shows.
struct ChartState {
  ChartView view;
  Curves curves;
  std::shared_ptr<const Reference> reference;  ///< null where there is none
  bool reference_fits = false;                 ///< it shows the same scene as the window
  std::shared_ptr<const Frame> making;         ///< the next reference as far as it has come; null where none is made
  double target = 1e-4;                        ///< relmse_scaled at which the next reference is finished
  std::optional<double> measuring;             ///< share done of a measurement that is going on
  std::optional<Finding<ShadowRayAdvice>> advice;
  std::optional<Finding<Families>> families;
};

/// What a person asked for (viewer/state/state.h).
struct Edits;

/// Keeps the chart: adds to the curves, measures them against the reference, makes references and measurements. No
/// function waits for that work.
class Charting {
 public:
  Charting(ChartState& state, const std::function<void()>& wake, Execution execution);
  ~Charting();
  Charting(const Charting&) = delete;
  Charting& operator=(const Charting&) = delete;

  /// The window shows this scene from now on. Edits of one gesture (not 0) leave one curve.
  void show(std::shared_ptr<const Scene> scene, std::uint64_t gesture);
  /// A new frame of that scene.
  void add(const std::shared_ptr<const Frame>& frame);
  /// Takes in what was done in the background. Returns true if there was something. Sets `error` if work failed.
  bool poll(std::string& error);
  /// Carries out the edits of the chart, except writing files.
  void apply(const Edits& edits);
  /// Whether a measurement or a reference is being made; these need the machine to themselves.
  bool busy() const { return making_ || finder_.busy(); }

 private:
  struct Measured {
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const Reference> reference;
    RunPoint point;
  };
  struct Loaded {
    std::shared_ptr<const Reference> reference;
    std::string error;
  };
  /// Puts a finding into the state, or sets `error` to why there is none.
  using Found = std::function<void(ChartState&, std::string& error)>;

  void measure();
  void load(const std::filesystem::path& file);
  void make_reference();
  bool poll_making();
  void use_made();
  void end_making();
  void set_reference(std::shared_ptr<const Reference> reference);
  template <class T, class How>
  void find(std::optional<Finding<T>> ChartState::*finding, How how);

  ChartState& state_;
  std::function<void()> wake_;
  Execution execution_;
  std::shared_ptr<const Scene> scene_;    ///< the scene that is shown
  std::shared_ptr<const Frame> newest_;   ///< newest frame of that scene
  std::shared_ptr<const Frame> waiting_;  ///< frame to measure next
  std::shared_ptr<const Scene> made_scene_;
  std::atomic<bool> stop_{false};  ///< asks the finder to stop
  std::atomic<double> found_share_{0};
  Background<Measured> meter_;
  Background<Loaded> loader_;
  Background<Found> finder_;
  std::unique_ptr<Session> making_;  ///< renders the next reference
};

}  // namespace glimt
