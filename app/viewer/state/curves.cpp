#include "viewer/state/curves.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace glimt {
namespace {

constexpr double spacing = 1.19;  ///< ratio of samples from one point to the next: four points to an octave

std::optional<double> interpolated(const Curve& curve, ErrorKind kind, Across axis, double value, bool by_error) {
  std::optional<std::pair<double, double>> last;  // logarithms of the previous point's place and error
  for (const RunPoint& point : curve.points) {
    const auto error = error_of(point, kind);
    if (!error) continue;
    const std::pair now{std::log(across(point, axis)), std::log(*error)};
    const double wanted = std::log(value);
    const auto [x0, y0] = last.value_or(now);
    const double begin = by_error ? y0 : x0, end = by_error ? now.second : now.first;
    if (by_error ? wanted <= begin && wanted >= end : wanted >= begin && wanted <= end) {
      const double share = end == begin ? 0 : (wanted - begin) / (end - begin);
      return std::exp(by_error ? x0 + share * (now.first - x0) : y0 + share * (now.second - y0));
    }
    last = now;
  }
  return std::nullopt;
}

std::string joined(const std::vector<std::string>& parts, const char* otherwise) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text.empty() ? otherwise : text;
}

void append(std::vector<RunPoint>& points, const RunPoint& point) {
  if (!points.empty() && point.samples < points.back().samples) points.clear();  // rendering has restarted
  const std::size_t count = points.size();
  const bool same = count > 0 && points.back().samples == point.samples;
  const bool near = count > 1 && points.back().samples < spacing * points[count - 2].samples;
  if (same || near)
    points.back() = point;
  else
    points.push_back(point);
}

}  // namespace

double across(const RunPoint& point, Across axis) { return axis == Across::seconds ? point.seconds : point.samples; }

std::optional<double> error_of(const RunPoint& point, ErrorKind kind) {
  if (kind == ErrorKind::reference && !point.error) return std::nullopt;
  const double error = kind == ErrorKind::estimate ? point.estimate : point.error->relmse_scaled;
  return error >= least_told && std::isfinite(error) ? std::optional(error) : std::nullopt;
}

ErrorKind error_kind(const Curve& curve) {
  const bool compared = std::ranges::any_of(curve.points, [](const RunPoint& p) { return p.error.has_value(); });
  return compared ? ErrorKind::reference : ErrorKind::estimate;
}

std::optional<double> error_at(const Curve& curve, ErrorKind kind, Across axis, double place) {
  return interpolated(curve, kind, axis, place, false);
}

std::optional<double> place_of(const Curve& curve, ErrorKind kind, Across axis, double error) {
  return interpolated(curve, kind, axis, error, true);
}

std::optional<double> efficiency_ratio(const Curve& curve, const Curve& base, std::optional<double> seconds) {
  // A smaller picture takes less time, so the two cannot be compared.
  if (curve.scene && base.scene && curve.scene->image != base.scene->image) return std::nullopt;
  if (curve.continued_from > 0 || base.continued_from > 0) return std::nullopt;
  const ErrorKind kind = std::min(error_kind(curve), error_kind(base));
  if (seconds) {
    const auto error = error_at(curve, kind, Across::seconds, *seconds);
    const auto base_error = error_at(base, kind, Across::seconds, *seconds);
    if (!error || !base_error) return std::nullopt;
    return *base_error / *error;
  }
  const auto work = [&](const Curve& c) -> std::optional<double> {
    const auto error = c.points.empty() ? std::nullopt : error_of(c.points.back(), kind);
    return error ? std::optional(*error * c.points.back().seconds) : std::nullopt;
  };
  const auto own = work(curve), other = work(base);
  return own && other ? std::optional(*other / *own) : std::nullopt;
}

const Curve* Curves::find(std::uint64_t id) const {
  const auto found = std::ranges::find(all_, id, &Curve::id);
  return found == all_.end() ? nullptr : &*found;
}

const Curve* Curves::base() const {
  const Curve* chosen = find(base_);
  return chosen || all_.empty() ? chosen : &all_.front();
}

void Curves::edited(std::uint64_t gesture) {
  gesture_ = gesture;
  const Curve* last = current();
  if (last && gesture != 0 && last->gesture == gesture) remove(last->id);
}

Curve& Curves::curve_of(const std::shared_ptr<const Scene>& scene) {
  if (scene == newest_)
    if (const auto found = std::ranges::find(all_, current_, &Curve::id); found != all_.end()) return *found;
  newest_ = scene;
  auto untargeted = std::make_shared<Scene>(*scene);
  untargeted->render = without_target(scene->render);
  for (Curve& curve : all_)
    if (*curve.scene == *untargeted) {
      current_ = curve.id;
      return curve;
    }
  if (all_.size() == most) erase(all_.begin());
  current_ = ++last_id_;
  Curve& curve = all_.emplace_back();
  curve.id = current_;
  curve.scene = std::move(untargeted);
  curve.gesture = gesture_;
  curve.differences = differences(*all_.front().scene, *curve.scene);
  relabel();
  return all_.back();
}

void Curves::add(const std::shared_ptr<const Scene>& scene, const RunPoint& point) {
  Curve& curve = curve_of(scene);
  append(curve.points, point);
  if (point.continued_from <= curve.continued_from) return;
  curve.continued_from = point.continued_from;
  relabel();
}

void Curves::set_shown(std::uint64_t id, bool shown) {
  for (Curve& curve : all_)
    if (curve.id == id) curve.shown = shown;
}

void Curves::remove(std::uint64_t id) {
  const auto curve = std::ranges::find(all_, id, &Curve::id);
  if (curve == all_.end()) return;
  erase(curve);
  relabel();
}

void Curves::erase(std::vector<Curve>::const_iterator curve) {
  const bool first = curve == all_.begin();
  all_.erase(curve);
  if (!first) return;
  for (Curve& other : all_) other.differences = differences(*all_.front().scene, *other.scene);
}

void Curves::clear() {
  all_.clear();
  current_ = 0;
}

void Curves::forget_errors() {
  for (Curve& curve : all_)
    for (RunPoint& point : curve.points) point.error.reset();
}

void Curves::relabel() {
  if (all_.empty()) return;
  std::set<std::string> keys, labels;
  std::vector<std::string> firsts;
  for (std::size_t i = 1; i < all_.size(); ++i) {
    std::vector<std::string> parts;
    for (const Difference& d : all_[i].differences) {
      parts.push_back(d.to);
      if (keys.insert(d.key).second) firsts.push_back(d.from);
    }
    std::string label = joined(parts, "same");
    if (const int samples = all_[i].continued_from; samples > 0)
      label += ", continued from " + std::to_string(samples) + " samples";
    all_[i].label = label;
    for (int n = 2; !labels.insert(all_[i].label).second; ++n) all_[i].label = label + " (" + std::to_string(n) + ")";
  }
  all_.front().label = joined(firsts, "first setting");
}

}  // namespace glimt
