#include <algorithm>
#include <cmath>
#include <cstdio>

#include "check/causes.h"
#include "cli/commands.h"
#include "cli/render_loop.h"
#include "cli/render_options.h"
#include "cli/report_page.h"
#include "film/file_bytes.h"
#include "film/image_file.h"
#include "film/statistics.h"
#include "scene/file/scene_file.h"

namespace glimt {
namespace {

struct CheckOptions : SceneOptions {
  std::filesystem::path picture, html;
  double seconds = 20;  ///< for the reference
};

/// The scene's picture after so many seconds.
Film render_for(const Scene& scene, double seconds, const Execution& execution) {
  const CompiledScene compiled = compile(scene);
  Film film = make_film(compiled);
  const auto render = [&](Film& to, int count) {
    render_pass(compiled, to, count, execution);
    return 0.0;
  };
  render_to({.samples = {0, max_spp}, .seconds = seconds}, compiled, film, render, std::atomic<bool>(false), {});
  return film;
}

std::string text(const char* format, auto... values) {
  char buffer[256];
  std::snprintf(buffer, sizeof buffer, format, values...);
  return buffer;
}

std::string mean_text(const PictureDifference& d) {
  if (d.mean_reference == 0) return text("mean %.6g, and the reference is black", d.mean);
  return text("mean %.6g, reference %.6g: %+.2f %% (+-%.2f %% in 95 of 100)", d.mean, d.mean_reference,
              100 * (d.mean / d.mean_reference - 1), 100 * 1.96 * d.mean_error / d.mean_reference);
}

std::string blocks_text(const PictureDifference& d) {
  return text("%d of %zu blocks of 8x8 pixels differ by more than noise (by chance one does in 1 of 1000 pictures)",
              d.beyond, d.blocks.size());
}

/// What is left to explain is a half at most of what there was.
bool explains(const Cause& cause, const PictureDifference& all) {
  return cause.left.mean_square_z < all.mean_square_z / 2 && 2 * cause.left.beyond < all.beyond;
}

/// How far each block is off, in standard errors: red where the picture is too bright, blue where it is too dark.
Image map_of(const PictureDifference& d, const Image& picture) {
  Image map = picture;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const double z = d.block_at(x, y).z;
      const auto size = static_cast<float>(std::min(std::abs(z) / 10, 1.0));
      float* const rgb = map.pixel(x, y);
      rgb[0] = z > 0 ? size : 0;
      rgb[1] = 0.1F * size;
      rgb[2] = z < 0 ? size : 0;
    }
  return map;
}

void write_page(const CheckOptions& options, const Image& picture, const Image& reference, const PictureDifference& all,
                const std::vector<Cause>& causes) {
  Page page("Is " + options.picture.filename().string() + " right?");
  page.paragraph(mean_text(all));
  page.paragraph(blocks_text(all));
  page.figure(
      {{picture, "Checked"}, {reference, "Reference"}, {map_of(all, picture), "Red: too bright. Blue: too dark"}},
      "Full colour is ten standard errors.");
  std::vector<Page::Row> rows;
  rows.reserve(causes.size());
  for (const Cause& cause : causes)
    rows.push_back({cause.name, std::to_string(cause.left.beyond), figure_text(cause.left.mean_square_z),
                    explains(cause, all) ? "explains it" : ""});
  page.table({"If this were the mistake", "blocks left", "mean square of z (1: noise)", ""}, rows,
             "Each is a picture that glimt has made with the mistake, compared with the checked one.");
  replace_file(options.html, page.html());
}

int run_check(const CheckOptions& options) {
  try {
    const Image picture = read_image(options.picture);
    Scene scene = read_scene(options.scene, options.overrides);
    if (picture.width * scene.image.height != picture.height * scene.image.width)
      throw BadInput(text("%s is %dx%d, which is not the shape of the scene's %dx%d", options.picture.c_str(),
                          picture.width, picture.height, scene.image.width, scene.image.height));
    scene.image = {picture.width, picture.height};
    scene.render = {};
    const Film film = render_for(scene, options.seconds, options.execution);
    const Image reference = film.mean();
    const PictureDifference all = difference_of(picture, reference);
    std::printf("%s against %s (%d spp, %s)\n%s\n%s\n", options.picture.c_str(), options.scene.c_str(), film.samples(),
                trust_text(estimate_error(film)).c_str(), mean_text(all).c_str(), blocks_text(all).c_str());
    std::fflush(stdout);
    std::vector<Cause> causes;
    if (all.beyond > 0)
      causes = likely_causes(picture, scene, reference, [&](const Scene& wrong) {
        return render_for(wrong, options.seconds / 4, options.execution).mean();
      });
    int told = 0;
    for (const Cause& cause : causes)
      if (explains(cause, all) && told++ < 3)
        std::printf("%s: %s; then %d blocks differ\n", told == 1 ? "likely" : "or", cause.name.c_str(),
                    cause.left.beyond);
    if (all.beyond == 0) std::printf("no difference but noise\n");
    if (all.beyond > 0 && told == 0) std::printf("no mistake that glimt knows explains it\n");
    if (!options.html.empty()) write_page(options, picture, reference, all, causes);
    return all.beyond > 0 ? 1 : 0;
  } catch (const ImageFileError& error) {
    throw BadInput(error.what());
  } catch (const std::invalid_argument& error) {
    throw BadInput(options.picture.string() + ": " + error.what());
  }
}

}  // namespace

void add_check_command(CLI::App& app, Run& run) {
  CLI::App* command = app.add_subcommand("check", "Tell where a picture is wrong, and what mistake makes such a one");
  const auto options = std::make_shared<CheckOptions>();
  command->add_option("PICTURE", options->picture, "What another renderer made of the scene, .exr or .pfm")
      ->required()
      ->type_name("FILE");
  add_scene_options(*command, *options);
  command->add_option("--seconds", options->seconds, "To render the reference; 20 if not given")
      ->check(check_positive)
      ->type_name("S");
  add_file_option(*command, "--html", options->html, "Page with the pictures, a map and all mistakes tried");
  command->callback([&run, options] { run = [options] { return run_check(*options); }; });
}

}  // namespace glimt
