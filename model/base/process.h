// SPDX-License-Identifier: Apache-2.0
// Child processes, without a shell in between.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace skyfit {

struct Command {
  std::filesystem::path program;  // absolute, see program_in_path()
  std::vector<std::string> arguments;
  std::string input;                // what it reads from stdin
  std::filesystem::path directory;  // where it runs; empty: where we do
};

struct Outcome {
  int exit_status = 0;
  int signal = 0;      // that ended it, or 0
  std::string output;  // stdout and stderr, the last 64 KiB

  bool succeeded() const { return exit_status == 0 && signal == 0; }
  // "exit status 2" or "ended by signal 9".
  std::string ending() const;
};

// Runs it to its end. Throws std::runtime_error `program: cannot run: reason`.
Outcome run(const Command& command);

// The first program of that name in PATH, or the file itself where the name has a slash; absolute.
std::optional<std::filesystem::path> program_in_path(std::string_view name);

}  // namespace skyfit
