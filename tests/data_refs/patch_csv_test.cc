// SPDX-License-Identifier: Apache-2.0
// 145 numbers become the luminances of the patches in the scanner's order; where azimuths start is
// stated or seen from the sky's brightness.
#include "data_refs/patch_csv.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "complaint.h"
#include "data_refs/cie_sky.h"
#include "data_refs/patch_scan.h"

namespace skyfit::refs {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kRounding = 1e-9;
const std::string kSun = "# sun_zenith_deg=50 sun_azimuth_deg=120\n";

// Luminances of a CIE type under that sun, patches to and fro; azimuths start at `zero_deg`.
std::vector<double> cie_values(int type, double zero_deg) {
  std::vector<double> values;
  for (const SkyDirection& patch : patch_directions({})) {
    Sample sample;
    sample.sun_zenith = 50 * kDegree;
    sample.view_zenith = patch.view_zenith;
    sample.relative_azimuth = patch.relative_azimuth + (zero_deg - 120) * kDegree;
    values.push_back(cie_relative_luminance(cie_skies()[type - 1], sample.sun_zenith,
                                            sample.view_zenith, scattering_angle(sample)));
  }
  return values;
}

std::string text_of(const std::vector<double>& values, const char* separator) {
  std::string text;
  for (const double value : values) text += std::to_string(value) + separator;
  text.pop_back();
  return text + "\n";
}

Reference parse(const std::string& text, const ImportOptions& options = {}) {
  return parse_patch_csv(text, "scan.csv", options);
}

std::string complaint(const std::string& text, const ImportOptions& options = {}) {
  return complaint_of([&] { parse(text, options); });
}

TEST(PatchOrder, GoesToAndFro) {
  const std::vector<SkyDirection> patches = patch_directions({});
  ASSERT_EQ(patches.size(), kPatches);
  const auto azimuth_deg = [&](int number) {
    return patches[number - 1].relative_azimuth / kDegree;
  };
  EXPECT_NEAR(azimuth_deg(1), 0, kRounding);
  EXPECT_NEAR(azimuth_deg(30), 348, kRounding);
  EXPECT_NEAR(azimuth_deg(31), 348, kRounding);
  EXPECT_NEAR(azimuth_deg(60), 0, kRounding);
  EXPECT_NEAR(azimuth_deg(61), 0, kRounding);
  EXPECT_NEAR(azimuth_deg(84), 345, kRounding);
  EXPECT_NEAR(azimuth_deg(109), 0, kRounding);  // the fifth row again upward
  EXPECT_NEAR(patches[144].view_zenith, 0, kRounding);
  ImportOptions rows;
  rows.patch_order = "rows";
  EXPECT_NEAR(patch_directions(rows)[30].relative_azimuth, 0, kRounding);
}

TEST(PatchCsv, HoldsTheSkyInOneLineOrIn145) {
  const std::vector<double> values = cie_values(12, 0);
  for (const char* separator : {",", "\n"}) {
    const Reference scan =
        parse("# unit=relative azimuth_zero=north\n" + kSun + text_of(values, separator));
    EXPECT_EQ(scan.quantity, Quantity::kRelativeLuminance);
    ASSERT_EQ(scan.samples.size(), kPatches);
    for (const Sample& sample : scan.samples) {
      constexpr double kSixDecimals = 2e-5;  // of values from 0.1 on
      EXPECT_NEAR(
          sample.value / cie_relative_luminance(cie_skies()[11], sample.sun_zenith,
                                                sample.view_zenith, scattering_angle(sample)),
          1, kSixDecimals);
    }
    EXPECT_EQ(scan.samples.front().direction, 1);
    EXPECT_EQ(scan.samples.back().direction, 145);
  }
}

TEST(PatchCsv, AzimuthZeroIsSeenFromTheBrightestPatches) {
  const std::string facts = "# unit=kcd/m^2\n" + kSun;
  for (const auto& [zero, name] : {std::pair{0, "north"}, {180, "south"}}) {
    const std::string text = facts + text_of(cie_values(12, zero), ",");
    const Reference found = parse(text);
    ASSERT_EQ(found.notes.size(), 1u);
    EXPECT_THAT(found.notes[0], StartsWith(std::string("azimuth_zero is ") + name));
    ImportOptions stated;
    stated.azimuth_zero = name;
    EXPECT_TRUE(parse(text, stated).notes.empty());
    const Sample brightest = *std::ranges::max_element(found.samples, {}, &Sample::value);
    EXPECT_LT(scattering_angle(brightest), 12 * kDegree);
    stated.azimuth_zero = zero == 0 ? "south" : "north";
    EXPECT_THAT(complaint(text, stated),
                StartsWith("scan.csv: azimuth_zero = " + *stated.azimuth_zero + ": expected " +
                           name + ": the brightest patches are "));
  }
  // An overcast sky does not tell.
  const std::string overcast = facts + text_of(cie_values(1, 0), ",");
  EXPECT_THAT(complaint(overcast),
              StartsWith("scan.csv: azimuth_zero: not stated, expected north or south"));
  ImportOptions stated;
  stated.azimuth_zero = "south";
  EXPECT_EQ(complaint(overcast, stated), "accepted");
}

TEST(PatchCsv, FaultsNameLineAndField) {
  std::vector<double> values = cie_values(12, 0);
  const std::string facts = "# unit=cd/m2 azimuth_zero=north\n" + kSun;
  const std::string line = text_of(values, ",");
  EXPECT_EQ(complaint("# azimuth_zero=north\n" + kSun + line),
            "scan.csv: unit: not stated, expected one of cd m-2, kcd m-2, relative");
  EXPECT_EQ(complaint("# unit=W/m2 azimuth_zero=north\n" + kSun + line).substr(0, 35),
            "scan.csv:1: unit = W/m2: expected o");
  EXPECT_EQ(complaint("# unit=W/m2/sr/nm azimuth_zero=north\n" + kSun + line),
            "scan.csv:1: unit = \"W/m2/sr/nm\": expected one of cd m-2, kcd m-2, relative");
  EXPECT_EQ(complaint("# unit=cd/m2\n" + line),
            "scan.csv: the sun is not known: expected local_time, latitude_deg, longitude_deg, or "
            "sun_zenith_deg and sun_azimuth_deg");
  EXPECT_EQ(complaint(facts + "1,2,bright\n"),
            "scan.csv:3: patch 3 = \"bright\": expected a number, or nan where there is none");
  values.pop_back();
  EXPECT_EQ(complaint(facts + text_of(values, ",")),
            "scan.csv: 144 numbers: expected the 145 patches of a sky scan");
}

TEST(PatchCsv, IsRecognisedByItsNumbers) {
  EXPECT_TRUE(is_patch_csv("1,2.5,nan"));
  EXPECT_TRUE(is_patch_csv("1"));
  for (const char* line : {"", "a,b", "1,b", "\"1\"", "sun_zenith_deg,view_zenith_deg"})
    EXPECT_FALSE(is_patch_csv(line)) << line;
}

}  // namespace
}  // namespace skyfit::refs
