// SPDX-License-Identifier: Apache-2.0
// A CSV of samples becomes the samples it holds; every fault is one line with file, line, column,
// value, expectation.
#include "data_refs/sample_csv.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <tuple>

#include "data_refs/references.h"

namespace skyfit::refs {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kRounding = 1e-15;
const std::string kHeader = "sun_zenith_deg,view_zenith_deg,relative_azimuth_deg,luminance_cd_m2";

std::string complaint(const std::string& text) {
  try {
    parse_sample_csv(text, "sky.csv");
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SampleCsv, ReadsEveryColumn) {
  const Reference reference = parse_sample_csv(
      "# measured\n" + kHeader +
          ",sigma,weight,scan\n30,60,90,4000,40,0.5,a\n40,10,-45,3000,30,0,b\n31,5,0,2000,20,1,a\n",
      "sky.csv");
  EXPECT_EQ(reference.name, "sky.csv");
  EXPECT_EQ(reference.description, "3 samples of luminance in 2 scans from sky.csv");
  EXPECT_EQ(reference.quantity, Quantity::kLuminance);
  ASSERT_EQ(reference.samples.size(), 3u);
  const Sample& first = reference.samples[0];
  EXPECT_NEAR(first.sun_zenith, 30 * kDegree, kRounding);
  EXPECT_NEAR(first.view_zenith, 60 * kDegree, kRounding);
  EXPECT_NEAR(first.relative_azimuth, 90 * kDegree, kRounding);
  EXPECT_EQ(first.value, 4000);
  EXPECT_EQ(first.sigma, 40);
  EXPECT_EQ(first.weight, 0.5);
  EXPECT_TRUE(first.zero_weight_reason.empty());
  EXPECT_EQ(reference.samples[1].zero_weight_reason, "weight 0 in the file");
  EXPECT_EQ(first.scan, 0);
  EXPECT_EQ(reference.samples[1].scan, 1);
  EXPECT_EQ(reference.samples[2].scan, 0);
}

TEST(SampleCsv, ReadsPolarisationWhereItWasMeasured) {
  const Reference reference = parse_sample_csv(
      kHeader +
          ",q_over_i,q_over_i_sigma,u_over_i\n30,60,90,4000,-0.25,0.01,0.5\n30,10,90,4000,,,\n",
      "sky.csv");
  EXPECT_EQ(reference.description,
            "2 samples of luminance and 2 readings of polarisation in 1 scans from sky.csv");
  const auto& readings = reference.samples[0].polarisation;
  ASSERT_EQ(readings.size(), 2u);
  EXPECT_EQ(readings[0].what, Polarisation::kQ);
  EXPECT_EQ(readings[0].value, -0.25);
  EXPECT_EQ(readings[0].sigma, 0.01);
  EXPECT_EQ(readings[1].what, Polarisation::kU);
  EXPECT_EQ(readings[1].value, 0.5);
  EXPECT_FALSE(readings[1].sigma);
  EXPECT_TRUE(reference.samples[1].polarisation.empty());
}

TEST(SampleCsv, FaultsOfPolarisationAreNamed) {
  EXPECT_THAT(complaint(kHeader + ",dolp\n30,60,90,4000,55\n"),
              StartsWith("sky.csv:2: dolp = \"55\": expected 0 to 1"));
  EXPECT_THAT(complaint(kHeader + ",q_over_i\n30,60,90,4000,-1.5\n"),
              StartsWith("sky.csv:2: q_over_i = \"-1.5\": expected -1 to 1"));
  EXPECT_THAT(complaint(kHeader + ",u_over_i,u_over_i_sigma\n30,60,90,4000,0.1,0\n"),
              StartsWith("sky.csv:2: u_over_i_sigma = \"0\": expected a number > 0"));
  EXPECT_THAT(complaint(kHeader + ",dolp_sigma\n30,60,90,4000,0.1\n"),
              HasSubstr("expected dolp with dolp_sigma"));
  EXPECT_THAT(complaint(kHeader + ",dolp,q_over_i\n30,60,90,4000,0.1,0.1\n"),
              HasSubstr("either dolp or q_over_i and u_over_i"));
}

TEST(SampleCsv, AzimuthsOfSunAndViewBecomeTheirDifference) {
  const Reference reference = parse_sample_csv(
      "view_azimuth_deg,sun_azimuth_deg,view_zenith_deg,sun_zenith_deg,relative_luminance\n10,350,"
      "60,30,1\n200,10,60,30,2\n",
      "sky.csv");
  EXPECT_EQ(reference.quantity, Quantity::kRelativeLuminance);
  EXPECT_NEAR(reference.samples[0].relative_azimuth, 20 * kDegree, kRounding);
  EXPECT_NEAR(reference.samples[1].relative_azimuth, -170 * kDegree, kRounding);
}

TEST(SampleCsv, EverySunPositionIsAScanWhenThereIsNoColumn) {
  const Reference by_zenith =
      parse_sample_csv(kHeader + "\n30,60,0,1\n40,60,0,1\n30,10,0,1\n", "sky.csv");
  EXPECT_EQ(by_zenith.samples[0].scan, 0);
  EXPECT_EQ(by_zenith.samples[1].scan, 1);
  EXPECT_EQ(by_zenith.samples[2].scan, 0);
  const Reference by_azimuth = parse_sample_csv(
      "sun_zenith_deg,sun_azimuth_deg,view_zenith_deg,view_azimuth_deg,relative_luminance\n30,90,0,"
      "0,1\n30,270,0,0,1\n",
      "sky.csv");
  EXPECT_EQ(by_azimuth.samples[1].scan, 1);
}

// A sun of its own for every sample: it moves within a scan.
TEST(SampleCsv, AMovingSunIsOneScanUntilItJumps) {
  const Reference sky = parse_sample_csv(
      "sun_zenith_deg,relative_azimuth_deg,view_zenith_deg,luminance_cd_m2\n"
      "30.0,0,10,4000\n30.1,20,10,4000\n30.2,40,10,4000\n45,0,10,3000\n45.1,20,10,3000\n",
      "sky.csv");
  ASSERT_EQ(sky.scans.size(), 2u);
  EXPECT_EQ(sky.samples[2].scan, 0);
  EXPECT_NEAR(sky.samples[2].sun_zenith * 180 / std::numbers::pi, 30.2, 1e-9);
  EXPECT_EQ(sky.samples[4].scan, 1);
}

TEST(SampleCsv, ColumnsMustBeTheKnownOnes) {
  const std::string columns = "sun_zenith_deg,view_zenith_deg,";
  EXPECT_THAT(complaint(kHeader + ",sigmas\n"),
              StartsWith("sky.csv:1: sigmas: unknown column, expected one of "));
  EXPECT_THAT(
      complaint("view_zenith_deg,relative_azimuth_deg,luminance_cd_m2\n"),
      StartsWith("sky.csv:1: expected a column sun_zenith_deg, got the columns view_zenith_deg,"));
  EXPECT_THAT(complaint("sun_zenith_deg,relative_azimuth_deg,luminance_cd_m2\n"),
              HasSubstr("expected a column view_zenith_deg"));
  const std::string azimuths =
      "expected either relative_azimuth_deg or both of sun_azimuth_deg and view_azimuth_deg";
  EXPECT_THAT(complaint(columns + "luminance_cd_m2\n"), HasSubstr(azimuths));
  EXPECT_THAT(complaint(columns + "sun_azimuth_deg,luminance_cd_m2\n"), HasSubstr(azimuths));
  EXPECT_THAT(complaint(columns + "relative_azimuth_deg,sun_azimuth_deg,luminance_cd_m2\n"),
              HasSubstr(azimuths));
  const std::string luminances =
      "expected exactly one of luminance_cd_m2, relative_luminance and "
      "spectral_radiance_w_m2_sr_nm";
  EXPECT_THAT(complaint(columns + "relative_azimuth_deg\n"), HasSubstr(luminances));
  EXPECT_THAT(complaint(kHeader + ",relative_luminance\n"), HasSubstr(luminances));
}

TEST(SampleCsv, WavelengthBelongsToASpectralRadiance) {
  const std::string expected = "expected wavelength_nm with a spectral radiance, and only there";
  EXPECT_THAT(complaint(kHeader + ",wavelength_nm\n"), HasSubstr(expected));
  EXPECT_THAT(complaint("sun_zenith_deg,view_zenith_deg,relative_azimuth_deg,"
                        "spectral_radiance_w_m2_sr_nm\n"),
              HasSubstr(expected));
}

// What the writer leaves the reader finds, to nine digits.
TEST(SampleCsv, IsReadBackAsItWasWritten) {
  constexpr double kNineDigits = 1e-8;
  Reference written;
  written.name = "scan.csv";
  written.quantity = Quantity::kSpectralRadiance;
  written.scans = {{"scan, the first", "2020-06-21T09:00:00Z", 2.1, 1.0163, 450.0},
                   {"second", "", 2.2, 1, {}}};
  for (int i = 0; i < 4; ++i) {
    Sample sample;
    sample.sun_zenith = 0.6;
    sample.view_zenith = 0.3 * i;
    sample.relative_azimuth = 1.5 * i - 3;
    sample.wavelength_nm = 400 + 10 * i;
    sample.value = i == 1 ? -1 : 0.1 * (i + 1);
    sample.weight = i == 1 ? 0 : 1;
    if (i == 1) sample.zero_weight_reason = "a \"bird\", or so";
    sample.scan = i / 2;
    sample.direction = i;
    written.samples.push_back(sample);
  }
  const Reference read = parse_sample_csv(sample_csv_text(written), "copy.csv");
  EXPECT_EQ(read.quantity, written.quantity);
  ASSERT_EQ(read.samples.size(), written.samples.size());
  for (std::size_t i = 0; i < read.samples.size(); ++i) {
    const Sample &a = read.samples[i], &b = written.samples[i];
    EXPECT_NEAR(a.view_zenith, b.view_zenith, kNineDigits);
    EXPECT_NEAR(std::remainder(a.relative_azimuth - b.relative_azimuth, 360 * kDegree), 0,
                kNineDigits);
    EXPECT_EQ(std::tie(a.wavelength_nm, a.weight, a.zero_weight_reason, a.scan, a.direction),
              std::tie(b.wavelength_nm, b.weight, b.zero_weight_reason, b.scan, b.direction));
    EXPECT_NEAR(a.value / b.value, 1, kNineDigits);
  }
  ASSERT_EQ(read.scans.size(), 2u);
  EXPECT_EQ(read.scans[0].name, "scan, the first");
  EXPECT_EQ(read.scans[0].time_utc, "2020-06-21T09:00:00Z");
  EXPECT_NEAR(read.scans[0].sun_distance_au, 1.0163, kNineDigits);
  EXPECT_NEAR(*read.scans[0].sun_azimuth, 2.1, kNineDigits);
  EXPECT_EQ(read.scans[0].elevation_m, 450);
  EXPECT_EQ(read.scans[1].time_utc, "");
}

TEST(SampleCsv, ValuesMustBeInRange) {
  const auto with = [](const std::string& record) {
    return complaint(kHeader + ",sigma,weight\n30,60,0,5,1,1\n" + record + "\n");
  };
  EXPECT_EQ(with("90,60,0,5,1,1"),
            "sky.csv:3: sun_zenith_deg = \"90\": expected 0 <= sun_zenith_deg < 90, a sun above "
            "the horizon");
  EXPECT_THAT(with("-1,60,0,5,1,1"), StartsWith("sky.csv:3: sun_zenith_deg = \"-1\""));
  EXPECT_THAT(with("30,90,0,5,1,1"), StartsWith("sky.csv:3: view_zenith_deg = \"90\""));
  EXPECT_EQ(with("30,60,361,5,1,1"),
            "sky.csv:3: relative_azimuth_deg = \"361\": expected -360 to 360");
  EXPECT_EQ(with("30,60,0,0,1,1"), "sky.csv:3: luminance_cd_m2 = \"0\": expected a number > 0");
  EXPECT_EQ(with("30,60,0,nan,1,1"),
            "sky.csv:3: luminance_cd_m2 = \"nan\": expected a finite number");
  EXPECT_EQ(with("30,60,0,abc,1,1"),
            "sky.csv:3: luminance_cd_m2 = \"abc\": expected a finite number");
  EXPECT_EQ(with("30,60,0,5,-1,1"), "sky.csv:3: sigma = \"-1\": expected a number > 0");
  EXPECT_EQ(with("30,60,0,5,1,-0.1"), "sky.csv:3: weight = \"-0.1\": expected a number >= 0");
  EXPECT_EQ(with("30,60,0,5,1"), "sky.csv:3: expected 6 fields, got 5");
}

TEST(SampleCsv, AnEmptyReferenceIsAnError) {
  EXPECT_EQ(complaint(kHeader + "\n"), "sky.csv: 0 samples with a weight > 0, expected at least 1");
  EXPECT_EQ(complaint(kHeader + ",weight\n30,60,0,5,0\n"),
            "sky.csv: 0 samples with a weight > 0, expected at least 1");
  EXPECT_EQ(complaint(""), "sky.csv: is empty, expected a line of column names");
}

TEST(SampleCsv, SamplesAreExcludedByTheirOrder) {
  const std::string text = kHeader + "\n30,60,0,5\n30,50,0,6\n";
  const std::vector<ExcludedSample> second = {{1, "a bird"}}, third = {{2, "a bird"}};
  const Reference reference = parse_sample_csv(text, "sky.csv", second);
  EXPECT_EQ(reference.samples[0].weight, 1);
  EXPECT_EQ(reference.samples[1].weight, 0);
  EXPECT_EQ(reference.samples[1].zero_weight_reason, "a bird");
  EXPECT_THAT([&] { parse_sample_csv(text, "sky.csv", third); },
              testing::ThrowsMessage<std::invalid_argument>(
                  "sky.csv: exclude_samples = 2: expected the number of a sample, from 0 in the "
                  "order of the file"));
}

TEST(ShippedExample, IsTheCieSkyItSays) {
  constexpr double kNineDigits = 1e-8;
  const Reference example =
      load_reference(SKYFIT_EXAMPLES "clear_sky_two_suns.csv", {}, Sampling::kPrincipalPlane);
  const Reference formula =
      load_reference("cie:12", {30 * kDegree, 60 * kDegree}, Sampling::kPrincipalPlane);
  ASSERT_EQ(example.samples.size(), formula.samples.size());
  for (std::size_t i = 0; i < example.samples.size(); ++i) {
    EXPECT_NEAR(example.samples[i].value / formula.samples[i].value, 1, kNineDigits);
    EXPECT_NEAR(scattering_angle(example.samples[i]), scattering_angle(formula.samples[i]), 1e-7);
    EXPECT_EQ(example.samples[i].scan, formula.samples[i].scan);
  }
}

}  // namespace
}  // namespace skyfit::refs
