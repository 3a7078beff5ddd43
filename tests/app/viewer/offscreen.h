#pragma once

#include <GL/gl.h>
#include <GL/osmesa.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include <array>
#include <cfloat>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "film/file_bytes.h"
#include "film/image_formats.h"
#include "scene/file/scene_file.h"
#include "viewer/keys.h"
#include "viewer/screen.h"
#include "viewer/state/controller.h"

/// The window's contents drawn into memory, with a mouse that a test moves.
namespace glimt::testing {

/// The report's room at a small size.
inline Scene small_room(int spp = 4) {
  const std::vector<std::string> small{"image.width=96", "image.height=72", "render.spp=" + std::to_string(spp)};
  return read_scene(std::filesystem::path(GLIMT_SCENES) / "report.toml", small);
}

class Offscreen {
 public:
  /// `width` and `height` are in window coordinates, each of which has `ratio` framebuffer pixels. Rendering stops
  /// where the scene's settings say.
  Offscreen(Scene scene, int width, int height, float scale = 1, int ratio = 1)
      : width_(width), height_(height), ratio_(ratio), scale_(scale), pixels_(4UL * ratio * width * ratio * height) {
    context_ = OSMesaCreateContextExt(OSMESA_RGBA, 0, 0, 0, nullptr);
    if (context_ == nullptr ||
        !OSMesaMakeCurrent(context_, pixels_.data(), GL_UNSIGNED_BYTE, ratio * width, ratio * height)) {
      throw std::runtime_error("OSMesa gives no OpenGL context");
    }
    OSMesaPixelStore(OSMESA_Y_UP, 0);
    const RenderGoal goal{.stop_at = StopAt::samples, .samples = scene.render.spp};
    controller_ = std::make_unique<Controller>(
        std::move(scene), "picture.toml", [] {}, Execution{.threads = 2}, goal);
    screen_ = std::make_unique<Screen>();
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
    io.DisplayFramebufferScale = {static_cast<float>(ratio), static_cast<float>(ratio)};
    io.DeltaTime = 1.0F / 60;
    io.MouseDoubleClickTime = 0;  // a test presses faster than a hand
  }
  ~Offscreen() {
    screen_.reset();
    controller_.reset();
    OSMesaDestroyContext(context_);
  }
  Offscreen(const Offscreen&) = delete;
  Offscreen& operator=(const Offscreen&) = delete;

  Controller& controller() { return *controller_; }
  Screen& screen() { return *screen_; }
  void apply(const Edits& edits) {
    controller_->apply(edits);
    draw();
  }
  /// Passes what a person asks for through the screen to the controller, as the window's loop does.
  void ask(Edits edits) {
    screen_->lay_out(controller_->state(), scale_, edits);
    controller_->apply(edits);
    draw();
  }
  /// Presses a key while nothing else uses keys.
  void key(const KeyPress& press) {
    Edits edits;
    press_key(press, {}, state(), edits);
    ask(edits);
  }
  /// Edits the scene as `change` does.
  void edit(const std::function<void(Scene&)>& change) {
    Edits edits;
    change(edits.edit(state()));
    apply(edits);
  }
  void set_goal(const std::function<void(RenderGoal&)>& change) {
    Edits edits;
    change(edits.goal.emplace(state().goal));
    apply(edits);
  }
  const ViewerState& state() const { return controller_->state(); }
  const WidgetRects& widgets() const { return screen_->widgets(); }
  Rect widget(const std::string& name) const {
    const auto found = widgets().find(name);
    if (found == widgets().end()) throw std::runtime_error("no control called " + name);
    return found->second;
  }

  /// Draws pictures as the window's loop does; several, so that menus and hovering settle.
  void draw(int pictures = 3) {
    for (int i = 0; i < pictures; ++i) {
      controller_->poll();
      Edits edits;
      screen_->lay_out(controller_->state(), scale_, edits);
      controller_->apply(edits);
      screen_->paint();
    }
    glFinish();
  }

  /// Draws until the condition holds; false where it does not within a minute.
  bool draw_until(const std::function<bool()>& condition) {
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (std::chrono::steady_clock::now() < give_up) {
      draw(1);
      if (condition()) {
        draw();
        return true;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return false;
  }
  /// Draws until the newest scene is on the screen with all its samples. A frame that was finished before its target
  /// was changed does not count.
  bool draw_until_finished() {
    return draw_until([&] {
      const auto& frame = state().frame;
      if (!frame || !frame->finished || frame->version < state().version) return false;
      const Settings& target = state().scene.render;
      return target.target_error > 0 ? frame->estimate.at_most() <= target.target_error : frame->samples >= target.spp;
    });
  }

  /// Moves the mouse to (x, y) in the image (pixels from its top left), presses, drags by (dx, dy) window coordinates,
  /// and lets go.
  void drag_in_image(float x, float y, float dx, float dy, int button = 0) {
    ImGuiIO& io = ImGui::GetIO();
    io.MousePos = in_window(x, y);
    draw(2);
    io.MouseDown[button] = true;
    draw(2);
    for (int step = 0; step < 4 && (dx != 0 || dy != 0); ++step) {
      io.MousePos.x += dx / 4;
      io.MousePos.y += dy / 4;
      draw(1);
    }
    release(button);
  }
  void click_in_image(float x, float y) { drag_in_image(x, y, 0, 0); }
  void scroll_in_image(float x, float y, float notches) {
    ImGuiIO& io = ImGui::GetIO();
    io.MousePos = in_window(x, y);
    draw(2);
    io.MouseWheel = notches;
    draw(1);
    io.MouseWheel = 0;
    release();
  }

  /// Moves the mouse to a share of the control's width, presses, and lets go.
  void press(const std::string& name, float share = 0.5F) {
    const Rect r = widget(name);
    ImGuiIO& io = ImGui::GetIO();
    io.MousePos = {r.x + share * r.width, r.y + r.height / 2};
    draw(2);
    io.MouseDown[0] = true;
    draw(2);
    release();
  }
  /// Presses in the middle of the control, drags to a share of its width, and lets go.
  void drag(const std::string& name, float share) {
    const Rect r = widget(name);
    ImGuiIO& io = ImGui::GetIO();
    io.MousePos = {r.x + r.width / 2, r.y + r.height / 2};
    draw(2);
    io.MouseDown[0] = true;
    draw(2);
    io.MousePos.x = r.x + share * r.width;
    draw(2);
    release();
  }

  /// Red, green and blue at a framebuffer pixel, from the top left.
  std::array<int, 3> pixel(int x, int y) const {
    const std::uint8_t* p = pixels_.data() + 4UL * (static_cast<std::size_t>(y) * width_ * ratio_ + x);
    return {p[0], p[1], p[2]};
  }

  /// A place in the image in window coordinates.
  ImVec2 in_window(float x, float y) const {
    const Rect r = widget("image");
    const float zoom = r.width / static_cast<float>(state().scene.image.width);
    return {r.x + x * zoom, r.y + y * zoom};
  }

  /// Saves what is drawn as a PNG.
  void save(const std::filesystem::path& file, const Metadata& metadata = {}) const {
    std::vector<std::uint8_t> rgb;
    for (std::size_t i = 0; i < pixels_.size(); i += 4)
      rgb.insert(rgb.end(), {pixels_[i], pixels_[i + 1], pixels_[i + 2]});
    replace_file(file, encode_png(width_ * ratio_, height_ * ratio_, rgb, metadata));
  }

 private:
  /// Lets go and takes the mouse away, so that no tooltip covers the picture.
  void release(int button = 0) {
    ImGuiIO& io = ImGui::GetIO();
    io.MouseDown[button] = false;
    draw(2);
    io.MousePos = {-FLT_MAX, -FLT_MAX};
    draw();
  }

  int width_, height_, ratio_;
  float scale_;
  std::vector<std::uint8_t> pixels_;
  OSMesaContext context_ = nullptr;
  std::unique_ptr<Controller> controller_;
  std::unique_ptr<Screen> screen_;
};

inline bool apart(const Rect& r, const Rect& s) {
  return r.x + r.width <= s.x || s.x + s.width <= r.x || r.y + r.height <= s.y || s.y + s.height <= r.y;
}

/// With GLIMT_SCREENSHOTS=FOLDER, saves what is drawn there, for people to look at.
inline void save_screenshot(const Offscreen& window, const std::string& name) {
  const char* folder = std::getenv("GLIMT_SCREENSHOTS");
  if (folder == nullptr) return;
  std::filesystem::create_directories(folder);
  window.save(std::filesystem::path(folder) / (name + ".png"));
}

}  // namespace glimt::testing
