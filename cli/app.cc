// SPDX-License-Identifier: Apache-2.0
#include "cli/app.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <string>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/output.h"
#include "model/version.h"

namespace skyfit::cli {
namespace {

constexpr int kSuccess = 0, kFailure = 1, kUsage = 2;

// One line, whatever a library's message holds.
int fail(int status, std::string message) {
  std::ranges::replace_if(
      message, [](char c) { return c == '\n' || c == '\r'; }, ' ');
  message.erase(message.find_last_not_of(' ') + 1);
  std::fprintf(stderr, "skyfit: error: %s\n", message.c_str());
  return status;
}

void add_commands(CLI::App& app) {
  app.set_version_flag("--version", std::string("skyfit ") + kVersion);
  app.require_subcommand(0, 1);  // none at all is refused by run(), with a better message
  app.get_formatter()->column_width(34);
  add_fit_command(app);
  add_report_command(app);
  add_sky_command(app);
  add_plot_command(app);
  add_render_command(app);
  add_presets_command(app);
  add_parameters_command(app);
  add_references_command(app);
  add_check_command(app);
  add_classify_command(app);
  add_compare_command(app);
  app.footer(
      "Example: skyfit fit --reference cie:12 --out fitted\nMore about a command: skyfit COMMAND "
      "--help");
}

}  // namespace

int run(int argc, char** argv) {
  CLI::App app("Fits an atmosphere to a reference sky, evaluates, plots and renders it.", "skyfit");
  add_commands(app);
  try {
    app.parse(argc, argv);
    if (app.get_subcommands().empty())
      return fail(kUsage, "expected a command (see skyfit --help)");
    finish_stdout();
    return kSuccess;
  } catch (const CLI::Success& help_or_version) {
    return app.exit(help_or_version);
  } catch (const CLI::ConversionError& error) {
    return fail(kUsage, std::string(error.what()) + ": expected a whole number");
  } catch (const CLI::ParseError& error) {
    return fail(kUsage, std::string(error.what()) + " (see skyfit --help)");
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
