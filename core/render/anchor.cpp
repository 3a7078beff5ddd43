#include "render/anchor.h"

#include <algorithm>
#include <utility>

namespace glimt {
namespace {

constexpr int least_samples = 32;  ///< fewer are rendered anew as fast

bool goes_on(const Scene& before, const Scene& after) {
  return before.camera == after.camera && before.image == after.image &&
         without_target(before.render) == without_target(after.render);
}

}  // namespace

void Anchor::look_at(Accumulation& now) {
  now.first.look_at(now.film);
  const int samples = now.film.samples();
  // The picture of a tenth fewer samples costs a tenth of the copies.
  const bool grown = !now.whole || samples > now.whole->samples() + now.whole->samples() / 10;
  if (samples >= least_samples && grown && !now.first.entries().empty())
    now.whole = std::make_shared<const Film>(now.film);
}

int Anchor::pass(const Accumulation& now, int wanted) const {
  const int samples = now.film.samples();
  if (const int next = now.first.next(now.film); next > 0)
    return used_ && samples == 0 ? next : std::min(wanted, next - samples);
  return wanted;
}

void Anchor::leave(const Scene& scene, const Accumulation& now) {
  if (!now.whole || (film_ && goes_on(scene_, scene) && film_->samples() > now.whole->samples())) return;
  scene_ = scene;
  film_ = now.whole;
  first_ = now.first;
  small_ = {};
}

void Anchor::show(const Scene& scene, bool from_zero) {
  correction_.reset();
  best_.reset();
  corrected_at_ = 0;
  const bool counted = scene.render.target_error == 0 && scene.render.spp < max_spp;
  used_ = film_ && !from_zero && !counted && goes_on(scene_, scene) && scene_ != scene;
}

std::optional<Anchor::Picture> Anchor::picture(const Accumulation& now) {
  if (!used_) return {};
  const auto& mine = first_.entries();
  const auto& theirs = now.first.entries();
  const int newest = theirs.empty() ? 0 : theirs.rbegin()->first;
  const bool fresh = newest > corrected_at_ && mine.contains(newest);
  if (fresh) {
    correction_ = continue_from(*film_, mine.at(newest), theirs.at(newest), newest, now.film.scale());
    corrected_at_ = newest;
  }
  if (!correction_) return {};
  Picture picture{corrected(now.film, *correction_), {}};
  picture.estimate = estimate_error(picture.film);
  // Samples of the edited scene alone make a picture worse that knows nearly all from the one before.
  if (!best_ || fresh || picture.estimate.at_most() <= best_->estimate.at_most()) best_ = std::move(picture);
  return best_;
}

Image Anchor::preview_from(const Image& now, int step) const {
  Image image = film_->mean();
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const int sx = std::min(x / step, now.width - 1), sy = std::min(y / step, now.height - 1);
      const float *a = now.pixel(sx, sy), *b = small_.pixel(sx, sy);
      for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] += a[c] - b[c];
    }
  return image;
}

}  // namespace glimt
