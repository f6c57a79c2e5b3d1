// SPDX-License-Identifier: Apache-2.0
// `skyfit man`: manual pages of the program and its commands, from the same tables as the help.
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>
#include <vector>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/output.h"
#include "model/base/whole_file.h"
#include "model/version.h"

namespace skyfit::cli {
namespace {

// Text of a page: nothing in it is a request to troff.
std::string roff(std::string_view text) {
  std::string result;
  bool at_begin = true;
  for (const char c : text) {
    if (at_begin && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      result += c;
    }
    at_begin = c == '\n';
  }
  return result;
}

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::string entry(const CLI::Option& option) {
  std::string names = option.get_name(option.get_positional(), true);
  if (!option.get_type_name().empty()) names += " " + option.get_type_name();
  std::string text = fmt::format(".TP\n.B {}\n{}", roff(names), roff(option.get_description()));
  text += text.ends_with('.') ? "\n" : ".\n";
  if (!option.get_default_str().empty())
    text += fmt::format("By default {}.\n", roff(option.get_default_str()));
  if (option.get_required()) text += "Required.\n";
  return text;
}

// Options by their group, in the order of the help.
std::string options_of(const CLI::App& app) {
  std::vector<std::string> groups;
  std::map<std::string, std::string> entries;
  for (const CLI::Option* option : app.get_options()) {
    const std::string& group = option->get_group();
    if (group.empty()) continue;  // hidden
    if (entries[group].empty()) groups.push_back(group);
    entries[group] += entry(*option);
  }
  std::string text;
  for (const std::string& group : groups)
    text += fmt::format(".SS {}\n{}", roff(group), entries[group]);
  return text.empty() ? text : ".SH OPTIONS\n" + text;
}

std::string page_name(const CLI::App* command) {
  return command ? fmt::format("skyfit-{}", command->get_name()) : "skyfit";
}

// Of a command, or of the program.
std::string page(const CLI::App& app, const CLI::App* command) {
  const CLI::App& about = command ? *command : app;
  const std::string name = page_name(command), description = about.get_description();
  std::string text = fmt::format(
      ".TH {} 1 \"\" \"skyfit {}\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n.B skyfit {}\n[OPTIONS]\n",
      name, kVersion, roff(name), roff(description),
      command ? roff(command->get_name()) : std::string("COMMAND"));
  if (!command) {
    text += ".SH COMMANDS\n";
    for (const CLI::App* of : commands_of(app))
      text +=
          fmt::format(".TP\n.BR {} (1)\n{}\n", roff(page_name(of)), roff(of->get_description()));
  }
  text += options_of(about);
  if (!about.get_footer().empty())
    text += fmt::format(".SH NOTES\n.nf\n{}\n.fi\n", roff(about.get_footer()));
  return text +
         ".SH SEE ALSO\nThe guides that are installed with the program: presets, and README.\n";
}

}  // namespace

void add_man_command(CLI::App& app) {
  struct Arguments {
    std::string command, directory;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* const man = app.add_subcommand("man", "Prints a manual page, or writes all of them.");
  man->add_option("command", arguments->command, "Of which command; by default the program's page")
      ->type_name("COMMAND");
  man->add_option("--out-dir", arguments->directory, "Write skyfit.1 and the pages of all commands")
      ->type_name("DIR");
  man->footer("Example: skyfit man fit | man -l -");
  man->callback([&app, arguments] {
    if (!arguments->directory.empty()) {
      const std::filesystem::path directory = arguments->directory;
      std::filesystem::create_directories(directory);
      write_whole_file(directory / "skyfit.1", page(app, nullptr));
      for (const CLI::App* command : commands_of(app))
        write_whole_file(directory / (page_name(command) + ".1"), page(app, command));
      return;
    }
    if (arguments->command.empty()) {
      print(page(app, nullptr));
      return;
    }
    std::string names;
    for (const CLI::App* command : commands_of(app)) {
      if (command->get_name() == arguments->command) {
        print(page(app, command));
        return;
      }
      names += (names.empty() ? "expected one of " : ", ") + command->get_name();
    }
    throw UsageError("command", arguments->command, names);
  });
}

}  // namespace skyfit::cli
