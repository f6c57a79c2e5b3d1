// SPDX-License-Identifier: Apache-2.0
// Files that are no sky are named for what they are, on one line; a CSV of samples is not taken for
// one.
#include "data_refs/other_formats.h"

#include <gmock/gmock.h>

#include <string>

#include "complaint.h"
#include "data_refs/measured_formats.h"

namespace skyfit::refs {
namespace {

using testing::HasSubstr;

std::string complaint(const std::string& name) {
  return complaint_of([&] { load_measured_sky(std::string(SKYFIT_TEST_DATA) + "/" + name, {}); });
}

TEST(OtherFormats, FilesAreNamed) {
  EXPECT_THAT(complaint("aeronet_aod.lev20"), HasSubstr("is aerosol optical depths of AERONET"));
  EXPECT_THAT(complaint("aeronet_inversion.all"), HasSubstr("is an inversion of AERONET"));
  EXPECT_THAT(complaint("gendaylit.rad"), HasSubstr("is a scene of Radiance"));
}

TEST(OtherFormats, TextsAreNamed) {
  EXPECT_THAT(*other_format("LOCATION,Somewhere,-,FRA\nDESIGN CONDITIONS,0\n"), HasSubstr("(EPW)"));
  EXPECT_THAT(*other_format("# gendaylit 6 21 12\nvoid light solar\n"), HasSubstr("Radiance"));
  EXPECT_THAT(*other_format("wavelength, irradiance\n400, 1\n"), HasSubstr("irradiances"));
  EXPECT_THAT(*other_format("# a day\nsun_zenith_deg,direct_normal_lx\n40,80000\n"),
              HasSubstr("fit --irradiance"));
  EXPECT_THAT(*other_format("PRC Krochmann sky scanner\n1 2 3\n"),
              HasSubstr("that a sidecar names"));
  EXPECT_THAT(*other_format("    2003  5 29  5 20  2   5.3339 : IY IM ID IHH IMM ISS TM(hr)\n"),
              HasSubstr(".DT5 of SKYRAD.pack"));
  EXPECT_THAT(*other_format("09:59:28,H,2006/03/07,Clalmanalco\n"), HasSubstr("POM-01L"));
  EXPECT_THAT(*other_format("{\"SkyAtmosphere\": {}}"), HasSubstr("JSON"));
  EXPECT_FALSE(other_format("sun_zenith_deg,view_zenith_deg,relative_azimuth_deg\n1,2,3\n"));
}

// Patterns with repetitions of repetitions would try blank lines in all ways, for years.
TEST(OtherFormats, BlankLinesWithoutEndAreSoonDone) {
  for (const std::string blank : {"\n", " ", " \n", "#\n", "# x\n\n"}) {
    std::string text;
    while (text.size() < 100'000) text += blank;
    EXPECT_FALSE(other_format(text));
    EXPECT_TRUE(other_format(text.substr(0, 4000) + "\nvoid light solar\n"));
  }
}

}  // namespace
}  // namespace skyfit::refs
