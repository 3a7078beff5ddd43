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

/// The state of a run after this many samples per pixel.
struct RunPoint {
  int samples = 0;
  double seconds = 0;               ///< rendering time
  double estimate = 0;              ///< relmse_scaled, from the two halves
  std::optional<Comparison> error;  ///< against the reference, where there was one
  bool at_least = false;            ///< the estimate is a bound: light may not have been found yet
  int continued_from = 0;           ///< samples of the scene before an edit, which the picture goes on from; 0: none
};

/// Error against time of one scene with one set of settings.
struct Curve {
  std::uint64_t id = 0;
  std::shared_ptr<const Scene> scene;
  std::string label;             ///< what differs from the first curve; of that, what the others change
  int continued_from = 0;        ///< of its points, the most
  std::vector<RunPoint> points;  ///< by increasing samples, each a fifth more or so than the one before
  bool shown = true;
  std::uint64_t gesture = 0;            ///< the gesture whose edit began it
  std::vector<Difference> differences;  ///< to the first curve's scene
};

/// The quantity along the horizontal axis.
enum class Across { seconds, samples };
double across(const RunPoint& point, Across axis);

/// The error that a curve shows, relmse_scaled: against the reference, or the estimate. Nothing where the point has
/// none, as for a black picture, and where it is below `least_told`: then the halves differ by rounding only.
enum class ErrorKind { estimate, reference };
inline constexpr double least_told = 1e-9;
std::optional<double> error_of(const RunPoint& point, ErrorKind kind);
/// `reference` where a point of the curve was compared with a reference, else `estimate`.
ErrorKind error_kind(const Curve& curve);

/// The curve's error at a place along the axis, and the place where the curve has come down to an error. Both are
/// interpolated on logarithmic axes. Nothing outside what was measured.
std::optional<double> error_at(const Curve& curve, ErrorKind kind, Across axis, double place);
std::optional<double> place_of(const Curve& curve, ErrorKind kind, Across axis, double error);

/// Efficiency over that of the base: inverse ratio of error times seconds. At an equal time, where one is given and
/// both have been there, else as far as each has come. Compared by the reference where both can be, else by estimate.
/// Nothing for pictures of different sizes, nor for those that go on from others, whose time does not count.
std::optional<double> efficiency_ratio(const Curve& curve, const Curve& base, std::optional<double> seconds);

/// One curve for every scene and setting tried, kept across edits.
class Curves {
 public:
  /// The most curves kept; the oldest is forgotten first.
  static constexpr std::size_t most = 100;

  const std::vector<Curve>& all() const { return all_; }
  /// Null where no curve has this number.
  const Curve* find(std::uint64_t id) const;
  /// The curve that grew last; null where it was removed.
  const Curve* current() const { return find(current_); }
  /// The curve that others are compared with: the chosen one, else the first. Null where there is none.
  const Curve* base() const;

  /// Call it when the scene was edited. Edits of one gesture (not 0) leave one curve, that of the last edit.
  void edited(std::uint64_t gesture);
  /// Adds a point to the curve of the scene. A scene seen before goes on with its old curve.
  void add(const std::shared_ptr<const Scene>& scene, const RunPoint& point);

  void set_shown(std::uint64_t id, bool shown);
  void set_base(std::uint64_t id) { base_ = id; }
  void remove(std::uint64_t id);
  void clear();
  /// Drops all errors against the reference, because the reference has changed.
  void forget_errors();

 private:
  Curve& curve_of(const std::shared_ptr<const Scene>& scene);
  void erase(std::vector<Curve>::const_iterator curve);
  void relabel();

  std::vector<Curve> all_;
  std::shared_ptr<const Scene> newest_;  ///< as passed to add()
  std::uint64_t last_id_ = 0, current_ = 0, base_ = 0, gesture_ = 0;
};

}  // namespace glimt
