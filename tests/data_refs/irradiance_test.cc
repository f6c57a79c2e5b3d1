// SPDX-License-Identifier: Apache-2.0
// Irradiances of the command line, of a CSV and of a weather file become the same samples; what is
// missing or contradicts itself is said in one line.
#include "data_refs/irradiance.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <string>

#include "complaint.h"
#include "model/base/temporary_directory.h"
#include "model/base/whole_file.h"
#include "model/numerics/angles.h"

namespace skyfit::refs {
namespace {

using ::testing::HasSubstr;

constexpr double kSun = 40 * kRadiansPerDegree;

class IrradianceReference : public ::testing::Test {
 protected:
  std::string file_of(const std::string& text) const {
    const auto file = directory_.path() / "irradiances.csv";
    write_whole_file(file, text);
    return file.string();
  }
  TemporaryDirectory directory_;
};

TEST_F(IrradianceReference, ValuesOfTheCommandLine) {
  const Reference r =
      irradiance_reference("direct=83000:1500lx,diffuse_horizontal=14000:700lx", kSun, {});
  EXPECT_EQ(r.quantity, Quantity::kIlluminance);
  ASSERT_EQ(r.samples.size(), 2u);
  EXPECT_EQ(r.samples[0].irradiance, kDirectNormal);
  EXPECT_EQ(r.samples[0].value, 83000);
  EXPECT_EQ(r.samples[0].sigma, 1500);
  EXPECT_EQ(r.samples[0].sun_zenith, kSun);
  EXPECT_EQ(r.samples[1].irradiance, kDiffuseHorizontal);
  EXPECT_EQ(r.samples[1].view_zenith, 0);
  EXPECT_FALSE(gives_luminance(r));
}

TEST_F(IrradianceReference, UnitsHaveSpellings) {
  const auto value = [](std::string_view text) {
    return irradiance_reference(text, kSun, {}).samples[0];
  };
  EXPECT_EQ(value("direct=83klx").value, 83000);
  EXPECT_EQ(value("direct=83:2 klx").sigma, 2000);
  EXPECT_EQ(value("direct = 850 W/m^2, precipitable_water=14mm").value, 850);
}

TEST_F(IrradianceReference, ACsvHasALineForEachSun) {
  const Reference r = irradiance_reference(
      file_of("# latitude_deg=47.5 longitude_deg=11 elevation_m=700\n"
              "time,direct_normal_w_m2,diffuse_horizontal_w_m2,precipitable_water_mm\n"
              "2024-05-15T08:30:00Z,800,,14\n"
              "2024-05-15T22:30:00Z,0,0,14\n"
              "2024-05-15T10:30:00Z,850,0,15\n"),
      {}, {});
  EXPECT_EQ(r.quantity, Quantity::kIrradiance);
  ASSERT_EQ(r.scans.size(), 2u);
  ASSERT_EQ(r.samples.size(), 3u);
  EXPECT_EQ(r.scans[1].time_utc, "2024-05-15T10:30:00Z");
  EXPECT_EQ(r.scans[1].precipitable_water_mm, 15);
  EXPECT_EQ(r.scans[1].elevation_m, 700);
  EXPECT_LT(r.samples[1].sun_zenith, r.samples[0].sun_zenith);
  EXPECT_EQ(r.samples[2].weight, 0);
  EXPECT_EQ(r.samples[2].zero_weight_reason, "not positive");
  bool night_is_noted = false;
  for (const std::string& note : r.notes)
    night_is_noted |= note.find("expected a sun above the horizon") != note.npos;
  EXPECT_TRUE(night_is_noted);
}

TEST_F(IrradianceReference, TheExampleCloses) {
  const Reference r = irradiance_reference(SKYFIT_EXAMPLES "irradiances.csv", {}, {});
  EXPECT_EQ(r.scans.size(), 5u);
  EXPECT_EQ(r.samples.size(), 15u);
  EXPECT_TRUE(r.notes.empty());
}

TEST_F(IrradianceReference, AnHourOfAWeatherFileBringsItsSunAndItsWater) {
  const std::string file = file_of(
      "LOCATION,Somewhere,CO,USA,made up,1,40.0,-105.0,-7.0,1800\n"
      "DESIGN CONDITIONS,0\nTYPICAL/EXTREME PERIODS,0\nGROUND TEMPERATURES,0\n"
      "HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0\nCOMMENTS 1,\nCOMMENTS 2,\n"
      "DATA PERIODS,1,1,Data,Sunday,1/1,12/31\n"
      "1999,6,21,12,60,f,20,5,40,82000,1200,1330,300,950,850,110,0,0,0,0,0,0,0,0,9,9,9,9,17,90\n");
  const Reference r = irradiance_reference(file + "@2026-06-21T11:20", {}, {});
  ASSERT_EQ(r.samples.size(), 2u);
  EXPECT_EQ(r.samples[0].value, 850);
  EXPECT_EQ(r.samples[1].value, 110);
  EXPECT_EQ(r.scans[0].precipitable_water_mm, 17);
  EXPECT_EQ(r.scans[0].time_utc, "2026-06-21T18:30:00Z");
  const Reference wet =
      irradiance_reference(file + "@2026-06-21T11:20,precipitable_water=25mm", {}, {});
  EXPECT_EQ(wet.scans[0].precipitable_water_mm, 25);
}

TEST_F(IrradianceReference, WaterOfTmyIsInCmAndWeaHasNone) {
  const std::string tmy = file_of(
      "1,\"Somewhere\",CO,-7.0,40.0,-105.0,1800\n"
      "Date (MM/DD/YYYY),Time (HH:MM),GHI (W/m^2),DNI (W/m^2),DHI (W/m^2),Pwat (cm)\n"
      "06/21/1999,12:00,950,850,110,1.7\n");
  EXPECT_EQ(irradiance_reference(tmy + "@2026-06-21T11:20", {}, {}).scans[0].precipitable_water_mm,
            17);
  const std::string wea = file_of(
      "place Somewhere\nlatitude 40.0\nlongitude 105.0\ntime_zone 105\nsite_elevation 1800\n"
      "weather_data_file_units 1\n6 21 11.5 850 110\n");
  EXPECT_THAT(complaint_of([&] { irradiance_reference(wea + "@2026-06-21T11:20", {}, {}); }),
              HasSubstr("precipitable_water: not known"));
}

TEST_F(IrradianceReference, BeamAndSkyThatDoNotMakeTheSumAreNoted) {
  const double direct = 80000 * std::cos(kSun);
  const auto notes = [&](double global) {
    return irradiance_reference(
               "direct=80000lx,diffuse=15000lx,global=" + std::to_string(global) + "lx", kSun, {})
        .notes;
  };
  EXPECT_TRUE(notes(1.07 * (direct + 15000)).empty());
  ASSERT_EQ(notes(1.10 * (direct + 15000)).size(), 1u);
  EXPECT_THAT(notes(1.10 * (direct + 15000))[0], HasSubstr("1.1 times direct and diffuse"));
}

TEST_F(IrradianceReference, WhatIsWrongIsNamed) {
  const auto message_of = [&](const std::string& text, std::optional<double> sun = kSun) {
    return complaint_of([&] { irradiance_reference(text, sun, {}); });
  };
  EXPECT_THAT(message_of("direct=800"), HasSubstr("direct=800: no unit, expected lx"));
  EXPECT_THAT(message_of("direct=800W/m2"), HasSubstr("precipitable_water: not known"));
  EXPECT_THAT(message_of("direct=800W/m2,diffuse=9000lx"), HasSubstr("one unit for all"));
  EXPECT_THAT(message_of("beam=800lx"), HasSubstr("beam=800lx: expected one of direct_normal"));
  EXPECT_THAT(message_of("direct=800lx,direct_normal=900lx"), HasSubstr("is given twice"));
  EXPECT_THAT(message_of("direct=900000lx"), HasSubstr("expected at most 200000"));
  EXPECT_THAT(message_of("direct=many lx"), HasSubstr("expected NAME=VALUE[:SIGMA]UNIT"));
  EXPECT_THAT(message_of("direct=0lx"), HasSubstr("expected a value > 0"));
  EXPECT_THAT(message_of("direct=8000:0lx"), HasSubstr("sigma = 0: expected a number > 0"));
  EXPECT_THAT(message_of("direct=80000lx", {}),
              HasSubstr("the sun is not known: expected sun_zenith_deg, or local_time"));
  EXPECT_THAT(message_of(file_of("sun_zenith_deg,view\n40,1\n")),
              HasSubstr("irradiances.csv:1: expected a column NAME_lx or NAME_w_m2"));
  EXPECT_THAT(message_of(file_of("sun_zenith_deg,dni,global_horizontal_lx\n40,80000,70000\n")),
              HasSubstr("irradiances.csv:1: dni: unknown column, expected one of time, "
                        "sun_zenith_deg, precipitable_water_mm, altitude_m, direct_normal_lx"));
  EXPECT_THAT(message_of(file_of("sun_zenith_deg,direct_normal_lx\n40,bright\n")),
              HasSubstr("irradiances.csv:2: direct_normal_lx"));
}

}  // namespace
}  // namespace skyfit::refs
