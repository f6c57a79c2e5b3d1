// SPDX-License-Identifier: Apache-2.0
#include "model/base/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "model/base/signal_cleanup.h"
#include "model/base/text.h"

namespace skyfit {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& program, int error) {
  throw std::runtime_error(
      fmt::format("{}: cannot run: {}", program.string(), std::strerror(error)));
}

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }

 private:
  int number_;
};

// A file in memory at its start: neither a full disk nor a child that does not read can stop us.
int file_of(const std::string& text, const fs::path& program) {
  const int file = ::memfd_create("input", MFD_CLOEXEC);
  if (file < 0) fail(program, errno);
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = ::write(file, text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const int error = errno;
      ::close(file);
      fail(program, error);
    }
    done += static_cast<std::size_t>(count);
  }
  ::lseek(file, 0, SEEK_SET);
  return file;
}

pid_t spawn(const Command& command, int input, int output) {
  std::vector<std::string> texts = {command.program.string()};
  texts.insert(texts.end(), command.arguments.begin(), command.arguments.end());
  std::vector<char*> arguments;
  for (std::string& text : texts) arguments.push_back(text.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, output, STDERR_FILENO);
  if (!command.directory.empty())
    posix_spawn_file_actions_addchdir_np(&actions, command.directory.c_str());
  pid_t child = 0;
  const int error =
      posix_spawn(&child, command.program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) fail(command.program, error);
  signal_cleanup::set_child(child);
  return child;
}

// All that the child prints, for a full pipe would stop it; the end of it is kept.
std::string last_output(int pipe) {
  constexpr std::size_t kMost = 1 << 16;
  std::string output;
  std::array<char, 4096> block;
  for (;;) {
    const ssize_t count = ::read(pipe, block.data(), block.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return output;
    output.append(block.data(), static_cast<std::size_t>(count));
    if (output.size() > kMost) output.erase(0, output.size() - kMost);
  }
}

}  // namespace

std::string Outcome::ending() const {
  return signal != 0 ? fmt::format("ended by signal {}", signal)
                     : fmt::format("exit status {}", exit_status);
}

Outcome run(const Command& command) {
  const Descriptor input(file_of(command.input, command.program));
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) fail(command.program, errno);
  const Descriptor read_end(ends[0]);
  Descriptor write_end(ends[1]);
  const pid_t child = spawn(command, input.number(), write_end.number());
  write_end.close();
  Outcome outcome;
  outcome.output = last_output(read_end.number());
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  signal_cleanup::set_child(0);
  if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
  if (WIFEXITED(status)) outcome.exit_status = WEXITSTATUS(status);
  return outcome;
}

std::optional<fs::path> program_in_path(std::string_view name) {
  const auto is_program = [](const fs::path& file) {
    std::error_code none;
    return fs::is_regular_file(file, none) && ::access(file.c_str(), X_OK) == 0;
  };
  if (name.find('/') != name.npos)
    return is_program(name) ? std::optional(fs::absolute(name)) : std::nullopt;
  const char* const path = std::getenv("PATH");
  for (const std::string_view folder : split(path == nullptr ? "" : path, ':')) {
    const fs::path program = fs::absolute(folder.empty() ? "." : folder) / name;
    if (is_program(program)) return program;
  }
  return {};
}

}  // namespace skyfit
