#pragma once

struct GLFWwindow;

namespace glimt {

/// Starts and ends the window system. Throws std::runtime_error where there is none.
class WindowSystem {
 public:
  WindowSystem();
  ~WindowSystem();
  WindowSystem(const WindowSystem&) = delete;
  WindowSystem& operator=(const WindowSystem&) = delete;
};

/// A window with an OpenGL context, which it makes current.
class Window {
 public:
  /// Opens a window of this size in design units, or as large as the screen allows. Throws std::runtime_error where it
  /// cannot be opened.
  Window(int width, int height);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  GLFWwindow* handle() const { return handle_; }
  /// Whether nothing of the window can be seen, for example when it is minimised.
  bool hidden() const;
  /// Its size in design units.
  void size(int& width, int& height) const;
  /// Window coordinates per design unit: the scale that the screen asks for, divided by what the framebuffer has
  /// already.
  float scale() const;
  /// Least time between two pictures, seconds; the display shows no more.
  double frame_time() const;

 private:
  GLFWwindow* handle_ = nullptr;
};

}  // namespace glimt
