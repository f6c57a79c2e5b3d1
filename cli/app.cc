// SPDX-License-Identifier: Apache-2.0
#include "cli/app.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/output.h"
#include "model/base/temporary_directory.h"
#include "model/base/text.h"
#include "model/version.h"

namespace skyfit::cli {
namespace {

constexpr int kSuccess = 0, kFailure = 1, kUsage = 2;

// One line, whatever a library's message or a file's text in it holds.
int fail(int status, std::string_view message) {
  constexpr std::size_t kMost = 8192;  // two of the longest paths
  const std::string line = printable(trim(message.substr(0, kMost)));
  std::fprintf(stderr, "skyfit: error: %s\n", line.c_str());
  return status;
}

// CLI11 prints help and version to a stream that does not tell when the disk is full.
int print_help(const CLI::App& app, const CLI::Success& help_or_version) {
  std::ostringstream text, ignored;
  const int status = app.exit(help_or_version, text, ignored);
  print(text.str());
  finish_stdout();
  return status;
}

// An empty value is one that a script lost.
void expect_values(CLI::App& command) {
  for (CLI::Option* const known : command.get_options()) {
    const std::string form = known->get_type_name(), name = known->get_name();
    if (known->get_expected_max() == 0) continue;
    const std::string expected =
        fmt::format("expected {} (see skyfit {} --help)", form, command.get_name());
    known->check([name, expected](const std::string& text) {
      if (text.empty()) throw UsageError(name, text, expected);
      return std::string();
    });
  }
}

void add_commands(CLI::App& app) {
  app.set_version_flag("--version", std::string("skyfit ") + kVersion);
  app.require_subcommand(0, 1);  // none at all is refused by run(), with a better message
  app.get_formatter()->column_width(34);
  app.add_flag_callback(
         "--allow-paths", [] { named_files() = NamedFiles::kAnywhere; },
         "Read the files that presets, sidecars, sequences and meshes name, wherever\nthey lie; "
         "else "
         "only those in the folder of the file that names them")
      ->trigger_on_parse();
  const auto add_verbosity = [&](const char* name, Verbosity chosen, const char* meaning) {
    return app
        .add_flag_callback(
            name, [chosen] { verbosity() = chosen; }, meaning)
        ->trigger_on_parse();
  };
  auto* const quiet = add_verbosity("-q,--quiet", Verbosity::kQuiet,
                                    "No progress and no warnings; errors and results stay");
  add_verbosity("-v,--verbose", Verbosity::kVerbose,
                "Tell begin and end of long work where there is no terminal")
      ->excludes(quiet);
  add_fit_command(app);
  add_report_command(app);
  add_campaign_command(app);
  add_sky_command(app);
  add_sky_map_command(app);
  add_export_command(app);
  add_import_command(app);
  add_plot_command(app);
  add_render_command(app);
  add_view_command(app);
  add_tables_command(app);
  add_presets_command(app);
  add_parameters_command(app);
  add_references_command(app);
  add_check_command(app);
  add_classify_command(app);
  add_compare_command(app);
  add_completion_command(app);
  add_man_command(app);
  add_doctor_command(app);
  for (CLI::App* const command : app.get_subcommands({})) {
    command->fallthrough();
    expect_values(*command);
  }
  app.footer(
      "Example: skyfit fit --reference cie:12 --out fitted\nMore about a command: skyfit COMMAND "
      "--help");
}

// "skyfit sky --help", of the command that was typed.
std::string help_of(const CLI::App& app, int argc, char** argv) {
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    if (argc > 1 && command->get_name() == argv[1])
      return fmt::format("skyfit {} --help", command->get_name());
  return "skyfit --help";
}

// A first word that is no command.
void expect_known_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  if (std::ranges::count(names, argv[1]) == 0)
    throw UsageError("command", argv[1], fmt::format("expected one of {}", fmt::join(names, ", ")));
}

// `--shadows=`, which the parser takes for --shadows.
void expect_values_behind_signs(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word.starts_with("--") && word.find('=') == word.size() - 1) {
      throw UsageError(word.substr(0, word.size() - 1), "",
                       "expected a value behind the =, or no = where the option takes none");
    }
  }
}

int run_command(CLI::App& app, int argc, char** argv) {
  expect_known_command(app, argc, argv);
  expect_values_behind_signs(argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    return print_help(app, help_or_version);
  }
  if (app.get_subcommands().empty()) return fail(kUsage, "expected a command (see skyfit --help)");
  finish_stdout();
  return kSuccess;
}

}  // namespace

int run(int argc, char** argv) {
  clean_up_on_signals();
  command_line() = "skyfit";
  for (int i = 1; i < argc; ++i) command_line() += " " + shell_quoted(argv[i]);
  CLI::App app("Fits an atmosphere to a reference sky, evaluates, plots and renders it.", "skyfit");
  add_commands(app);
  try {
    return run_command(app, argc, argv);
  } catch (const CLI::ConversionError& error) {
    return fail(kUsage, std::string(error.what()) + ": expected a whole number");
  } catch (const CLI::ExtrasError&) {
    return fail(kUsage,
                fmt::format("{}: unknown, expected options and their values alone (see {})",
                            in_quotes(fmt::format("{}", fmt::join(app.remaining(true), " "))),
                            help_of(app, argc, argv)));
  } catch (const CLI::ParseError& error) {
    return fail(kUsage, fmt::format("{} (see {})", error.what(), help_of(app, argc, argv)));
  } catch (const UsageError& error) {
    return fail(kUsage, error.what());
  } catch (const std::bad_alloc&) {
    return fail(kFailure, "not enough memory for what was asked");
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(kFailure, error.path1().string() + ": " + error.code().message());
  } catch (const std::exception& error) {
    return fail(kFailure, error.what());
  }
}

}  // namespace skyfit::cli
