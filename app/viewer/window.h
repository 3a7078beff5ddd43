#pragma once

struct GLFWwindow;

namespace glimt {

/// The window system. Throws std::runtime_error where there is none.
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
  /// Of this size, in units of design, or as large as the screen allows. Throws std::runtime_error where none can be
  /// opened.
  Window(int width, int height);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  GLFWwindow* handle() const { return handle_; }
  /// Nothing can be seen, for example when minimised.
  bool hidden() const;
  /// In units of design.
  void size(int& width, int& height) const;
  /// Window coordinates per unit of design: what the screen asks for, less what the framebuffer does already.
  float scale() const;
  /// Least time between two pictures, seconds: the display shows no more.
  double frame_time() const;

 private:
  GLFWwindow* handle_ = nullptr;
};

}  // namespace glimt
