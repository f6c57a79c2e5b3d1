// SPDX-License-Identifier: Apache-2.0
// Text that others wrote is shown on one line, in UTF-8, without what steers a terminal, and not
// all of it.
#include "model/base/text.h"

#include <gmock/gmock.h>

namespace skyfit {
namespace {

using ::testing::ElementsAre;

TEST(Text, IsTrimmedAndSplit) {
  EXPECT_EQ(trim(" \t a b\r\n"), "a b");
  EXPECT_EQ(trim(" \n"), "");
  EXPECT_THAT(split("a,,b,", ','), ElementsAre("a", "", "b", ""));
  EXPECT_THAT(split("", ','), ElementsAre(""));
}

TEST(Text, PrintableKeepsWhatCanBeRead) {
  for (const char* text : {"", "plain", "Zürich ☉ 日本 𝄞", "C:\\x {y}_z@`'\""})
    EXPECT_EQ(printable(text), text);
}

TEST(Text, PrintableReplacesWhatSteersATerminal) {
  EXPECT_EQ(printable("\x1b[2J\x07"), "?[2J?");
  EXPECT_EQ(printable("a\nb\tc\r"), "a b c ");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "?31m");  // CSI of C1
  EXPECT_EQ(printable("a\xe2\x80\xae"
                      "b"),
            "a?b");  // right-to-left override
  EXPECT_EQ(printable(std::string_view("\0\x7f", 2)), "??");
}

TEST(Text, PrintableReplacesWhatIsNoUtf8) {
  EXPECT_EQ(printable("\xff"
                      "a\x80"),
            "?a?");
  EXPECT_EQ(printable("\xe2\x98"), "??");            // cut short
  EXPECT_EQ(printable("\xc0\xaf"), "??");            // overlong
  EXPECT_EQ(printable("\xed\xa0\x80"), "???");       // a surrogate
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "????");  // beyond Unicode
}

TEST(Text, ExcerptsCountCharactersNotBytes) {
  std::string suns;
  for (std::size_t i = 0; i < kMostShown; ++i) suns += "☉";
  EXPECT_EQ(excerpt(suns), suns);
  EXPECT_EQ(in_quotes(suns + "x"), '"' + suns + "...\"");
}

}  // namespace
}  // namespace skyfit
