// SPDX-License-Identifier: Apache-2.0
// Files that appear whole or not at all: written under a temporary name beside the target, then
// renamed together.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace skyfit::plot {

// Creates one empty temporary file per target (same folder, same extension). commit() moves all of
// them to their targets; without it the destructor removes them.
class WholeFiles {
 public:
  // Throws std::runtime_error `file: cannot write: reason`, and leaves nothing behind, when a
  // target cannot be written.
  explicit WholeFiles(std::vector<std::filesystem::path> targets);
  ~WholeFiles();
  WholeFiles(const WholeFiles&) = delete;
  WholeFiles& operator=(const WholeFiles&) = delete;

  const std::filesystem::path& temporary(std::size_t target) const { return temporaries_[target]; }
  void commit();  // throws std::runtime_error as the constructor does

 private:
  void remove_temporaries() noexcept;
  std::vector<std::filesystem::path> targets_, temporaries_;
};

}  // namespace skyfit::plot
