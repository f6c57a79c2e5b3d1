// SPDX-License-Identifier: Apache-2.0
// A CSV of a table is read, with comments, and every fault is one line that names its place.
#include "data_refs/table_csv.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "model/atmosphere/linear_profile.h"
#include "model/atmosphere/tabulated_phase.h"

namespace skyfit::refs {
namespace {

std::string complaint(std::string_view text, const TableFormat& format) {
  try {
    parse_table_csv(text, "t.csv", format);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(TableCsv, ReadsColumnsInAnyOrderAndComments) {
  const TwoColumns table =
      parse_table_csv("# aerosol\nrelative_density,height_m\n1,0\n# mixed\n0.5,800\n0,2000\n",
                      "t.csv", kProfileFormat);
  EXPECT_EQ(table, (TwoColumns{{0, 800, 2000}, {1, 0.5, 0}}));
}

TEST(TableCsv, FaultsNameTheirLine) {
  const auto profile = [](const std::string& rows) {
    return complaint("height_m,relative_density\n" + rows, kProfileFormat);
  };
  EXPECT_EQ(profile("0,1\n5,0\n"), "accepted");
  EXPECT_EQ(profile("0,1\n"), "t.csv:1: height_m: 1 values: expected at least 2");
  EXPECT_EQ(profile("1,1\n5,0\n"), "t.csv:2: height_m = \"1\": expected 0, the first");
  EXPECT_EQ(profile("0,1\n5,1\n5,0\n"),
            "t.csv:4: height_m = \"5\": expected more than 5, the one before");
  EXPECT_EQ(profile("0,1\n5,-1\n"), "t.csv:3: relative_density = \"-1\": expected a density >= 0");
  EXPECT_EQ(profile("0,0\n5,0\n"),
            "t.csv:1: relative_density: only zeros: expected a density > 0 somewhere");
  EXPECT_EQ(complaint("height_m,density\n0,1\n", kProfileFormat),
            "t.csv:1: columns height_m, density: expected height_m, relative_density");
  const auto phase = [](const std::string& rows) {
    return complaint("scattering_angle_deg,phase_per_sr\n" + rows, kPhaseFormat);
  };
  EXPECT_EQ(phase("0,0.08\n90,0.08\n180,0.08\n"), "accepted");
  EXPECT_EQ(phase("0,0.08\n90,0\n180,0.08\n"),
            "t.csv:3: phase_per_sr = \"0\": expected a phase function > 0");
  EXPECT_EQ(phase("0,0.08\n170,0.08\n"),
            "t.csv:3: scattering_angle_deg = \"170\": expected 180, the last");
  EXPECT_EQ(phase("0,0.1\n180,0.1\n"),
            "t.csv:1: phase_per_sr: integral over the sphere 1.25664: expected 1 within 5 %");
}

TEST(TableCsv, FileThatCannotBeReadIsNamed) {
  try {
    load_table_csv("no/such.csv", kProfileFormat);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()),
              "no/such.csv: cannot be read (No such file or directory), expected a CSV of a table");
  }
}

}  // namespace
}  // namespace skyfit::refs
