// SPDX-License-Identifier: Apache-2.0
// Results that are computed again and again, in files of a directory: found by everything that they
// follow from and by the program that computes them. A cache never fails: what cannot be read is
// computed, what cannot be written is left out.
//
// An entry is a file, named by its key. It appears whole, under its name, after a private temporary
// one; a reader checks its length and a checksum and takes a damaged one for none. So any number of
// processes may share a directory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "model/base/content_hash.h"
#include "model/base/temporary_directory.h"

namespace skyfit {

// What an entry follows from, one thing after the other, and program_identity().
class CacheKey {
 public:
  explicit CacheKey(std::string_view kind);
  CacheKey& text(std::string_view text);

  // All bytes of a value without padding.
  template <class T>
  CacheKey& value(const T& value) {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
    return text({reinterpret_cast<const char*>(&value), sizeof value});
  }

  std::string name() const { return hash_.text(); }

 private:
  ContentHash hash_;
};

class ContentCache {
 public:
  // Of all entries together. More only while runs are writing: each a sixteenth of it, or an entry,
  // before it removes what was used longest ago.
  static constexpr std::uintmax_t kLimitBytes = 2000000000;

  // Nothing is made before the first entry. Only in a directory of this user, which others cannot
  // write to.
  explicit ContentCache(std::filesystem::path directory, std::uintmax_t limit_bytes = kLimitBytes);
  virtual ~ContentCache();
  ContentCache(const ContentCache&) = delete;
  ContentCache& operator=(const ContentCache&) = delete;

  // An entry is a list of parts. `room` gives the memory for a part of so many bytes, or a span of
  // another size where the entry cannot be what was kept. False, and nothing of use in that memory,
  // where there is no such entry. May be called from several threads, as keep(). Virtual, so that
  // modules call the program's.
  using Room = std::function<std::span<std::byte>(std::size_t part, std::uint64_t bytes)>;
  virtual bool find(const CacheKey& key, const Room& room);

  // Not what would take more than a quarter of the limit.
  virtual void keep(const CacheKey& key, const std::vector<std::span<const std::byte>>& parts);

  // What first kept this object from reading or writing entries, in one line that names the
  // directory; a missing entry is none.
  std::optional<std::string> trouble() const;

  struct Usage {
    std::uintmax_t entries = 0, bytes = 0;
  };
  Usage usage() const;
  const std::filesystem::path& directory() const { return directory_; }
  std::uintmax_t limit_bytes() const { return limit_bytes_; }

 private:
  bool is_usable();
  bool make_writable();
  void note(std::string_view trouble);
  void trim();
  struct Entry {
    std::filesystem::path file;
    std::filesystem::file_time_type used;
    std::uintmax_t bytes;
  };
  std::vector<Entry> entries() const;

  const std::filesystem::path directory_;
  const std::uintmax_t limit_bytes_;
  mutable std::mutex mutex_;  // of what follows
  std::optional<std::string> trouble_;
  bool usable_ = false, writable_ = true;
  std::optional<TemporaryDirectory> temporary_;  // for entries that are being written
  std::uint64_t temporaries_ = 0;
  std::uintmax_t written_bytes_ = 0;  // since the last trim()
};

// $XDG_CACHE_HOME/skyfit, or $HOME/.cache/skyfit; nothing where neither is an absolute path (XDG
// Base Directory Specification 0.8).
std::optional<std::filesystem::path> user_cache_directory();
inline constexpr const char* kNoCachePlace = "neither XDG_CACHE_HOME nor HOME is an absolute path";

}  // namespace skyfit
