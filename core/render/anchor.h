#pragma once

#include <memory>
#include <optional>

#include "film/continuation.h"
#include "render/film_cache.h"
#include "scene/scene.h"

namespace glimt {

/// The picture that edits go on from: that of a scene before them, with more samples than any since. It stays the same
/// while a control is dragged, so that errors do not pile up.
class Anchor {
 public:
  struct Picture {
    Film film;
    ErrorEstimate estimate;
  };

  /// Keeps `accumulation.whole` up to date, and takes what the film has after its first samples. After each pass.
  static void look_at(Accumulation& accumulation);
  /// How many samples the next pass is to have, where the caller wants `wanted`.
  int pass(const Accumulation& accumulation, int wanted) const;

  /// The scene is not shown any more: it becomes the anchor if it has as many samples as the one there is.
  void leave(const Scene& scene, const Accumulation& accumulation);
  /// Another scene is shown from now on; it goes on from the anchor if camera, size and settings are the same. Not
  /// `from_zero`, nor where a person has asked for so many samples: that is the picture which the command line makes.
  void show(const Scene& scene, bool from_zero);

  /// The picture to show: the film of the scene that is shown, corrected by the anchor once it can be; else null.
  std::optional<Picture> picture(const Accumulation& accumulation);
  /// The same for a small picture of one sample a pixel, whose pixels are `step` pixels wide: it has the size of the
  /// anchor's. `render` renders a scene so. Null where there is nothing to go on from.
  template <class Render>
  std::optional<Image> preview(const Image& now, int step, Render render) {
    if (!used_) return {};
    if (small_.rgb.empty()) small_ = render(scene_);
    return preview_from(now, step);
  }
  /// Samples of the anchor, where picture() has gone on from it; else 0.
  int continued_from() const { return correction_ ? film_->samples() : 0; }

 private:
  Image preview_from(const Image& now, int step) const;

  Scene scene_;
  std::shared_ptr<const Film> film_;  ///< null where there is no anchor
  FirstSamples first_;
  Image small_;  ///< preview of its scene; empty until it is asked for
  std::optional<Correction> correction_;
  std::optional<Picture> best_;  ///< the last picture that was no worse than the one before it
  int corrected_at_ = 0;         ///< samples that the correction is from
  bool used_ = false;
};

}  // namespace glimt
