// SPDX-License-Identifier: Apache-2.0
// Outputs that appear whole or not at all.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace skyfit::cli {

// Throws std::runtime_error with one line when the file cannot be created in its folder; leaves
// nothing behind. Called before long work whose result goes there.
void require_writable_file(const std::filesystem::path& file);

// The same for every file of --out; throws UsageError where a name ends in none of `extensions` or
// a file is named twice.
void require_output_files(const std::vector<std::string>& files,
                          const std::vector<std::string>& extensions);

// A directory for a result that consists of known files.
class ResultDirectory {
 public:
  // Throws std::runtime_error with one line when `directory` holds anything but an earlier result
  // (some of `names`) and `force` is not set, is no directory, or cannot be written. Changes
  // nothing.
  ResultDirectory(std::filesystem::path directory, std::vector<std::string> names, bool force);

  // Calls `write` with an empty directory on the same file system, then moves the files written
  // there to their place: in one step where the directory is new or holds an earlier result only.
  // Other files (with force) stay.
  void publish(const std::function<void(const std::filesystem::path& staging)>& write) const;

 private:
  std::filesystem::path shown_;      // as the user names it
  std::filesystem::path directory_;  // absolute
  std::vector<std::string> names_;
};

// Figures of a result, which is published without those that cannot be drawn.
class Figures {
 public:
  // Calls `draw`; what it throws is kept.
  void draw(std::string_view name, const std::function<void()>& draw);
  // Throws std::runtime_error with one line that names the figures that are missing and why, so
  // that the exit status tells.
  void expect_all(const std::string& directory) const;

 private:
  std::vector<std::string> failures_;
};

// Writes text to a file; throws std::runtime_error with one line.
void write_text(const std::filesystem::path& file, std::string_view text);

// Writes text to stdout; finish_stdout() then throws std::runtime_error when not all of it could be
// written.
void print(std::string_view text);
void finish_stdout();

}  // namespace skyfit::cli
