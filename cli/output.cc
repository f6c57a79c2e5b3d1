// SPDX-License-Identifier: Apache-2.0
#include "cli/output.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "cli/arguments.h"
#include "model/base/text.h"
#include "model/base/whole_file.h"

namespace skyfit::cli {
namespace fs = std::filesystem;
namespace {

// "a, b or c"
std::string either(const std::vector<std::string>& words) {
  if (words.size() == 1) return words.front();
  const auto last = words.end() - 1;
  return fmt::format("{} or {}", fmt::join(words.begin(), last, ", "), *last);
}

bool stdout_is_taken = false;  // by a file of --out

[[noreturn]] void fail_stdout() {
  throw std::runtime_error(
      fmt::format("stdout: not everything could be written: {}", std::strerror(errno)));
}

}  // namespace

void require_output_files(const std::vector<std::string>& files,
                          const std::vector<std::string>& extensions, std::string_view option) {
  std::set<fs::path> seen;
  for (const std::string& file : files) {
    if (std::ranges::count(extensions, fs::path(file).extension().string()) == 0) {
      throw UsageError(option, file, "expected a name that ends in " + either(extensions));
    }
    require_writable_file(file);
    if (is_stdout(file)) {
      if (isatty(STDOUT_FILENO) == 1 || stdout_is_taken)
        throw UsageError(option, file,
                         "expected a pipe or a file on the standard output, and once");
      stdout_is_taken = true;
    }
    if (!seen.insert(resolved_path(file)).second) {
      throw UsageError(option, file, "expected each file once");
    }
  }
}

void print(std::string_view text) {
  std::FILE* const stream = stdout_is_taken ? stderr : stdout;
  const bool terminal = isatty(fileno(stream)) == 1;
  std::string shown;
  if (terminal) {
    for (const std::string_view line : split(text, '\n')) shown += printable(line) + '\n';
    shown.pop_back();
    text = shown;
  }
  if (std::fwrite(text.data(), 1, text.size(), stream) != text.size()) fail_stdout();
}

void Figures::draw(const fs::path& directory, std::string_view name,
                   const std::function<void()>& draw) {
  try {
    draw();
  } catch (const std::exception& error) {
    std::string reason = error.what();
    const std::string staging = directory.string() + '/';
    if (reason.starts_with(staging)) reason.erase(0, staging.size());
    failures_.push_back(fmt::format("{} ({})", name, reason));
  }
}

void Figures::expect_all(const std::string& directory) const {
  if (failures_.empty()) return;
  throw std::runtime_error(
      fmt::format("{}: the result is complete but for figures that could not be "
                  "drawn: {}",
                  directory, fmt::join(failures_, ", ")));
}

void finish_stdout() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) fail_stdout();
}

std::string json_text(const nlohmann::json& json) {
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string shell_quoted(const std::string& text) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:=,@%+";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? "'\\''" : std::string(1, c);
  return result + "'";
}

std::string& command_line() {
  static std::string line;
  return line;
}

Verbosity& verbosity() {
  static Verbosity chosen = Verbosity::kNormal;
  return chosen;
}

void warn(std::string_view message) {
  if (verbosity() == Verbosity::kQuiet) return;
  fmt::print(stderr, "skyfit: warning: {}\n", printable(message));
}

}  // namespace skyfit::cli
