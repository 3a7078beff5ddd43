#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "film/display.h"
#include "render/session.h"
#include "scene/pick.h"
#include "scene/scene.h"
#include "viewer/state/camera_moves.h"
#include "viewer/state/charting.h"
#include "viewer/state/compare.h"
#include "viewer/state/render_goal.h"

namespace glimt {

/// One line for the person at the window.
struct Message {
  std::string text;
  bool error = false;
};

/// What a window has left that ended without being closed.
struct LeftBehind {
  std::string scene;  ///< its name
  int samples = 0;    ///< per pixel
};

/// All that the panels show. They read it; the controller alone changes it.
struct ViewerState {
  Scene scene;                                    ///< as edited and rendered; the frame may still show an older one
  std::shared_ptr<const Scene> filed;             ///< the same as a file holds it, with the file's own target
  RenderGoal goal;                                ///< how far the scene is rendered
  std::uint64_t version = 0;                      ///< of the scene; frames of this or a later version show it
  std::shared_ptr<const CompiledScene> compiled;  ///< of the scene
  bool fits_window = false;                       ///< the picture's size follows the free space in the window
  ImageSize room{};                               ///< free space for the picture, without the chart; framebuffer pixels
  Camera opened_camera;                           ///< as in the file, to return to
  ImageSize opened_size{};                        ///< the picture's size in the file
  std::filesystem::path file;                     ///< of the scene; empty where the scene came from a picture
  std::filesystem::path folder;                   ///< where the files' sheet opens
  std::optional<ObjectId> selected;               ///< always an object of the scene
  Display display;
  bool paused = false, can_undo = false, can_redo = false;
  bool hint = false;                   ///< the hint for the first start is shown
  std::shared_ptr<const Frame> frame;  ///< the newest; null before the first
  Message message;
  ChartState chart;
  Compare compare;
  bool inspect = false;  ///< show the numbers of the pixel under the mouse
  DragView drag_view = DragView::automatic;
  bool enclosed = false;                  ///< the eye is in a closed room
  std::optional<LeftBehind> left_behind;  ///< to go on with, or to forget
  bool following = false;                 ///< the picture is that of a checkpoint which another program writes
  bool black = false;                     ///< all of the frame is, and it has enough samples to say so
};

/// Whether a drag turns the view about the eye (else it orbits).
inline bool drag_turns(const ViewerState& state) {
  return state.drag_view == DragView::automatic ? state.enclosed : state.drag_view == DragView::turn;
}

/// What a file is chosen for.
enum class FilePurpose { none, open, save, reference };

/// How large the picture is shown.
enum class PictureZoom { fitted, pixel_by_pixel };

/// What a person asked for while one picture of the window was drawn.
struct Edits {
  std::optional<Scene> scene;  ///< its own target is ignored: the target is `goal`
  std::optional<RenderGoal> goal;
  std::uint64_t gesture = 0;        ///< edits of scene and goal in one gesture, such as a drag, are undone together
  std::optional<bool> fits_window;  ///< false: the picture has the size of `scene` from now on
  std::optional<ImageSize> room;    ///< free space for the picture, as laid out now
  std::optional<Display> display;
  std::optional<std::optional<ObjectId>> select;  ///< an object, or none
  std::optional<std::filesystem::path> open;      ///< a scene file, or a picture or checkpoint of glimt
  std::optional<std::filesystem::path> save;      ///< a scene file to write, over one that is there
  std::optional<std::filesystem::path> folder;
  bool recover = false, forget_left_behind = false;
  bool toggle_pause = false;
  bool restart = false;
  bool undo = false, redo = false;
  bool snapshot = false, snapshot_exr = false;
  bool dismiss_hint = false;
  std::optional<FilePurpose> choose_file;  ///< open the files' sheet
  std::optional<PictureZoom> zoom;
  bool worst_pixel = false;  ///< go to it
  bool toggle_help = false;
  bool escape = false;  ///< close the sheets over the picture, else select nothing
  std::optional<ChartView> chart_view;
  std::optional<std::uint64_t> show_curve, hide_curve, remove_curve, base_curve;
  std::optional<std::filesystem::path> load_reference;
  std::optional<double> reference_target;  ///< relmse_scaled at which the next reference is finished
  bool clear_chart = false;
  bool make_reference = false, use_reference_now = false, stop_reference = false, drop_reference = false;
  bool advise = false, measure_families = false, stop_measuring = false;
  bool export_csv = false, export_svg = false;
  std::optional<Compare> compare;
  std::optional<bool> inspect;
  std::optional<DragView> drag_view;
  bool quit = false;

  /// The scene to change: the one edited so far, or a copy of the present one.
  Scene& edit(const ViewerState& state) { return scene ? *scene : scene.emplace(state.scene); }
};

}  // namespace glimt
