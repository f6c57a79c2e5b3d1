// SPDX-License-Identifier: Apache-2.0
// Columns of somebody's own become those of a CSV of samples or of a spectral scan, and what is
// wrong names the line of the file.
#include "data_refs/column_mapping.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>
#include <numbers>

#include "data_refs/import_options.h"
#include "data_refs/measured_formats.h"
#include "model/base/temporary_directory.h"
#include "model/base/whole_file.h"

namespace skyfit::refs {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;

constexpr double kDegree = std::numbers::pi / 180;

class ColumnMappingTest : public ::testing::Test {
 protected:
  Reference read(const std::string& text, const std::string& sidecar) const {
    write_file(folder_.path() / "sky.txt", text);
    write_file(folder_.path() / "sky.txt.sidecar.json", sidecar);
    return load_measured_sky(folder_.path() / "sky.txt", {});
  }
  std::string complaint(const std::string& text, const std::string& sidecar) const {
    try {
      read(text, sidecar);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "none";
  }

 private:
  const TemporaryDirectory folder_;
};

TEST_F(ColumnMappingTest, MakesACsvOfSamplesWithTheSunOfTheTime) {
  const Reference sky =
      read("Station X\nmade by hand\nAzi;Elev;note;L\n90;60;clear;4,5\n270;30;clear;2,5\n",
           R"({"columns": {"view_azimuth_deg": "Azi",
                      "view_zenith_deg": {"column": "Elev", "times": -1, "plus": 90},
                      "luminance_cd_m2": {"column": "#4", "times": 1000}},
          "delimiter": ";", "decimal_comma": true, "skip_lines": 2,
          "local_time": "2024-06-21T12:00:00", "utc_offset_h": 0,
          "latitude_deg": 47.5, "longitude_deg": 0})");
  EXPECT_EQ(sky.quantity, Quantity::kLuminance);
  ASSERT_THAT(sky.samples, SizeIs(2));
  EXPECT_NEAR(sky.samples[0].view_zenith, 30 * kDegree, 1e-12);
  EXPECT_EQ(sky.samples[0].value, 4500);
  EXPECT_EQ(sky.samples[1].value, 2500);
  // The scan keeps its time and place, the Earth its distance from the sun.
  ASSERT_THAT(sky.scans, SizeIs(1));
  EXPECT_EQ(sky.scans[0].name, "sky.txt");
  EXPECT_EQ(sky.scans[0].time_utc, "2024-06-21T12:00:00Z");
  EXPECT_NEAR(sky.scans[0].sun_distance_au, 1.0163, 1e-4);
  EXPECT_TRUE(sky.scans[0].site.has_value());
  EXPECT_THAT(sky.notes, Not(Contains(HasSubstr("is not used"))));
  // Near the solstice's noon the sun stands in the south, 24 deg from the zenith.
  EXPECT_NEAR(sky.samples[0].sun_zenith / kDegree, 47.5 - 23.44, 0.1);
  EXPECT_NEAR(std::abs(sky.samples[0].relative_azimuth) / kDegree, 90, 2);
}

TEST_F(ColumnMappingTest, MakesASpectralScanWithoutAHeader) {
  const Reference sky = read("10 40  0.21 0.12\n200 70  0.25 0.14\n",
                             R"({"columns": {"view_azimuth_deg": "#1", "view_zenith_deg": "#2",
                                             "radiance_440": "#3", "radiance_600": "#4"},
                                 "delimiter": "space", "header": false, "unit": "W m-2 sr-1 nm-1",
                                 "sun_zenith_deg": 30, "sun_azimuth_deg": 180})");
  EXPECT_EQ(sky.quantity, Quantity::kSpectralRadiance);
  ASSERT_THAT(sky.samples, SizeIs(4));
  EXPECT_EQ(sky.samples[0].wavelength_nm, 440);
  EXPECT_EQ(sky.samples[3].value, 0.14);
}

TEST_F(ColumnMappingTest, NamesLinesOfTheFile) {
  const std::string sidecar =
      R"({"columns": {"view_azimuth_deg": "Azi", "view_zenith_deg": "Zen",
                      "luminance_cd_m2": {"column": "L", "times": 1000}},
          "delimiter": "tab", "skip_lines": 1, "sun_zenith_deg": 30, "sun_azimuth_deg": 180})";
  EXPECT_THAT(complaint("head\nAzi\tElev\tL\n", sidecar),
              HasSubstr("sky.txt:2: expected a column \"Zen\" (columns.view_zenith_deg of the "
                        "sidecar), got Azi, Elev, L"));
  EXPECT_THAT(complaint("head\nAzi\tZen\tL\n1\t2\t3\n1\t2\tx\n", sidecar),
              HasSubstr("sky.txt:4: L = \"x\": expected a number"));
  EXPECT_THAT(complaint("head\nAzi\tZen\tL\n1\t2\n", sidecar),
              HasSubstr("sky.txt:3: expected at least 3 columns, got 2"));
  EXPECT_THAT(complaint("head\nAzi\tZen\tL\n1\t195\t3\n", sidecar), HasSubstr("sky.txt:3: "));
}

// What would be read as something else.
TEST_F(ColumnMappingTest, WhatMeansSomethingElseIsRefused) {
  const auto sidecar = [](const std::string& more) {
    return R"({"columns": {"view_azimuth_deg": "Azi", "view_zenith_deg": "Zen",
                           "luminance_cd_m2": "L"}, "delimiter": ";", "decimal_comma": true,
               "sun_zenith_deg": 30, "sun_azimuth_deg": 180)" +
           more + "}";
  };
  const std::string head = "Azi;Zen;L\n", rows = "10;20;4,5\n";
  EXPECT_EQ(read(head + rows, sidecar("")).samples[0].value, 4.5);
  EXPECT_EQ(read(head + "\"10\";20;\"4,5\"\n", sidecar("")).samples[0].value, 4.5);
  EXPECT_THAT(complaint(head + "10;20;4.500\n", sidecar("")),
              HasSubstr("sky.txt:2: L = \"4.500\": expected a decimal comma and no points"));
  EXPECT_THAT(complaint("Azi;Zen;L;L\n10;20;4,5;5\n", sidecar("")),
              HasSubstr("sky.txt:1: 2 columns \"L\""));
  EXPECT_THAT(complaint(head + rows, sidecar(R"(, "unit": "kcd m-2")")),
              HasSubstr("unit: expected none beside columns of luminance"));
  std::string timed = sidecar("");
  timed.insert(timed.find("\"view_zenith"), "\"sun_zenith_deg\": \"S\", ");
  EXPECT_THAT(complaint("Azi;Zen;S;L\n10;20;40;4,5\n", timed),
              HasSubstr("sun_zenith_deg: expected none beside columns.sun_zenith_deg"));
}

// Each line has the sun of its own time; a scan ends where the sun jumps.
TEST_F(ColumnMappingTest, LinesMayTellTheirTimes) {
  const std::string facts =
      R"("view_azimuth_deg": "Azi", "view_zenith_deg": "Zen", "luminance_cd_m2": "L"},
         "delimiter": ";", "latitude_deg": 47.5, "longitude_deg": 0)";
  const std::string utc = R"({"columns": {"time_utc": "T", )" + facts + "}",
                    local = R"({"columns": {"local_date": "D", "local_time": "T", )" + facts +
                            R"(, "utc_offset_h": 2})";
  for (const Reference& sky :
       {read("T;Azi;Zen;L\n2024-06-21T12:00:00Z;90;30;4500\n2024-06-21T12:02:00Z;90;40;4600\n"
             "2024-06-21T14:00:00Z;90;30;4700\n2024-06-21T23:00:00Z;90;30;1\n",
             utc),
        read("D;T;Azi;Zen;L\n2024-06-21;14:00:00;90;30;4500\n2024-06-21;14:02:00;90;40;4600\n"
             "2024-06-21;16:00;90;30;4700\n2024-06-22;01:00;90;30;1\n",
             local)}) {
    ASSERT_THAT(sky.samples, SizeIs(3));
    ASSERT_THAT(sky.scans, SizeIs(2));
    EXPECT_EQ(sky.scans[1].time_utc, "2024-06-21T14:00:00Z");
    EXPECT_EQ(sky.samples[1].scan, 0);
    EXPECT_NE(sky.samples[1].sun_zenith, sky.samples[0].sun_zenith);
    EXPECT_TRUE(sky.scans[1].site.has_value());
    EXPECT_THAT(sky.notes, Contains(HasSubstr("a sun above the horizon")));
    EXPECT_THAT(sky.notes, Not(Contains(HasSubstr("is not used"))));
  }
  EXPECT_THAT(complaint("T;Azi;Zen;L\nnoon;90;30;4500\n", utc),
              HasSubstr("sky.txt:2: local_time = noon: expected"));
  EXPECT_THAT(complaint("D;Azi;Zen;L\n2024-06-21;90;30;4500\n",
                        R"({"columns": {"local_date": "D", )" + facts + "}"),
              HasSubstr("columns.local_date: expected columns.local_time beside it"));
  EXPECT_THAT(complaint("T;Azi;Zen;R\n2024-06-21T12:00:00Z;90;30;0.1\n",
                        R"({"columns": {"local_time": "T", "view_azimuth_deg": "Azi",
                            "view_zenith_deg": "Zen", "radiance_440": "R"}, "delimiter": ";"})"),
              HasSubstr("columns.local_time: expected local_time of the sidecar in its place"));
}

TEST_F(ColumnMappingTest, SunsOfColumnsAreThoseOfTimeAndPlace) {
  const auto sidecar = [](double longitude) {
    return fmt::format(R"({{"columns": {{"sun_zenith_deg": "S", "relative_azimuth_deg": "Azi",
                            "view_zenith_deg": "Zen", "luminance_cd_m2": "L", "time_utc": "T"}},
                           "latitude_deg": 47.5, "longitude_deg": {}}})",
                       longitude);
  };
  const std::string text = "S,Azi,Zen,L,T\n42.67,90,30,4500,2024-06-21T15:00:00Z\n";
  EXPECT_THAT(complaint(text, sidecar(0)), HasSubstr("none"));
  EXPECT_THAT(complaint(text, sidecar(-60)), HasSubstr("sun_zenith_deg = 42.67: expected the sun"));
}

// One cell does not cost the rest.
TEST_F(ColumnMappingTest, WhatCannotBeUsedHasNoWeight) {
  const Reference sky = read(
      "Azi;Zen;L\n10;20;4,5\n20;20;\n30;20;-9999\n40;20;--\n50;20;-0,1\n"
      "60;92;4,5\n;;\n",
      R"({"columns": {"view_azimuth_deg": "Azi", "view_zenith_deg": "Zen",
                                             "luminance_cd_m2": "L"},
                                 "delimiter": ";", "decimal_comma": true,
                                 "sun_zenith_deg": 30, "sun_azimuth_deg": 180})");
  std::vector<std::string> reasons;
  for (const Sample& sample : sky.samples) reasons.push_back(sample.zero_weight_reason);
  EXPECT_THAT(reasons, testing::ElementsAre("", "missing", "missing", "missing", "not positive",
                                            "outside the sky"));
  EXPECT_EQ(sky.samples[0].weight, 1);
  EXPECT_EQ(sky.samples[1].weight, 0);
}

TEST_F(ColumnMappingTest, BadMappingsAreRefusedInALine) {
  const auto with = [&](const std::string& fields) {
    return complaint("a,b\n1,2\n", R"({"columns": {"view_zenith_deg": "a"}, )" + fields + "}");
  };
  EXPECT_THAT(with(R"("delimiter": "|")"), HasSubstr("\"tab\" or \"space\""));
  EXPECT_THAT(with(R"("decimal_comma": true)"), HasSubstr("another delimiter"));
  EXPECT_THAT(with(R"("header": false)"), HasSubstr("numbers such as #3"));
  EXPECT_THAT(with(R"("skip_lines": 1.5)"), HasSubstr("a whole number >= 0"));
  EXPECT_THAT(complaint("a\n", R"({"columns": {}})"), HasSubstr("at least one column"));
  EXPECT_THAT(complaint("a\n", R"({"delimiter": ";"})"), HasSubstr("columns"));
  EXPECT_THAT(complaint("a\n", R"({"columns": {"view_zenith_deg": "#0"}})"),
              HasSubstr("its number such as #3"));
}

}  // namespace
}  // namespace skyfit::refs
