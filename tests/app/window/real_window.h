#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
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
#include "scene/file/scene_file.h"

/// The program with its real window on an X server without a screen. Tests drive it from outside by mouse and keys.
namespace glimt::testing {

namespace fs = std::filesystem;

inline bool wait_for(const std::function<bool()>& condition) {
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (std::chrono::steady_clock::now() < give_up) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
  }
  return false;
}

inline bool have(const std::string& command) {
  return std::system(("command -v " + command + " >/dev/null 2>&1").c_str()) == 0;
}

inline std::string content(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// A running program. It is killed if it has not ended by itself.
class Process {
 public:
  /// Starts the program; its standard error goes to the file.
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

  /// The exit code, or -1 if the program does not end in time.
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
    setenv("XDG_CONFIG_HOME", (folder_ / "config").c_str(), 1);
    setenv("XDG_STATE_HOME", (folder_ / "state").c_str(), 1);
    // Small pictures, as the scenes of the tests have them, are soon rendered.
    fs::create_directories("config/glimt");
    std::ofstream("config/glimt/window.toml") << "picture_fits_window = false\n";
    unsetenv("WAYLAND_DISPLAY");

    // The server names the display that it found free.
    int ends[2];
    ASSERT_EQ(pipe2(ends, O_CLOEXEC), 0);
    server_ = std::make_unique<Process>(
        std::vector<std::string>{"Xvfb", "-displayfd", std::to_string(ends[1]), "-screen", "0", "1400x950x24"},
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
    manager_.reset();
    server_.reset();
    fs::current_path("/");
    if (!folder_.empty()) fs::remove_all(folder_);
  }

  /// Starts the program and waits for the first picture.
  void open_window(const std::string& scene) {
    for (const char* log : {"frames", "widgets"}) fs::remove(log);
    program_ = std::make_unique<Process>(std::vector<std::string>{GLIMT_PROGRAM, scene}, "program.log");
    ASSERT_TRUE(wait_for([&] { return !content("frames").empty() && widgets().contains("snapshot"); }))
        << content("program.log");
  }

  void close_window() {
    xdotool("key ctrl+q");
    EXPECT_EQ(program_->wait(), 0);
    EXPECT_EQ(content("program.log"), "");
  }

  /// Name and rectangle of every control.
  static std::map<std::string, std::array<double, 4>> widgets() {
    std::map<std::string, std::array<double, 4>> all;
    std::istringstream lines(content("widgets"));
    for (std::string line; std::getline(lines, line);) {
      const auto tab = line.rfind('\t');
      std::array<double, 4> r{};
      std::istringstream(line.substr(tab)) >> r[0] >> r[1] >> r[2] >> r[3];
      all[line.substr(0, tab)] = r;
    }
    return all;
  }

  static bool is_there(const std::string& widget) {
    return wait_for([&] { return widgets().contains(widget); });
  }
  static bool is_gone(const std::string& widget) {
    return wait_for([&] { return !widgets().contains(widget); });
  }
  /// Whether the status line comes to hold the text.
  static bool says(const std::string& text) {
    return wait_for([&] {
      for (const auto& [name, ignored] : widgets())
        if (name.starts_with("says.") && name.find(text) != std::string::npos) return true;
      return false;
    });
  }

  static void xdotool(const std::string& arguments) {
    ASSERT_EQ(std::system(("xdotool " + arguments).c_str()), 0) << arguments;
  }

  static std::string in_window() { return "$(xdotool search --onlyvisible --class '^glimt$' | head -1)"; }

  static void move_to(double x, double y) {
    xdotool("mousemove --window " + in_window() + " " + std::to_string(std::lround(x)) + " " +
            std::to_string(std::lround(y)));
  }

  /// Waits for the control and puts the mouse at a share of its width and height.
  static void point_at(const std::string& name, double share = 0.5, double share_down = 0.5) {
    ASSERT_TRUE(is_there(name)) << name << " in\n" << content("widgets");
    const auto [x, y, width, height] = widgets()[name];
    move_to(x + share * width, y + share_down * height);
  }

  static void click(const std::string& name, double share = 0.5) {
    point_at(name, share);
    xdotool("sleep 0.05 click 1 sleep 0.05");
  }

  /// Drags as slowly as a hand, because ImGui takes in only one change of a button in each picture.
  static void drag(const std::string& name, double from, double to) {
    point_at(name, from);
    xdotool("mousedown 1 sleep 0.08");
    point_at(name, (from + to) / 2);
    point_at(name, to);
    xdotool("sleep 0.08 mouseup 1 sleep 0.08");
  }

  static void choose(const std::string& menu, const std::string& item) {
    click(menu);
    click(menu + "." + item);
    EXPECT_TRUE(is_gone(menu + "." + item)) << menu << " stays open";
  }

  /// Without this the window renders without end.
  static void stop_at_the_files_samples() { choose("stop_at", "samples"); }

  /// Takes a snapshot, whose name begins with `stem`, and returns the scene in it.
  Scene snapshot(const std::string& stem) {
    xdotool("key s");
    const std::string number = std::to_string(++snapshots_);
    last_snapshot_ = stem + "-" + std::string(3 - std::min<std::size_t>(number.size(), 3), '0') + number + ".png";
    EXPECT_TRUE(wait_for([&] { return fs::exists(last_snapshot_) && fs::file_size(last_snapshot_) > 0; }))
        << last_snapshot_;
    return parse_scene(read_metadata(last_snapshot_).at("scene"), last_snapshot_);
  }

  static bool finished() {
    const std::string text = content("frames");
    return text.ends_with(" 1\n");
  }

  /// Whether a picture other than the coarse preview was shown.
  static bool has_samples() {
    std::istringstream text(content("frames"));
    for (std::string time, samples, end; text >> time >> samples >> end;)
      if (samples != "0") return true;
    return false;
  }

  static std::string report_scene() { return std::string(GLIMT_SCENES) + "/report.toml"; }

  fs::path folder_;
  std::unique_ptr<Process> server_, manager_, program_;
  int snapshots_ = 0;
  std::string last_snapshot_;
};

}  // namespace glimt::testing
