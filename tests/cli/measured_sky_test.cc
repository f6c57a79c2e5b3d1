// SPDX-License-Identifier: Apache-2.0
// Measured skies go through check, references and back; what is wrong with them, their sidecar or
// the options is one line.
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace skyfit::cli {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kExamples = SKYFIT_EXAMPLES;

class MeasuredSkyTest : public ProgramTest {
 protected:
  json summary(const std::string& file) const {
    return json::parse(output({"check", "--json", file}));
  }
};

TEST_F(MeasuredSkyTest, CheckSaysWhatAScanHolds) {
  EXPECT_EQ(
      output({"check", kExamples + "spectral_scan.csv"}),
      kExamples +
          "spectral_scan.csv: valid samples of spectral radiance: 225 (216 with weight; not "
          "used: 9 \"twice too bright, shutter left half open\") at 9 wavelengths from 400 to "
          "720 nm in 25 directions and 1 scan, sun zenith 43.5108098 to 43.5108098 deg\n"
          "  spectral_scan.csv: 2024-05-15T08:30:00Z, sun zenith 43.511, azimuth 116.684 deg, "
          "1.01093 au, 225 samples\n");
  const json scan = summary(kExamples + "spectral_scan.csv");
  EXPECT_EQ(scan.at("quantity"), "spectral radiance");
  EXPECT_EQ(scan.at("samples_not_used").at("twice too bright, shutter left half open"), 9);
  EXPECT_EQ(scan.at("wavelengths_nm").size(), 9u);
  EXPECT_EQ(scan.at("scan_list")[0].at("elevation_m"), 700);
  EXPECT_THAT(output({"check", kExamples + "sky_scan_eko.csv"}),
              HasSubstr("azimuth_zero is south: the brightest patches are"));
  EXPECT_THAT(output({"check", kExamples + "spectral_scan.csv.sidecar.json"}),
              HasSubstr("valid sidecar, 1 excluded samples"));
}

// The lines of an almucantar follow the sun; the summary has time, zenith angle and azimuth of the
// first, by NOAA's formula.
TEST_F(MeasuredSkyTest, CheckHasTheSunOfAScansBegin) {
  const json scan = summary(kExamples + "aeronet_almucantar.csv").at("scan_list")[0];
  EXPECT_EQ(scan.at("time_utc"), "2024-05-15T06:30:00Z");
  EXPECT_NEAR(scan.at("sun_zenith_deg").get<double>(), 63.112, 0.02);
  EXPECT_NEAR(scan.at("sun_azimuth_deg").get<double>(), 90.754, 0.02);
}

// Every example, printed as a CSV of samples, is read back as the same sky.
TEST_F(MeasuredSkyTest, ReferencesPrintEveryFormatForTheOtherCommands) {
  for (const char* name :
       {"spectral_scan.csv", "spectral_scan_folder", "sky_scan_145.csv", "sky_scan_eko.csv",
        "aeronet_almucantar.csv", "arm_csphotalm.nc", "fisheye.exr"}) {
    json first = summary(kExamples + name);
    write("copy.csv", output({"references", kExamples + name}));
    json second = summary("copy.csv");
    for (json* each : {&first, &second}) {
      for (const char* differs : {"file", "notes", "sun_zenith_deg", "scan_list"})
        each->erase(differs);
    }
    EXPECT_EQ(first, second) << name;
  }
}

TEST_F(MeasuredSkyTest, OptionsSayWhatTheFileDoesNot) {
  std::string line;
  for (int i = 0; i < 145; ++i) line += (i == 0 ? "" : ",") + std::to_string(1 + i % 7);
  write("scan.csv", line + "\n");
  expect_refusal({"check", "scan.csv"}, {"scan.csv: unit: not stated", "kcd m-2"});
  const std::vector<std::string> facts = {"check",           "scan.csv",
                                          "--unit",          "kcd/m^2",
                                          "--local-time",    "2024-05-15T15:00:00",
                                          "--utc-offset-h",  "2",
                                          "--latitude-deg",  "47.5",
                                          "--longitude-deg", "11"};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = facts;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  expect_refusal(facts, {"scan.csv: azimuth_zero: not stated", "brightest patches"});
  // The numbers above are of no sky, and no sun fits them.
  EXPECT_THAT(
      output(with({"--azimuth-zero", "south", "--exclude-sample", "1:3:1", "--accept-sun"})),
      HasSubstr("145 (142 with weight; not used: 3 \"excluded by --exclude-sample\")"));
  expect_refusal(with({"--azimuth-zero", "east"}), {"--azimuth-zero", "east", "north or south"});
  expect_refusal(with({"--azimuth-zero", "south", "--exclude-sample", "146"}),
                 {"scan.csv: exclude_samples = 146"});
  expect_refusal(with({"--exclude-sample", "0.5"}), {"--exclude-sample", "0.5", "whole numbers"});
  expect_refusal(with({"--sidecar", "none.json"}), {"none.json", "No such file"});
  expect_refusal({"check", "scan.csv", "--unit", "lux"}, {"--unit", "lux", "kcd m-2"});
  expect_refusal({"check", "scan.csv", "--latitude-deg", "95"},
                 {"--latitude-deg", "95", "-90 to 90"});
  write("scan.csv.sidecar.json", "{\n\"utc_offset_h\": 20}");
  expect_refusal({"check", "scan.csv"},
                 {"scan.csv.sidecar.json:2: utc_offset_h = 20: expected -14 to 14"});
  expect_refusal({"check", "scan.csv.sidecar.json"}, {"utc_offset_h = 20"});
}

TEST_F(MeasuredSkyTest, UnusedOptionsAreSaid) {
  EXPECT_THAT(output({"check", kExamples + "spectral_scan.csv", "--bin-deg", "5"}),
              HasSubstr("bin_deg is not used"));
  const Outcome outcome = run({"references", "cie:12", "--unit", "cd/m2"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "skyfit: warning: --unit is not used: cie:12 is no measured sky\n");
}

TEST_F(MeasuredSkyTest, FilesThatAreNoSkyAreRefused) {
  write("picture.png", std::string("\x89PNG\r\n\x1a\n\0\0", 10));
  expect_refusal({"check", "picture.png"}, {"picture.png: is an image of colours", "OpenEXR"});
  write("broken.exr", "\x76\x2f\x31\x01 nothing else");
  expect_refusal({"check", "broken.exr", "--projection", "equisolid"},
                 {"broken.exr: cannot be read"});
  write("text.csv", "a poem,about the sky\n");
  expect_refusal({"check", "text.csv"}, {"text.csv:1: a poem: unknown column"});
}

}  // namespace
}  // namespace skyfit::cli
