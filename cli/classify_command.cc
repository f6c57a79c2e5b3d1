// SPDX-License-Identifier: Apache-2.0
// `skyfit classify`: which CIE standard sky a reference is.
#include <memory>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/output.h"
#include "data_refs/spectra.h"
#include "fit/classify.h"

namespace skyfit::cli {
namespace {

struct ClassifyArguments {
  std::string reference, sampling = "tregenza", sun_zenith = "0:80:10", exclude_sun = "3";
  ImportArguments import;
  bool free_azimuth = false, json = false;
};

void run_classify(const ClassifyArguments& arguments, const CLI::App& command) {
  const double exclude = parse_number("--exclude-sun-deg", arguments.exclude_sun);
  if (exclude < 0 || exclude >= 180)
    throw UsageError("--exclude-sun-deg", arguments.exclude_sun,
                     "expected at least 0 and less than 180 degrees");
  const refs::Reference reference = load_references(arguments.reference, arguments.sun_zenith,
                                                    arguments.sampling, arguments.import, command);
  const fit::Classification found = fit::classify(reference, refs::standard_spectral_data(),
                                                  {radians(exclude), arguments.free_azimuth});
  print(arguments.json ? json_text(fit::classification_json(found))
                       : fit::classification_text(found));
}

}  // namespace

void add_classify_command(CLI::App& app) {
  const auto arguments = std::make_shared<ClassifyArguments>();
  CLI::App* const command =
      app.add_subcommand("classify", "Says which CIE standard sky a reference is.");
  command
      ->add_option("--reference", arguments->reference,
                   "Measured skies, taken together, or shipped references")
      ->required()
      ->type_name("NAME|FILE,FILE");
  add_sampling_options(*command, arguments->sampling, arguments->sun_zenith);
  add_import_options(*command, arguments->import);
  command->add_option("--exclude-sun-deg", arguments->exclude_sun, "Leave out what is closer")
      ->type_name("ANGLE")
      ->capture_default_str();
  command->add_flag("--free-azimuth", arguments->free_azimuth,
                    "Fit an azimuth offset of every scan");
  command->add_flag("--json", arguments->json, "Print the result as JSON");
  command->footer(
      "All 15 types with their RMS, the nearest one of each scan, and the free fit of the\n"
      "coefficients a to e. One luminance scale per scan is free.\n"
      "\n"
      "Example: skyfit classify --reference scan.csv --exclude-sample 0 --free-azimuth");
  command->callback([arguments, command] { run_classify(*arguments, *command); });
}

}  // namespace skyfit::cli
