// SPDX-License-Identifier: Apache-2.0
// Optical depths and inversions of AERONET, in the layouts of versions 2 and 3, become the power
// law, the albedo and their uncertainties at the time of a scan.
#include "data_refs/aeronet_products.h"

#include <gmock/gmock.h>

#include <cmath>

#include "model/base/temporary_directory.h"
#include "model/base/whole_file.h"
#include "model/numerics/angles.h"

namespace skyfit::refs {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

std::vector<AerosolRecord> records(const std::string& text) {
  const TemporaryDirectory directory;
  write_file(directory.path() / "site.lev20", text);
  return load_aerosol_records(directory.path() / "site.lev20");
}
std::string complaint(const auto& what) {
  try {
    what();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "none";
}
Instant at(const std::string& time) { return *instant(time, 0); }
std::string number(double value) { return std::to_string(value); }

// tau = 0.2 (lambda / 550 nm)^-1.4 at three wavelengths; -999 and what is no optical depth beside.
std::string optical_depths(const std::string& clock, double factor = 1) {
  std::string line = "15:05:2024," + clock + ",136,-999.";
  for (const double nm : {870.0, 675.0, 440.0})
    line += "," + number(factor * 0.2 * std::pow(nm / 550, -1.4));
  return line + ",0.001,1.4,16:05:2025\n";
}
const std::string kHead =
    "AERONET Version 3;\nSite\nVersion 3: AOD Level 2.0\nnote, with a comma\n"
    "Date(dd:mm:yyyy),Time(hh:mm:ss),Day_of_Year,AOD_1640nm,AOD_870nm,AOD_675nm,AOD_440nm,"
    "Triplet_Variability_870,440-870_Angstrom_Exponent,Last_Date_Processed(dd:mm:yyyy)\n";

TEST(AeronetProducts, OpticalDepthsBecomeAPowerLaw) {
  const auto list = records(kHead + optical_depths("06:30:00"));
  ASSERT_THAT(list, SizeIs(1));
  EXPECT_EQ(list[0].time, at("2024-05-15T06:30:00"));
  EXPECT_THAT(list[0].optical_depth, SizeIs(3));
  const AerosolKnowledge known = aerosol_at(list, {at("2024-05-15T06:40:00")}, "site");
  EXPECT_NEAR(known.optical_depth->mean, 0.2, 1e-6);
  EXPECT_EQ(known.optical_depth->sigma, 0.01);
  EXPECT_NEAR(known.angstrom_exponent->mean, 1.4, 1e-5);
  EXPECT_FALSE(known.single_scattering_albedo);
  EXPECT_THAT(known.notes, SizeIs(2));
}

TEST(AeronetProducts, TheExponentsErrorIsThatOfTwoDepths) {
  // Of two wavelengths: alpha = -ln(tau1 / tau2) / ln(l1 / l2), each ln tau off by 0.01 / tau.
  const auto list = records(
      "Date(dd:mm:yyyy),Time(hh:mm:ss),AOD_870nm,AOD_440nm\n15:05:2024,06:30:00,0.1,0.25\n");
  const AerosolKnowledge known = aerosol_at(list, {at("2024-05-15T06:30:00")}, "site");
  EXPECT_NEAR(known.angstrom_exponent->sigma, std::hypot(0.1, 0.04) / std::log(870.0 / 440), 1e-9);
  EXPECT_NEAR(known.angstrom_exponent->mean, std::log(2.5) / std::log(870.0 / 440), 1e-9);
}

TEST(AeronetProducts, WhatTheNeighbourLacksIsTakenAlone) {
  const std::string head = "Date(dd:mm:yyyy),Time(hh:mm:ss),AOD_870nm,AOD_440nm\n";
  const auto list = records(head + "15:05:2024,06:28:00,0.1,0.25\n15:05:2024,06:32:00,0.1,-999.\n");
  const AerosolKnowledge known = aerosol_at(list, {at("2024-05-15T06:30:00")}, "site");
  EXPECT_NEAR(known.angstrom_exponent->mean, std::log(2.5) / std::log(870.0 / 440), 1e-9);
}

TEST(AeronetProducts, ATableBelowAnotherHasItsOwnColumns) {
  const auto list = records(
      "Date(dd:mm:yyyy),Time(hh:mm:ss),AOD_870nm,AOD_440nm\n15:05:2024,06:30:00,0.1,0.25\n"
      "Date(dd:mm:yyyy),Time(hh:mm:ss),AOD_440nm,AOD_870nm\n15:05:2024,07:30:00,0.25,0.1\n");
  ASSERT_THAT(list, SizeIs(2));
  EXPECT_EQ(list[0].optical_depth, list[1].optical_depth);
}

TEST(AeronetProducts, InterpolatesInTimeAndAveragesScans) {
  const auto list = records(kHead + optical_depths("06:50:00", 3) + optical_depths("06:30:00", 1) +
                            optical_depths("12:00:00", 5));
  EXPECT_NEAR(aerosol_at(list, {at("2024-05-15T06:35:00")}, "site").optical_depth->mean, 0.3, 1e-6);
  EXPECT_NEAR(aerosol_at(list, {at("2024-05-15T06:20:00"), at("2024-05-15T12:10:00")}, "site")
                  .optical_depth->mean,
              0.6, 1e-6);
  EXPECT_THAT(
      complaint([&] { aerosol_at(list, {at("2024-05-15T08:00:00")}, "site"); }),
      HasSubstr("site: no record within 30 minutes of the scan of 2024-05-15T08:00:00Z: the "
                "nearest is of 2024-05-15T06:50:00Z"));
}

TEST(AeronetProducts, AnInversionHasAlbedoAndAsymmetry) {
  const std::string columns =
      "Site,Date(dd:mm:yyyy),Time(hh:mm:ss),AOD_Extinction-Total[440nm],"
      "AOD_Extinction-Total[675nm],Single_Scattering_Albedo[440nm],"
      "Single_Scattering_Albedo[675nm],Asymmetry_Factor-Total[440nm]\n";
  const auto thick =
      records(columns + "S,15:05:2024,06:30:00,0.5,0.3,0.90,0.94,0.7<br>\n</body></html>\n");
  const AerosolKnowledge known = aerosol_at(thick, {at("2024-05-15T08:00:00")}, "site");
  EXPECT_NEAR(known.single_scattering_albedo->mean, 0.90 + 0.04 * (550 - 440) / (675 - 440), 1e-12);
  EXPECT_EQ(known.single_scattering_albedo->sigma, 0.03);
  EXPECT_THAT(known.notes.back(), HasSubstr("asymmetry factor at 550 nm 0.7"));
  const auto thin = records(columns + "S,15:05:2024,06:30:00,0.2,0.1,0.90,0.94,N/A\n");
  EXPECT_EQ(aerosol_at(thin, {at("2024-05-15T08:00:00")}, "site").single_scattering_albedo->sigma,
            0.07);
}

TEST(AeronetProducts, OfVersion2) {
  const auto aod = records(
      "Date(dd-mm-yy),Time(hh:mm:ss),AOT_870,AOT_440,440-870Angstrom\n"
      "15:05:2024,06:30:00,0.1,0.25,1.3\n");
  EXPECT_EQ(aod[0].optical_depth.at(440), 0.25);
  const auto inversion = records(
      "Date(dd-mm-yyyy),Time(hh:mm:ss),AOTExt440-T,AOTExt675-T,SSA440-T,ASYM440-T,ASYM440-F\n"
      "15:05:2024,06:30:00,0.25,0.15,0.91,0.69,0.6\n");
  EXPECT_EQ(inversion[0].optical_depth.at(675), 0.15);
  EXPECT_EQ(inversion[0].single_scattering_albedo.at(440), 0.91);
  EXPECT_EQ(inversion[0].asymmetry.at(440), 0.69);
}

// Along a meridian a degree is 111.2 km.
TEST(AeronetProducts, RecordsOfAnotherPlaceAreRefused) {
  const std::string columns =
      "Date(dd:mm:yyyy),Time(hh:mm:ss),AOD_870nm,AOD_440nm,Site_Latitude(Degrees),"
      "Site_Longitude(Degrees)\n";
  const auto here = [](double latitude_deg) {
    return Site{latitude_deg * kRadiansPerDegree, 11 * kRadiansPerDegree};
  };
  const auto list = records(columns + "15:05:2024,06:30:00,0.1,0.25,47.5,11\n" +
                            "15:05:2024,06:30:00,0.1,0.25,-33.5,151\n");
  EXPECT_THAT(records_near(list, here(48.3), "site"), SizeIs(1));
  EXPECT_THAT(complaint([&] { records_near(list, here(48.5), "site"); }),
              HasSubstr("site: is of latitude 47.5, longitude 11 deg, 111 km from the scan's "
                        "latitude 48.5, longitude 11 deg: expected within 100 km"));
  const auto second = records(
      "AERONET Data, Version 2\nLocation=Somewhere,long=11.000,lat=47.500,elev=700\n"
      "Date(dd-mm-yy),Time(hh:mm:ss),AOT_870,AOT_440\n15:05:2024,06:30:00,0.1,0.25\n");
  EXPECT_THAT(complaint([&] { records_near(second, here(0), "site"); }), HasSubstr("5282 km"));
  const auto nowhere = records(kHead + optical_depths("06:30:00"));
  EXPECT_THAT(records_near(nowhere, here(0), "site"), SizeIs(1));
}

TEST(AeronetProducts, WhatTellsNothingIsSaid) {
  const std::string missing = "15:05:2024,06:30:00,136,-999.,-999.,-999.,-999.,0,1.4,16:05:2025\n";
  EXPECT_THAT(complaint([&] { records(kHead + missing); }),
              HasSubstr("site.lev20: every value of its 1 record is missing"));
  // A record without values hides none beside it.
  EXPECT_THAT(records(kHead + missing + optical_depths("06:31:00")), SizeIs(1));
  const std::string columns =
      "Date(dd:mm:yyyy),Time(hh:mm:ss),AOD_Extinction-Total[440nm],"
      "Single_Scattering_Albedo[440nm]\n15:05:2024,06:30:00,0.2,";
  const auto of = [&](const std::string& albedo) {
    return aerosol_at(records(columns + albedo + "\n"), {at("2024-05-15T06:30:00")}, "site");
  };
  EXPECT_THAT(complaint([&] { of("-999"); }), HasSubstr("site: tells nothing at the time"));
  const AerosolKnowledge known = of("0.92");
  EXPECT_EQ(known.single_scattering_albedo->mean, 0.92);
  EXPECT_FALSE(known.optical_depth);
  EXPECT_THAT(known.notes.back(), HasSubstr("no optical depth by site at 1 of 1 scans"));
}

TEST(AeronetProducts, SaysWhatIsWrong) {
  EXPECT_THAT(complaint([] { records(kHead + "15:05:2024,06:30:00,136,1,1,99,1,0,1.4,x\n"); }),
              HasSubstr("site.lev20:6: AOD_675nm = 99: expected -0.1 to 10"));
  EXPECT_THAT(complaint([] {
                records(
                    "Date(dd:mm:yyyy),Time(hh:mm:ss),Single_Scattering_Albedo[440nm]\n"
                    "15:05:2024,06:30:00,1.92\n");
              }),
              HasSubstr("site.lev20:2: Single_Scattering_Albedo[440nm] = 1.92: expected 0 to 1"));
  EXPECT_THAT(complaint([] { records("no columns\n"); }), HasSubstr("expected a line of columns"));
  EXPECT_THAT(complaint([] { records(kHead); }), HasSubstr("expected records"));
  EXPECT_THAT(
      complaint([] { records(kHead + "15:13:2024,06:30:00,136,1,1,1,1,1,1,1\n"); }),
      HasSubstr("site.lev20:6: date and time \"15:13:2024\", \"06:30:00\": expected dd:mm"));
  EXPECT_THAT(complaint([] { records(kHead + "15:05:2024,06:30:00,136,x,1,1,1,1,1,1\n"); }),
              HasSubstr("\"x\": expected a number"));
  EXPECT_THAT(complaint([] { records(kHead + "15:05:2024,06:30:00\n"); }),
              HasSubstr("expected at least 4 fields"));
}

}  // namespace
}  // namespace skyfit::refs
