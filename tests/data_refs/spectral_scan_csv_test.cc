// SPDX-License-Identifier: Apache-2.0
// A spectral scan becomes one sample per direction and wavelength under the sun of its time and
// place; what cannot be used stays with a reason, and every fault is one line.
#include "data_refs/spectral_scan_csv.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "complaint.h"
#include "data_refs/solar_position.h"

namespace skyfit::refs {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kRounding = 1e-12;
const std::string kPlace =
    "# local_time=2020-06-21T10:00:00 utc_offset_h=1 latitude_deg=48 longitude_deg=16\n";
const std::string kUnit = "# radiance_<nm> in W m^-2 sr^-1 nm^-1; made for this test\n";
const std::string kColumns = "sample,view_azimuth_deg,view_zenith_deg,radiance_400,radiance_550\n";
const std::string kRecords = "0,90,60,0.1,0.2\n1,180,45,0.3,0.4\n";

Reference parse(const std::string& text, const ImportOptions& options = {}) {
  return parse_spectral_scan(text, "scan.csv", options);
}

std::string complaint(const std::string& text, const ImportOptions& options = {}) {
  return complaint_of([&] { parse(text, options); });
}

TEST(SpectralScan, MayHaveLuminancesBesideTheRadiances) {
  const Reference scan = parse(kPlace + kUnit +
                               "sample,view_azimuth_deg,view_zenith_deg,luminance_cd_m2,"
                               "radiance_400,radiance_550\n0,90,60,8000,0.1,0.2\n");
  ASSERT_EQ(scan.samples.size(), 2u);
  EXPECT_EQ(scan.samples[0].value, 0.1);
  EXPECT_EQ(scan.samples[1].value, 0.2);
  EXPECT_THAT(scan.notes, testing::Contains(StartsWith("luminance_cd_m2 is not used")));
}

TEST(SpectralScan, HasASamplePerDirectionAndWavelength) {
  const Reference scan = parse(kPlace + kUnit + kColumns + kRecords);
  const SolarPosition sun =
      solar_position(*instant("2020-06-21T10:00:00", 1), {48 * kDegree, 16 * kDegree, 0});
  EXPECT_EQ(scan.quantity, Quantity::kSpectralRadiance);
  EXPECT_EQ(scan.description,
            "4 samples of spectral radiance in 2 directions and 1 scan from scan.csv");
  ASSERT_EQ(scan.samples.size(), 4u);
  const Sample& second = scan.samples[1];
  EXPECT_EQ(second.direction, 0);
  EXPECT_EQ(second.wavelength_nm, 550);
  EXPECT_EQ(second.value, 0.2);
  EXPECT_EQ(second.weight, 1);
  EXPECT_NEAR(second.view_zenith, 60 * kDegree, kRounding);
  EXPECT_NEAR(second.sun_zenith, sun.zenith, kRounding);
  EXPECT_NEAR(
      std::remainder(second.relative_azimuth - (90 * kDegree - sun.azimuth), 2 * std::numbers::pi),
      0, kRounding);
  EXPECT_EQ(scan.samples[2].direction, 1);
  ASSERT_EQ(scan.scans.size(), 1u);
  EXPECT_EQ(scan.scans[0].name, "scan.csv");
  EXPECT_EQ(scan.scans[0].time_utc, "2020-06-21T09:00:00Z");
  EXPECT_EQ(scan.scans[0].sun_azimuth, sun.azimuth);
  EXPECT_EQ(scan.scans[0].sun_distance_au, sun.distance_au);
}

TEST(SpectralScan, IsRecognisedByItsColumns) {
  EXPECT_TRUE(is_spectral_scan("sample,view_azimuth_deg,view_zenith_deg,radiance_380"));
  EXPECT_FALSE(is_spectral_scan("sun_zenith_deg,view_zenith_deg,view_azimuth_deg,luminance_cd_m2"));
}

// A band, a weight or a sun that nobody reads would be missed.
TEST(SpectralScan, UnknownColumnsAreNamed) {
  std::string columns = kColumns;
  columns.erase(columns.rfind('_'), 1);
  EXPECT_THAT(complaint(kPlace + kUnit + columns + kRecords),
              testing::HasSubstr("unknown column, expected one of sample"));
}

// Blanks around the sign change nothing.
TEST(SpectralScan, FactsMayHaveBlanks) {
  std::string spaced = kPlace;
  for (std::size_t at = 0; (at = spaced.find('=', at)) != spaced.npos; at += 3)
    spaced.replace(at, 1, " = ");
  spaced.insert(spaced.find('#') + 1, std::string(10'000, 'x') + ' ');
  EXPECT_EQ(parse(spaced + kUnit + kColumns + kRecords).samples[0].sun_zenith,
            parse(kPlace + kUnit + kColumns + kRecords).samples[0].sun_zenith);
}

TEST(SpectralScan, UnitsAreConverted) {
  for (const auto& [unit, value] : {std::pair{"mW m-2 sr-1 nm-1", 1e-4},
                                    {"W/(m^2 sr um)", 1e-4},
                                    {"uW cm^-2 sr^-1 nm^-1", 1e-3},
                                    {"W/m2/sr/nm", 0.1}}) {
    const Reference scan =
        parse(kPlace + "# radiance_<nm> in " + unit + "\n" + kColumns + kRecords);
    EXPECT_NEAR(scan.samples[0].value / value, 1, kRounding) << unit;
  }
}

TEST(SpectralScan, UnitIsStatedByTheFileOrTheOptions) {
  const std::string accepted =
      "expected one of W m-2 sr-1 nm-1, mW m-2 sr-1 nm-1, W m-2 sr-1 um-1, uW cm-2 sr-1 nm-1, "
      "mW cm-2 sr-1 um-1";
  const std::string bare = kPlace + kColumns + kRecords;
  EXPECT_EQ(complaint(bare), "scan.csv: unit: not stated, " + accepted);
  EXPECT_EQ(complaint(kPlace + "# radiance_<nm> in cd/m^2\n" + kColumns + kRecords),
            "scan.csv:2: unit = \"cd/m^2\": " + accepted);
  EXPECT_EQ(complaint(kPlace + "# radiance_<nm> in furlongs; oh\n" + kColumns + kRecords),
            "scan.csv:2: unit = \"furlongs\": " + accepted);
  ImportOptions options;
  options.unit = "mW m-2 sr-1 nm-1";
  EXPECT_NEAR(parse(bare, options).samples[0].value, 1e-4, kRounding);
  EXPECT_EQ(complaint(kPlace + kUnit + kColumns + kRecords, options),
            "scan.csv:2: unit = \"W m^-2 sr^-1 nm^-1\": expected \"mW m-2 sr-1 nm-1\", as options "
            "or sidecar state");
}

TEST(SpectralScan, SuspectSamplesStayWithAReason) {
  ImportOptions options;
  options.saturation = 0.9;
  options.near_sun_deg = 5;
  options.exclude_samples = {{0, "a bird"}};
  const SolarPosition sun =
      solar_position(*instant("2020-06-21T10:00:00", 1), {48 * kDegree, 16 * kDegree, 0});
  const Reference scan = parse(
      kPlace + kUnit + "sample,view_azimuth_deg,view_zenith_deg,radiance_400,radiance_2600\n" +
          "0,0,10,1,1\n1,0,10,-0.1,0.1\n2,0,10,nan,0.1\n3,0,10,0.95,0.1\n4,0,92,0.1,0.1\n5," +
          std::to_string(sun.azimuth / kDegree) + "," + std::to_string(sun.zenith / kDegree + 4) +
          ",0.1,0.1\n6,0,10,0.1,0.1\n",
      options);
  std::vector<std::string> reasons;
  for (const Sample& sample : scan.samples) {
    EXPECT_EQ(sample.weight == 0, !sample.zero_weight_reason.empty());
    if (sample.wavelength_nm == 400) reasons.push_back(sample.zero_weight_reason);
  }
  EXPECT_EQ(scan.samples.back().zero_weight_reason,
            "wavelength outside the model's 300 to 2500 nm");
  EXPECT_THAT(reasons, testing::ElementsAre("a bird", "not positive", "not finite", "saturated",
                                            "outside the sky", "near the sun", ""));
}

TEST(SpectralScan, SunIsComputedAndCheckedAgainstTheStatedOne) {
  const std::string rest = kUnit + kColumns + kRecords;
  EXPECT_EQ(complaint(kPlace + "# sun_zenith_deg=33.90 sun_azimuth_deg=126\n" + rest), "accepted");
  EXPECT_THAT(complaint(kPlace + "# sun_zenith_deg=40.1 sun_azimuth_deg=127\n" + rest),
              StartsWith("scan.csv:2: sun_zenith_deg = 40.1: expected the sun of "
                         "2020-06-21T09:00:00Z at this site"));
  EXPECT_THAT(complaint("# local_time=2020-06-21T10:00:00 utc_offset_h=1\n" + rest),
              StartsWith("scan.csv: the sun is not known: expected latitude_deg, longitude_deg, or "
                         "sun_zenith_deg and sun_azimuth_deg"));
  EXPECT_THAT(
      complaint("# local_time=2020-06-21T10:00:00 latitude_deg=48 longitude_deg=16\n" + rest),
      StartsWith("scan.csv: utc_offset_h: not stated"));
  EXPECT_THAT(complaint("# local_time=2020-06-21T23:00:00 utc_offset_h=1 latitude_deg=48 "
                        "longitude_deg=16\n" +
                        rest),
              HasSubstr("at 2020-06-21T22:00:00Z: expected a sun above the horizon"));
  // Half past ten in the morning in New York State, with the longitude's sign turned round.
  EXPECT_THAT(
      complaint("# local_time=2020-06-21T10:30:00 utc_offset_h=-4 latitude_deg=42.4 "
                "longitude_deg=76.5\n" +
                rest),
      AllOf(HasSubstr("a sun above the horizon; longitude_deg = -76.5 would put it at 37.7 deg"),
            HasSubstr(", utc_offset_h = 5 would put it at 26.0 deg")));
  const Reference stated = parse("# sun_zenith_deg=40 sun_azimuth_deg=100\n" + rest);
  EXPECT_NEAR(stated.samples[0].sun_zenith, 40 * kDegree, kRounding);
  EXPECT_EQ(stated.scans[0].time_utc, "");
  EXPECT_EQ(stated.scans[0].sun_distance_au, 1);
}

TEST(SpectralScan, AzimuthsRunAsTheFactsSay) {
  const auto azimuth = [](std::optional<std::string> zero, std::optional<std::string> turns) {
    ImportOptions options;
    options.azimuth_zero = zero;
    options.azimuth_turns = turns;
    const Reference scan = parse(
        "# sun_zenith_deg=40 sun_azimuth_deg=0\n" + kUnit + kColumns + "0,30,60,1,1\n", options);
    return scan.samples[0].relative_azimuth / kDegree;
  };
  EXPECT_NEAR(azimuth({}, {}), 30, kRounding);
  EXPECT_NEAR(azimuth("south", {}), -150, kRounding * 100);
  EXPECT_NEAR(azimuth({}, "counter-clockwise"), -30, kRounding);
  EXPECT_NEAR(azimuth("south", "counter-clockwise"), 150, kRounding * 100);
}

TEST(SpectralScan, FaultsNameLineAndField) {
  const auto with = [](const std::string& record) {
    return complaint(kPlace + kUnit + kColumns + record + "\n");
  };
  EXPECT_EQ(with("0,90,60,bright,0.2"),
            "scan.csv:4: radiance_400 = \"bright\": expected a number, or nan where there is none");
  EXPECT_EQ(with("0,400,60,1,1"), "scan.csv:4: view_azimuth_deg = \"400\": expected -360 to 360");
  EXPECT_EQ(with("0,0,-1,1,1"), "scan.csv:4: view_zenith_deg = \"-1\": expected 0 to 180");
  EXPECT_EQ(with("0.5,0,1,1,1"), "scan.csv:4: sample = \"0.5\": expected a whole number >= 0");
  EXPECT_EQ(with("0,0,1,1,1\n0,0,2,1,1"), "scan.csv:5: sample = \"0\": expected every number once");
  EXPECT_EQ(with("0,0,1,1"), "scan.csv:4: expected 5 fields, got 4");
  EXPECT_EQ(with("0,0,1,0,0"),
            "scan.csv: none of 2 samples can be used, expected at least 1: not positive");
  EXPECT_EQ(complaint(kPlace + kUnit + "sample,view_azimuth_deg,view_zenith_deg,radiance_5x\n"),
            "scan.csv:3: radiance_5x: expected radiance_ and a wavelength in nm");
  EXPECT_EQ(complaint(kPlace + kUnit + "view_azimuth_deg,view_zenith_deg,radiance_500\n"),
            "scan.csv:3: expected a column sample");
  EXPECT_EQ(
      complaint("# local_time=yesterday\n" + kUnit + kColumns + kRecords),
      "scan.csv:1: local_time = yesterday: expected YYYY-MM-DDTHH:MM:SS, also with Z or +HH:MM "
      "behind");
  ImportOptions options;
  options.exclude_samples = {{7, "gone"}};
  EXPECT_EQ(complaint(kPlace + kUnit + kColumns + kRecords, options),
            "scan.csv: exclude_samples = 7: expected the number of a sample");
}

}  // namespace
}  // namespace skyfit::refs
