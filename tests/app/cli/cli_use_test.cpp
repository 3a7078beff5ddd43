#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/cli/cli_test.h"
#include "film/image_file.h"
#include "scene/fields.h"

using namespace glimt;

namespace {

class Use : public CommandLine {
 protected:
  /// Status 2, a message on stderr alone with all the parts, and no file written.
  void expect_refused(const Arguments& arguments, const Arguments& parts = {}) const {
    const std::size_t before = files();
    const Result result = glimt(arguments);
    std::string line;
    for (const auto& argument : arguments) line += argument + " ";
    EXPECT_EQ(result.status, 2) << line << result.err;
    EXPECT_EQ(result.out, "") << line;
    EXPECT_NE(result.err, "") << line;
    for (const auto& part : parts) EXPECT_TRUE(has(result.err, part)) << line << "says " << result.err;
    EXPECT_EQ(files(), before) << line;
  }
  void expect_render_refused(const Arguments& options, const Arguments& parts = {}) const {
    Arguments arguments{"render", scene, "-o", "a.png"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    expect_refused(arguments, parts);
  }
};

TEST_F(Use, SaysItsVersion) {
  const Result result = glimt({"--version"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out, "glimt " GLIMT_VERSION "\n");
}

TEST_F(Use, EveryCommandHasHelp) {
  for (const Arguments& arguments :
       {Arguments{"--help"}, Arguments{"render", "--help"}, Arguments{"compare", "--help"},
        Arguments{"chart", "--help"}, Arguments{"report", "--help"}, Arguments{"info", "-h"}}) {
    const Result result = glimt(arguments);
    EXPECT_EQ(result.status, 0);
    EXPECT_TRUE(has(result.out, "Usage: glimt")) << result.out;
    EXPECT_EQ(result.err, "");
  }
  for (const char* command : {"render", "compare", "chart", "report", "info"})
    EXPECT_TRUE(has(glimt({"--help"}).out, command));
}

TEST_F(Use, HelpOfRenderComesFromTheListOfSettings) {
  const std::string help = glimt({"render", "--help"}).out;
  for (const auto& field : settings_fields()) {
    std::string name = "--" + std::string(field.key);
    std::replace(name.begin(), name.end(), '_', '-');
    EXPECT_TRUE(has(help, name)) << name;
    EXPECT_TRUE(has(help, std::string(field.doc.substr(0, 20)))) << field.doc;
  }
  for (const char* option :
       {"--output", "--seconds", "--target-error", "--size", "--threads", "--lanes", "--set", "--stats", "--quiet"})
    EXPECT_TRUE(has(help, option)) << option;
}

TEST_F(Use, RefusesWhatItDoesNotKnow) {
  expect_refused({"--unknown"});
  expect_refused({"render"});
  expect_refused({"render", scene}, {"--output"});
  expect_refused({"render", "-o", "a.png"}, {"SCENE"});
  expect_refused({"render", scene, "-o", "a.png", "more"}, {"more"});
  expect_refused({"rendr", scene, "-o", "a.png"});
  expect_refused({scene, "render", scene, "-o", "a.png"}, {"after the scene"});
  expect_refused({"compare", "a.exr"}, {"B"});
  expect_refused({"info"}, {"SCENE"});
  expect_render_refused({"--unknown", "1"});
}

TEST_F(Use, RefusesBadValues) {
  for (const char* spp : {"0", "-1", "1.5", "many", "99999999999"}) expect_render_refused({"--spp", spp}, {"--spp"});
  for (const char* seconds : {"0", "-1", "nan", "inf", "soon"})
    expect_render_refused({"--seconds", seconds}, {"--seconds"});
  for (const char* error : {"0", "-1", "nan", "1e-3x"})
    expect_render_refused({"--target-error", error}, {"--target-error"});
  for (const char* size : {"10", "10x", "x10", "0x10", "10x0", "-3x4", "4x4x4", "4 x 4", "99999999999x1", "1000000x1"})
    expect_render_refused({"--size=" + std::string(size)}, {"--size", "WIDTHxHEIGHT"});
  for (const char* threads : {"0", "1025", "two"}) expect_render_refused({"--threads", threads}, {"--threads"});
  expect_render_refused({"--lanes", "3"}, {"--lanes", "1", "native"});
  expect_render_refused({"--shadow-rays", "0"}, {"--shadow-rays"});
  expect_render_refused({"--seed", "x"}, {"--seed"});
  expect_render_refused({"--method", "magic"}, {"--method", "path", "naive"});
  expect_render_refused({"--roulette", "magic"}, {"--roulette", "throughput", "constant"});
}

TEST_F(Use, RefusesMoreThanOneGoal) {
  expect_render_refused({"--spp", "4", "--seconds", "1"}, {"--spp", "--seconds"});
  expect_render_refused({"--spp", "4", "--target-error", "1"}, {"--spp", "--target-error"});
  expect_render_refused({"--seconds", "4", "--target-error", "1"}, {"--seconds", "--target-error"});
}

TEST_F(Use, RefusesBadOverrides) {
  expect_render_refused({"--set", "material.white.roughnes=0.5"}, {"--set material.white.roughnes=0.5"});
  expect_render_refused({"--set", "material.white.reflectance=[2, 0, 0]"}, {"--set material.white.reflectance"});
  expect_render_refused({"--set", "camera.fov_y=wide"}, {"--set camera.fov_y=wide"});
  expect_render_refused({"--set", "nonsense"}, {"nonsense"});
  expect_render_refused({"--set"});
}

TEST_F(Use, RefusesOutputThatCannotBeWrittenBeforeItRenders) {
  // So many samples that the test would never end if rendering began.
  const auto expect_refused_output = [this](const std::string& out, const std::string& part) {
    expect_refused({"render", scene, "-o", out, "--spp", "16000000"}, {part});
  };
  expect_refused_output("a.jpg", "allowed are .png");
  expect_refused_output("a", "allowed are .png");
  expect_refused_output("none/a.png", "does not exist");
  expect_refused_output("", "ending");
  std::filesystem::create_directory(folder / "b.png");
  expect_refused_output("b.png", "is a folder");
  expect_refused({"render", scene, "-o", "a.png", "--spp", "16000000", "--stats", "none/s.json"}, {"does not exist"});
  expect_refused({"render", scene, "-o", "a.png", "--spp", "16000000", "--stats", "b.png"}, {"is a folder"});
  expect_refused({"render", scene, "-o", "a.png", "--spp", "16000000", "--stats", "/dev/stdout"}, {"messages"});
  expect_refused({"render", scene, "-o", "a.png", "--spp", "16000000", "--stats", "/dev/null"}, {"not a regular file"});
}

TEST_F(Use, SceneErrorsAreOneLineWithThePlace) {
  write("bad.toml",
        "name = \"x\"\n[camera]\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\nfov_y = 500\n[image]\nwidth = 4\nheight = 4\n");
  for (const Arguments& arguments :
       {Arguments{"render", "bad.toml", "-o", "a.png"}, Arguments{"info", "bad.toml"}, Arguments{"bad.toml"}}) {
    const Result result = glimt(arguments);
    EXPECT_EQ(result.status, 2);
    EXPECT_TRUE(result.err.starts_with("bad.toml:5:")) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_EQ(files(), 1u);
  }
  expect_refused({"render", "missing.toml", "-o", "a.png"}, {"missing.toml"});
  expect_refused({"info", "missing.toml"}, {"missing.toml"});
}

TEST_F(Use, InfoSaysWhatTheSceneHolds) {
  const Result result = glimt({"info", scene});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err, "");
  for (const char* part : {"Hexagonal room", "400 x 400", "4 spheres", "clay: lambertian", "glass: glass", "lamp",
                           "compiled in", "left out"})
    EXPECT_TRUE(has(result.out, part)) << part << " is not in " << result.out;
}

class Compare : public Use {
 protected:
  Compare() {
    write("a.pfm", std::string("PF\n1 1\n-1\n\0\0\xc0\x3f\0\0\x80\x3f\0\0\x80\x3f", 22));  // 1.5, 1, 1
    write("b.pfm", std::string("PF\n1 1\n-1\n\0\0\x80\x3f\0\0\x80\x3f\0\0\x80\x3f", 22));  // 1, 1, 1
  }
};

TEST_F(Compare, PrintsTheMeasures) {
  const Result result = glimt({"compare", "a.pfm", "b.pfm"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out,
            "mean            1.1666667\nmean_reference  1\nbias            0.16666667\nrmse            0.28867513\n"
            "relmse          0.082508251\nrelmse999       0\nrelmse_scaled   0.080593166\n");
}

TEST_F(Compare, PrintsJson) {
  const Result result = glimt({"compare", "a.pfm", "b.pfm", "--json"});
  EXPECT_EQ(result.status, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_DOUBLE_EQ(json.at("mean"), 3.5 / 3);
  EXPECT_DOUBLE_EQ(json.at("mean_reference"), 1);
  EXPECT_DOUBLE_EQ(json.at("bias"), 0.5 / 3);
  EXPECT_DOUBLE_EQ(json.at("rmse"), std::sqrt(0.25 / 3));
  EXPECT_DOUBLE_EQ(json.at("relmse"), 0.25 / 1.01 / 3);
  EXPECT_EQ(json.at("relmse999"), 0);
  EXPECT_DOUBLE_EQ(json.at("relmse_scaled"), 0.25 / 1.034 / 3);
}

TEST_F(Compare, AnImageDoesNotDifferFromItself) {
  ASSERT_EQ(render("a.exr", {"--spp", "2"}).status, 0);
  ASSERT_EQ(render("b.pfm", {"--spp", "2"}).status, 0);
  const auto json = nlohmann::json::parse(glimt({"compare", "a.exr", "b.pfm", "--json"}).out);
  EXPECT_EQ(json.at("rmse"), 0);
  EXPECT_EQ(json.at("relmse"), 0);
  EXPECT_GT(json.at("mean"), 0);
}

TEST_F(Compare, RefusesWhatCannotBeCompared) {
  write("big.pfm", std::string("PF\n2 1\n-1\n") + std::string(24, '\0'));
  write("nan.pfm", std::string("PF\n1 1\n-1\n") + std::string(12, '\xff'));
  write("short.pfm", "PF\n1 1\n-1\n");
  write("empty.exr", "");
  ASSERT_EQ(render("a.png", {"--spp", "1"}).status, 0);
  expect_refused({"compare", "a.pfm", "big.pfm"}, {"1x1", "2x1", "a.pfm", "big.pfm"});
  expect_refused({"compare", "nan.pfm", "b.pfm"}, {"not finite", "(0, 0)"});
  expect_refused({"compare", "short.pfm", "b.pfm"}, {"short.pfm", "cut short"});
  expect_refused({"compare", "b.pfm", "empty.exr"}, {"empty.exr", "empty"});
  expect_refused({"compare", "a.png", "b.pfm"}, {"a.png", "EXR and PFM"});
  expect_refused({"compare", "none.exr", "b.pfm"}, {"none.exr", "No such file"});
  expect_refused({"compare", ".", "b.pfm"}, {"folder"});
}

TEST_F(Use, WithoutADisplayTheSceneIsRendered) {
  ASSERT_EQ(render("a.png", {"--spp", "2"}).status, 0);
  write("small.toml", read_metadata(folder / "a.png").at("scene"));
  const Result result = glimt({"small.toml"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(has(result.out, "small.toml to small.png")) << result.out;
  EXPECT_EQ(read_metadata(folder / "small.png").at("samples"), "2");
}

TEST_F(Use, WithoutASceneItIsTheReports) {
  const Result result = program::run_on_terminal({}, folder, "ETA");  // stopped early, unless it is done by then
  EXPECT_NE(result.status, 2) << result.out;
  EXPECT_TRUE(has(result.out, "report.toml to report.png")) << result.out;
  EXPECT_TRUE(has(read_metadata(folder / "report.png").at("scene"), "oren-nayar"));
}

}  // namespace
