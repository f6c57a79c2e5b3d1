// SPDX-License-Identifier: Apache-2.0
// Facts about a measured sky come from its file, its sidecar and the options, the later ones
// overrule, and each wrong one is named.
#include "data_refs/import_options.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "complaint.h"
#include "data_refs/references.h"

namespace skyfit::refs {
namespace {

using testing::StartsWith;

std::string complaint(const std::string& json) {
  return complaint_of([&] { parse_sidecar(json, "sky.csv.sidecar.json"); });
}

TEST(Sidecar, HoldsTheFactsOfTheTable) {
  const ImportOptions options = parse_sidecar(
      R"({"note": "ours", "unit": "kcd/m^2", "latitude_deg": -33.9, "azimuth_zero": "south",
          "exclude_samples": {"0": "shutter", "12": "bird"}})",
      "sky.csv.sidecar.json");
  EXPECT_EQ(options.unit, "kcd/m^2");
  EXPECT_EQ(options.latitude_deg, -33.9);
  EXPECT_EQ(options.azimuth_zero, "south");
  EXPECT_FALSE(options.longitude_deg.has_value());
  ASSERT_EQ(options.exclude_samples.size(), 2u);
  EXPECT_EQ(options.exclude_samples[1].sample + options.exclude_samples[0].sample, 12);
}

TEST(Sidecar, FaultsAreNamedWithTheirLine) {
  EXPECT_EQ(complaint("{\n\"latitude_deg\": 95}"),
            "sky.csv.sidecar.json:2: latitude_deg = 95: expected -90 to 90");
  EXPECT_EQ(complaint("{\"utc_offset_h\": \"CET\"}"),
            "sky.csv.sidecar.json:1: utc_offset_h = \"CET\": expected a number");
  EXPECT_THAT(
      complaint("{\"unit\": \"lux\"}"),
      StartsWith("sky.csv.sidecar.json:1: unit = \"lux\": expected one of W m-2 sr-1 nm-1"));
  EXPECT_EQ(complaint("{\"azimuth_zero\": \"east\"}"),
            "sky.csv.sidecar.json:1: azimuth_zero = \"east\": expected north or south");
  EXPECT_THAT(complaint("{\"latitude\": 5}"),
              StartsWith("sky.csv.sidecar.json:1: latitude: unknown name, expected one of "));
  EXPECT_EQ(complaint("{\"exclude_samples\": {\"x\": \"why\"}}"),
            "sky.csv.sidecar.json:1: exclude_samples.x = \"why\": expected the number of a sample "
            "and the reason for leaving it out");
  EXPECT_EQ(complaint("{\"exclude_samples\": {\"1\": \"\"}}").substr(0, 45),
            "sky.csv.sidecar.json:1: exclude_samples.1 = \"");
  EXPECT_THAT(complaint("{"), StartsWith("sky.csv.sidecar.json:1: expected JSON"));
}

TEST(ImportOptions, AreValidated) {
  ImportOptions options;
  options.elevation_m = 1e5;
  EXPECT_THAT([&] { validate(options); }, testing::ThrowsMessage<std::invalid_argument>(
                                              "elevation_m = 100000: must be -500 to 9000"));
  options.elevation_m = 500;
  options.azimuth_turns = "left";
  EXPECT_THAT([&] { validate(options); },
              testing::ThrowsMessage<std::invalid_argument>(
                  "azimuth_turns = left: must be clockwise or counter-clockwise"));
  options.azimuth_turns = "clockwise";
  EXPECT_NO_THROW(validate(options));
}

// The file says 10 h, the sidecar 11 h, the options 12 h.
TEST(ImportOptions, OverruleTheSidecarWhichOverrulesTheFile) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / "skyfit_overruled.csv";
  const std::filesystem::path sidecar = file.string() + ".sidecar.json";
  std::ofstream(file)
      << "# local_time=2020-06-21T10:00:00 utc_offset_h=0 latitude_deg=48 "
         "longitude_deg=0\n# radiance_<nm> in W m-2 sr-1 nm-1\n"
         "sample,view_azimuth_deg,view_zenith_deg,radiance_400\n0,0,45,1\n1,0,45,1\n";
  const auto load = [&](const ImportOptions& options = {}) {
    return load_reference(file.string(), {}, Sampling::kPrincipalPlane, options);
  };
  EXPECT_EQ(load().scans[0].time_utc, "2020-06-21T10:00:00Z");
  std::ofstream(sidecar)
      << R"({"local_time": "2020-06-21T11:00:00", "exclude_samples": {"0": "known wrong"}})";
  EXPECT_EQ(load().scans[0].time_utc, "2020-06-21T11:00:00Z");
  EXPECT_EQ(load().samples[0].zero_weight_reason, "known wrong");
  ImportOptions options;
  options.local_time = "2020-06-21T12:00:00";
  EXPECT_EQ(load(options).scans[0].time_utc, "2020-06-21T12:00:00Z");
  EXPECT_EQ(load(options).samples[0].weight, 0);
  options.sidecar = file.string() + ".elsewhere";
  EXPECT_THROW(load(options), std::runtime_error);
  std::filesystem::remove(file);
  std::filesystem::remove(sidecar);
}

}  // namespace
}  // namespace skyfit::refs
