#include "viewer/state/render_goal.h"

#include <utility>

namespace glimt {

RenderGoal goal_for(const Scene& scene, RenderGoal goal) {
  if (goal.stop_at != StopAt::samples) goal.samples = scene.render.spp;
  if (goal.stop_at != StopAt::error && scene.render.target_error > 0) goal.error = scene.render.target_error;
  return goal;
}

Scene as_shown(Scene scene, const RenderGoal& goal, const std::optional<ImageSize>& size) {
  if (size) scene.image = *size;
  Settings& settings = scene.render;
  // There are as many sub-pixel centres as samples. So the number is part of the method, and rendering ends there.
  const bool counted = settings.sampler == Sampler::centres;
  settings.target_error = goal.stop_at == StopAt::error ? goal.error : 0;
  if (goal.stop_at == StopAt::samples)
    settings.spp = goal.samples;
  else if (!counted)
    settings.spp = max_spp;
  return scene;
}

Scene as_filed(Scene shown, const Scene& before, bool window_gave_size) {
  if (window_gave_size) shown.image = before.image;
  shown.render.spp = before.render.spp;
  shown.render.target_error = before.render.target_error;
  return shown;
}

bool has_target(const Settings& settings) { return settings.target_error > 0 || settings.spp < max_spp; }

}  // namespace glimt
