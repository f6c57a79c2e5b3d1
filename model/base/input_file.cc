// SPDX-License-Identifier: Apache-2.0
#include "model/base/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace skyfit {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, std::string_view reason,
                       std::string_view expectation) {
  throw std::runtime_error(
      fmt::format("{}: cannot be read ({}), expected {}", file.string(), reason, expectation));
}

// The file, open, closed by the destructor. It does not wait for the writer of a pipe.
class OpenFile {
 public:
  OpenFile(const fs::path& file, std::string_view expectation, std::uintmax_t most_bytes)
      : number_(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY)) {
    if (number_ < 0) fail(file, std::strerror(errno), expectation);
    struct stat status;
    std::string reason;
    if (::fstat(number_, &status) != 0) {
      reason = std::strerror(errno);
    } else if (S_ISDIR(status.st_mode)) {
      reason = std::strerror(EISDIR);
    } else if (!S_ISREG(status.st_mode)) {
      reason = "it is a pipe or a device";
    } else if (static_cast<std::uintmax_t>(status.st_size) > most_bytes) {
      reason = too_large(most_bytes);
    }
    if (reason.empty()) return;
    ::close(number_);
    fail(file, reason, expectation);
  }
  ~OpenFile() { ::close(number_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  int number() const { return number_; }

  static std::string too_large(std::uintmax_t most_bytes) {
    return fmt::format("it is larger than {} MiB", most_bytes >> 20);
  }

 private:
  int number_;
};

std::string read_to_end(int number, const fs::path& shown, std::string_view expectation,
                        std::uintmax_t most_bytes) {
  std::string text;
  std::array<char, 1 << 16> block;
  for (;;) {
    const ssize_t count = ::read(number, block.data(), block.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(shown, std::strerror(errno), expectation);
    if (count == 0) return text;
    text.append(block.data(), static_cast<std::size_t>(count));
    // The files of /proc say that they are empty.
    if (text.size() > most_bytes) fail(shown, OpenFile::too_large(most_bytes), expectation);
  }
}

}  // namespace

void require_regular_file(const fs::path& file, std::string_view expectation,
                          std::uintmax_t most_bytes) {
  const OpenFile open(file, expectation, most_bytes);
}

std::string read_file(const fs::path& file, std::string_view expectation,
                      std::uintmax_t most_bytes) {
  const OpenFile open(file, expectation, most_bytes);
  return read_to_end(open.number(), file, expectation, most_bytes);
}

std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  return text.starts_with(kMark) ? text.substr(kMark.size()) : text;
}

std::string read_text_file(const fs::path& file, std::string_view expectation,
                           std::uintmax_t most_bytes) {
  return std::string(without_byte_order_mark(read_file(file, expectation, most_bytes)));
}

std::string read_stdin(std::string_view expectation, std::uintmax_t most_bytes) {
  return read_to_end(STDIN_FILENO, "stdin", expectation, most_bytes);
}

std::optional<fs::path> named_file(const fs::path& folder, std::string_view name,
                                   NamedFiles allowed) {
  if (name.empty() || name.find('\0') != std::string_view::npos) return {};
  const fs::path path(name);
  if (allowed == NamedFiles::kAnywhere) return folder / path;
  if (path.is_absolute() || std::ranges::count(path, "..") > 0) return {};
  std::error_code error;  // what is not there is refused by its reader
  const fs::path top = fs::weakly_canonical(folder.empty() ? "." : folder, error);
  const fs::path target = fs::weakly_canonical(top / path, error);
  if (std::ranges::mismatch(top, target).in1 != top.end()) return {};
  return folder / path;
}

}  // namespace skyfit
