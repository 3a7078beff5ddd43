#include "viewer/viewer.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

#include <algorithm>
#include <iostream>
#include <string_view>
#include <utility>

#include "scene/scene_file.h"
#include "viewer/controller.h"
#include "viewer/logs.h"
#include "viewer/screen.h"
#include "viewer/window.h"

namespace glimt {
namespace {

/// ImGui needs some pictures after the last event until menus and tooltips stand.
constexpr int pictures_to_settle = 3;

/// What has come in from the window since the last picture.
struct Inbox {
  Edits edits;
  bool touched = true;
};

Inbox& inbox(GLFWwindow* window) { return *static_cast<Inbox*>(glfwGetWindowUserPointer(window)); }

bool is_letter(int key, int scancode, std::string_view letter) {
  const char* name = glfwGetKeyName(key, scancode);  // of this keyboard's layout
  return name != nullptr && name == letter;
}

void on_key(GLFWwindow* window, int key, int scancode, int action, int modifiers) {
  Inbox& in = inbox(window);
  in.touched = true;
  if (action != GLFW_PRESS) return;
  const bool control = (modifiers & GLFW_MOD_CONTROL) != 0;
  if (control && is_letter(key, scancode, "q")) in.edits.quit = true;

  const ImGuiIO& io = ImGui::GetIO();
  const bool popup = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
  if (io.WantTextInput || io.NavVisible || popup || control) return;
  if (key == GLFW_KEY_ESCAPE) in.edits.quit = true;
  if (key == GLFW_KEY_SPACE) in.edits.toggle_pause = true;
  if (is_letter(key, scancode, "r")) in.edits.restart = true;
  if (is_letter(key, scancode, "s")) in.edits.snapshot = true;
}

void on_drop(GLFWwindow* window, int count, const char** paths) {
  inbox(window).touched = true;
  if (count > 0) inbox(window).edits.open = paths[0];
}

void set_callbacks(GLFWwindow* window, Inbox& in) {
  glfwSetWindowUserPointer(window, &in);
  glfwSetKeyCallback(window, on_key);
  glfwSetDropCallback(window, on_drop);
  glfwSetCharCallback(window, [](GLFWwindow* w, unsigned) { inbox(w).touched = true; });
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double, double) { inbox(w).touched = true; });
  glfwSetCursorEnterCallback(window, [](GLFWwindow* w, int) { inbox(w).touched = true; });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int, int, int) { inbox(w).touched = true; });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double, double) { inbox(w).touched = true; });
  glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int) { inbox(w).touched = true; });
  glfwSetWindowIconifyCallback(window, [](GLFWwindow* w, int) { inbox(w).touched = true; });
  glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { inbox(w).touched = true; });
  glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { inbox(w).touched = true; });
  glfwSetWindowContentScaleCallback(window, [](GLFWwindow* w, float, float) { inbox(w).touched = true; });
  glfwSetWindowCloseCallback(window, [](GLFWwindow* w) { inbox(w).edits.quit = true; });
}

/// ImGui's platform side, which passes events on to the callbacks that were there before.
struct Platform {
  explicit Platform(GLFWwindow* window) {
    ImGui_ImplGlfw_InitForOpenGL(window, true);
    ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  }
  ~Platform() { ImGui_ImplGlfw_Shutdown(); }
  Platform(const Platform&) = delete;
  Platform& operator=(const Platform&) = delete;
};

/// Sleeps until there is something to draw and the display can show it.
void wait(double next_picture, bool settled) {
  if (settled) glfwWaitEvents();
  for (double left; (left = next_picture - glfwGetTime()) > 0;) glfwWaitEventsTimeout(left);
  glfwPollEvents();
}

void run(const std::filesystem::path& scene_file) {
  Scene scene = read_scene(scene_file);
  const WindowSystem system;
  Controller controller(std::move(scene), scene_file.stem().string(), [] { glfwPostEmptyEvent(); });
  const Window window;
  Inbox in;
  set_callbacks(window.handle(), in);
  Screen screen;
  const Platform platform(window.handle());
  Logs logs;

  double next_picture = 0;
  int unsettled = pictures_to_settle;
  while (!in.edits.quit) {
    wait(next_picture, unsettled == 0);
    if (controller.poll()) unsettled = std::max(unsettled, 1);
    if (std::exchange(in.touched, false)) unsettled = pictures_to_settle;
    if (window.hidden()) unsettled = 0;
    if (unsettled == 0) continue;

    --unsettled;
    next_picture = glfwGetTime() + window.frame_time();
    ImGui_ImplGlfw_NewFrame();
    screen.draw(controller.state(), window.scale(), in.edits);
    glfwSwapBuffers(window.handle());
    logs.shown(controller.state(), screen.widgets());
    const bool quit = in.edits.quit;
    controller.apply(std::exchange(in.edits, {}));
    in.edits.quit = quit;
  }
}

}  // namespace

int run_viewer(const std::filesystem::path& scene_file) {
  try {
    run(scene_file);
    return 0;
  } catch (const SceneError& error) {
    std::cerr << error.what() << '\n';
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "glimt: " << error.what() << '\n';
    return 1;
  }
}

}  // namespace glimt
