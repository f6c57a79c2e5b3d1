// SPDX-License-Identifier: Apache-2.0
// `skyfit completion`: what shells need to complete commands and options, from the same tables as
// the help.
#include <fmt/format.h>

#include <array>
#include <memory>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/output.h"

namespace skyfit::cli {
namespace {

std::string options_of(const CLI::App& app) {
  std::string names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names += " --" + name;
  }
  return names.empty() ? names : names.substr(1);
}

std::string commands_of(const CLI::App& app) {
  std::string names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names += " " + command->get_name();
  return names.empty() ? names : names.substr(1);
}

std::string bash_script(const CLI::App& app) {
  std::string cases;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    cases += fmt::format("    {}) words=\"{}\" ;;\n", command->get_name(), options_of(*command));
  }
  return fmt::format(R"(# Completion of skyfit for bash: source <(skyfit completion bash)
_skyfit() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} words
  case "${{COMP_WORDS[1]}}" in
{}    *) words="{} {}" ;;
  esac
  if [[ $COMP_CWORD -eq 1 || $current == -* ]]; then
    COMPREPLY=($(compgen -W "$words" -- "$current"))
  else
    COMPREPLY=($(compgen -f -- "$current"))
  fi
}}
complete -o filenames -F _skyfit skyfit
)",
                     cases, commands_of(app), options_of(app));
}

std::string zsh_script(const CLI::App& app) {
  return "# Completion of skyfit for zsh: source <(skyfit completion zsh)\n"
         "autoload -Uz bashcompinit && bashcompinit\n" +
         bash_script(app);
}

// The first line of a text, without what a shell's quotes would end at.
std::string quoted(std::string text) {
  text = text.substr(0, text.find('\n'));
  std::erase(text, '\'');
  return "'" + text + "'";
}

std::string fish_script(const CLI::App& app) {
  std::string script = "# Completion of skyfit for fish: skyfit completion fish | source\n";
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    script += fmt::format("complete -c skyfit -n __fish_use_subcommand -a {} -d {}\n",
                          command->get_name(), quoted(command->get_description()));
    for (const CLI::Option* option : command->get_options()) {
      for (const std::string& name : option->get_lnames()) {
        script +=
            fmt::format("complete -c skyfit -n '__fish_seen_subcommand_from {}' -l {} -d {}\n",
                        command->get_name(), name, quoted(option->get_description()));
      }
    }
  }
  return script;
}

struct Shell {
  std::string_view name;
  std::string (*script)(const CLI::App& app);
};
constexpr std::array<Shell, 3> kShells = {
    {{"bash", bash_script}, {"zsh", zsh_script}, {"fish", fish_script}}};

}  // namespace

void add_completion_command(CLI::App& app) {
  const auto shell = std::make_shared<std::string>();
  CLI::App& command =
      *app.add_subcommand("completion", "Prints what a shell needs to complete this program.");
  command.add_option("shell", *shell, "bash, zsh or fish")->required()->type_name("SHELL");
  command.footer("Example: source <(skyfit completion bash)");
  command.callback([&app, shell] {
    for (const Shell& known : kShells) {
      if (known.name == *shell) return print(known.script(app));
    }
    throw UsageError("shell", *shell, "expected bash, zsh or fish");
  });
}

}  // namespace skyfit::cli
