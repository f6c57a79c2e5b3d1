// SPDX-License-Identifier: Apache-2.0
// A folder of spectra, one file per direction, becomes band means in the directions that the names
// hold.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "complaint.h"
#include "data_refs/references.h"
#include "model/base/temporary_directory.h"

namespace skyfit::refs {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

constexpr double kDegree = std::numbers::pi / 180;

class SpectralScanFolder : public testing::Test {
 protected:
  void SetUp() override {
    options_.utc_offset_h = -4;
    options_.latitude_deg = 42;
    options_.longitude_deg = -76;
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  Reference load() const {
    return load_reference(folder_.string(), {}, Sampling::kPrincipalPlane, options_);
  }
  std::string complaint() const {
    return complaint_of([&] { load(); });
  }

  const TemporaryDirectory temporary_;
  const fs::path folder_ = temporary_.path();
  ImportOptions options_;
};

// Radiance `slope` * (nm - 300) from 350 to 900 nm, every nm.
std::string ramp(double slope) {
  std::string text = "Wavelength\tvalue\n";
  for (int nm = 350; nm <= 900; ++nm)
    text += std::to_string(nm) + "\t" + std::to_string(slope * (nm - 300)) + "\r\n";
  return text;
}

TEST_F(SpectralScanFolder, HoldsBandMeansInTheDirectionsOfTheNames) {
  write("2013-05-27___09.30.00_-_0____000___12.1151.asd.rad.txt", ramp(0.001));
  write("2013-05-27___09.32.10_-_12____135___45.asd.rad.txt", ramp(0.002));
  write("notes.txt", "a dog walked by");
  const Reference scan = load();
  EXPECT_EQ(scan.quantity, Quantity::kSpectralRadiance);
  ASSERT_EQ(scan.samples.size(), 2u * 93);  // 365, 370 .. 825 nm: bands within 360 to 830
  EXPECT_EQ(scan.samples.front().wavelength_nm, 365);
  EXPECT_EQ(scan.samples.back().wavelength_nm, 825);
  EXPECT_EQ(scan.samples.back().direction, 12);
  for (const Sample& sample : scan.samples) {
    // The mean of a straight line over a band is its value in the middle.
    const double slope = sample.direction == 0 ? 0.001 : 0.002;
    constexpr double kSixDecimals = 1e-6;
    EXPECT_NEAR(sample.value, slope * (sample.wavelength_nm - 300), kSixDecimals);
    EXPECT_NEAR(sample.view_zenith, (sample.direction == 0 ? 77.8849 : 45) * kDegree, 1e-12);
    // Counter-clockwise from north: 135 deg lies in the south-west.
    const double azimuth = sample.direction == 0 ? 0 : -135;
    EXPECT_NEAR(
        std::remainder(sample.relative_azimuth + *scan.scans[0].sun_azimuth - azimuth * kDegree,
                       360 * kDegree),
        0, 1e-12);
  }
  EXPECT_EQ(scan.scans[0].time_utc, "2013-05-27T13:32:10Z");
  options_.band_nm = 20;
  EXPECT_EQ(load().samples.size(), 2u * 23);  // 380, 400 .. 820
}

TEST_F(SpectralScanFolder, ASpectrumThatWasCutShortIsSaid) {
  write("2013-05-27___09.30.00_-_0____000___12.1151.asd.rad.txt", ramp(0.001));
  const std::string whole = ramp(0.002);
  write("2013-05-27___09.32.10_-_12____135___45.asd.rad.txt", whole.substr(0, whole.find("\n601")));
  const Reference scan = load();
  EXPECT_EQ(scan.samples.size(), 93u + 47u);  // 365 to 595 nm
  EXPECT_THAT(scan.notes, testing::Contains(HasSubstr("1 of 2 spectra holds fewer wavelengths than "
                                                      "the others, as "
                                                      "\"2013-05-27___09.32.10_-_12____135___45")));
}

TEST_F(SpectralScanFolder, FaultsNameTheFile) {
  EXPECT_THAT(complaint(), HasSubstr(": no measured sky: expected files DATE___HH.MM.SS"));
  const std::string good = "2013-05-27___09.30.00_-_0____000___12.1151.asd.rad.txt";
  const std::string path = (folder_ / good).string();
  write(good, "Wavelength\tvalue\n400\t0.1\n401\tdark\n");
  EXPECT_EQ(complaint(), path + ":3: \"401 dark\": expected a wavelength in nm and a radiance");
  write(good, "Wavelength\tvalue\n400\t0.1\n400\t0.1\n");
  EXPECT_EQ(complaint(), path + ":3: wavelength = 400: expected ascending wavelengths");
  write(good, "Wavelength\tvalue\n");
  EXPECT_EQ(complaint(), path + ":2: expected at least 2 wavelengths");
  write(good, ramp(0.001));
  EXPECT_EQ(complaint(), "accepted");
  write("2013-05-27___09.30.00_-_0____090___12.1151.asd.rad.txt", ramp(0.001));
  EXPECT_THAT(complaint(), HasSubstr("expected one file with index 0"));
  fs::remove(folder_ / "2013-05-27___09.30.00_-_0____090___12.1151.asd.rad.txt");
  write("2013-05-27___11.30.00_-_1____090___12.1151.asd.rad.txt", ramp(0.001));
  EXPECT_THAT(complaint(), HasSubstr("expected those of one scan, within 30 minutes"));
}

TEST_F(SpectralScanFolder, SiteAndOffsetAreAskedFor) {
  write("2013-05-27___09.30.00_-_0____000___12.1151.asd.rad.txt", ramp(0.001));
  options_ = {};
  EXPECT_EQ(complaint(), folder_.string() +
                             ": utc_offset_h: not stated, expected the hours that local_time is "
                             "ahead of UTC");
  std::ofstream(folder_.string() + ".sidecar.json")
      << R"({"utc_offset_h": -4, "latitude_deg": 42, "longitude_deg": -76})";
  EXPECT_EQ(complaint(), "accepted");
  fs::remove(folder_.string() + ".sidecar.json");
  options_.unit = "cd m-2";
  options_.utc_offset_h = -4;
  EXPECT_THAT(complaint(), HasSubstr("unit = \"cd m-2\": expected one of W m-2 sr-1 nm-1"));
}

}  // namespace
}  // namespace skyfit::refs
