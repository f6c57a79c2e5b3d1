// SPDX-License-Identifier: Apache-2.0
// What the program says and where its results go.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace skyfit::cli {

// Throws std::runtime_error with one line where a file of --out cannot be written, and UsageError
// where a name ends in none of `extensions`, a file is named twice, or the standard output (see
// is_stdout()) is a terminal. Called before long work whose result goes there; what print() says
// then goes to stderr.
void require_output_files(const std::vector<std::string>& files,
                          const std::vector<std::string>& extensions,
                          std::string_view option = "--out");

// Figures of a result, which is published without those that cannot be drawn.
class Figures {
 public:
  // Calls `draw`, which writes into the directory; what it throws is kept, without the directory,
  // whose name is a temporary one.
  void draw(const std::filesystem::path& directory, std::string_view name,
            const std::function<void()>& draw);
  // Throws std::runtime_error with one line that names the figures that are missing and why, so
  // that the exit status tells.
  void expect_all(const std::string& directory) const;

 private:
  std::vector<std::string> failures_;
};

// Writes text to stdout, or to stderr where a file goes to stdout; on a terminal without the
// control characters of file names and the like. Throws std::runtime_error when stdout takes no
// more; finish_stdout() does where not all of it could be written.
void print(std::string_view text);
void finish_stdout();

// Indented, with a newline at the end. Text that is not UTF-8 gets replacement characters.
std::string json_text(const nlohmann::json& json);

// How much stderr says: --quiet leaves out progress and warnings, --verbose tells long work's begin
// and end, and how long it took, where stderr is no terminal. Set before a command runs.
enum class Verbosity { kQuiet, kNormal, kVerbose };
Verbosity& verbosity();

// In single quotes for a shell, where it needs them.
std::string shell_quoted(const std::string& text);

// What was typed, quoted for a shell. Set before a command runs.
std::string& command_line();

// One line on stderr, `skyfit: warning: message`, unless quiet.
void warn(std::string_view message);

}  // namespace skyfit::cli
