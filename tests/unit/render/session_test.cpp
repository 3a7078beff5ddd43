#include "render/session.h"

#include <gtest/gtest.h>

#include <chrono>
#include <ctime>
#include <functional>
#include <thread>

#include "film/statistics.h"
#include "pictures.h"
#include "scene/file/scene_file.h"

using namespace glimt;

namespace {

using namespace std::chrono_literals;

Scene small_scene(int spp) {
  Scene scene = read_scene(GLIMT_SCENES "/report.toml");
  scene.render.sphere_connections = SphereConnections::off;  // which take long with every access checked
  scene.image = {64, 48};
  scene.render.spp = spp;
  return scene;
}

constexpr int endless = 1 << 24;

using FramePtr = std::shared_ptr<const Frame>;

/// The first frame seen for which `wanted` holds; null when none has come for four minutes, which is no measurement but
/// an end: with sanitizers, and another test beside it, a frame may take one.
FramePtr wait_for(const Session& session, const std::function<bool(const Frame&)>& wanted) {
  for (const auto start = std::chrono::steady_clock::now(); std::chrono::steady_clock::now() - start < 240s;) {
    if (FramePtr frame = session.frame(); frame && wanted(*frame)) return frame;
    std::this_thread::sleep_for(1ms);
  }
  return nullptr;
}

FramePtr wait_until_finished(const Session& session, std::uint64_t version, int samples) {
  return wait_for(session, [=](const Frame& f) { return f.version == version && f.finished && f.samples == samples; });
}

TEST(Session, ShowsNothingBeforeTheFirstPost) {
  const Session session;
  std::this_thread::sleep_for(20ms);
  EXPECT_EQ(session.frame(), nullptr);
}

TEST(Session, EndsWithThePictureOfTheCommandLine) {
  Session session;
  const Scene scene = small_scene(37);
  const std::uint64_t version = session.post(scene);
  const FramePtr frame = wait_until_finished(session, version, 37);
  ASSERT_TRUE(frame);
  EXPECT_EQ(first_difference(frame->mean.rgb, render(compile(scene), 37).mean().rgb), -1);
  EXPECT_GT(frame->seconds, 0);
  EXPECT_GT(frame->paths_per_second, 0);
  EXPECT_TRUE(std::isfinite(frame->estimate.relmse_scaled));
}

TEST(Session, WakesTheWindowForEachFrame) {
  std::atomic<int> calls{0};
  Session session({}, [&] { ++calls; });
  const auto version = session.post(small_scene(5));
  ASSERT_TRUE(wait_until_finished(session, version, 5));
  EXPECT_GE(calls, 1);
}

TEST(Session, FramesShowTheNewestPost) {
  Session session;
  Scene scene = small_scene(endless);
  const auto first = session.post(scene);
  ASSERT_TRUE(wait_for(session, [=](const Frame& f) { return f.version == first; }));
  scene.spheres[0].radius = 1;
  const auto second = session.post(scene);
  EXPECT_GT(second, first);
  const FramePtr frame = wait_for(session, [=](const Frame& f) { return f.version == second; });
  ASSERT_TRUE(frame);
  for (int i = 0; i < 20; ++i, std::this_thread::sleep_for(5ms))
    EXPECT_EQ(session.frame()->version, second) << "never back";
}

TEST(Session, NewTargetGoesOnWithTheSamplesThereAre) {
  Session session;
  const auto version = session.post(small_scene(20));
  ASSERT_TRUE(wait_until_finished(session, version, 20));
  EXPECT_EQ(session.post(small_scene(30)), version);
  std::vector<int> seen;
  const FramePtr more = wait_for(session, [&](const Frame& f) {
    seen.push_back(f.samples);
    return f.finished && f.samples == 30;
  });
  ASSERT_TRUE(more);
  EXPECT_GE(*std::ranges::min_element(seen), 20) << "never restarted";
  EXPECT_EQ(first_difference(more->mean.rgb, render(compile(small_scene(30)), 30).mean().rgb), -1);
  // A lower one keeps what is there.
  EXPECT_EQ(session.post(small_scene(10)), version);
  ASSERT_TRUE(wait_until_finished(session, version, 30));
}

TEST(Session, TargetRaisedWhileRenderingIsReached) {
  Session session;
  const auto version = session.post(small_scene(400));
  EXPECT_EQ(session.post(small_scene(50)), version);
  const FramePtr frame = wait_for(session, [](const Frame& f) { return f.finished; });
  ASSERT_TRUE(frame);
  EXPECT_GE(frame->samples, 50);
}

double process_cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

TEST(Session, PauseStopsAndUsesNoCpu) {
  Session session;
  session.post(small_scene(endless));
  ASSERT_TRUE(wait_for(session, [](const Frame& f) { return f.samples > 2; }));
  session.set_paused(true);
  EXPECT_TRUE(session.paused());
  // The pass that runs may end; after it, nothing comes.
  int samples = 0;
  wait_for(session, [&](const Frame& f) {
    const bool same = f.samples == samples;
    samples = f.samples;
    std::this_thread::sleep_for(1s);
    return same;
  });
  const double before = process_cpu_seconds();
  std::this_thread::sleep_for(300ms);
  EXPECT_LT(process_cpu_seconds() - before, 0.15) << "a busy thread would take twice that or more";
  EXPECT_EQ(session.frame()->samples, samples);
  session.set_paused(false);
  EXPECT_TRUE(wait_for(session, [&](const Frame& f) { return f.samples > samples; }));
}

TEST(Session, FinishedUsesNoCpu) {
  Session session;
  const auto version = session.post(small_scene(4));
  ASSERT_TRUE(wait_until_finished(session, version, 4));
  std::this_thread::sleep_for(100ms);
  const double before = process_cpu_seconds();
  std::this_thread::sleep_for(300ms);
  EXPECT_LT(process_cpu_seconds() - before, 0.15);
}

TEST(Session, EditsOfAPausedSceneAreShownOnce) {
  Session session;
  Scene scene = small_scene(endless);
  session.post(scene);
  ASSERT_TRUE(wait_for(session, [](const Frame&) { return true; }));
  session.set_paused(true);
  scene.spheres[0].radius = 1;
  const auto version = session.post(scene);
  EXPECT_TRUE(wait_for(session, [=](const Frame& f) { return f.version == version && f.samples >= 1; }));
}

TEST(Session, RestartBeginsAgain) {
  Session session;
  session.restart();  // of nothing
  const auto version = session.post(small_scene(12));
  const FramePtr first = wait_until_finished(session, version, 12);
  ASSERT_TRUE(first);
  session.restart();
  const FramePtr again = wait_for(session, [=](const Frame& f) { return f.version > version && f.finished; });
  ASSERT_TRUE(again);
  EXPECT_EQ(again->samples, 12);
  EXPECT_EQ(first_difference(again->mean.rgb, first->mean.rgb), -1);
}

TEST(Session, RefusedSceneKeepsTheLast) {
  Session session;
  const auto version = session.post(small_scene(10));
  Scene bad = small_scene(10);
  bad.spheres[0].radius = -1;
  EXPECT_THROW(session.post(bad), SceneError);
  EXPECT_TRUE(wait_until_finished(session, version, 10));
  EXPECT_GT(session.post(small_scene(10)), 0u);
}

// A slider moved fast, as the window moves it: the last position counts.
TEST(Session, ManyPostsEndWithTheLast) {
  Session session;
  Scene scene = small_scene(6);
  std::uint64_t version = 0;
  for (int i = 0; i < 200; ++i) {
    scene.spheres[0].radius = 0.5 + 0.005 * i;
    const auto next = session.post(scene);
    EXPECT_GT(next, version);
    version = next;
    if (i % 50 == 49) std::this_thread::sleep_for(10ms);
  }
  const FramePtr frame = wait_until_finished(session, version, 6);
  ASSERT_TRUE(frame);
  EXPECT_EQ(first_difference(frame->mean.rgb, render(compile(scene), 6).mean().rgb), -1);
}

/// So many samples that the film is kept.
constexpr int worth_keeping = 100;

// Back at a scene, a second rendering would start at 1 sample and at 0 seconds.
TEST(Session, GoingBackBringsTheSamplesBack) {
  Session session;
  Scene scene = small_scene(worth_keeping);
  const FramePtr first = wait_until_finished(session, session.post(scene), worth_keeping);
  ASSERT_TRUE(first);
  Scene other = scene;
  other.spheres[0].radius = 1;
  ASSERT_TRUE(wait_until_finished(session, session.post(other), worth_keeping));
  const auto version = session.post(scene);
  const FramePtr back = wait_for(session, [=](const Frame& f) { return f.version == version; });
  ASSERT_TRUE(back);
  EXPECT_EQ(back->samples, worth_keeping) << "the first frame already";
  EXPECT_EQ(back->seconds, first->seconds);
  EXPECT_EQ(first_difference(back->mean.rgb, first->mean.rgb), -1);

  session.restart();
  const FramePtr again = wait_for(session, [=](const Frame& f) { return f.version > version && f.finished; });
  ASSERT_TRUE(again);
  EXPECT_NE(again->seconds, first->seconds) << "a restart brings nothing back";
}

// A pass that an edit cancelled is finished when its scene comes back: the image is the one of a rendering without a
// break.
TEST(Session, CancelledPassIsNotLost) {
  Session session;
  const Scene scene = small_scene(300);
  Scene other = scene;
  other.spheres[0].radius = 1;
  int samples = 0;
  for (int i = 0; i < 6; ++i) {
    const auto version = session.post(scene);
    const FramePtr more =
        wait_for(session, [=](const Frame& f) { return f.version == version && f.samples > worth_keeping; });
    ASSERT_TRUE(more);
    EXPECT_GE(more->samples, samples);
    samples = more->samples;
    std::this_thread::sleep_for(std::chrono::milliseconds(3 * i));
    session.post(other);
    std::this_thread::sleep_for(3ms);
  }
  const FramePtr end = wait_until_finished(session, session.post(scene), 300);
  ASSERT_TRUE(end);
  EXPECT_EQ(first_difference(end->mean.rgb, render(compile(scene), 300).mean().rgb), -1);
}

// An edit of a large scene does not wait for the estimate of the pass that it interrupts; it is made up for.
TEST(Session, FilmsThatComeBackKnowTheirError) {
  Session session;
  Scene scene = small_scene(endless);
  scene.image = {400, 300};  // has a preview
  Scene other = scene;
  other.spheres[0].radius = 1;
  int samples = 2;
  for (int i = 0; i < 8; ++i) {
    const auto version = session.post(scene);
    const FramePtr back =
        wait_for(session, [=](const Frame& f) { return f.version == version && f.samples >= samples; });
    ASSERT_TRUE(back);
    EXPECT_EQ(back->estimate.relmse_scaled, estimate_error(render(compile(scene), back->samples)).relmse_scaled);
    samples = back->samples;
    std::this_thread::sleep_for(std::chrono::milliseconds(5 + 3 * i));
    const auto between = session.post(other);
    ASSERT_TRUE(wait_for(session, [=](const Frame& f) { return f.version == between; }));
  }
}

TEST(Session, FilmsAreKeptUpToSoManyBytes) {
  const Scene scene = small_scene(worth_keeping);
  const auto film = [&] { return render(compile(scene), worth_keeping); };
  FilmCache cache(2 * film().bytes() + 100);
  const auto scene_of = [&](int seed) {
    Scene other = scene;
    other.render.seed = seed;
    return other;
  };
  for (int seed = 1; seed <= 3; ++seed) cache.put(scene_of(seed), {.film = film(), .progress = {}});
  EXPECT_LE(cache.bytes(), 2 * film().bytes() + 100);
  EXPECT_FALSE(cache.take(scene_of(1))) << "the oldest has gone";
  Scene other_target = scene_of(2);
  other_target.render.spp = 7;
  other_target.render.target_error = 0.5;
  const auto kept = cache.take(other_target);
  ASSERT_TRUE(kept) << "the target does not count";
  EXPECT_EQ(kept->film.samples(), worth_keeping);
  EXPECT_FALSE(cache.take(scene_of(2))) << "handed over";
}

TEST(Session, StopsAtAnEstimatedError) {
  Session session;
  Scene scene = small_scene(1);
  scene.render.target_error = 0.05;
  const auto version = session.post(scene);
  const FramePtr end = wait_for(session, [](const Frame& f) { return f.finished; });
  ASSERT_TRUE(end);
  EXPECT_GE(end->samples, 8) << "fewer say too little of the error";
  EXPECT_LE(end->estimate.relmse_scaled, 0.05);
  EXPECT_EQ(estimate_error(render(compile(scene), end->samples)).relmse_scaled, end->estimate.relmse_scaled);
  scene.render.target_error = 0.005;
  EXPECT_EQ(session.post(scene), version) << "goes on with the samples there are";
  const FramePtr more =
      wait_for(session, [](const Frame& f) { return f.finished && f.estimate.relmse_scaled <= 0.005; });
  ASSERT_TRUE(more);
  EXPECT_GT(more->samples, end->samples);
}

TEST(Session, StandardErrorIsThereWhereItIsWanted) {
  Session session;
  session.set_paused(true);
  const Scene scene = small_scene(20);
  const auto version = session.post(scene);
  session.set_paused(false);
  const FramePtr without = wait_until_finished(session, version, 20);
  ASSERT_TRUE(without);
  EXPECT_TRUE(without->error.rgb.empty()) << "costs memory and time";
  session.set_error_wanted(true);  // of a rendering that is finished
  const FramePtr with = wait_for(session, [](const Frame& f) { return !f.error.rgb.empty(); });
  ASSERT_TRUE(with);
  EXPECT_EQ(with->version, version);
  EXPECT_EQ(first_difference(with->error.rgb, render(compile(scene), 20).standard_error().rgb), -1);
}

// The coarse image that answers an edit covers the same view with fewer pixels.
TEST(Session, PreviewOfALargeImageComesFirst) {
  Session session;
  Scene scene = small_scene(endless);
  scene.image = {1600, 900};
  session.post(scene);
  const FramePtr preview = wait_for(session, [](const Frame&) { return true; });
  ASSERT_TRUE(preview);
  EXPECT_EQ(preview->samples, 0);
  EXPECT_EQ(preview->size, scene.image);
  EXPECT_LT(preview->mean.width * preview->mean.height, 100'000);
  EXPECT_NEAR(static_cast<double>(preview->mean.width) / preview->mean.height, 16.0 / 9, 0.02);
}

// Would take hours if it waited for the target, or for one pass of so large a picture to end.
TEST(Session, EndsWhileRendering) {
  Scene scene = small_scene(endless);
  scene.image = {2048, 2048};
  for (int i = 0; i < 3; ++i) {
    Session session;
    session.post(scene);
    std::this_thread::sleep_for(std::chrono::milliseconds(10 * i));
  }
}

}  // namespace
