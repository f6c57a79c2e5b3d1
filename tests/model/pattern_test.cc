// SPDX-License-Identifier: Apache-2.0
// Patterns match as std::regex does up to kMostMatched characters, and no longer text at all.
#include "model/base/pattern.h"

#include <gtest/gtest.h>

#include <string>

namespace skyfit {
namespace {

TEST(Pattern, WholeAndFirstMatchesHaveTheirParts) {
  const std::regex pattern(R"(a(b*)c)");
  ASSERT_TRUE(whole_match("abbc", pattern));
  EXPECT_EQ((*whole_match("abbc", pattern))[1].str(), "bb");
  EXPECT_FALSE(whole_match("xabbc", pattern));
  ASSERT_TRUE(first_match("xabbcac", pattern));
  EXPECT_EQ((*first_match("xabbcac", pattern))[0].str(), "abbc");
  EXPECT_FALSE(first_match("x", pattern));
}

TEST(Pattern, TextThatWouldTakeTheStackIsNoMatch) {
  const std::regex pattern("a*");
  EXPECT_TRUE(whole_match(std::string(kMostMatched, 'a'), pattern));
  for (const std::size_t length : {kMostMatched + 1, std::size_t{10'000'000}}) {
    EXPECT_FALSE(whole_match(std::string(length, 'a'), pattern));
    EXPECT_FALSE(first_match(std::string(length, 'a'), pattern));
  }
}

}  // namespace
}  // namespace skyfit
