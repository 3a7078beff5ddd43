#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "film/statistics.h"
#include "scene/scene.h"
#include "viewer/state/scene_difference.h"

namespace glimt {

/// A run as it was after so many samples per pixel.
struct RunPoint {
  int samples = 0;
  double seconds = 0;               ///< of rendering
  double estimate = 0;              ///< relmse_scaled, from the two halves
  std::optional<Comparison> error;  ///< against the reference, where there was one
  bool at_least = false;            ///< the estimate is a bound: light may not have been found yet
};

/// Error against time of one scene with one set of settings.
struct Curve {
  std::uint64_t id = 0;
  std::shared_ptr<const Scene> scene;
  std::string label;             ///< what differs from the first curve; of that, what the others change
  std::vector<RunPoint> points;  ///< by increasing samples, each a fifth more or so than the one before
  bool shown = true;
  std::uint64_t gesture = 0;            ///< the edit that it began with
  std::vector<Difference> differences;  ///< from the first curve's scene
};

/// What a curve is drawn against.
enum class Across { seconds, samples };
double across(const RunPoint& point, Across axis);

/// The error that a curve stands for, relmse_scaled: against the reference, or the estimate. Nothing where the point
/// has none, as of a black picture, and where it is below `least_told`: the halves do not differ but for rounding.
enum class ErrorKind { estimate, reference };
inline constexpr double least_told = 1e-9;
std::optional<double> error_of(const RunPoint& point, ErrorKind kind);
/// `reference` where the curve has a point that was compared with it.
ErrorKind error_kind(const Curve& curve);

/// The curve's error at a place along the axis, and the place where it has come down to an error; both interpolated on
/// logarithmic axes, nothing outside what was measured.
std::optional<double> error_at(const Curve& curve, ErrorKind kind, Across axis, double place);
std::optional<double> place_of(const Curve& curve, ErrorKind kind, Across axis, double error);

/// Efficiency over that of the base: inverse ratio of error times seconds. At an equal time, where one is given and
/// both have been there, else as far as each has come. Compared by the reference where both can be, else by estimate.
/// Nothing for pictures of different sizes.
std::optional<double> efficiency_ratio(const Curve& curve, const Curve& base, std::optional<double> seconds);

/// A curve for every scene and setting tried, kept across edits.
class Curves {
 public:
  /// More are forgotten, the oldest first.
  static constexpr std::size_t most = 100;

  const std::vector<Curve>& all() const { return all_; }
  /// Null where there is none of that number.
  const Curve* find(std::uint64_t id) const;
  /// The one that grew last; null where it was removed.
  const Curve* current() const { return find(current_); }
  /// What the others are compared with: as chosen, else the first. Null where there is none.
  const Curve* base() const;

  /// The scene was edited. Edits of one gesture (not 0) leave one curve, that of the last of them.
  void edited(std::uint64_t gesture);
  /// What the run of a scene has come to. One that has been seen before goes on with its curve.
  void add(const std::shared_ptr<const Scene>& scene, const RunPoint& point);

  void set_shown(std::uint64_t id, bool shown);
  void set_base(std::uint64_t id) { base_ = id; }
  void remove(std::uint64_t id);
  void clear();
  /// Comparisons with another reference are worth nothing.
  void forget_errors();

 private:
  Curve& curve_of(const std::shared_ptr<const Scene>& scene);
  void erase(std::vector<Curve>::const_iterator curve);
  void relabel();

  std::vector<Curve> all_;
  std::shared_ptr<const Scene> newest_;  ///< as it was given
  std::uint64_t last_id_ = 0, current_ = 0, base_ = 0, gesture_ = 0;
};

}  // namespace glimt
