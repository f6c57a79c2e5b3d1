// SPDX-License-Identifier: Apache-2.0
// A cache gives back the bytes that were kept under a key, or nothing: not those of another key,
// nor damaged ones; it stays within its limit, and trouble with its directory is no error.
#include "model/base/content_cache.h"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

namespace skyfit {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Optional;
using ::testing::StartsWith;

using Parts = std::vector<std::string>;

CacheKey key_of(std::string_view name) {
  CacheKey key("test");
  key.text(name);
  return key;
}

void keep(ContentCache& cache, std::string_view name, const Parts& parts) {
  std::vector<std::span<const std::byte>> bytes;
  for (const std::string& part : parts) bytes.push_back(std::as_bytes(std::span(part)));
  cache.keep(key_of(name), bytes);
}

std::optional<Parts> find(ContentCache& cache, std::string_view name) {
  Parts parts;
  const auto room = [&](std::size_t part, std::uint64_t bytes) {
    EXPECT_EQ(part, parts.size());
    parts.emplace_back(bytes, '?');
    return std::as_writable_bytes(std::span(parts.back()));
  };
  if (!cache.find(key_of(name), room)) return {};
  return parts;
}

class ContentCacheTest : public ::testing::Test {
 protected:
  fs::path file_of(std::string_view name) const { return directory_ / key_of(name).name(); }
  std::string bytes_of(std::string_view name) const {
    std::ostringstream text;
    text << std::ifstream(file_of(name), std::ios::binary).rdbuf();
    return text.str();
  }
  void overwrite(std::string_view name, const std::string& bytes) const {
    std::ofstream(file_of(name), std::ios::binary | std::ios::trunc) << bytes;
  }

  const TemporaryDirectory folder_;
  const fs::path directory_ = folder_.path() / "caches" / "skyfit";
};

const Parts kParts = {"ab", "", std::string(3000, 'x') + std::string("\0y", 2)};

TEST_F(ContentCacheTest, AnotherProcessFindsWhatWasKept) {
  ContentCache writer(directory_);
  EXPECT_FALSE(find(writer, "a"));
  EXPECT_FALSE(fs::exists(directory_)) << "made by looking";
  keep(writer, "a", kParts);
  ContentCache reader(directory_);
  EXPECT_THAT(find(reader, "a"), Optional(kParts));
  EXPECT_FALSE(find(reader, "b"));
  EXPECT_EQ(writer.trouble(), std::nullopt);
  EXPECT_EQ(reader.usage().entries, 1u);
  EXPECT_EQ(reader.usage().bytes, fs::file_size(file_of("a")));
}

TEST_F(ContentCacheTest, NobodyElseCanRead) {
  ContentCache cache(directory_);
  keep(cache, "a", kParts);
  EXPECT_EQ(fs::status(directory_).permissions(), fs::perms::owner_all);
  EXPECT_EQ(fs::status(file_of("a")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(ContentCacheTest, AKeyIsAListOfThings) {
  const auto name = [](std::string_view a, std::string_view b) {
    CacheKey key("test");
    key.text(a).text(b);
    return key.name();
  };
  EXPECT_EQ(name("ab", "c"), name("ab", "c"));
  EXPECT_NE(name("ab", "c"), name("a", "bc"));
  EXPECT_NE(name("ab", "c"), name("c", "ab"));
  EXPECT_NE(CacheKey("a").name(), CacheKey("b").name());
}

// One byte changed anywhere, an end anywhere, more than there was: none, until it is kept again.
TEST_F(ContentCacheTest, ADamagedEntryIsNoneAndIsReplaced) {
  const Parts parts = {"ab", "", "0123456789"};
  ContentCache cache(directory_);
  keep(cache, "a", parts);
  const std::string whole = bytes_of("a");
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    overwrite("a", damaged);
    ASSERT_FALSE(find(cache, "a")) << "byte " << i;
  }
  for (std::size_t size = 0; size < whole.size(); ++size) {
    overwrite("a", whole.substr(0, size));
    ASSERT_FALSE(find(cache, "a")) << size << " bytes";
  }
  overwrite("a", whole + "x");
  EXPECT_FALSE(find(cache, "a"));
  EXPECT_EQ(cache.trouble(), std::nullopt);
  keep(cache, "a", parts);
  EXPECT_THAT(find(cache, "a"), Optional(parts));
}

TEST_F(ContentCacheTest, AnEntryUnderAnothersNameIsNone) {
  ContentCache cache(directory_);
  keep(cache, "a", kParts);
  keep(cache, "b", {"b"});
  fs::rename(file_of("a"), file_of("b"));
  EXPECT_FALSE(find(cache, "b"));
}

TEST_F(ContentCacheTest, WhatWasUsedLongestAgoMakesRoom) {
  constexpr std::uintmax_t kLimit = 10000;
  const Parts parts = {std::string(2000, 'x')};  // five would be too many
  const auto now = fs::file_time_type::clock::now();
  ContentCache cache(directory_, kLimit);
  for (const char* name : {"a", "b", "c", "d"}) keep(cache, name, parts);
  int age = 9;
  for (const char* name : {"a", "b", "c", "d"})
    fs::last_write_time(file_of(name), now - std::chrono::hours(age--));
  std::ofstream(directory_ / "notes.txt") << "a user's";
  ASSERT_TRUE(find(cache, "a"));  // that it is used counts
  keep(cache, "e", parts);
  EXPECT_LE(cache.usage().bytes, kLimit);
  EXPECT_EQ(cache.usage().entries, 4u);
  EXPECT_FALSE(find(cache, "b"));
  for (const char* name : {"a", "c", "d", "e"}) EXPECT_TRUE(find(cache, name)) << name;
  EXPECT_TRUE(fs::exists(directory_ / "notes.txt"));
  keep(cache, "f", {std::string(9000, 'x')});
  EXPECT_FALSE(find(cache, "f")) << "would leave no room for others";
}

TEST_F(ContentCacheTest, ADirectoryThatCannotBeMadeIsNoError) {
  std::ofstream(folder_.path() / "caches") << "a file";
  ContentCache cache(directory_);
  keep(cache, "a", kParts);
  EXPECT_FALSE(find(cache, "a"));
  EXPECT_THAT(cache.trouble(), Optional(StartsWith(directory_.string() + ": cannot be read: ")));
}

TEST_F(ContentCacheTest, ADirectoryOfOthersIsNotUsed) {
  {
    ContentCache cache(directory_);
    keep(cache, "a", kParts);
  }
  fs::permissions(directory_, fs::perms::all);
  ContentCache cache(directory_);
  EXPECT_FALSE(find(cache, "a"));
  keep(cache, "b", kParts);
  EXPECT_FALSE(fs::exists(file_of("b")));
  EXPECT_THAT(cache.trouble(), Optional(HasSubstr("others can write to it")));
}

// As on a full disk: a file may not grow beyond a limit.
TEST_F(ContentCacheTest, AFullDiskIsNoErrorAndLeavesNothing) {
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before;
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small = {1000, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  {
    ContentCache cache(directory_);
    keep(cache, "a", kParts);
    keep(cache, "b", {"short"});  // is not tried any more
    EXPECT_FALSE(find(cache, "a"));
    EXPECT_THAT(cache.trouble(), Optional(AllOf(StartsWith(directory_.string()),
                                                HasSubstr("cannot be written: File too large"))));
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_TRUE(fs::is_empty(directory_));
}

// Writers and readers of one entry, each with a cache of its own as processes have: what is found
// is what was kept.
TEST_F(ContentCacheTest, ManyMayUseADirectoryAtOnce) {
  std::atomic<int> found = 0, wrong = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] {
      ContentCache cache(directory_);
      for (int i = 0; i < 100; ++i) {
        keep(cache, "a", kParts);
        const auto parts = find(cache, "a");
        found += parts.has_value();
        wrong += parts && *parts != kParts;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(found, 400);
  EXPECT_EQ(ContentCache(directory_).usage().entries, 1u);
}

TEST(UserCacheDirectory, FollowsTheEnvironment) {
  const TemporaryDirectory folder;
  const fs::path home = folder.path() / "home", caches = folder.path() / "caches";
  ::setenv("HOME", home.c_str(), 1);
  ::setenv("XDG_CACHE_HOME", caches.c_str(), 1);
  EXPECT_EQ(user_cache_directory(), caches / "skyfit");
  ::setenv("XDG_CACHE_HOME", "relative", 1);  // is to be ignored
  EXPECT_EQ(user_cache_directory(), home / ".cache" / "skyfit");
  ::unsetenv("XDG_CACHE_HOME");
  EXPECT_EQ(user_cache_directory(), home / ".cache" / "skyfit");
  ::unsetenv("HOME");
  EXPECT_EQ(user_cache_directory(), std::nullopt);
}

}  // namespace
}  // namespace skyfit
