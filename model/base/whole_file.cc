// SPDX-License-Identifier: Apache-2.0
#include "model/base/whole_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "model/base/input_file.h"

namespace skyfit {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, std::string_view what) {
  throw std::runtime_error(fmt::format("{}: {}", path.string(), what));
}

[[noreturn]] void fail_to_write(const fs::path& path, std::string_view reason) {
  fail(path, fmt::format("cannot be written: {}", reason));
}

// The nearest folder above that exists.
fs::path existing_parent(fs::path path) {
  do path = path.parent_path();
  while (!fs::exists(path));
  return path;
}

// A private directory in `folder`; `shown` is named when there can be none.
void make_private(const fs::path& shown, const fs::path& folder,
                  std::optional<TemporaryDirectory>& directory) {
  try {
    directory.emplace(folder);
  } catch (const std::runtime_error& error) {
    fail(shown, std::string_view(error.what()).substr(folder.string().size() + 2));
  }
}

// The error number of forcing a file to the disk, or 0. A quota or a full disk of a server may show
// here first.
int sync_error(const fs::path& file) {
  const int number = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (number < 0) return errno;
  const int failed = ::fsync(number) != 0 ? errno : 0;
  const int closed = ::close(number) != 0 ? errno : 0;
  return failed != 0 ? failed : closed;
}

// The error number of writing all of it, or 0.
int write_error(int number, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(number, bytes.data(), bytes.size());
    if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
    if (count < 0 && errno != EINTR) return errno;
  }
  return 0;
}

// The error number of writing, forcing to the disk if `sync`, and closing, or 0.
int write_error(const fs::path& file, std::span<const std::string_view> parts, bool sync) {
  const int number = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (number < 0) return errno;
  int failed = 0;
  for (const std::string_view bytes : parts) {
    if (failed == 0) failed = write_error(number, bytes);
  }
  if (sync && failed == 0 && ::fsync(number) != 0 && errno != EINVAL) failed = errno;
  const int closed = ::close(number) != 0 ? errno : 0;
  return failed != 0 ? failed : closed;
}

// What mkdir(2) would give a new directory, instead of the 0700 of a private one.
void give_usual_permissions(const fs::path& directory) {
  const mode_t mask = umask(0);
  umask(mask);
  fs::permissions(directory, static_cast<fs::perms>(0777 & ~mask));
}

// The name of a file in the directory that is not one of `names`, or "".
std::string foreign_file(const fs::path& directory, const std::vector<std::string>& names) {
  for (const auto& entry : fs::directory_iterator(directory)) {
    const std::string name = entry.path().filename().string();
    if (std::ranges::count(names, name) == 0 || !entry.is_regular_file()) return name;
  }
  return {};
}

// Swaps two directories in one step; false where the system cannot.
bool exchange(const fs::path& a, const fs::path& b) {
  return renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0;
}

// Where a target must be a file or nothing. A pipe or a device would be replaced by the file.
void require_file_name(const fs::path& file) {
  if (is_stdout(file)) return;
  std::error_code error;
  if (file.filename().empty() || fs::is_directory(file, error))
    fail(file, "expected the name of a file, this is a directory");
  if (fs::exists(file, error) && !fs::is_regular_file(file, error))
    fail(file, "expected the name of a file, this is a pipe or a device");
}

std::string with_user_path(std::string message, const fs::path& staging, const fs::path& shown) {
  const std::string hidden = staging.string();
  for (std::size_t at = 0; (at = message.find(hidden, at)) != message.npos;)
    message.replace(at, hidden.size(), shown.string());
  return message;
}

}  // namespace

fs::path resolved_path(const fs::path& path) {
  if (path.empty()) throw std::runtime_error("--out \"\": expected a name");
  const fs::path absolute = fs::weakly_canonical(fs::absolute(path));
  return absolute.has_filename() ? absolute : absolute.parent_path();
}

bool is_stdout(const fs::path& file) { return !file.has_parent_path() && file.stem() == "-"; }

WholeFiles::WholeFiles(std::vector<fs::path> targets) : targets_(std::move(targets)) {
  for (const fs::path& target : targets_) {
    require_file_name(target);
    const fs::path folder =
        is_stdout(target) ? fs::temp_directory_path() : fs::absolute(target).parent_path();
    auto& directory = directories_[folder];
    if (!directory) make_private(target, folder, directory);
    temporaries_.push_back(directory->path() /
                           fmt::format("{}{}", temporaries_.size(), target.extension().string()));
  }
}

void WholeFiles::write(std::size_t index, std::string_view bytes) const {
  if (const int error = write_error(temporaries_[index], {&bytes, 1}, true); error != 0)
    fail(index, std::strerror(error));
}

void WholeFiles::make(std::size_t index, const std::function<void(const fs::path&)>& write) const {
  try {
    write(temporaries_[index]);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(with_user_path(error.what(), temporaries_[index], targets_[index]));
  }
}

void WholeFiles::fail(std::size_t index, std::string_view reason) const {
  fail_to_write(targets_[index], reason);
}

void WholeFiles::publish() {
  for (std::size_t i = 0; i < targets_.size(); ++i)
    if (const int error = sync_error(temporaries_[i]); error != 0) fail(i, std::strerror(error));
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    if (is_stdout(targets_[i])) {
      const std::string bytes = read_file(temporaries_[i], "what was written", kMostImageBytes);
      if (const int error = write_error(STDOUT_FILENO, bytes); error != 0)
        fail(i, std::strerror(error));
      continue;
    }
    std::error_code error;
    fs::rename(temporaries_[i], targets_[i], error);
    if (error) fail(i, error.message());
  }
}

void write_whole_file(const fs::path& file, std::string_view bytes) {
  WholeFiles whole({file});
  whole.write(0, bytes);
  whole.publish();
}

void write_file(const fs::path& file, std::string_view bytes) {
  if (const int error = write_error(file, {&bytes, 1}, true); error != 0)
    fail_to_write(file, std::strerror(error));
}

void write_losable_file(const fs::path& file, std::span<const std::string_view> parts) {
  if (const int error = write_error(file, parts, false); error != 0)
    fail_to_write(file, std::strerror(error));
}

void require_writable_file(const fs::path& file) {
  require_file_name(file);
  if (is_stdout(file)) return;
  const fs::path path = resolved_path(file);
  if (!fs::exists(path.parent_path())) fail(file, "cannot be written: its folder does not exist");
  std::optional<TemporaryDirectory> probe;
  make_private(file, path.parent_path(), probe);
}

WholeDirectory::WholeDirectory(fs::path directory, std::vector<std::string> names, bool force)
    : shown_(std::move(directory)), directory_(resolved_path(shown_)), names_(std::move(names)) {
  if (fs::exists(directory_)) {
    if (!fs::is_directory(directory_)) fail(shown_, "expected a directory, this is a file");
    std::optional<TemporaryDirectory> probe;
    make_private(shown_, directory_, probe);  // what a killed run left there is no stranger's
    probe.reset();
    const std::string foreign = foreign_file(directory_, names_);
    if (!foreign.empty() && !force) {
      fail(shown_, fmt::format("holds {}, which no earlier result left: expected a new or empty "
                               "directory, or --force",
                               foreign));
    }
  }
  std::optional<TemporaryDirectory> probe;
  make_private(shown_, existing_parent(directory_), probe);
}

void WholeDirectory::publish(const std::function<void(const fs::path&)>& write) const {
  std::optional<TemporaryDirectory> temporary;
  make_private(shown_, existing_parent(directory_), temporary);
  const fs::path staging = temporary->path() / "result";
  fs::create_directory(staging);
  try {
    write(staging);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(with_user_path(error.what(), staging, shown_));
  }
  give_usual_permissions(staging);
  if (!fs::exists(directory_)) {
    std::error_code error;
    fs::create_directories(directory_.parent_path(), error);
    if (!error) fs::rename(staging, directory_, error);
    if (error) fail_to_write(shown_, error.message());
    return;
  }
  // A shell that stands in the directory would be left in the old one.
  const bool replaceable =
      foreign_file(directory_, names_).empty() && !fs::equivalent(directory_, fs::current_path());
  if (replaceable && exchange(staging, directory_)) return;
  for (const std::string& name : names_) {
    if (fs::exists(staging / name)) {
      fs::rename(staging / name, directory_ / name);
    } else {
      fs::remove(directory_ / name);
    }
  }
}

}  // namespace skyfit
