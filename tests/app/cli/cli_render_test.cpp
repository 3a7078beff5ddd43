#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <stb_image.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/cli_test.h"
#include "film/image_file.h"
#include "film/statistics.h"
#include "scene/fields.h"
#include "scene/file/scene_file.h"

using namespace glimt;
using nlohmann::json;

namespace {

/// All channels of an EXR, by name.
std::map<std::string, std::vector<float>> exr_channels(const std::filesystem::path& file) {
  Imf::InputFile input(file.c_str());
  const Imath::Box2i window = input.header().dataWindow();
  const auto width = static_cast<std::size_t>(window.max.x + 1), height = static_cast<std::size_t>(window.max.y + 1);
  std::map<std::string, std::vector<float>> channels;
  Imf::FrameBuffer buffer;
  for (auto c = input.header().channels().begin(); c != input.header().channels().end(); ++c) {
    auto& values = channels[c.name()];
    values.resize(width * height);
    buffer.insert(c.name(),
                  Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), sizeof(float), width * sizeof(float)));
  }
  input.setFrameBuffer(buffer);
  input.readPixels(window.min.y, window.max.y);
  return channels;
}

/// The bytes of an RGB picture of 24x16 pixels.
std::vector<std::uint8_t> png_pixels(const std::filesystem::path& file) {
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
      stbi_load(file.c_str(), &width, &height, &channels, 0), &stbi_image_free);
  EXPECT_TRUE(pixels && width == 24 && height == 16 && channels == 3) << file;
  return pixels ? std::vector<std::uint8_t>(pixels.get(), pixels.get() + 24 * 16 * 3) : std::vector<std::uint8_t>();
}

class Render : public CommandLine {
 protected:
  json stats(const Arguments& options) const {
    Arguments all = options;
    all.insert(all.end(), {"--stats", "stats.json"});
    const Result result = render("stats.pfm", all);
    EXPECT_EQ(result.status, 0) << result.err;
    return json::parse(read("stats.json"));
  }
  /// The picture as a PFM's bytes.
  std::string picture(const Arguments& options) const {
    const Result result = render("picture.pfm", options);
    EXPECT_EQ(result.status, 0) << result.err;
    return read("picture.pfm");
  }
};

TEST_F(Render, WritesEveryFormat) {
  for (const char* out : {"a.png", "a.exr", "a.pfm"}) {
    const Result result = render(out, {"--spp", "4"});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(has(result.out, std::string(out) + ": 4 spp in ")) << result.out;
    EXPECT_TRUE(has(result.out, "Mpaths/s, error ")) << result.out;
    EXPECT_EQ(result.err, "");
  }
  EXPECT_EQ(files(), 3u);
  EXPECT_EQ(read_image(folder / "a.exr").rgb, read_image(folder / "a.pfm").rgb);

  EXPECT_EQ(png_pixels(folder / "a.png"), to_srgb8(read_image(folder / "a.exr"), {}));
}

TEST_F(Render, DithersAPngUnlessToldNotTo) {
  for (const char* out : {"a.exr", "a.png"}) ASSERT_EQ(render(out, {"--spp", "4", "--no-dither"}).status, 0);
  ASSERT_EQ(render("b.exr", {"--spp", "4"}).status, 0);
  const Image image = read_image(folder / "a.exr");
  EXPECT_EQ(image.rgb, read_image(folder / "b.exr").rgb);
  EXPECT_EQ(png_pixels(folder / "a.png"), to_srgb8(image, {.dither = Dither::off}));
  EXPECT_NE(png_pixels(folder / "a.png"), to_srgb8(image, {}));
  EXPECT_EQ(read_metadata(folder / "a.png").at("dither"), "off");
}

TEST_F(Render, ExrHasErrorChannelsAndAttributes) {
  ASSERT_EQ(render("a.exr", {"--spp", "6", "--seed", "9"}).status, 0);
  const auto channels = exr_channels(folder / "a.exr");
  EXPECT_EQ(channels.size(), 6u);
  for (const char* name : {"error.R", "error.G", "error.B"}) {
    ASSERT_TRUE(channels.contains(name));
    double sum = 0;
    for (const float e : channels.at(name)) sum += e;
    EXPECT_TRUE(std::isfinite(sum) && sum > 0) << name;
  }
  const Metadata metadata = read_metadata(folder / "a.exr");
  EXPECT_EQ(metadata.at("samples"), "6");
  EXPECT_EQ(metadata.at("seed"), "9");
  EXPECT_EQ(metadata.at("version"), GLIMT_VERSION);
  for (const auto& field : settings_fields()) EXPECT_TRUE(metadata.contains(std::string(field.key))) << field.key;
}

TEST_F(Render, ImagesHoldTheSceneThatMakesThemAgain) {
  const Arguments options{"--seconds", "0.2", "--seed", "5", "--set", "material.clay.reflectance=[0.1, 0.2, 0.3]"};
  for (const std::string ending : {".png", ".exr"}) {
    ASSERT_EQ(render("a" + ending, options).status, 0);
    write("again.toml", read_metadata(folder / ("a" + ending)).at("scene"));
    ASSERT_EQ(glimt({"render", "again.toml", "-o", "again" + ending}).status, 0);
    EXPECT_EQ(read_metadata(folder / ("again" + ending)).at("scene"), read("again.toml"));
  }
  EXPECT_EQ(exr_channels(folder / "a.exr"), exr_channels(folder / "again.exr"));
  EXPECT_EQ(png_pixels(folder / "a.png"), png_pixels(folder / "again.png"));
}

TEST_F(Render, StatsSayWhatItWasAndWhatItCost) {
  const json s = stats({"--spp", "8", "--threads", "2", "--lanes", "1", "--shadow-rays", "2", "--seed", "3"});
  EXPECT_EQ(s.at("spp"), 8);
  EXPECT_EQ(s.at("sample_ranges"), "0:8");
  EXPECT_EQ(s.at("width"), 24);
  EXPECT_EQ(s.at("height"), 16);
  EXPECT_EQ(s.at("paths"), 24 * 16 * 8);
  EXPECT_GT(s.at("seconds"), 0);
  EXPECT_NEAR(s.at("paths_per_second").get<double>() * s.at("seconds").get<double>(), 24 * 16 * 8, 1e-6);
  EXPECT_NEAR(s.at("mean").get<double>(), mean(read_image(folder / "stats.pfm")), 1e-12);
  EXPECT_GT(s.at("relmse_estimate"), 0);
  EXPECT_EQ(s.at("threads"), 2);
  EXPECT_EQ(s.at("lanes"), 1);
  EXPECT_EQ(s.at("method"), "path");
  EXPECT_EQ(s.at("shadow_rays"), 2);
  EXPECT_EQ(s.at("seed"), 3);
  EXPECT_EQ(s.at("version"), GLIMT_VERSION);
  EXPECT_EQ(s.at("invalid"), 0);
  EXPECT_EQ(s.at("saturated"), 0);
  EXPECT_EQ(s.at("scene"), "Hexagonal room");
}

TEST_F(Render, StatsHaveNullForWhatIsUnknown) {
  const json s = stats({"--spp", "1", "--set", R"(name="a \"b\"\\ \u00e4")"});
  EXPECT_TRUE(s.at("relmse_estimate").is_null());
  EXPECT_TRUE(s.at("relmse_scaled").is_null());
  EXPECT_EQ(s.at("scene"), "a \"b\"\\ \u00e4");
  EXPECT_GE(s.at("threads"), 1);
  EXPECT_GE(s.at("lanes"), 4);
}

TEST_F(Render, IsTheSameForAnyNumberOfThreadsAndLanes) {
  const std::string one = picture({"--spp", "20", "--threads", "1"});
  for (const char* threads : {"2", "4", "1024"}) EXPECT_EQ(one, picture({"--spp", "20", "--threads", threads}));
  EXPECT_EQ(one, picture({"--spp", "20", "--lanes", "1"}));
  EXPECT_EQ(one, picture({"--spp", "20", "--lanes", "native"}));
}

TEST_F(Render, ExrDataIsTheSameForAnyNumberOfThreads) {
  ASSERT_EQ(render("1.exr", {"--spp", "5", "--threads", "1"}).status, 0);
  const auto one = exr_channels(folder / "1.exr");
  for (const std::string threads : {"2", "4"}) {
    ASSERT_EQ(render("n.exr", {"--spp", "5", "--threads", threads}).status, 0);
    EXPECT_EQ(one, exr_channels(folder / "n.exr")) << threads;
  }
}

TEST_F(Render, OptionsOverrideTheScene) {
  const std::string plain = picture({"--spp", "4"});
  EXPECT_EQ(plain, picture({"--spp", "4", "--seed", "1", "--shadow-rays", "1", "--method", "path"}))
      << "what the scene says anyway";
  for (const Arguments& options :
       {Arguments{"--seed", "2"}, Arguments{"--shadow-rays", "2"}, Arguments{"--method", "naive"},
        Arguments{"--roulette", "constant"}, Arguments{"--roulette-depth", "1"},
        Arguments{"--set", "material.white.reflectance=[0.5, 0.5, 0.5]"}, Arguments{"--set", "render.seed=2"},
        Arguments{"--set", "camera.fov_y=60"}}) {
    Arguments all = options;
    all.insert(all.end(), {"--spp", "4"});
    EXPECT_NE(plain, picture(all)) << options[0] << " " << options[1];
  }
  EXPECT_EQ(picture({"--spp", "4", "--set", "render.seed=2"}), picture({"--spp", "4", "--seed", "2"}));
  EXPECT_EQ(plain, picture({"--spp", "4", "--set", "image.width=7"})) << "--size wins";
  EXPECT_NE(picture({"--spp", "2", "--set", "camera.fov_y=60", "--set", "material.white.reflectance=[0.5, 0.5, 0.5]"}),
            picture({"--spp", "2", "--set", "camera.fov_y=60"}));
}

TEST_F(Render, SizeIsTheImages) {
  ASSERT_EQ(glimt({"render", scene, "-o", "a.pfm", "--size", "31x7", "--spp", "1"}).status, 0);
  const Image image = read_image(folder / "a.pfm");
  EXPECT_EQ(image.width, 31);
  EXPECT_EQ(image.height, 7);
}

TEST_F(Render, UsesTheSamplesOfTheSceneIfNoneAreGiven) {
  EXPECT_EQ(stats({"--set", "render.spp=3"}).at("spp"), 3);
  EXPECT_EQ(stats({}).at("spp"), Settings().spp);
}

TEST_F(Render, SecondsEndIt) {
  const json s = stats({"--seconds", "0.3"});
  EXPECT_GT(s.at("spp"), 1);
  EXPECT_GT(s.at("seconds"), 0);
}

TEST_F(Render, TargetErrorIsReachedWithTheSameSamplesByAnyThreads) {
  const json one = stats({"--target-error", "0.05", "--threads", "1"});
  EXPECT_LE(one.at("relmse_scaled"), 0.05);
  EXPECT_GE(one.at("spp"), 8);
  const json two = stats({"--target-error", "0.05", "--threads", "2"});
  EXPECT_EQ(one.at("spp"), two.at("spp"));
  EXPECT_EQ(stats({"--target-error", "1e6"}).at("spp"), 8) << "never fewer";
}

// Powers of two times every radiance are exact, so no sample may differ but by them.
TEST_F(Render, TargetErrorHasNoScale) {
  const json one = stats({"--target-error", "0.003"});
  for (const char* radiance : {"10", "0.01953125", "1310720"}) {
    const std::string lamp = std::string("material.lamp.radiance=[") + radiance + "," + radiance + "," + radiance + "]";
    const json other = stats({"--target-error", "0.003", "--set", lamp});
    EXPECT_EQ(other.at("spp"), one.at("spp")) << radiance;
    EXPECT_EQ(other.at("relmse_scaled"), one.at("relmse_scaled")) << radiance;
  }
  EXPECT_GT(one.at("spp"), 8) << "a dim lamp must not end it at once";
}

// No sample of `naive` finds this lamp within the first look: a black picture is no picture of error 0.
TEST_F(Render, TargetErrorIsNotReachedByBlack) {
  write("speck.toml", R"(
[camera]
eye = [0, 0, 4]
look_at = [0, 0, 0]
up = [0, 1, 0]
fov_y = 40
[material.white]
type = "lambertian"
reflectance = [0.7, 0.7, 0.7]
[material.lamp]
type = "light"
radiance = [5, 5, 5]
[[sphere]]
center = [0, -1, 0]
radius = 1
material = "white"
[[sphere]]
center = [0, 40, 0]
radius = 1
material = "lamp"
)");
  const Arguments options{"render",   "speck.toml", "-o",     "speck.pfm", "--size",  "8x8",
                          "--method", "naive",      "--seed", "1",         "--stats", "speck.json"};
  Arguments look = options, target = options;
  look.insert(look.end(), {"--spp", "8"});
  target.insert(target.end(), {"--target-error", "0.5"});
  ASSERT_EQ(glimt(look).status, 0);
  const json black = json::parse(read("speck.json"));
  ASSERT_EQ(black.at("mean"), 0);
  EXPECT_TRUE(black.at("relmse_scaled").is_null());
  ASSERT_EQ(glimt(target).status, 0);
  const json found = json::parse(read("speck.json"));
  EXPECT_GT(found.at("mean"), 0);
  EXPECT_LE(found.at("relmse_scaled"), 0.5);
}

TEST_F(Render, WithoutLightTheTargetIsReachedAtOnce) {
  EXPECT_EQ(stats({"--target-error", "0.05", "--set", "material.lamp.radiance=[0,0,0]"}).at("spp"), 8);
}

TEST_F(Render, PipedOutputHoldsNoProgress) {
  const Result result = render("a.png", {"--seconds", "0.3"});
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1);
  EXPECT_FALSE(has(result.out, "\r") || has(result.out, "\x1b") || has(result.out, "ETA")) << result.out;
}

TEST_F(Render, DashIsStandardOutput) {
  ASSERT_EQ(render("a.png", {"--spp", "2"}).status, 0);
  const Result result = render("-", {"--spp", "2"});
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(has(result.err, "2 spp")) << "the summary is beside the picture: " << result.err;
  write("b.png", result.out);
  EXPECT_EQ(png_pixels(folder / "a.png"), png_pixels(folder / "b.png"));
  EXPECT_EQ(files(), 2u);
  const Result shown = program::run_on_terminal({"render", scene, "-o", "-", "--size", "24x16"}, folder);
  EXPECT_EQ(shown.status, 2);
  EXPECT_TRUE(has(shown.out, "terminal")) << shown.out;
}

TEST_F(Render, QuietSaysNothing) {
  const Result result = render("a.png", {"--spp", "2", "--quiet"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out + result.err, "");
  const Result shown = program::run_on_terminal({"render", scene, "-o", "a.png", "--size", "24x16", "--quiet"}, folder);
  EXPECT_EQ(shown.status, 0);
  EXPECT_EQ(shown.out, "");
}

TEST_F(Render, TerminalShowsProgressInOneLine) {
  const Result result =
      program::run_on_terminal({"render", scene, "-o", "a.png", "--size", "24x16", "--seconds", "0.5"}, folder);
  EXPECT_EQ(result.status, 0);
  for (const char* part : {" %", " spp", "Mpaths/s", "error ", "ETA 0:00", "100 %", "a.png: "})
    EXPECT_TRUE(has(result.out, part)) << part << " is not in " << result.out;
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1) << result.out;
  std::size_t lines = 0;
  for (std::size_t at = 0; (at = result.out.find("100 %", at)) != std::string::npos; ++at) ++lines;
  EXPECT_EQ(lines, 1u) << "100 % only at the end: " << result.out;
}

TEST_F(Render, InterruptKeepsTheImageSoFar) {
  const Result result = program::run_on_terminal(
      {"render", scene, "-o", "a.exr", "--size", "24x16", "--seconds", "300", "--stats", "s.json"}, folder, "ETA");
  EXPECT_EQ(result.status, 130) << result.out;
  EXPECT_TRUE(has(result.out, "interrupted: a.exr holds")) << result.out;
  EXPECT_FALSE(has(result.out, "100 %")) << result.out;
  EXPECT_EQ(read_image(folder / "a.exr").width, 24);
  EXPECT_EQ(std::stoi(read_metadata(folder / "a.exr").at("samples")), json::parse(read("s.json")).at("spp"));
}

// Half of the pixels' memory is not needed yet with one sample. The small picture takes what has nothing to do with
// size.
TEST_F(Render, TakesNoMoreMemoryThanItSays) {
  for (const std::string out : {"a.png", "a.exr", "a.pfm"}) {
    const auto peak = [&](const std::string& size) {
      const program::Result result = glimt({"render", scene, "-o", out, "--size", size, "--spp", "2"});
      EXPECT_EQ(result.status, 0) << result.err;
      return 1024.0 * static_cast<double>(result.peak_kilobytes);
    };
    const double said =
        static_cast<double>(Film::pixel_bytes) * 700 * 700 + static_cast<double>(bytes_to_write(out, 700, 700));
    const double taken = peak("700x700") - peak("10x10");
    EXPECT_LT(taken, 1.1 * said) << out;
    EXPECT_GT(taken, 0.7 * said) << out << ": it asks for too much";
  }
}

/// Renders with a limit on the bytes of the address space, of which the program's code and threads have some.
class LimitedRender : public Render {
 protected:
  Result render_within(rlim_t bytes, const Arguments& options) const {
    rlimit before{};
    EXPECT_EQ(getrlimit(RLIMIT_AS, &before), 0);
    rlimit limit = before;
    limit.rlim_cur = bytes;
    EXPECT_EQ(setrlimit(RLIMIT_AS, &limit), 0);
    Arguments arguments{"render", scene, "-o", "a.exr", "--spp", "2"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Result result = glimt(arguments);
    setrlimit(RLIMIT_AS, &before);
    return result;
  }
};

TEST_F(LimitedRender, AnImageBeyondMemoryIsRefusedAtOnce) {
  const Result result = render_within(1'500'000'000, {"--size", "8192x8192", "--threads", "1"});
  EXPECT_EQ(result.status, 2);
  EXPECT_TRUE(has(result.err, "an image of 8192x8192 takes 9.66 GB of memory, and ")) << result.err;
  EXPECT_TRUE(has(result.err, " GB are free\n")) << result.err;
  EXPECT_EQ(files(), 0U);
}

// A thread has a stack of 2 MB or more.
TEST_F(LimitedRender, ThreadsThatCannotBeStartedAreRefusedAtOnce) {
  const Result result = render_within(1'500'000'000, {"--size", "24x16", "--threads", "1024"});
  EXPECT_EQ(result.status, 2);
  EXPECT_TRUE(has(result.err, "of 1024 threads only ")) << result.err;
  EXPECT_TRUE(has(result.err, " can be started here: give --threads a smaller number\n")) << result.err;
  EXPECT_EQ(files(), 0U);
}

}  // namespace
