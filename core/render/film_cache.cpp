#include "render/film_cache.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace glimt {
namespace {

constexpr std::int64_t few_paths = 250'000;

Scene key_of(Scene scene) {
  scene.render = without_target(scene.render);
  return scene;
}

}  // namespace

void FilmCache::put(const Scene& scene, Accumulation accumulation) {
  const Film& film = accumulation.film;
  if (std::int64_t{film.width()} * film.height() * film.samples() < few_paths) return;
  take(scene);
  accumulation.whole.reset();
  entries_.push_front({key_of(scene), std::move(accumulation)});
  while (bytes() > max_bytes_) entries_.pop_back();
}

std::optional<Accumulation> FilmCache::take(const Scene& scene) {
  const auto found = std::ranges::find(entries_, key_of(scene), &Entry::scene);
  if (found == entries_.end()) return std::nullopt;
  Accumulation taken = std::move(found->accumulation);
  entries_.erase(found);
  return taken;
}

std::size_t FilmCache::bytes() const {
  std::size_t sum = 0;
  for (const Entry& entry : entries_) sum += entry.accumulation.film.bytes() + entry.accumulation.first.bytes();
  return sum;
}

}  // namespace glimt
