// SPDX-License-Identifier: Apache-2.0
// The CSV reader takes what spreadsheets write and names the place of everything else.
#include "data_refs/csv.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace skyfit::refs {
namespace {

using testing::ElementsAre;

std::string complaint(std::string_view text) {
  try {
    const CsvTable table(text, "t.csv");
    for (const CsvRecord& record : table.records()) table.number(record, table.columns().front());
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Csv, AcceptsMarksCommentsBlanksQuotesAndSpaces) {
  const CsvTable table(
      "\xef\xbb\xbf# a comment, with a comma\r\n\r\n a , \"b\" \r\n1, \"x, \"\"y\"\"\"\r\n# "
      "more\n+2.5e3,",
      "t.csv");
  EXPECT_THAT(table.columns(), ElementsAre("a", "b"));
  EXPECT_EQ(table.header_line(), 3);
  ASSERT_EQ(table.records().size(), 2u);
  EXPECT_EQ(table.records()[1].line, 6);
  EXPECT_EQ(table.text(table.records()[0], "b"), "x, \"y\"");
  EXPECT_EQ(table.number(table.records()[1], "a"), 2500);
  EXPECT_EQ(table.text(table.records()[1], "b"), "");
}

TEST(Csv, FaultsNameTheirLine) {
  EXPECT_EQ(complaint(""), "t.csv: is empty, expected a line of column names");
  EXPECT_EQ(complaint("# only this\n"), "t.csv: is empty, expected a line of column names");
  EXPECT_EQ(complaint("a,b\n1,2\n3\n"), "t.csv:3: expected 2 fields, got 1");
  EXPECT_EQ(complaint("a,b\n1,2,3\n"), "t.csv:2: expected 2 fields, got 3");
  EXPECT_EQ(complaint("a,a\n"), "t.csv:1: column a: expected once, found twice");
  EXPECT_EQ(complaint("a\n\x1b[2J\n"), "t.csv:2: a = \"?[2J\": expected a finite number");
  EXPECT_EQ(complaint("a,,b\n"), "t.csv:1: column 2 has no name");
  EXPECT_EQ(complaint("a\n\"1\n"), "t.csv:2: expected a closing quote before the end of the line");
  EXPECT_EQ(complaint("a\n\"1\"2\n"), "t.csv:2: expected \",\" after a closing quote");
}

// As spreadsheets end them.
TEST(Csv, EmptyColumnsAtTheEndAreNone) {
  const CsvTable table("a,b,,\n1,2,,\n3,,,\n", "t.csv");
  EXPECT_EQ(table.columns().size(), 2u);
  EXPECT_EQ(table.text(table.records()[1], "b"), "");
  EXPECT_EQ(complaint("a,\n1,2\n"), "t.csv:2: expected 1 fields, got 2");
}

TEST(Csv, KnowsOtherDelimiters) {
  EXPECT_EQ(other_delimiter("a;b;c"), "semicolons");
  EXPECT_EQ(other_delimiter("1,5;2,5;3,5"), "semicolons");
  EXPECT_EQ(other_delimiter("a\tb\tc"), "tabs");
  EXPECT_EQ(other_delimiter("a,b;c,d"), "");
  EXPECT_EQ(csv_fields("\"a;b\"; c;\"\"", "t", 1, ';'), (std::vector<std::string>{"a;b", "c", ""}));
  EXPECT_EQ(csv_fields("\"a\"\tb\t", "t", 1, '\t'), (std::vector<std::string>{"a", "b", ""}));
}

TEST(Csv, OnlyFiniteNumbersAreNumbers) {
  for (const std::string value :
       {"abc", "1x", "nan", "inf", "-inf", "1e999", "+-1", "0x10", "1 2", "--1"}) {
    EXPECT_EQ(complaint("a\n" + value + "\n"),
              "t.csv:2: a = \"" + value + "\": expected a finite number");
  }
  EXPECT_EQ(complaint("a,b\n,1\n"), "t.csv:2: a = \"\": expected a finite number");
  EXPECT_EQ(complaint("a\n-1.5E-3\n"), "accepted");
}

TEST(Csv, AnyNumberMayBeNoFiniteOne) {
  const CsvTable table("a\nnan\n-inf\n+2\nabc\n", "t.csv");
  EXPECT_TRUE(std::isnan(table.any_number(table.records()[0], "a")));
  EXPECT_EQ(table.any_number(table.records()[1], "a"), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(table.any_number(table.records()[2], "a"), 2);
  EXPECT_THAT([&] { table.any_number(table.records()[3], "a"); },
              testing::ThrowsMessage<std::invalid_argument>(
                  "t.csv:5: a = \"abc\": expected a number, or nan where there is none"));
}

}  // namespace
}  // namespace skyfit::refs
