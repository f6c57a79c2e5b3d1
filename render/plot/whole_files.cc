// SPDX-License-Identifier: Apache-2.0
#include "render/plot/whole_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace skyfit::plot {
namespace {

std::runtime_error cannot_write(const std::filesystem::path& file, std::string_view reason) {
  return std::runtime_error(fmt::format("{}: cannot write: {}", file.string(), reason));
}

// Leading dot and process id: hidden, and no two programs meet.
std::filesystem::path temporary_beside(const std::filesystem::path& target) {
  const std::string name =
      fmt::format(".{}.{}{}", target.stem().string(), ::getpid(), target.extension().string());
  return target.parent_path() / name;
}

}  // namespace

WholeFiles::WholeFiles(std::vector<std::filesystem::path> targets) : targets_(std::move(targets)) {
  for (const auto& target : targets_) {
    const auto temporary = temporary_beside(target);
    const bool is_folder = std::filesystem::is_directory(target);
    const int file =
        is_folder ? -1 : ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file < 0) {
      const std::string reason = std::strerror(is_folder ? EISDIR : errno);
      remove_temporaries();
      throw cannot_write(target, reason);
    }
    ::close(file);
    temporaries_.push_back(temporary);
  }
}

WholeFiles::~WholeFiles() { remove_temporaries(); }

void WholeFiles::commit() {
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    std::error_code error;
    std::filesystem::rename(temporaries_[i], targets_[i], error);
    if (error) throw cannot_write(targets_[i], error.message());
  }
  temporaries_.clear();
}

void WholeFiles::remove_temporaries() noexcept {
  for (const auto& temporary : temporaries_) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
  }
}

}  // namespace skyfit::plot
