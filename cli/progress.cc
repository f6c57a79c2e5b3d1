// SPDX-License-Identifier: Apache-2.0
#include "cli/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "cli/output.h"
#include "model/base/text.h"

namespace skyfit::cli {
namespace {

constexpr int kBarWidth = 24;
constexpr std::chrono::milliseconds kInterval{100};

std::size_t terminal_columns() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size.ws_col - 1u : 79u;
}

}  // namespace

Progress::Progress(std::string task)
    : task_(std::move(task)),
      terminal_(isatty(STDERR_FILENO) == 1 && verbosity() != Verbosity::kQuiet),
      tells_(!terminal_ && verbosity() == Verbosity::kVerbose),
      begin_(std::chrono::steady_clock::now()) {
  if (tells_) fmt::print(stderr, "skyfit: {}\n", printable(task_));
  show(0);
}

Progress::~Progress() {
  if (terminal_) std::fputs("\r\033[K", stderr);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin_;
  if (tells_) fmt::print(stderr, "skyfit: {}: {:.2f} s\n", printable(task_), taken.count());
}

void Progress::show(double fraction, std::string_view status) {
  if (!terminal_) return;
  const std::lock_guard lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return;
  next_ = now + kInterval;
  const int done = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * kBarWidth);
  std::string line = fmt::format("{} [{:#<{}}{:.<{}}] {:3.0f} % {}", task_, "", done, "",
                                 kBarWidth - done, 100 * std::clamp(fraction, 0.0, 1.0), status);
  line.resize(std::min(line.size(), terminal_columns()));
  fmt::print(stderr, "\r{}\033[K", printable(line));
  std::fflush(stderr);
}

}  // namespace skyfit::cli
