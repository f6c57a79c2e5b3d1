// SPDX-License-Identifier: Apache-2.0
// Private directories for files that are not finished. Their names, .skyfit-PID-RANDOM, hold
// nothing of a user's text. They go with their owner: by the destructor, by the handler of a signal
// that ends the program, and after kill -9 when the next one is made in the same place. Whether an
// owner lives is told by a lock on the directory, which the system drops with the process.
#pragma once

#include <filesystem>

namespace skyfit {

class TemporaryDirectory {
 public:
  // In `parent`, or where the system keeps temporary files. Throws std::runtime_error
  // `parent: cannot be written: reason`.
  TemporaryDirectory();
  explicit TemporaryDirectory(const std::filesystem::path& parent);
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }  // absolute

 private:
  std::filesystem::path path_;
  int lock_ = -1;  // the open directory
  int slot_ = -1;  // in the list of those that a signal removes
};

// From now on SIGINT, SIGTERM and SIGHUP end the program with the exit status 128 + signal, after
// the child that runs has ended and all temporary directories are gone. A signal that is ignored
// stays ignored. A file that grows too large is an error of the writer instead of the signal
// SIGXFSZ.
void clean_up_on_signals();

}  // namespace skyfit
