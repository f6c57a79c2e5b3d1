// SPDX-License-Identifier: Apache-2.0
// Currents of a sky radiometer become radiances L = U E0 / (F0 SVA), in directions that count from
// the sun that its first direction is; every fault is one line.
#include "data_refs/sky_radiometer.h"

#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "complaint.h"
#include "data_refs/measured_formats.h"
#include "data_refs/pom_instrument.h"
#include "data_refs/spectra.h"
#include "model/base/temporary_directory.h"
#include "model/base/whole_file.h"
#include "model/numerics/angles.h"

namespace skyfit::refs {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr double kRounding = 1e-9;
// The sun of 2024-05-15 06:30 UTC at 47.5 N 11 E: zenith 63.112, azimuth 90.754 deg. The
// instrument's axis is 0.5 deg off.
const std::string kHead =
    "POM-01,T,S, 011.000, 047.500,24/05/15,06:30:00,24/05/15,08:30:00\n3,0315,0500,0870\n";
const std::string kScan = "24/05/15,06:30:00,24/05/15,08:30:00,H,Site,\n";
const std::string kSun = "06:30:00,08:30:00,-89.25,027.39,1E-09,2E-05,3E-05\n";
const std::string kSky = "06:30:06,08:30:06,-59.25,027.39,0.0E+00,4.0E-09,3.0E-09,21.3,18.1,0000\n";
const std::string kInstrument =
    "title\n\"S\" : number\n30\n 3 : wavelengths\n3.15E-05 5.0E-05 8.7E-05 : cm\n"
    "2.4E-04 2.5E-04\n2.0E-04 : sr\n2 : calibrations\n"
    "2024 5 10 6.5  0.0 2.0E-4 1.0E-4\n2024 5 20 6.5  0.0 4.0E-4 1.0E-4\n";

class SkyRadiometer : public testing::Test {
 protected:
  Reference parse(const std::string& text, const std::string& instrument = kInstrument) const {
    write_file(directory_.path() / "ins.para", instrument);
    ImportOptions options;
    options.instrument_parameters = (directory_.path() / "ins.para").string();
    return parse_sky_radiometer(text, "sky.dat", options);
  }
  std::string complaint(const std::string& text,
                        const std::string& instrument = kInstrument) const {
    return complaint_of([&] { parse(text, instrument); });
  }
  std::string complaint_about(const std::string& instrument) const {
    const std::string file = (directory_.path() / "ins.para").string();
    const std::string message = complaint(kHead + kScan + kSun + kSky, instrument);
    EXPECT_THAT(message, StartsWith(file + ":"));
    return message.substr(std::min(message.size(), file.size() + 1));
  }

  const TemporaryDirectory directory_;
};

TEST_F(SkyRadiometer, CurrentsBecomeRadiancesBesideTheSun) {
  const Reference sky = parse(kHead + kScan + kSun + kSky);
  ASSERT_EQ(sky.samples.size(), 6u);
  EXPECT_EQ(sky.quantity, Quantity::kSpectralRadiance);
  const Sample &sun = sky.samples[2], &green = sky.samples[3], &infrared = sky.samples[5];
  EXPECT_EQ(sun.zero_weight_reason, "the sun itself");
  EXPECT_EQ(sky.samples[1].zero_weight_reason, "channel without calibration");
  EXPECT_EQ(green.wavelength_nm, 500);
  const Spectrum& e0 = standard_spectral_data().solar_irradiance;
  EXPECT_NEAR(green.value, 4e-9 * e0.at(500) / (3e-4 * 2.5e-4), kRounding);  // F0 of half-way
  EXPECT_NEAR(infrared.value, 3e-9 * e0.at(870) / (1e-4 * 2e-4), kRounding);
  EXPECT_NEAR(green.relative_azimuth, 30 * kRadiansPerDegree, kRounding);
  EXPECT_NEAR(green.view_zenith, green.sun_zenith, kRounding);
  EXPECT_NEAR(green.sun_zenith / kRadiansPerDegree, 63.112, 0.001);
  EXPECT_EQ(sky.scans.size(), 1u);
  EXPECT_EQ(sky.scans[0].time_utc, "2024-05-15T06:30:00Z");
  EXPECT_THAT(sky.notes, testing::Contains(HasSubstr("up to 0.5 deg away")));
}

TEST_F(SkyRadiometer, AVerticalScanGoesThroughTheZenith) {
  std::string scan = kScan;
  scan.replace(scan.find(",H,"), 3, ",V,");
  const Reference sky =
      parse(kHead + scan + kSun + "06:30:06,08:30:06,-89.25,127.39,0,4.0E-09,3.0E-09\n");
  const Sample& beyond = sky.samples[3];
  EXPECT_NEAR(beyond.view_zenith / kRadiansPerDegree, 100 - 63.112, 0.001);
  EXPECT_NEAR(std::abs(beyond.relative_azimuth) / kRadiansPerDegree, 180, kRounding);
}

TEST_F(SkyRadiometer, AScanThatIsCutOffIsLeftOutAndSaid) {
  std::string later = kScan;
  later.replace(later.find("06:30"), 5, "06:31");
  const Reference sky = parse(kHead + kScan + kSun + kSky + later + kSun + kSky.substr(0, 40));
  EXPECT_EQ(sky.scans.size(), 1u);
  EXPECT_THAT(sky.notes[0],
              StartsWith("a scan is left out: sky.dat:8: expected at least 7 fields"));
}

TEST_F(SkyRadiometer, FaultsNameLineAndField) {
  EXPECT_THAT(
      complaint_of([] { parse_sky_radiometer(kHead + kScan + kSun + kSky, "sky.dat", {}); }),
      StartsWith("sky.dat: instrument_parameters: not stated"));
  EXPECT_EQ(complaint(kHead), "sky.dat: 0 scans: expected at least 1");
  EXPECT_THAT(complaint(kHead + kScan), HasSubstr("sky.dat:3: 0 directions: expected the sun"));
  EXPECT_EQ(complaint(kHead + kScan + "06:30:00,08:30:00,east,027.39,1,1,1\n"),
            "sky.dat:4: azimuth = \"east\": expected a number");
  std::string other = kScan;
  other.replace(other.find(",H,"), 3, ",S,");
  EXPECT_EQ(complaint(kHead + other + kSun + kSky),
            "sky.dat:3: scan type = \"S\": expected H or V, a scan of the sky");
  EXPECT_THAT(
      complaint(kHead + kScan + "06:30:00,08:30:00,-39.25,027.39,1,1,1\n" + kSky),
      HasSubstr("deg away from the sun of 2024-05-15T06:30:00Z: expected the sun within 5"));
  std::string far = kHead;
  far.replace(far.find("047.500"), 7, "147.500");
  EXPECT_EQ(complaint(far + kScan), "sky.dat:1: latitude = 147.500: expected -90 to 90");
  EXPECT_THAT(complaint("POM-02,T,S, 011.000, 047.500\n"),
              StartsWith("sky.dat:1: expected 9 fields"));
  EXPECT_THAT(complaint(kHead.substr(0, kHead.find('\n')) + "\n4,0315,0500,0870\n"),
              StartsWith("sky.dat:2: number of channels = 4"));
}

TEST_F(SkyRadiometer, TheInstrumentMustBeTheFiles) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = kInstrument;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_THAT(complaint_about(with("\"S\"", "\"R\"")), HasSubstr("\"R\": expected \"S\""));
  EXPECT_THAT(complaint_about(with("5.0E-05", "5.5E-05")), HasSubstr("expected 315, 500, 870 nm"));
  EXPECT_THAT(complaint_about(with("\"S\"", "S")), HasSubstr("2: expected the number of the inst"));
  EXPECT_THAT(complaint_about(with("2.4E-04", "?")), HasSubstr("0 of 3 numbers were found"));
  EXPECT_THAT(complaint_about(with("2024 5 20", "2024 5 32")), HasSubstr("no date and hour"));
  EXPECT_THAT(complaint_about(kInstrument.substr(0, kInstrument.size() - 40)),
              HasSubstr("expected year, month, day"));
}

TEST(PomInstrument, OutsideItsCalibrationsTheNearestHolds) {
  const PomInstrument instrument = parse_pom_instrument(kInstrument, "ins.para");
  EXPECT_EQ(instrument.current_a(1, *instant("2024-01-01T00:00:00", 0)), 2e-4);
  EXPECT_EQ(instrument.current_a(1, *instant("2025-01-01T00:00:00", 0)), 4e-4);
  EXPECT_EQ(instrument.current_a(0, *instant("2025-01-01T00:00:00", 0)), std::nullopt);
}

}  // namespace
}  // namespace skyfit::refs
