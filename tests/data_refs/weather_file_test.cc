// SPDX-License-Identifier: Apache-2.0
// The layouts of weather files give the same hour and the same Perez sky; what is wrong in
// one is named by line and field.
#include "data_refs/weather_file.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "complaint.h"
#include "data_refs/references.h"
#include "model/base/temporary_directory.h"
#include "model/base/whole_file.h"
#include "model/numerics/angles.h"

namespace skyfit::refs {
namespace {

using ::testing::HasSubstr;

// Made up: one hour of a place at 40 N, 105 W, 1800 m, on the clock of UTC - 7.
const std::string kEpw =
    "LOCATION,Somewhere,CO,USA,made up,1,40.0,-105.0,-7.0,1800\n"
    "DESIGN CONDITIONS,0\nTYPICAL/EXTREME PERIODS,0\nGROUND TEMPERATURES,0\n"
    "HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0\nCOMMENTS 1,\nCOMMENTS 2,\n"
    "DATA PERIODS,1,1,Data,Sunday,1/1,12/31\n"
    "1999,6,21,11,60,flags,20,5,40,82000,1200,1330,300,870,800,120,0,0,0,0\n"
    "1999,6,21,12,60,flags,20,5,40,82000,1200,1330,300,950,850,110,0,0,0,0\n";
const std::string kWea =
    "place Somewhere\nlatitude 40.0\nlongitude 105.0\ntime_zone 105\nsite_elevation 1800\n"
    "weather_data_file_units 1\n6 21 10.5 800 120\n6 21 11.5 850 110\n";
const std::string kTmy =
    "1,\"Somewhere\",CO,-7.0,40.0,-105.0,1800\n"
    "Date (MM/DD/YYYY),Time (HH:MM),GHI (W/m^2),DNI (W/m^2),DHI (W/m^2)\n"
    "06/21/1999,11:00,870,800,120\n06/21/1999,12:00,950,850,110\n";

// Rows of 142 columns: direct normal at 24, diffuse horizontal at 30, water at 124.
std::string tmy2_row(const std::string& hour, const std::string& direct,
                     const std::string& diffuse) {
  return " 99 621" + hour + "12001330 870I5" + direct + "I5" + diffuse + "I5" +
         std::string(88, '0') + " 14E8" + std::string(14, '0') + "\n";
}
const std::string kTmy2 = " 12345 SOMEWHERE              CO  -7 N 40  0 W 105  0  1800\n" +
                          tmy2_row("11", " 800", " 120") + tmy2_row("12", " 850", " 110");

// Downloads of NREL, stamped at the middle of the hour, and of PVGIS, stamped in UTC.
const std::string kNsrdb =
    "Source,Location ID,City,State,Country,Latitude,Longitude,Time Zone,Elevation,Local Time Zone\n"
    "NSRDB,1,-,-,-,40.0,-105.0,-7,1800,-7\n"
    "Year,Month,Day,Hour,Minute,Clearsky DNI,DHI,DNI,GHI,Precipitable Water\n"
    "1999,6,21,10,30,990,120,800,870,1.2\n1999,6,21,11,30,990,110,850,950,1.4\n";
const std::string kPvgis =
    "Latitude (decimal degrees): 40.0\nLongitude (decimal degrees): -105.0\n"
    "Elevation (m): 1800\nIrradiance Time Offset (h): 0.5\nmonth,year\n1,2005\n6,1999\n"
    "time(UTC),T2m,RH,G(h),Gb(n),Gd(h),IR(h),WS10m,WD10m,SP\n"
    "19990621:1700,20,40,870,800,120,300,1,0,82000\n"
    "19990621:1800,21,40,950,850,110,300,1,0,82000\n\nT2m: air temperature (degree Celsius)\n";

// As a spreadsheet writes it.
std::string quoted(std::string text) { return text.replace(0, 8, "\"LOCATION\""); }

class WeatherFile : public ::testing::Test {
 protected:
  std::string hour_of(const std::string& text, const std::string& time) const {
    const auto file = directory_.path() / "weather.txt";
    write_whole_file(file, text);
    return file.string() + "@" + time;
  }
  TemporaryDirectory directory_;
};

TEST_F(WeatherFile, TheLayoutsGiveTheSameHour) {
  std::string tabs = kWea;
  std::ranges::replace(tabs, ' ', '\t');
  for (const std::string& text : {kEpw, quoted(kEpw), kWea, tabs, kTmy, kTmy2, kNsrdb, kPvgis}) {
    const bool utc = text == kPvgis;
    const WeatherHour hour =
        weather_hour(hour_of(text, utc ? "2026-06-21T18:20" : "2026-06-21T11:20"));
    EXPECT_EQ(hour.direct_normal_w_m2, 850);
    EXPECT_EQ(hour.diffuse_horizontal_w_m2, 110);
    EXPECT_EQ(iso_text(hour.middle), "2026-06-21T18:30:00Z");
    EXPECT_NEAR(hour.site.latitude, 40 * kRadiansPerDegree, 1e-12);
    EXPECT_NEAR(hour.site.longitude, -105 * kRadiansPerDegree, 1e-12);
    EXPECT_EQ(hour.site.elevation_m, 1800);
  }
}

TEST_F(WeatherFile, KnowsTheWaterOfTmy2) {
  EXPECT_EQ(weather_hour(hour_of(kTmy2, "2026-06-21T11:20")).precipitable_water_mm, 14);
  // A line may end before it.
  EXPECT_FALSE(weather_hour(hour_of(kTmy2.substr(0, kTmy2.size() - 30), "2026-06-21T11:20"))
                   .precipitable_water_mm);
}

TEST_F(WeatherFile, InstantsOfNsrdbAreNotMovedToAMiddle) {
  EXPECT_EQ(weather_hour(hour_of(kNsrdb, "2026-06-21T11:20")).precipitable_water_mm, 14);
  std::string five = kNsrdb;
  five.replace(five.find("10,30,"), 6, "11,25,");
  const WeatherHour first = weather_hour(hour_of(five, "2026-06-21T11:25"));
  EXPECT_EQ(iso_text(first.middle), "2026-06-21T18:25:00Z");
  EXPECT_EQ(first.direct_normal_w_m2, 800);
}

TEST_F(WeatherFile, IntervalsShorterThanAnHourHaveTheirOwnSun) {
  std::string half = kEpw;
  half.replace(half.find("DATA PERIODS,1,1"), 16, "DATA PERIODS,1,2");
  half.replace(half.find("6,21,11,60"), 10, "6,21,12,30");
  const WeatherHour first = weather_hour(hour_of(half, "2026-06-21T11:10")),
                    second = weather_hour(hour_of(half, "2026-06-21T11:40"));
  EXPECT_EQ(first.direct_normal_w_m2, 800);
  EXPECT_EQ(second.direct_normal_w_m2, 850);
  EXPECT_EQ(iso_text(first.middle), "2026-06-21T18:15:00Z");
  EXPECT_EQ(iso_text(second.middle), "2026-06-21T18:45:00Z");
}

TEST_F(WeatherFile, ClearnessAndBrightnessAreThoseOfTheFormulas) {
  const PerezHour hour = perez_hour(weather_hour(hour_of(kEpw, "2026-06-21T11:20")), "x");
  const double z = hour.sun.zenith, cube = 1.041 * z * z * z;
  EXPECT_NEAR(hour.sky.epsilon, (960.0 / 110 + cube) / (1 + cube), 1e-12);
  // Near the zenith the air mass is 1 / cos z.
  EXPECT_NEAR(hour.sky.delta, 110 / std::cos(z) * std::pow(hour.sun.distance_au, 2) / 1367, 1e-4);
}

TEST_F(WeatherFile, AnHourIsAReference) {
  const Reference sky =
      load_reference("perez:" + hour_of(kWea, "2026-06-21T11:20"), {}, Sampling::kTregenza);
  EXPECT_EQ(sky.samples.size(), 145u);
  EXPECT_THAT(sky.description, HasSubstr("diffuse horizontal 110 W/m^2"));
  EXPECT_NEAR(sky.samples[0].sun_zenith / kRadiansPerDegree, 18, 2);
}

TEST_F(WeatherFile, FaultsAreNamed) {
  const auto complaint = [&](const std::string& text, const std::string& time) {
    return complaint_of([&] { weather_hour(hour_of(text, time)); });
  };
  EXPECT_THAT(complaint(kEpw, "2026-06-22T11:20"), HasSubstr("an hour that the file has"));
  EXPECT_THAT(complaint(kEpw, "noon"), HasSubstr("YYYY-MM-DDTHH:MM"));
  EXPECT_THAT(complaint(kEpw, "2026-06-21T11:20Z"), HasSubstr("the file's own clock"));
  std::string north = kEpw;
  north.replace(north.find("40.0"), 4, "91.0");
  EXPECT_THAT(complaint(north, "2026-06-21T11:20"), HasSubstr("latitude = 91"));
  EXPECT_THAT(complaint("hello\n", "2026-06-21T11:20"),
              HasSubstr("expected EPW, WEA, TMY2, TMY3, NSRDB or PVGIS"));
  for (const std::string& text : {kEpw, kTmy}) {
    std::string turned = text;
    turned.replace(turned.find("-105.0"), 6, "75.00");
    EXPECT_THAT(complaint(turned, "2026-06-21T11:20"),
                HasSubstr("longitude or time zone may be wrong"));
  }
  std::string turned = kPvgis;
  turned.replace(turned.find("-105.0"), 6, "105.00");
  EXPECT_THAT(complaint(turned, "2026-06-21T18:20"),
              HasSubstr("longitude or time zone may be wrong"));
  EXPECT_THAT(complaint(kPvgis.substr(0, kPvgis.find("time(UTC)")), "2026-06-21T18:20"),
              HasSubstr("expected a line of columns time(UTC)"));
  EXPECT_THAT(complaint(kNsrdb.substr(0, kNsrdb.find("Year")), "2026-06-21T11:20"),
              HasSubstr("weather.txt:2: expected a line of columns"));
  std::string zone = kWea;
  const std::size_t at = zone.find("time_zone ") + 10;
  zone.replace(at, zone.find('\n', at) - at, "7");
  EXPECT_THAT(complaint(zone, "2026-06-21T11:20"), HasSubstr("weather.txt:4: time_zone = 7"));
  std::string bad = kEpw;
  bad.replace(bad.find(",950,850,"), 9, ",950,9999,");
  EXPECT_THAT(complaint(bad, "2026-06-21T11:20"),
              HasSubstr("weather.txt:10: direct normal = 9999"));
  EXPECT_THAT(complaint("place x\nlatitude 40\n", "2026-06-21T11:20"),
              HasSubstr("weather.txt:3: expected a line longitude"));
  EXPECT_THAT(complaint_of([&] {
                perez_hour(weather_hour(hour_of("place x\nlatitude 40\nlongitude 0\ntime_zone 0\n"
                                                "site_elevation 0\nweather_data_file_units 1\n"
                                                "6 21 0.5 0 0\n",
                                                "2026-06-21T00:10")),
                           "perez:x");
              }),
              HasSubstr("deg from the zenith"));
}

}  // namespace
}  // namespace skyfit::refs
