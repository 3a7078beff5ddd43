#include <unistd.h>

#include <cstdio>
#include <memory>

#include "cli/commands.h"
#include "cli/report_parts.h"
#include "film/file_bytes.h"
#include "film/image_file.h"

namespace glimt {
namespace fs = std::filesystem;
namespace {

struct ReportOptions {
  fs::path out;
  ReportPlan plan;
};

int run_report(ReportOptions& options) {
  ReportPlan& plan = options.plan;
  const fs::path file = options.out / "index.html";
  std::error_code failure;
  fs::create_directories(options.out, failure);
  if (failure) throw BadInput(options.out.string() + ": cannot be made a folder: " + failure.message());
  try {
    check_replaceable(file);
  } catch (const ImageFileError& error) {
    throw BadInput(error.what());
  }
  const bool show = isatty(STDERR_FILENO) != 0;
  plan.say = [show](const std::string& what) { show ? std::fprintf(stderr, "%s\n", what.c_str()) : 0; };

  Page page("A Monte Carlo ray tracer, measured again");
  page.paragraph(
      "The pictures and tables of the course report A Monte Carlo Ray Tracer by Fredrik Johansson and Isak Engström "
      "(Linköping University, 2019), by glimt " GLIMT_VERSION
      ": with the report's method, and with the best that glimt has. Every figure was measured by the run that wrote "
      "this page, with " +
      std::to_string(plan.execution.threads > 0 ? plan.execution.threads : hardware_threads()) + " threads and " +
      std::to_string(native_lane_count()) +
      " paths side by side in each; those of the report's machine, an Intel Core i7-4790K, are the report's. Times in "
      "tables are of "
      "one run each; what else the machine did is in them.");
  if (plan.quick) page.paragraph("A quick run: pictures are small and have few samples, so the figures mean little.");
  add_room(page, plan);
  add_samples(page, plan);
  add_roughness(page, plan);
  add_materials(page, plan);
  add_shadow_rays(page, plan);
  add_chart(page, plan);
  add_errors(page, plan);
  add_balance(page, plan);
  add_stability(page, plan);
  add_furnace(page, plan);
  replace_file(file, page.html());
  std::printf("%s\n", file.c_str());
  return 0;
}

}  // namespace

void add_report_command(CLI::App& app, Run& run) {
  CLI::App* command = app.add_subcommand("report", "Make the course report's figures and tables again, as a page");
  const auto options = std::make_shared<ReportOptions>();
  command->add_option("-o,--output", options->out, "Folder to write index.html to")->required()->type_name("DIR");
  command->add_flag("--quick", options->plan.quick, "Small pictures and few samples, to see the page");
  command->add_option("--threads", options->plan.execution.threads, "Threads; all the machine has if not given")
      ->check(CLI::Range(1, 1024));
  command->callback([&run, options] { run = [options] { return run_report(*options); }; });
}

}  // namespace glimt
