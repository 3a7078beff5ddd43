#include "viewer/viewer.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

#include <algorithm>
#include <iostream>
#include <string>
#include <utility>

#include "import/import.h"
#include "scene/file/scene_file.h"
#include "viewer/keys.h"
#include "viewer/screen.h"
#include "viewer/state/controller.h"
#include "viewer/state/logs.h"
#include "viewer/state/window_settings.h"
#include "viewer/window.h"

namespace glimt {
namespace {

/// After the last event, ImGui needs some pictures until menus and tooltips have their place.
constexpr int pictures_to_settle = 6;
/// How long the window waits for the image that answers an edit, seconds. The image mostly comes sooner, and both are
/// painted at once.
constexpr double patience = 0.006;

/// What has come in from the window since the last picture.
struct Inbox {
  Screen* screen = nullptr;
  const ViewerState* state = nullptr;
  Edits edits;
  bool touched = true;
};

Inbox& inbox(GLFWwindow* window) { return *static_cast<Inbox*>(glfwGetWindowUserPointer(window)); }

KeyContext context_of(GLFWwindow* window) {
  const ImGuiIO& io = ImGui::GetIO();
  return {.typing = io.WantTextInput,
          .popup = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel),
          // From the press of the right button on, before the screen has seen it.
          .flying = inbox(window).screen->flying() || glfwGetMouseButton(window, GLFW_MOUSE_BUTTON_RIGHT) == GLFW_PRESS,
          .navigating = io.NavVisible};
}

char key_of(int key, int scancode) {
  switch (key) {
    case GLFW_KEY_ESCAPE:
      return key_escape;
    case GLFW_KEY_SPACE:
      return key_space;
    case GLFW_KEY_HOME:
      return key_home;
    case GLFW_KEY_F1:
      return key_f1;
    default:  // GLFW's numbers of other keys are the ASCII signs that a US layout has there
      return key_letter(glfwGetKeyName(key, scancode), key);
  }
}

void on_key(GLFWwindow* window, int key, int scancode, int action, int modifiers) {
  Inbox& in = inbox(window);
  in.touched = true;
  if (action != GLFW_PRESS) return;
  const KeyPress press{.key = key_of(key, scancode),
                       .control = (modifiers & GLFW_MOD_CONTROL) != 0,
                       .shift = (modifiers & GLFW_MOD_SHIFT) != 0};
  press_key(press, context_of(window), *in.state, in.edits);
}

void on_character(GLFWwindow* window, unsigned character) {
  Inbox& in = inbox(window);
  in.touched = true;
  type_sign(character, context_of(window), *in.state, in.edits);
}

void on_drop(GLFWwindow* window, int count, const char** paths) {
  inbox(window).touched = true;
  if (count > 0) inbox(window).screen->drop(paths[0], inbox(window).edits);
}

void set_callbacks(GLFWwindow* window, Inbox& in) {
  glfwSetWindowUserPointer(window, &in);
  glfwSetKeyCallback(window, on_key);
  glfwSetDropCallback(window, on_drop);
  glfwSetCharCallback(window, on_character);
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double, double) { inbox(w).touched = true; });
  glfwSetCursorEnterCallback(window, [](GLFWwindow* w, int) { inbox(w).touched = true; });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int, int, int) { inbox(w).touched = true; });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double, double) { inbox(w).touched = true; });
  glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int) { inbox(w).touched = true; });
  glfwSetWindowIconifyCallback(window, [](GLFWwindow* w, int) { inbox(w).touched = true; });
  glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) {
    inbox(w).touched = true;
    inbox(w).screen->forget_picture();
  });
  glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { inbox(w).touched = true; });
  glfwSetWindowContentScaleCallback(window, [](GLFWwindow* w, float, float) { inbox(w).touched = true; });
  glfwSetWindowCloseCallback(window, [](GLFWwindow* w) { inbox(w).edits.quit = true; });
}

/// ImGui's GLFW backend. It passes events on to the callbacks that were set before.
struct Platform {
  explicit Platform(GLFWwindow* window) {
    ImGui_ImplGlfw_InitForOpenGL(window, true);
    ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  }
  ~Platform() { ImGui_ImplGlfw_Shutdown(); }
  Platform(const Platform&) = delete;
  Platform& operator=(const Platform&) = delete;
};

/// Sleeps until there is something to draw and the display can show it. With `fitting` it returns soon, even without an
/// event.
void wait(double next_picture, bool settled, bool fitting) {
  constexpr double while_fitting = 0.02;  // seconds
  if (settled && fitting)
    glfwWaitEventsTimeout(while_fitting);
  else if (settled)
    glfwWaitEvents();
  for (double left; (left = next_picture - glfwGetTime()) > 0;) glfwWaitEventsTimeout(left);
  glfwPollEvents();
}

/// Whether the picture shows the scene as edited.
bool answered(const ViewerState& state) { return state.frame && state.frame->version >= state.version; }

/// Saves what the window remembers for its next start. If it cannot be written, the program goes on.
void remember(const Window& window, const ViewerState& state) {
  const auto file = window_settings_file();
  if (file.empty()) return;
  WindowSettings settings{.display = state.display,
                          .folder = state.folder,
                          .hint_seen = !state.hint,
                          .chart = state.chart.view,
                          .drag_view = state.drag_view,
                          .fits_window = state.fits_window};
  window.size(settings.width, settings.height);
  try {
    write_window_settings(file, settings);
  } catch (const std::exception& error) {
    std::cerr << "glimt: " << error.what() << '\n';
  }
}

void run(const std::filesystem::path& scene_file) {
  const bool checkpoint = scene_file.extension() == ".ckpt";
  ImportedScene opened;
  if (checkpoint)
    opened.scene = read_checkpoint(scene_file).scene;
  else
    opened = read_or_import(scene_file);
  std::string note;
  const WindowSettings settings = read_window_settings(window_settings_file(), note);
  const WindowSystem system;
  std::optional<ImageSize> room;
  if (settings.fits_window) room = room_in_window(settings.width, settings.height);
  Controller controller(
      std::move(opened.scene), scene_file, [] { glfwPostEmptyEvent(); }, {}, {}, room);
  controller.recall(settings.display, settings.chart, settings.folder, !settings.hint_seen, note, settings.drag_view);
  if (const auto folder = autosave_folder(); !folder.empty()) controller.autosave(folder);
  const Window window(settings.width, settings.height);
  Inbox in;
  if (checkpoint) in.edits.open = scene_file;
  set_callbacks(window.handle(), in);
  Screen screen;
  in.screen = &screen;
  in.state = &controller.state();
  const Platform platform(window.handle());
  Logs logs;

  double next_picture = 0, painted_at = 0, patient_until = 0;
  int unsettled = pictures_to_settle;
  while (!in.edits.quit) {
    wait(next_picture, unsettled == 0, controller.fitting());
    const std::string said = controller.state().message.text;
    if (controller.poll())
      unsettled = std::max(unsettled, controller.state().message.text == said ? 1 : pictures_to_settle);
    if (std::exchange(in.touched, false)) unsettled = pictures_to_settle;
    if (window.hidden()) unsettled = 0;
    if (unsettled == 0) continue;

    if (!screen.flying()) --unsettled;
    const double start = glfwGetTime();
    ImGui_ImplGlfw_NewFrame();
    screen.lay_out(controller.state(), window.scale(), in.edits);
    // Edits are applied before painting, so that rendering their answer goes on meanwhile.
    const bool quit = in.edits.quit;
    const std::uint64_t version = controller.state().version;
    controller.apply(std::exchange(in.edits, {}));
    in.edits.quit = quit;
    if (controller.state().version != version && patient_until <= painted_at) patient_until = start + patience;
    const bool waits = start < patient_until && !answered(controller.state());
    if (waits) unsettled = std::max(unsettled, 1);
    const bool painted = !waits && screen.paint();
    // Where nothing on the screen changed, the next edits are taken in sooner than the display can show pictures.
    next_picture = start + window.frame_time() * (painted ? 1 : 0.125);
    if (painted) {
      painted_at = start;
      glfwSwapBuffers(window.handle());
      logs.picture(controller.state());
    }
    logs.laid_out(screen.widgets());
  }
  remember(window, controller.state());
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
