#include "cli/render_options.h"

#include <charconv>
#include <cmath>

#include "film/file_bytes.h"
#include "film/image_file.h"
#include "scene/fields.h"
#include "scene/file/text.h"

namespace glimt {
namespace {

std::string option_name(std::string_view key) {
  std::string name = "--" + std::string(key);
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

/// Adds an option that overrides one setting of the scene, as --set does.
struct AddSetting {
  CLI::App& command;
  std::vector<std::string>& overrides;
  const Field<Settings>& field;

  CLI::Option* operator()(const Choice<Settings>& choice) const {
    const std::vector<std::string> names(choice.names.begin(), choice.names.end());
    return add<std::string>([](const std::string& value) { return toml_string(value); })
        ->check(CLI::IsMember(names))
        ->type_name("NAME");
  }
  CLI::Option* operator()(const Value<Settings, int>&) const {
    return add<int>([](int value) { return std::to_string(value); })
        ->check(CLI::Range(static_cast<int>(field.min), static_cast<int>(field.max)));
  }
  CLI::Option* operator()(const Value<Settings, double>&) const {
    return add<double>([](double value) { return number_text(value); })->check(CLI::Range(field.min, field.max));
  }
  CLI::Option* operator()(const Value<Settings, glm::dvec3>&) const {
    return add<std::string>([](const std::string& value) { return value; })->type_name("[X,Y,Z]");
  }

  template <class T, class ToText>
  CLI::Option* add(ToText to_text) const {
    const auto set = [path = "render." + std::string(field.key) + "=", &list = overrides, to_text](const T& value) {
      list.push_back(path + to_text(value));
    };
    return command.add_option_function<T>(option_name(field.key), set, std::string(field.doc))->group("Settings");
  }
};

/// A validator for CLI11: returns the message of what `check` throws.
template <class Check>
auto message_of(Check check) {
  return [check](const std::string& text) -> std::string {
    try {
      check(text);
      return {};
    } catch (const ImageFileError& error) {
      return error.what();
    }
  };
}

/// Turns "640x480" into overrides of the image's size.
void set_size(const std::string& text, std::vector<std::string>& overrides) {
  const auto fields = image_fields();
  const char* next = text.data();
  const char* const last = text.data() + text.size();
  for (std::size_t i = 0; i < fields.size(); ++i) {
    int value = 0;
    const auto [end, error] = std::from_chars(next, last, value);
    const bool followed = i + 1 == fields.size() ? end == last : end != last && *end == 'x';
    if (error != std::errc{} || !followed || value < fields[i].min || value > fields[i].max)
      throw CLI::ValidationError("--size", text + " is not WIDTHxHEIGHT with both sides " +
                                               range_text(fields[i].min, fields[i].max, fields[i].min_excluded));
    overrides.push_back("image." + std::string(fields[i].key) + "=" + std::to_string(value));
    next = end + 1;
  }
}

/// Reads "64:32" as samples 64 to 95.
SampleRange part_of(const std::string& text) {
  SampleRange part;
  const char* const last = text.data() + text.size();
  const auto [colon, error] = std::from_chars(text.data(), last, part.first);
  if (error == std::errc{} && colon != last && *colon == ':') {
    const auto [end, count_error] = std::from_chars(colon + 1, last, part.count);
    if (count_error == std::errc{} && end == last && part.first >= 0 && part.first < max_spp && part.count >= 1 &&
        part.count <= max_spp - part.first)
      return part;
  }
  throw CLI::ValidationError("--samples", text +
                                              " is not FIRST:COUNT with FIRST from 0 on, COUNT from 1 on and at most " +
                                              std::to_string(max_spp) + " for both together");
}

void add_checkpoint_options(CLI::App& command, RenderOptions& options) {
  command
      .add_option_function<std::string>(
          "--samples",
          [&options](const std::string& text) {
            options.part = part_of(text);
            options.overrides.emplace_back("render.target_error=0");
          },
          "Take only samples FIRST to FIRST + COUNT - 1 of each pixel: a part for glimt merge")
      ->type_name("FIRST:COUNT")
      ->excludes(command.get_option("--seconds"))
      ->excludes(command.get_option("--target-error"));
  CLI::Option* checkpoint = add_file_option(command, "--checkpoint", options.checkpoint,
                                            "Keep all that is rendered in this file, for --resume and glimt merge");
  command.add_option("--every", options.every, "Time from one checkpoint to the next; 60 if not given")
      ->check(check_positive)
      ->type_name("S")
      ->needs(checkpoint);
  command
      .add_option("--resume", options.resume,
                  "Go on from this checkpoint; where it is missing and named by --checkpoint too, begin anew")
      ->type_name("FILE");
}

}  // namespace

std::string check_positive(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool number = error == std::errc{} && end == text.data() + text.size();
  return number && std::isfinite(value) && value > 0 ? "" : text + " is not a number above 0";
}

void add_scene_options(CLI::App& command, SceneOptions& options) {
  command.add_option("SCENE", options.scene, "Scene file")->required()->type_name("FILE");
  command.add_option("--set", options.overrides, "Override any value of the scene: material.clay.roughness=0.6")
      ->type_name("PATH=VALUE")
      ->expected(1)
      ->take_all();
  command
      .add_option_function<std::string>(
          "--size", [&options](const std::string& text) { set_size(text, options.overrides); },
          "Size of the image, pixels")
      ->type_name("WxH");
  command.add_option("--threads", options.execution.threads, "Threads; all the machine has if not given")
      ->check(CLI::Range(1, 1024));
}

CLI::Option* add_file_option(CLI::App& command, const std::string& name, std::filesystem::path& file,
                             const std::string& doc) {
  return command.add_option(name, file, doc)->type_name("FILE")->check(message_of([](const std::string& text) {
    check_replaceable(text);
  }));
}

void add_render_options(CLI::App& command, RenderOptions& options) {
  add_scene_options(command, options);
  command
      .add_option(
          "-o,--output", options.out,
          "Image to write: .png (displayed picture), .exr or .pfm (linear radiance); -: a PNG on standard output")
      ->required()
      ->type_name("FILE")
      ->check(message_of([](const std::string& file) { check_writable(file); }));
  for (const auto& field : settings_fields()) std::visit(AddSetting{command, options.overrides, field}, field.member);
  CLI::Option* spp = command.get_option("--spp");
  spp->each([&options](const std::string&) { options.overrides.emplace_back("render.target_error=0"); });
  CLI::Option* seconds =
      command.add_option("--seconds", options.seconds, "Render for this time in all instead of to --spp");
  CLI::Option* error = command.get_option("--target-error");
  seconds->check(check_positive)->type_name("S")->excludes(spp);
  error->check(check_positive)->type_name("RELMSE")->excludes(spp)->excludes(seconds);
  add_checkpoint_options(command, options);

  command
      .add_option_function<std::string>(
          "--lanes",
          [&options](const std::string& lanes) {
            options.execution.lanes = lanes == "1" ? Lanes::scalar : Lanes::native;
          },
          "Paths traced side by side in one thread")
      ->check(CLI::IsMember({"1", "native"}))
      ->type_name("N");
  add_file_option(command, "--stats", options.stats, "Write what the render was and cost as JSON")
      ->type_name("FILE.json");
  command.add_flag("--no-dither", options.no_dither,
                   "Round a PNG's colours to the nearest, which shows bands in smooth shades");
  command.add_flag("--quiet", options.quiet, "No progress and no summary");
}

}  // namespace glimt
