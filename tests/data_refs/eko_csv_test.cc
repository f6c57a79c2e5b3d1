// SPDX-License-Identifier: Apache-2.0
// Every row L of the scanner's file is a scan of 145 luminances under the sun of its middle; every
// fault is one line.
#include "data_refs/eko_csv.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "complaint.h"
#include "data_refs/patch_scan.h"
#include "data_refs/solar_position.h"

namespace skyfit::refs {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr double kDegree = std::numbers::pi / 180;

// 25 December 2002, 10:20 at UTC+9, 36 deg 3' N and 140 deg 8' E: the example of the manual, whose
// sun stands at azimuth -20.56 from south.
std::vector<std::string> header() {
  std::string channels = ",,";
  for (int i = 1; i <= 145; ++i) channels += "," + std::to_string(i);
  return {"Title, Sky Scanner MS-321LR Sky Luminance and Radiance distributions",
          "Firmware,1.00",
          "Date,2002/12/25",
          "Comment,made for this test",
          "Lon140 d 8.0 m",
          "La36 d 3.0 m",
          "Timezone,UTC +9:00",
          "Unit,kcd/m^2, W/(sr*m^2)",
          channels + ",,"};
}

std::string row(const std::string& kind, const std::string& value = "4.5",
                const std::string& altitude = "+27.67") {
  std::string text = kind + ",10:20:00,10:24:18";
  for (int i = 1; i <= 145; ++i) text += "," + (i == 7 ? value : "4.5");
  return text + ",-20.56," + altitude;
}

std::string text_of(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\r\n";
  return text;
}

Reference parse(const std::vector<std::string>& lines) {
  ImportOptions options;
  options.azimuth_zero = "south";
  return parse_eko_csv(text_of(lines), "eko.csv", options);
}

std::string complaint(const std::vector<std::string>& lines) {
  return complaint_of([&] { parse(lines); });
}

std::string complaint_of_header(std::size_t line, const std::string& text) {
  std::vector<std::string> lines = header();
  lines[line - 1] = text;
  lines.push_back(row("L"));
  return complaint(lines);
}

TEST(EkoCsv, HoldsAScanPerRowOfLuminances) {
  std::vector<std::string> lines = header();
  for (const char* kind : {"L", "R", "L", "R"}) lines.push_back(row(kind));
  const Reference scans = parse(lines);
  const SolarPosition sun = solar_position(*instant("2002-12-25", "10:22:09", 9),
                                           {(36 + 3 / 60.0) * kDegree, (140 + 8 / 60.0) * kDegree});
  EXPECT_EQ(scans.quantity, Quantity::kLuminance);
  ASSERT_EQ(scans.samples.size(), 2 * kPatches);
  EXPECT_EQ(scans.samples[0].value, 4500);
  EXPECT_NEAR(scans.samples[0].sun_zenith, sun.zenith, 1e-12);
  // The first patch looks south.
  EXPECT_NEAR(std::remainder(scans.samples[0].relative_azimuth - (180 * kDegree - sun.azimuth),
                             360 * kDegree),
              0, 1e-12);
  EXPECT_EQ(scans.scans[1].time_utc, "2002-12-25T01:22:09Z");
}

// The sun of the manual's example is ours.
TEST(EkoCsv, AgreesWithTheSunOfTheManual) {
  const SolarPosition sun = solar_position(*instant("2002-12-25", "10:20:00", 9),
                                           {36.05 * kDegree, (140 + 8 / 60.0) * kDegree});
  EXPECT_NEAR(sun.azimuth / kDegree - 180, -20.56, 1.0);  // whichever minute of the scan it is of
  EXPECT_NEAR(90 - sun.zenith / kDegree, 27.67, 1.0);
}

TEST(EkoCsv, FaultsOfTheHeaderNameTheirLine) {
  EXPECT_EQ(complaint_of_header(3, "Date,today"),
            "eko.csv:3: \"Date,today\": expected Date,YYYY/MM/DD");
  EXPECT_EQ(complaint_of_header(5, "Long way"), "eko.csv:5: \"Long way\": expected Lon140 d 8.0 m");
  EXPECT_EQ(complaint_of_header(6, "Lo36 d 3.0 m"),
            "eko.csv:6: \"Lo36 d 3.0 m\": expected La36 d 3.0 m");
  EXPECT_EQ(complaint_of_header(7, "Timezone,JST"),
            "eko.csv:7: \"Timezone,JST\": expected Timezone,UTC +9:00");
  EXPECT_EQ(complaint_of_header(3, "Date,2010/13/45"),
            "eko.csv:3: \"Date,2010/13/45\": expected Date,YYYY/MM/DD of a day that exists");
  EXPECT_THAT(complaint_of_header(7, "Timezone,UTC +10:75"),
              StartsWith("eko.csv:7: \"Timezone,UTC +10:75\": expected an offset"));
  for (const char* wrong : {"LaS133 d 30.0 m", "LaS33 d 90.0 m", "LaS-33 d 30.0 m"}) {
    EXPECT_THAT(complaint_of_header(6, wrong), StartsWith(std::string("eko.csv:6: \"") + wrong +
                                                          "\": expected La36 d 3.0 m, up to"));
  }
  EXPECT_EQ(complaint_of_header(8, "Unit,lux"),
            "eko.csv:8: unit = \"lux\": expected one of cd m-2, kcd m-2");
  EXPECT_EQ(complaint_of_header(9, ",,,1,2,4"),
            "eko.csv:9: expected the channels 1 to 145 from the fourth field on, channel 3 is not "
            "there");
  EXPECT_EQ(complaint({"Title, Sky Scanner MS-321LR"}),
            "eko.csv: 1 lines: expected 9 header lines");
  EXPECT_EQ(complaint(header()), "eko.csv: 0 rows L: expected at least 1");
}

TEST(EkoCsv, FaultsOfARowNameLineAndField) {
  const auto with = [](const std::string& text) {
    std::vector<std::string> lines = header();
    lines.push_back(text);
    return complaint(lines);
  };
  EXPECT_EQ(with(row("L", "bright")), "eko.csv:10: channel 7 = \"bright\": expected a number");
  EXPECT_EQ(with(row("X")), "eko.csv:10: \"X\": expected a row L or R");
  EXPECT_EQ(with("L,10:20:00,10:24:18,1"), "eko.csv:10: expected 150 fields, got 4");
  EXPECT_THAT(with(row("L", "1", "+35.00")),
              StartsWith("eko.csv:10: altitude of the sun = 35: expected 2"));
  std::string late = row("L");
  late.replace(2, 8, "25:20:00");
  EXPECT_EQ(with(late), "eko.csv:10: time = \"25:20:00\": expected HH:MM:SS");
}

TEST(EkoCsv, ABadLineLeavesOutItsScanAlone) {
  std::vector<std::string> lines = header();
  std::string quote = row("L");
  quote.insert(2, "\"");
  for (const std::string& text : {row("L"), row("X"), quote, row("R"), row("L")})
    lines.push_back(text);
  const Reference sky = parse(lines);
  EXPECT_EQ(sky.scans.size(), 2u);
  EXPECT_THAT(sky.notes,
              testing::IsSupersetOf(
                  {HasSubstr("a scan is left out: eko.csv:11: \"X\": expected a row L or R"),
                   HasSubstr("a scan is left out: eko.csv:12: expected a closing quote")}));
}

TEST(EkoCsv, TheStatedAltitudeTellsAWrongClock) {
  std::vector<std::string> lines = header();
  lines[6] = "Timezone,UTC +11:00";
  lines.push_back(row("L"));
  EXPECT_THAT(complaint(lines),
              HasSubstr("mended by a clock that is 2 h slow (utc_offset_h 2 less)"));
}

TEST(EkoCsv, SuspectPatchesStay) {
  std::vector<std::string> lines = header();
  lines.push_back(row("L", "-0.01"));
  EXPECT_EQ(parse(lines).samples[6].zero_weight_reason, "not positive");
}

}  // namespace
}  // namespace skyfit::refs
