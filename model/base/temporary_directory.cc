// SPDX-License-Identifier: Apache-2.0
#include "model/base/temporary_directory.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>
#include <system_error>

#include "model/base/signal_cleanup.h"

namespace skyfit {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = ".skyfit-";

// The directory, open and locked, or -1 when it is gone or another process holds it.
int locked(const fs::path& directory) {
  const int open = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (open < 0) return -1;
  struct stat held, named;
  // Another process may have removed it, or put its own there, before the lock was taken.
  if (::flock(open, LOCK_EX | LOCK_NB) == 0 && ::fstat(open, &held) == 0 &&
      ::lstat(directory.c_str(), &named) == 0 && held.st_ino == named.st_ino &&
      held.st_dev == named.st_dev)
    return open;
  ::close(open);
  return -1;
}

// Removes those whose owner ended without doing so: theirs is the name, the user and no lock.
void remove_abandoned(const fs::path& parent) {
  std::error_code error;
  for (fs::directory_iterator entry(parent, error), end; !error && entry != end;
       entry.increment(error)) {
    if (!entry->path().filename().string().starts_with(kPrefix)) continue;
    struct stat status;
    if (::lstat(entry->path().c_str(), &status) != 0 || !S_ISDIR(status.st_mode) ||
        status.st_uid != ::geteuid())
      continue;
    const int lock = locked(entry->path());
    if (lock < 0) continue;
    std::error_code ignored;  // the next run tries again
    fs::remove_all(entry->path(), ignored);
    ::close(lock);
  }
}

}  // namespace

TemporaryDirectory::TemporaryDirectory() : TemporaryDirectory(fs::temp_directory_path()) {}

TemporaryDirectory::TemporaryDirectory(const fs::path& parent) {
  const fs::path folder = fs::absolute(parent);
  remove_abandoned(folder);
  // A run beside this one may take a new directory for an abandoned one before it is locked.
  constexpr int kTries = 100;
  for (int tries = 0; lock_ < 0 && tries < kTries; ++tries) {
    std::string name = (folder / fmt::format("{}{}-XXXXXX", kPrefix, ::getpid())).string();
    if (::mkdtemp(name.data()) == nullptr)
      throw std::runtime_error(
          fmt::format("{}: cannot be written: {}", parent.string(), std::strerror(errno)));
    path_ = name;
    lock_ = locked(path_);
  }
  if (lock_ < 0)
    throw std::runtime_error(fmt::format(
        "{}: cannot be written: no temporary directory can be locked there", parent.string()));
  slot_ = signal_cleanup::add_directory(path_.c_str());
}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code ignored;  // the next run in this place tries again
  fs::remove_all(path_, ignored);
  signal_cleanup::remove_directory(slot_);
  ::close(lock_);
}

}  // namespace skyfit
