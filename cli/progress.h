// SPDX-License-Identifier: Apache-2.0
// A bar on stderr for long work, drawn on a terminal; elsewhere nothing, or with --verbose a line
// when it begins and when it ends.
#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <string_view>

namespace skyfit::cli {

class Progress {
 public:
  explicit Progress(std::string task);
  ~Progress();  // wipes the bar
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // fraction 0..1; drawn at most ten times a second. May be called from several threads.
  void show(double fraction, std::string_view status = {});

 private:
  std::string task_;
  bool terminal_, tells_;
  std::chrono::steady_clock::time_point begin_;
  std::mutex mutex_;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace skyfit::cli
