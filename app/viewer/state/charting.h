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
  std::shared_ptr<const Frame> frame;  ///< samples are 0 where unknown
  std::shared_ptr<const Scene> scene;  ///< that it is of
};

/// What was measured of a scene.
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
  bool reference_fits = false;                 ///< it is of the scene that is shown
  std::shared_ptr<const Frame> making;         ///< how far the next reference has come; null where none is made
  double target = 1e-4;                        ///< relmse_scaled that it is made to
  std::optional<double> measuring;             ///< share done of the next finding
  std::optional<Finding<ShadowRayAdvice>> advice;
  std::optional<Finding<Families>> families;
};

/// What a person asked for (viewer/state/state.h).
struct Edits;

/// Keeps the chart: grows the curves, measures them against the reference, makes references and findings. Nothing
/// waits for any of it.
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
  /// Takes in what was done in the background; true where there was something. An error, if any, goes into `error`.
  bool poll(std::string& error);
  /// Carries out what needs no files written.
  void apply(const Edits& edits);
  /// A measurement or a reference is being made, which wants the machine to itself.
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
  /// Puts a finding into the state, or says why there is none.
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
  std::shared_ptr<const Scene> scene_;    ///< that is shown
  std::shared_ptr<const Frame> newest_;   ///< of that scene
  std::shared_ptr<const Frame> waiting_;  ///< to be measured
  std::shared_ptr<const Scene> made_scene_;
  std::atomic<bool> stop_{false};  ///< the finder
  std::atomic<double> found_share_{0};
  Background<Measured> meter_;
  Background<Loaded> loader_;
  Background<Found> finder_;
  std::unique_ptr<Session> making_;  ///< renders the next reference
};

}  // namespace glimt
