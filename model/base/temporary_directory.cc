// SPDX-License-Identifier: Apache-2.0
#include "model/base/temporary_directory.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

#include "model/base/signal_cleanup.h"

namespace skyfit {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = ".skyfit-";

// An open directory, locked or not.
struct Claim {
  int directory = -1;  // -1: it is gone, or another process holds it
  bool locked = false;
};

// Some file systems know no locks: then nobody can claim what another may use.
Claim claim(const fs::path& directory) {
  const int open = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (open < 0) return {};
  if (::flock(open, LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK) return {open, false};
  } else {
    // Another process may have removed it, or put its own there, before the lock was taken.
    struct stat held, named;
    if (::fstat(open, &held) == 0 && ::lstat(directory.c_str(), &named) == 0 &&
        held.st_ino == named.st_ino && held.st_dev == named.st_dev)
      return {open, true};
  }
  ::close(open);
  return {};
}

// .skyfit-PID-RANDOM
bool is_ours(const fs::path& directory) {
  constexpr std::size_t kRandom = 6;
  const std::string file_name = directory.filename().string();
  std::string_view name = file_name;
  if (!name.starts_with(kPrefix)) return false;
  name.remove_prefix(kPrefix.size());
  const std::size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
  return digits > 0 && name.size() == digits + 1 + kRandom && name[digits] == '-';
}

// Removes those whose owner ended without doing so: theirs is the name, the user and no lock.
void remove_abandoned(const fs::path& parent) {
  std::error_code error;
  for (fs::directory_iterator entry(parent, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path path = entry->path();
    struct stat status;
    if (!is_ours(path) || ::lstat(path.c_str(), &status) != 0 || !S_ISDIR(status.st_mode) ||
        status.st_uid != ::geteuid())
      continue;
    const Claim claimed = claim(path);
    std::error_code ignored;  // the next run tries again
    if (claimed.locked) fs::remove_all(path, ignored);
    if (claimed.directory >= 0) ::close(claimed.directory);
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
    lock_ = claim(path_).directory;
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
