#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "cli/commands.h"
#include "film/image_file.h"
#include "film/statistics.h"

namespace glimt {
namespace fs = std::filesystem;
namespace {

struct CompareOptions {
  fs::path image, reference;
  bool json = false;
};

Comparison compare_files(const CompareOptions& options) {
  try {
    return compare(read_image(options.image), read_image(options.reference));
  } catch (const ImageFileError& error) {
    throw BadInput(error.what());
  } catch (const std::invalid_argument& error) {
    throw BadInput(options.image.string() + " against " + options.reference.string() + ": " + error.what());
  }
}

int run_compare(const CompareOptions& options) {
  const Comparison c = compare_files(options);
  const std::array<std::pair<const char*, double>, 7> measures{{{"mean", c.mean},
                                                                {"mean_reference", c.mean_reference},
                                                                {"bias", c.bias},
                                                                {"rmse", c.rmse},
                                                                {"relmse", c.relmse},
                                                                {"relmse999", c.relmse999},
                                                                {"relmse_scaled", c.relmse_scaled}}};
  nlohmann::ordered_json json;
  for (const auto& [name, value] : measures) {
    json[name] = value;
    if (!options.json) std::printf("%-15s %.8g\n", name, value);
  }
  if (options.json) std::printf("%s\n", json.dump(2).c_str());
  return 0;
}

}  // namespace

void add_compare_command(CLI::App& app, Run& run) {
  CLI::App* command = app.add_subcommand("compare", "Measure the error of an image against a reference");
  const auto options = std::make_shared<CompareOptions>();
  command->add_option("A", options->image, "Image, .exr or .pfm")->required()->type_name("FILE");
  command->add_option("B", options->reference, "Reference of the same size, .exr or .pfm")
      ->required()
      ->type_name("FILE");
  command->add_flag("--json", options->json, "Print JSON");
  command->callback([&run, options] { run = [options] { return run_compare(*options); }; });
}

}  // namespace glimt
