// SPDX-License-Identifier: Apache-2.0
#include "render/plot/gnuplot.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace skyfit::plot {
namespace {

struct Closer {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Closer>;

// An unnamed file, so that neither a full pipe nor a dead reader can stop the program.
File unnamed_file(std::string_view content) {
  File file(std::tmpfile());
  if (!file || std::fwrite(content.data(), 1, content.size(), file.get()) != content.size() ||
      std::fflush(file.get()) != 0)
    throw std::runtime_error(
        fmt::format("gnuplot: cannot write its script: {}", std::strerror(errno)));
  std::rewind(file.get());
  return file;
}

// gnuplot prints the offending line, a caret and then the reason: the last line that says something
// is the reason.
std::string last_message(std::FILE* file) {
  std::rewind(file);
  std::array<char, 4096> line;
  std::string message;
  while (std::fgets(line.data(), static_cast<int>(line.size()), file) != nullptr) {
    std::string text(line.data());
    text.erase(text.find_last_not_of(" \r\n") + 1);
    text.erase(0, text.find_first_not_of(' '));
    if (!text.empty()) message = text;
  }
  return message.empty() ? "no message" : message;
}

pid_t spawn(const char* program, std::FILE* input, std::FILE* output) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, fileno(input), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(output), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(output), STDERR_FILENO);
  std::string name = program, defaults = "-d";
  const std::array<char*, 3> arguments = {name.data(), defaults.data(), nullptr};
  pid_t child = 0;
  const int error = posix_spawnp(&child, program, &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0)
    throw std::runtime_error(
        fmt::format("{}: cannot run: {}; figures need gnuplot 5.4 (package gnuplot-nox)", program,
                    std::strerror(error)));
  return child;
}

}  // namespace

std::string gnuplot_quoted(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') quoted += '\'';
    const auto code = static_cast<unsigned char>(c);
    quoted += code < 0x20 || code == 0x7f ? ' ' : c;
  }
  return quoted + "'";
}

void run_gnuplot(const std::string& script) {
  const char* chosen = std::getenv("SKYFIT_GNUPLOT");
  const char* program = chosen != nullptr ? chosen : "gnuplot";
  const File input = unnamed_file(script), output = unnamed_file("");
  const pid_t child = spawn(program, input.get(), output.get());
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  if (WIFSIGNALED(status))
    throw std::runtime_error(fmt::format("{}: ended by signal {}", program, WTERMSIG(status)));
  if (WEXITSTATUS(status) != 0)
    throw std::runtime_error(fmt::format("{}: exit status {}: {}", program, WEXITSTATUS(status),
                                         last_message(output.get())));
}

}  // namespace skyfit::plot
