// SPDX-License-Identifier: Apache-2.0
// Files and directories that appear whole or not at all: they are made in a private directory on
// the same file system, forced to the disk, and moved to their place. Every function throws
// std::runtime_error with one line that starts with the path as its caller named it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/base/temporary_directory.h"

namespace skyfit {

// Whether a name stands for the standard output: "-" with the extension of what goes there, as in
// "-.png". It is made like a file and written there as a whole.
bool is_stdout(const std::filesystem::path& file);

// Several files that are published together. The names of the temporary ones are our own, with the
// target's extension, so that a program that draws or encodes them sees no text of a user.
class WholeFiles {
 public:
  // Throws when a target cannot be written, and leaves nothing behind.
  explicit WholeFiles(std::vector<std::filesystem::path> targets);

  // Absolute; nothing is there yet.
  const std::filesystem::path& temporary(std::size_t index) const { return temporaries_[index]; }

  // Writes one of them: bytes, or what a function leaves under the temporary name, which is
  // replaced by the target in the message of a std::runtime_error.
  void write(std::size_t index, std::string_view bytes) const;
  void make(std::size_t index,
            const std::function<void(const std::filesystem::path& temporary)>& write) const;
  // What cannot be written, with the name of the target.
  [[noreturn]] void fail(std::size_t index, std::string_view reason) const;

  // Moves all of them to their targets. Throws when one was not written.
  void publish();

 private:
  std::map<std::filesystem::path, std::optional<TemporaryDirectory>> directories_;  // by folder
  std::vector<std::filesystem::path> targets_, temporaries_;
};

void write_whole_file(const std::filesystem::path& file, std::string_view bytes);

// Not atomic: for files inside of a staging directory.
void write_file(const std::filesystem::path& file, std::string_view bytes);
// The same of parts, one after the other, and not forced to the disk: for what may be lost.
void write_losable_file(const std::filesystem::path& file, std::span<const std::string_view> parts);

// Throws when the file cannot be created in its folder, or its name is that of something that is no
// file; leaves nothing behind. Called before long work whose result goes there.
void require_writable_file(const std::filesystem::path& file);

// The absolute path without trailing slash, dot or link.
std::filesystem::path resolved_path(const std::filesystem::path& path);

// A directory for a result that consists of known files.
class WholeDirectory {
 public:
  // Throws when `directory` holds anything but an earlier result (some of `names`) and `force` is
  // not set, is no directory, or cannot be written. Changes nothing.
  WholeDirectory(std::filesystem::path directory, std::vector<std::string> names, bool force);

  // Calls `write` with an empty directory on the same file system, then moves the files written
  // there to their place: in one step where the directory is new or holds an earlier result only.
  // Other files (with force) stay. What `write` throws names no temporary path: it is replaced by
  // the directory as the user names it.
  void publish(const std::function<void(const std::filesystem::path& staging)>& write) const;

 private:
  std::filesystem::path shown_;      // as the user names it
  std::filesystem::path directory_;  // absolute
  std::vector<std::string> names_;
};

}  // namespace skyfit
