#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "film/image_file.h"
#include "scene/scene_file.h"

/// The program with its real window, on an X server without a screen, driven from outside by mouse and keys.
namespace glimt {
namespace {

namespace fs = std::filesystem;

bool wait_for(const std::function<bool()>& condition) {
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (std::chrono::steady_clock::now() < give_up) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

bool have(const std::string& command) {
  return std::system(("command -v " + command + " >/dev/null 2>&1").c_str()) == 0;
}

std::string content(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// A program that is running; killed where it has not ended by itself.
class Process {
 public:
  /// Standard error goes to the file.
  Process(const std::vector<std::string>& command, const fs::path& errors, int kept_open = -1) {
    id_ = fork();
    if (id_ != 0) return;
    dup2(open(errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
    if (kept_open >= 0) fcntl(kept_open, F_SETFD, 0);
    std::vector<char*> arguments;
    for (const auto& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  ~Process() {
    if (id_ <= 0) return;
    kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Exit code, or -1 where it does not end in time.
  int wait() {
    int status = 0;
    if (!wait_for([&] { return waitpid(id_, &status, WNOHANG) == id_; })) return -1;
    id_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -2;
  }

 private:
  pid_t id_ = 0;
};

class WindowTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!have("Xvfb") || !have("xdotool")) GTEST_SKIP() << "needs Xvfb and xdotool (packages xvfb and xdotool)";
    std::string pattern = (fs::temp_directory_path() / "glimt_window_XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    fs::current_path(folder_);
    setenv("GLIMT_WIDGET_LOG", "widgets", 1);
    setenv("GLIMT_FRAME_LOG", "frames", 1);
    unsetenv("WAYLAND_DISPLAY");

    // The server names the display that it found free.
    int ends[2];
    ASSERT_EQ(pipe2(ends, O_CLOEXEC), 0);
    server_ = std::make_unique<Process>(
        std::vector<std::string>{"Xvfb", "-displayfd", std::to_string(ends[1]), "-screen", "0", "1280x900x24"},
        "server.log", ends[1]);
    close(ends[1]);
    std::string number;
    for (char c = 0; read(ends[0], &c, 1) == 1 && c != '\n';) number += c;
    close(ends[0]);
    ASSERT_NE(number, "") << content("server.log");
    setenv("DISPLAY", (":" + number).c_str(), 1);
  }

  void TearDown() override {
    program_.reset();
    server_.reset();
    fs::current_path("/");
    if (!folder_.empty()) fs::remove_all(folder_);
  }

  /// Starts the program and waits for the first picture.
  void open_window(const std::string& scene) {
    program_ = std::make_unique<Process>(std::vector<std::string>{GLIMT_PROGRAM, scene}, "program.log");
    ASSERT_TRUE(wait_for([&] { return !content("frames").empty() && widgets().contains("snapshot"); }))
        << content("program.log");
  }

  /// Name and rectangle of every control.
  static std::map<std::string, std::array<double, 4>> widgets() {
    std::map<std::string, std::array<double, 4>> all;
    std::istringstream lines(content("widgets"));
    for (std::string line; std::getline(lines, line);) {
      const auto tab = line.find('\t');
      std::array<double, 4> r{};
      std::istringstream(line.substr(tab)) >> r[0] >> r[1] >> r[2] >> r[3];
      all[line.substr(0, tab)] = r;
    }
    return all;
  }

  static void xdotool(const std::string& arguments) {
    ASSERT_EQ(std::system(("xdotool " + arguments).c_str()), 0) << arguments;
  }

  /// Waits for the control and puts the mouse at a share of its width. No window manager has moved the window from 0,
  /// 0.
  static void point_at(const std::string& name, double share = 0.5) {
    ASSERT_TRUE(wait_for([&] { return widgets().contains(name); })) << name << " in\n" << content("widgets");
    const auto [x, y, width, height] = widgets()[name];
    xdotool("mousemove " + std::to_string(std::lround(x + share * width)) + " " +
            std::to_string(std::lround(y + height / 2)));
  }

  static void click(const std::string& name, double share = 0.5) {
    point_at(name, share);
    xdotool("click 1");
  }

  static std::string report_scene() { return std::string(GLIMT_SCENES) + "/report.toml"; }

  fs::path folder_;
  std::unique_ptr<Process> server_, program_;
};

const Material& material_of(const Scene& scene, const std::string& sphere) {
  for (const auto& s : scene.spheres) {
    if (s.name == sphere) return *find_material(scene, s.material);
  }
  throw std::runtime_error("no sphere called " + sphere);
}

TEST_F(WindowTest, EditsSceneTakesSnapshotAndQuits) {
  open_window(report_scene());

  click("sphere.lambertian.material");
  click("sphere.lambertian.material.glass");
  ASSERT_TRUE(wait_for([] { return widgets().contains("sphere.lambertian.material.ior"); })) << content("widgets");

  point_at("sphere.oren-nayar.material.roughness", 0.5);
  xdotool("mousedown 1");
  point_at("sphere.oren-nayar.material.roughness", 0.25);
  xdotool("mouseup 1");

  // Taken until the edits are in it: a snapshot shows what is on the screen, which is a moment behind.
  Scene made;
  int number = 0;
  ASSERT_TRUE(wait_for([&] {
    xdotool("key s");
    char file[32];
    std::snprintf(file, sizeof file, "report-%03d.png", ++number);
    if (!wait_for([&] { return fs::exists(file) && fs::file_size(file) > 0; })) return false;
    made = parse_scene(read_metadata(file).at("scene"), file);
    return material_of(made, "oren-nayar").roughness < 0.5;
  })) << content("program.log");
  const Scene before = read_scene(report_scene());
  EXPECT_EQ(material_of(made, "lambertian").type, MaterialType::glass);
  EXPECT_NEAR(material_of(made, "oren-nayar").roughness, 0.39, 0.03);  // a quarter of pi/2
  EXPECT_EQ(material_of(made, "glass"), material_of(before, "glass"));
  EXPECT_EQ(made.polygons, before.polygons);
  EXPECT_EQ(made.camera, before.camera);

  xdotool("key Escape");
  EXPECT_EQ(program_->wait(), 0);
  EXPECT_EQ(content("program.log"), "");
}

TEST_F(WindowTest, FollowsItsSize) {
  open_window(report_scene());
  const double before = widgets()["snapshot"][0];
  xdotool("search --onlyvisible --name glimt windowsize 800 600");
  EXPECT_TRUE(wait_for([&] {
    const auto all = widgets();
    const auto& r = all.at("snapshot");
    return r[0] < before && r[0] + r[2] < 800;
  })) << content("widgets");
  xdotool("key ctrl+q");
  EXPECT_EQ(program_->wait(), 0);
}

TEST_F(WindowTest, SpacePausesAndResumes) {
  open_window(report_scene());
  const auto pictures = [] {
    const std::string text = content("frames");
    return std::count(text.begin(), text.end(), '\n');
  };
  click("render.spp", 1);  // so many samples that it does not finish
  point_at("image");
  xdotool("key space");
  // The frames stop once it is paused; the mouse stays still.
  ASSERT_TRUE(wait_for([&] {
    const auto before = pictures();
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    return pictures() == before;
  }));
  const auto before = pictures();
  xdotool("key space");
  EXPECT_TRUE(wait_for([&] { return pictures() > before + 10; }));
  xdotool("key Escape");
  EXPECT_EQ(program_->wait(), 0);
}

TEST_F(WindowTest, DisplayThatDoesNotAnswerIsNamed) {
  server_.reset();
  Process program({GLIMT_PROGRAM, report_scene()}, "program.log");
  EXPECT_EQ(program.wait(), 1);
  const std::string said = content("program.log");
  EXPECT_NE(said.find("cannot open a window"), std::string::npos) << said;
  EXPECT_NE(said.find(std::getenv("DISPLAY")), std::string::npos) << said;
}

TEST_F(WindowTest, SceneThatCannotBeReadIsNamed) {
  std::ofstream("bad.toml") << "name = 1\n";
  Process program({GLIMT_PROGRAM, "bad.toml"}, "program.log");
  EXPECT_EQ(program.wait(), 2);
  const std::string said = content("program.log");
  EXPECT_TRUE(said.starts_with("bad.toml:1:")) << said;
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << "one line";
}

}  // namespace
}  // namespace glimt
