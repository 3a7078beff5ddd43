#include "viewer/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace glimt {
namespace {

[[noreturn]] void fail() {
  const char* reason = nullptr;
  glfwGetError(&reason);
  throw std::runtime_error(std::string("cannot open a window: ") + (reason != nullptr ? reason : "unknown reason") +
                           " (\"glimt render\" needs no window)");
}

}  // namespace

WindowSystem::WindowSystem() {
  if (glfwInit() == GLFW_FALSE) fail();
}

WindowSystem::~WindowSystem() { glfwTerminate(); }

Window::Window(int width_wanted, int height_wanted) {
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  glfwWindowHintString(GLFW_X11_CLASS_NAME, "glimt");
  glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "glimt");
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  handle_ = glfwCreateWindow(width_wanted, height_wanted, "glimt", nullptr, nullptr);
  if (handle_ == nullptr) fail();
  if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) {
    int x = 0, y = 0, free_width = 0, free_height = 0, width = 0, height = 0;
    glfwGetMonitorWorkarea(monitor, &x, &y, &free_width, &free_height);
    glfwGetWindowSize(handle_, &width, &height);
    if (free_width > 0 && free_height > 0) {
      glfwSetWindowSize(handle_, std::min(width, free_width), std::min(height, free_height));
    }
  }
  // A smaller window would cut off the column's numbers or leave no room for the picture.
  const auto least = [this](float length) { return static_cast<int>(std::lround(length * scale())); };
  glfwSetWindowSizeLimits(handle_, least(704), least(560), GLFW_DONT_CARE, GLFW_DONT_CARE);
  glfwShowWindow(handle_);
  glfwMakeContextCurrent(handle_);
  glfwSwapInterval(1);
}

Window::~Window() { glfwDestroyWindow(handle_); }

bool Window::hidden() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(handle_, &width, &height);
  // Some window managers hide a minimised window without saying that it is minimised.
  return width == 0 || height == 0 || glfwGetWindowAttrib(handle_, GLFW_ICONIFIED) == GLFW_TRUE ||
         glfwGetWindowAttrib(handle_, GLFW_VISIBLE) == GLFW_FALSE;
}

void Window::size(int& width, int& height) const {
  glfwGetWindowSize(handle_, &width, &height);
  width = static_cast<int>(std::lround(static_cast<float>(width) / scale()));
  height = static_cast<int>(std::lround(static_cast<float>(height) / scale()));
}

float Window::scale() const {
  float x = 1, y = 1;
  glfwGetWindowContentScale(handle_, &x, &y);
  int width = 0, pixels = 0, ignored = 0;
  glfwGetWindowSize(handle_, &width, &ignored);
  glfwGetFramebufferSize(handle_, &pixels, &ignored);
  const float ratio = width > 0 ? static_cast<float>(pixels) / static_cast<float>(width) : 1;
  return std::clamp(x / ratio, 0.5F, 8.0F);
}

double Window::frame_time() const {
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
  // A little less than the display's period, so that this wait and the buffer swap's do not add up.
  return 0.9 / (mode != nullptr && mode->refreshRate > 0 ? mode->refreshRate : 60);
}

}  // namespace glimt
