// SPDX-License-Identifier: Apache-2.0
#include "model/base/content_cache.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include "model/base/program_identity.h"
#include "model/base/whole_file.h"

namespace skyfit {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kNameDigits = 32;  // of ContentHash::text()
constexpr std::uintmax_t kTrimShare = 16;

// An entry's file: this, the sizes of the parts, the parts. Byte order and layout are those of the
// program that the key names.
struct Head {
  std::array<char, 8> format = {'s', 'k', 'y', 'c', 'a', 'c', 'h', '2'};
  std::array<char, kNameDigits> checksum = {};  // of its name and all that follows
  std::uint64_t parts = 0;
};
constexpr std::uint64_t kMostParts = 64;

std::string_view view_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::array<char, kNameDigits> digits_of(const ContentHash& hash) {
  std::array<char, kNameDigits> digits;
  std::ranges::copy(hash.text(), digits.begin());
  return digits;
}

bool is_entry_name(std::string_view name) {
  return name.size() == kNameDigits && name.find_first_not_of("0123456789abcdef") == name.npos;
}

// An open file.
class Descriptor {
 public:
  explicit Descriptor(const fs::path& file)
      : number_(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  bool opened() const { return number_ >= 0; }

  // Of a regular file.
  std::optional<std::uint64_t> size() const {
    struct stat status;
    if (::fstat(number_, &status) != 0 || !S_ISREG(status.st_mode)) return {};
    return static_cast<std::uint64_t>(status.st_size);
  }

  // False where the file ends before or cannot be read.
  bool read(std::span<std::byte> to) const {
    while (!to.empty()) {
      const ssize_t count = ::read(number_, to.data(), to.size());
      if (count == 0 || (count < 0 && errno != EINTR)) return false;
      if (count > 0) to = to.subspan(static_cast<std::size_t>(count));
    }
    return true;
  }

  void note_use() const { ::futimens(number_, nullptr); }

 private:
  int number_;
};

// In steps that stay in the processor's cache for the sum.
bool read_part(const Descriptor& file, std::span<std::byte> to, ContentHash& sum) {
  constexpr std::size_t kStep = std::size_t{1} << 19;
  while (!to.empty()) {
    const std::span<std::byte> step = to.first(std::min(kStep, to.size()));
    if (!file.read(step)) return false;
    sum.add(view_of(step));
    to = to.subspan(step.size());
  }
  return true;
}

bool read_entry(const Descriptor& file, std::string_view name, const ContentCache::Room& room) {
  const Head expected;
  Head head;
  const auto size = file.size();
  if (!size || !file.read(std::as_writable_bytes(std::span(&head, 1)))) return false;
  if (head.format != expected.format || head.parts > kMostParts) return false;
  ContentHash sum;
  sum.add(name);
  std::vector<std::uint64_t> sizes(head.parts);
  if (!read_part(file, std::as_writable_bytes(std::span(sizes)), sum)) return false;
  std::uint64_t rest = *size - std::min<std::uint64_t>(*size, sizeof head + 8 * sizes.size());
  for (const std::uint64_t bytes : sizes) {
    if (bytes > rest) return false;
    rest -= bytes;
  }
  if (rest != 0) return false;
  for (std::size_t part = 0; part < sizes.size(); ++part) {
    const std::span<std::byte> to = room(part, sizes[part]);
    if (to.size() != sizes[part] || !read_part(file, to, sum)) return false;
  }
  return digits_of(sum) == head.checksum;
}

}  // namespace

CacheKey::CacheKey(std::string_view kind) { text(program_identity()).text(kind); }

CacheKey& CacheKey::text(std::string_view text) {
  const std::uint64_t size = text.size();  // so that "ab", "c" is not "a", "bc"
  hash_.add({reinterpret_cast<const char*>(&size), sizeof size});
  hash_.add(text);
  return *this;
}

ContentCache::ContentCache(fs::path directory, std::uintmax_t limit_bytes)
    : directory_(std::move(directory)), limit_bytes_(limit_bytes) {
  if (!program_identity().empty()) return;
  writable_ = false;
  note("not used: this build of skyfit has no identifier");
}

ContentCache::~ContentCache() {
  if (written_bytes_ > 0) trim();
}

void ContentCache::note(std::string_view trouble) {
  if (!trouble_) trouble_ = fmt::format("{}: {}", directory_.string(), trouble);
}

std::optional<std::string> ContentCache::trouble() const {
  const std::scoped_lock lock(mutex_);
  return trouble_;
}

// Whether entries may be read; under the lock.
bool ContentCache::is_usable() {
  if (usable_ || program_identity().empty()) return usable_;
  struct stat status;
  if (::stat(directory_.c_str(), &status) != 0) {
    if (errno != ENOENT) note(fmt::format("cannot be read: {}", std::strerror(errno)));
  } else if (!S_ISDIR(status.st_mode)) {
    note("expected a directory");
  } else if (status.st_uid != ::geteuid() || (status.st_mode & (S_IWGRP | S_IWOTH)) != 0) {
    note("not used: others can write to it; expected a directory of this user alone");
  } else {
    usable_ = true;
  }
  return usable_;
}

// The same for writing; makes the directory.
bool ContentCache::make_writable() {
  if (temporary_ || !writable_) return writable_;
  fs::path made;
  for (const fs::path& name : directory_) {
    made /= name;
    ::mkdir(made.c_str(), 0700);  // what matters is whether it is there in the end
  }
  writable_ = false;
  if (!is_usable()) {
    note("cannot be made");
    return false;
  }
  try {
    temporary_.emplace(directory_);
    writable_ = true;
  } catch (const std::runtime_error& error) {
    if (!trouble_) trouble_ = error.what();
  }
  return writable_;
}

bool ContentCache::find(const CacheKey& key, const Room& room) {
  {
    const std::scoped_lock lock(mutex_);
    if (!is_usable()) return false;
  }
  const Descriptor file(directory_ / key.name());
  if (!file.opened() || !read_entry(file, key.name(), room)) return false;
  file.note_use();
  return true;
}

void ContentCache::keep(const CacheKey& key, const std::vector<std::span<const std::byte>>& parts) {
  std::uintmax_t bytes = 0;
  std::vector<std::uint64_t> sizes;
  for (const auto part : parts) {
    sizes.push_back(part.size());
    bytes += part.size();
  }
  if (bytes > limit_bytes_ / 4) return;  // it would leave no room for others
  fs::path temporary;
  {
    const std::scoped_lock lock(mutex_);
    if (!make_writable()) return;
    temporary = temporary_->path() / fmt::to_string(temporaries_++);
  }
  Head head;
  head.parts = parts.size();
  ContentHash sum;
  sum.add(key.name());
  std::vector<std::string_view> texts = {view_of(std::as_bytes(std::span(&head, 1))),
                                         view_of(std::as_bytes(std::span(sizes)))};
  sum.add(texts.back());
  for (const auto part : parts) {
    texts.push_back(view_of(part));
    sum.add(texts.back());
  }
  head.checksum = digits_of(sum);
  std::error_code ignored;
  try {
    write_losable_file(temporary, texts);
    fs::permissions(temporary, fs::perms::owner_read | fs::perms::owner_write);
    fs::rename(temporary, directory_ / key.name());
  } catch (const std::runtime_error& error) {
    fs::remove(temporary, ignored);
    const std::scoped_lock lock(mutex_);
    writable_ = false;
    const std::string_view message = error.what();  // path: what: reason
    note(fmt::format("cannot be written: {}", message.substr(message.rfind(": ") + 2)));
    return;
  }
  const std::scoped_lock lock(mutex_);
  written_bytes_ += bytes;
  if (written_bytes_ > limit_bytes_ / kTrimShare) trim();
}

// Files of other names are not ours.
std::vector<ContentCache::Entry> ContentCache::entries() const {
  std::vector<Entry> found;
  std::error_code error;
  for (fs::directory_iterator file(directory_, error), end; !error && file != end;
       file.increment(error)) {
    std::error_code gone;  // another process may remove what this one looks at
    if (!is_entry_name(file->path().filename().string()) || !file->is_regular_file(gone)) continue;
    const fs::file_time_type used = file->last_write_time(gone);
    const std::uintmax_t bytes = gone ? 0 : file->file_size(gone);
    if (!gone) found.push_back({file->path(), used, bytes});
  }
  return found;
}

void ContentCache::trim() {
  written_bytes_ = 0;
  std::vector<Entry> all = entries();
  std::uintmax_t bytes = 0;
  for (const Entry& entry : all) bytes += entry.bytes;
  std::ranges::sort(all, {}, &Entry::used);
  for (const Entry& entry : all) {
    if (bytes <= limit_bytes_) return;
    std::error_code ignored;  // it is gone already, or stays until the next time
    fs::remove(entry.file, ignored);
    bytes -= entry.bytes;
  }
}

ContentCache::Usage ContentCache::usage() const {
  Usage sum;
  for (const Entry& entry : entries()) {
    ++sum.entries;
    sum.bytes += entry.bytes;
  }
  return sum;
}

std::optional<fs::path> user_cache_directory() {
  const auto absolute = [](const char* name) -> std::optional<fs::path> {
    const char* value = std::getenv(name);
    if (value == nullptr || !fs::path(value).is_absolute()) return {};
    return fs::path(value);
  };
  if (const auto cache = absolute("XDG_CACHE_HOME")) return *cache / "skyfit";
  if (const auto home = absolute("HOME")) return *home / ".cache" / "skyfit";
  return {};
}

}  // namespace skyfit
