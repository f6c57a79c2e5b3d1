// SPDX-License-Identifier: Apache-2.0
#include "cli/output.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <set>
#include <stdexcept>
#include <system_error>

#include "cli/arguments.h"

namespace skyfit::cli {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const fs::path& path, std::string_view what) {
  throw std::runtime_error(fmt::format("{}: {}", path.string(), what));
}

// The nearest folder above that exists.
fs::path existing_parent(fs::path path) {
  do path = path.parent_path();
  while (!fs::exists(path));
  return path;
}

// A new empty directory in the nearest existing folder above `target`, removed with what is left in
// it.
class StagingDirectory {
 public:
  StagingDirectory(const fs::path& shown, const fs::path& target) {
    std::string name = fmt::format("{}/.{}.partial-XXXXXX", existing_parent(target).string(),
                                   target.filename().string());
    if (mkdtemp(name.data()) == nullptr) {
      fail(shown, fmt::format("cannot be written: {}", std::strerror(errno)));
    }
    path_ = name;
  }
  ~StagingDirectory() {
    std::error_code
        ignored;  // a destructor cannot report it, and the result is in place or was never made
    fs::remove_all(path_, ignored);
  }
  StagingDirectory(const StagingDirectory&) = delete;
  StagingDirectory& operator=(const StagingDirectory&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// The path without trailing slash, dot or link.
fs::path resolved(const fs::path& path) {
  if (path.empty()) throw std::runtime_error("--out \"\": expected a name");
  const fs::path absolute = fs::weakly_canonical(fs::absolute(path));
  return absolute.has_filename() ? absolute : absolute.parent_path();
}

// "a, b or c"
std::string either(const std::vector<std::string>& words) {
  const auto last = words.end() - 1;
  return fmt::format("{} or {}", fmt::join(words.begin(), last, ", "), *last);
}

// What mkdir(2) would give a new directory, instead of the 0700 of a temporary one.
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

}  // namespace

void require_writable_file(const fs::path& file) {
  if (file.filename().empty() || fs::is_directory(file)) {
    fail(file, "expected the name of a file, this is a directory");
  }
  const fs::path path = resolved(file);
  if (!fs::exists(path.parent_path())) fail(file, "cannot be written: its folder does not exist");
  const StagingDirectory probe(file, path);
}

void require_output_files(const std::vector<std::string>& files,
                          const std::vector<std::string>& extensions) {
  std::set<fs::path> seen;
  for (const std::string& file : files) {
    if (std::ranges::count(extensions, fs::path(file).extension().string()) == 0) {
      throw UsageError("--out", file, "expected a name that ends in " + either(extensions));
    }
    require_writable_file(file);
    if (!seen.insert(resolved(file)).second) {
      throw UsageError("--out", file, "expected each file once");
    }
  }
}

ResultDirectory::ResultDirectory(fs::path directory, std::vector<std::string> names, bool force)
    : shown_(std::move(directory)), directory_(resolved(shown_)), names_(std::move(names)) {
  if (fs::exists(directory_)) {
    if (!fs::is_directory(directory_)) fail(shown_, "expected a directory, this is a file");
    const std::string foreign = foreign_file(directory_, names_);
    if (!foreign.empty() && !force) {
      fail(shown_, fmt::format("holds {}, which no earlier result left: expected a new or empty "
                               "directory, or --force",
                               foreign));
    }
    const StagingDirectory probe(shown_, directory_ / "inside");
  }
  const StagingDirectory probe(shown_, directory_);
}

void ResultDirectory::publish(const std::function<void(const fs::path&)>& write) const {
  const StagingDirectory staging(shown_, directory_);
  write(staging.path());
  give_usual_permissions(staging.path());
  if (!fs::exists(directory_)) {
    fs::create_directories(directory_.parent_path());
    fs::rename(staging.path(), directory_);
    return;
  }
  // A shell that stands in the directory would be left in the old one.
  const bool replaceable =
      foreign_file(directory_, names_).empty() && !fs::equivalent(directory_, fs::current_path());
  if (replaceable && exchange(staging.path(), directory_)) return;
  for (const std::string& name : names_) {
    if (fs::exists(staging.path() / name)) {
      fs::rename(staging.path() / name, directory_ / name);
    } else {
      fs::remove(directory_ / name);
    }
  }
}

void Figures::draw(std::string_view name, const std::function<void()>& draw) {
  try {
    draw();
  } catch (const std::exception& error) {
    failures_.push_back(fmt::format("{} ({})", name, error.what()));
  }
}

void Figures::expect_all(const std::string& directory) const {
  if (failures_.empty()) return;
  throw std::runtime_error(
      fmt::format("{}: the result is complete but for figures that could not be "
                  "drawn: {}",
                  directory, fmt::join(failures_, ", ")));
}

void write_text(const fs::path& file, std::string_view text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (!out) fail(file, "cannot be written");
}

void print(std::string_view text) { std::fwrite(text.data(), 1, text.size(), stdout); }

void finish_stdout() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    throw std::runtime_error("stdout: not everything could be written");
  }
}

}  // namespace skyfit::cli
