#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "kernel/entry/kernels.h"
#include "kernel/geometry/squares.h"
#include "kernel/transport/random.h"
#include "math/vec.h"

namespace glimt {

/// Paths about to begin, as arrays so that free lanes are filled from them at once.
template <class F>
struct PathQueue {
  static constexpr int batches = 16;
  static constexpr int capacity = batches * lane_count<F>;
  /// Places beyond the capacity are read, never used, when the last lanes are filled.
  template <class T>
  using Array = std::array<T, capacity + lane_count<F>>;

  Array<float> direction_x, direction_y, direction_z;
  Array<std::uint32_t> key_a, key_b, key_index;  ///< past the camera's dimensions
  Array<std::int32_t> path;                      ///< the path's place in PathSums; -1 where there is none
  int next = capacity;                           ///< first place not taken yet

  void store_key(const PathKey<F>& key, int place) {
    store(key.a, key_a.data() + place);
    store(key.b, key_b.data() + place);
    store(key.index, key_index.data() + place);
  }
};

/// Where paths come from. Asked once for many paths, so the path loop is compiled once for all sources.
template <class F>
class PathSource {
 public:
  virtual ~PathSource() = default;
  virtual Vec3<F> origin() const = 0;        ///< of all first rays, compiled space
  virtual bool from_camera() const = 0;      ///< the paths make a picture
  virtual bool exhausted() const = 0;        ///< every path has been put into a queue
  virtual void refill(PathQueue<F>& q) = 0;  ///< moves what is left in the queue to its front and fills the rest
};

/// The ray through a pixel's sample, and the key of its path, at the camera's dimensions.
template <class F>
struct CameraSample {
  Vec3<F> direction;
  PathKey<F> key;
};

/// Sub-pixels in the order of samples, as many along each side as the samples to take need.
template <class F>
Point2<F> sub_pixel_centre(const CompiledScene& scene, const Int<F>& sample) {
  const float side = std::ceil(std::sqrt(static_cast<float>(scene.settings.spp)));
  const auto mod = [](F a, float n) { return a - F(n) * to_float(to_int((a + F(0.5f)) * F(1 / n))); };
  const F cell = mod(to_float(sample), side * side);
  const F column = mod(cell, side);
  const F row = to_float(to_int((cell + F(0.5f)) * F(1 / side)));
  return {(column + F(0.5f)) * F(1 / side), (row + F(0.5f)) * F(1 / side)};
}

/// Of several rays of the sample, number `k` of `count`.
template <class F>
CameraSample<F> camera_sample(const CompiledScene& scene, const Int<F>& px, const Int<F>& py, const Int<F>& sample,
                              int count = 1, int k = 0) {
  const Sampler sampler = scene.settings.sampler;
  const Uint<F> pixel = as_uint(py * Int<F>(scene.width) + px);
  const PathKey<F> key = first_key<F>(sampler, static_cast<std::uint32_t>(scene.settings.seed), pixel, as_uint(sample));
  const Point2<F> in_pixel =
      sampler == Sampler::centres
          ? sub_pixel_centre<F>(scene, sample)
          : random_pair<F>(sampler, key, {Int<F>(0)}, static_cast<std::uint32_t>(Dimension::pixel_x), count, k);
  const F x = to_float(px) + in_pixel.u, y = to_float(py) + in_pixel.v;
  return {normalize(fma(broadcast<F>(scene.camera.right), x,
                        fma(broadcast<F>(scene.camera.down), y, broadcast<F>(scene.camera.corner)))),
          key};
}

/// Camera rays of all squares of a block, each through a uniform point of its pixel (box filter).
template <class F>
class CameraRays final : public PathSource<F> {
 public:
  CameraRays(const CompiledScene& scene, const Squares<F>& squares)
      : scene_(scene),
        squares_(squares),
        block_(squares.whole),
        x_(block_.x0),
        y_(block_.y0),
        sample_(static_cast<std::int32_t>(block_.first_sample)) {}

  Vec3<F> origin() const override { return broadcast<F>(scene_.camera.eye); }
  bool from_camera() const override { return true; }
  bool exhausted() const override { return next_path_ >= block_.paths(); }

  void refill(PathQueue<F>& q) override {
    const int kept = PathQueue<F>::capacity - q.next;
    auto to_front = [&](auto& a) { std::copy(a.begin() + q.next, a.begin() + q.next + kept, a.begin()); };
    to_front(q.direction_x), to_front(q.direction_y), to_front(q.direction_z);
    to_front(q.key_a), to_front(q.key_b), to_front(q.key_index), to_front(q.path);
    q.next = 0;
    int place = kept;
    for (; place + lane_count<F> <= PathQueue<F>::capacity && !exhausted(); place += lane_count<F>) generate(q, place);
    std::fill(q.path.begin() + place, q.path.end(), -1);
  }

 private:
  void generate(PathQueue<F>& q, int place) {
    using I = Int<F>;
    const I lane = lane_numbers<F>();
    I px = I(x_) + lane, py = I(y_), sample = I(sample_);
    const int x_end = block_.x0 + block_.width, y_end = block_.y0 + block_.height;
    for (Mask<F> beyond = !less(px, I(x_end)); any(beyond); beyond = !less(px, I(x_end))) {
      px = select(beyond, px - I(block_.width), px);
      py = select(beyond, py + I(1), py);
      const Mask<F> below = !less(py, I(y_end));
      py = select(below, I(block_.y0), py);
      sample = select(below, sample + I(1), sample);
    }
    const Mask<F> exists = less(I(next_path_) + lane, I(block_.paths()));
    const I first(static_cast<std::int32_t>(block_.first_sample));
    store(select(exists, squares_.place(px, py, I(sample - first)), I(-1)), q.path.data() + place);
    advance();
    const CameraSample<F> camera = camera_sample<F>(scene_, px, py, sample);
    store(camera.direction.x, q.direction_x.data() + place);
    store(camera.direction.y, q.direction_y.data() + place);
    store(camera.direction.z, q.direction_z.data() + place);
    q.store_key(skip_dimensions<F>(camera.key, static_cast<std::uint32_t>(Dimension::camera_count)), place);
  }

  void advance() {
    next_path_ += lane_count<F>;
    for (x_ += lane_count<F>; x_ >= block_.x0 + block_.width; x_ -= block_.width)
      if (++y_ >= block_.y0 + block_.height) {
        y_ = block_.y0;
        ++sample_;
      }
  }

  const CompiledScene& scene_;
  const Squares<F>& squares_;
  const PathBlock& block_;
  int x_, y_;
  std::int32_t sample_;
  int next_path_ = 0;
};

/// One path whose first ray is given.
template <class F>
class GivenRay final : public PathSource<F> {
 public:
  GivenRay(const CompiledScene& scene, const GivenPath& path) : scene_(scene), path_(path) {}

  Vec3<F> origin() const override {
    auto component = [&](std::size_t k) { return F(static_cast<float>(path_.origin[k] - scene_.origin[k])); };
    return {component(0), component(1), component(2)};
  }
  bool from_camera() const override { return false; }
  bool exhausted() const override { return used_; }

  void refill(PathQueue<F>& q) override {
    const PathKey<F> key =
        skip_dimensions<F>(first_key<F>(scene_.settings.sampler, static_cast<std::uint32_t>(scene_.settings.seed),
                                        Uint<F>(path_.pixel), Uint<F>(path_.sample)),
                           static_cast<std::uint32_t>(Dimension::camera_count));
    store(F(static_cast<float>(path_.direction[0])), q.direction_x.data());
    store(F(static_cast<float>(path_.direction[1])), q.direction_y.data());
    store(F(static_cast<float>(path_.direction[2])), q.direction_z.data());
    q.store_key(key, 0);
    q.path.fill(-1);
    if (!used_) q.path[0] = 0;
    q.next = 0;
    used_ = true;
  }

 private:
  const CompiledScene& scene_;
  const GivenPath& path_;
  bool used_ = false;
};

}  // namespace glimt
