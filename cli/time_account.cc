// SPDX-License-Identifier: Apache-2.0
#include "cli/time_account.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <sstream>

namespace skyfit::cli {
namespace {

// Since the process was started, which the system knows to a hundredth of a second; 0 where it does
// not say.
double process_age_s() {
  std::ifstream file("/proc/self/stat");
  std::string line;
  std::getline(file, line);
  // Behind the name, which may hold anything, in parentheses: fields from the third on. The start
  // is the 22nd, in ticks since the boot.
  constexpr int kFirst = 3, kStart = 22;
  std::istringstream fields(line.substr(std::min(line.rfind(')') + 1, line.size())));
  std::string field;
  for (int i = kFirst; i <= kStart; ++i) fields >> field;
  timespec now{};
  if (!fields || ::clock_gettime(CLOCK_BOOTTIME, &now) != 0) return 0;
  const double start = std::stod(field) / static_cast<double>(::sysconf(_SC_CLK_TCK));
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec) - start;
}

}  // namespace

TimeAccount::TimeAccount() : before_s_(process_age_s()) { add("start", before_s_); }

double TimeAccount::elapsed() {
  const Clock::time_point now = Clock::now();
  const std::chrono::duration<double> passed = now - last_;
  last_ = now;
  return passed.count();
}

void TimeAccount::add(std::string_view step, double seconds) {
  auto found = std::ranges::find(steps_, step, &std::pair<std::string, double>::first);
  if (found == steps_.end()) found = steps_.insert(found, {std::string(step), 0.0});
  found->second += seconds;
}

void TimeAccount::done(std::string_view step) { done(step, {}); }

void TimeAccount::done(std::string_view step, std::span<const PassTime> parts) {
  double rest = elapsed();
  for (const PassTime& part : parts) {
    add(part.pass, 1e-3 * part.milliseconds);
    rest -= 1e-3 * part.milliseconds;
  }
  add(step, rest);
}

std::string TimeAccount::table() const {
  const std::chrono::duration<double> since = Clock::now() - made_;
  const double total = before_s_ + since.count();
  const auto row = [&](std::string_view step, double seconds) {
    return fmt::format("  {:<32} {:>8.3f} s {:>5.1f} %\n", step, seconds, 100 * seconds / total);
  };
  std::string text = "wall time since the start of the process\n";
  double rest = total;
  for (const auto& [step, seconds] : steps_) {
    text += row(step, seconds);
    rest -= seconds;
  }
  return text + row("rest", rest) + row("total", total);
}

}  // namespace skyfit::cli
