// SPDX-License-Identifier: Apache-2.0
// `skyfit report`: prints the report of a finished fit again, or writes it as a page with the
// fitted sky beside it.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/fit_files.h"
#include "cli/inputs.h"
#include "cli/output.h"
#include "cli/sky_page_file.h"
#include "fit/result/record.h"
#include "model/base/whole_file.h"

namespace skyfit::cli {
namespace {

// The file of the fitted sky that belongs to a report; none to one that goes to the standard
// output.
std::optional<std::filesystem::path> sky_beside(const std::filesystem::path& report) {
  if (is_stdout(report)) return {};
  return report.parent_path() / (report.stem().string() + "-sky.html");
}

// Every file that the report consists of.
std::vector<std::string> report_files(const std::string& report) {
  std::vector<std::string> files = {report};
  if (const auto sky = sky_beside(report)) files.push_back(sky->string());
  return files;
}

// The page of the fitted sky; empty, with a warning, where there can be none.
std::string live_sky(const Preset& preset, int threads, const std::string& report) {
  try {
    return make_sky_page(preset, usual_sliders(preset, preset.name), threads).html;
  } catch (const std::invalid_argument& error) {
    warn(fmt::format("{}: without the live sky: {}", report, error.what()));
    return {};
  }
}

void write_report_page(const std::filesystem::path& directory, const FinishedFit& finished,
                       const std::filesystem::path& report, int threads) {
  const auto beside = sky_beside(report);
  const std::string sky =
      beside ? live_sky(fit::fitted_preset(finished.result), threads, report.string()) : "";
  std::vector<std::filesystem::path> targets = {report};
  if (!sky.empty()) targets.push_back(*beside);
  WholeFiles files(targets);
  files.write(0, fit::html_report(finished.result, finished.checks,
                                  report_figures(directory, finished.result, threads),
                                  sky.empty() ? "" : beside->filename().string()));
  if (!sky.empty()) files.write(1, sky);
  files.publish();
}

}  // namespace

void add_report_command(CLI::App& app) {
  struct Arguments {
    std::string directory;
    std::vector<std::string> out;
    bool json = false;
    int threads = default_threads();
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* const command = app.add_subcommand(
      "report", "Prints the report of a finished fit again, or writes it as a page.");
  command->add_option("directory", arguments->directory, "What skyfit fit left")
      ->required()
      ->type_name("DIR");
  CLI::Option* const json = command->add_flag("--json", arguments->json, "Print report.json");
  command
      ->add_option("--out", arguments->out,
                   "Write one page for a browser, with figures and the preset, and beside it\n"
                   "FILE-sky.html, the live sky of skyfit view; both need no network")
      ->type_name("FILE.html")
      ->expected(1)
      ->excludes(json);
  add_threads_option(*command, arguments->threads);
  command->footer(
      "The report is made anew from preset.json, whose record holds the fit, and the checks in\n"
      "report.json.\n"
      "\n"
      "Examples:\n"
      "  skyfit report fitted\n"
      "  skyfit report fitted --out report.html");
  command->callback([arguments] {
    if (!arguments->out.empty())
      require_output_files(report_files(arguments->out.front()), {".html"});
    const FinishedFit finished = read_fit(arguments->directory);
    if (!arguments->out.empty()) {
      write_report_page(arguments->directory, finished, arguments->out.front(), arguments->threads);
      return;
    }
    print(arguments->json ? json_text(fit::report_json(finished.result, finished.checks))
                          : fit::full_report(finished.result, finished.checks));
  });
}

}  // namespace skyfit::cli
