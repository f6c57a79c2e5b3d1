// SPDX-License-Identifier: Apache-2.0
// Files that are no sky are named for what they are, on one line; a CSV of samples is not taken for
// one.
#include "data_refs/other_formats.h"

#include <gmock/gmock.h>

#include <string>

#include "complaint.h"
#include "data_refs/measured_formats.h"
#include "model/base/temporary_directory.h"
#include "model/base/whole_file.h"

namespace skyfit::refs {
namespace {

using testing::HasSubstr;

std::string complaint(const std::string& name) {
  return complaint_of([&] { load_measured_sky(std::string(SKYFIT_TEST_DATA) + "/" + name, {}); });
}

TEST(OtherFormats, FilesAreNamed) {
  EXPECT_THAT(complaint("aeronet_aod.lev20"), HasSubstr("is aerosol optical depths of AERONET"));
  EXPECT_THAT(complaint("aeronet_inversion.all"), HasSubstr("is an inversion of AERONET"));
  EXPECT_THAT(complaint("gendaylit.rad"), HasSubstr("is a scene of Radiance"));
}

TEST(OtherFormats, TextsAreNamed) {
  EXPECT_THAT(*other_format("LOCATION,Somewhere,-,FRA\nDESIGN CONDITIONS,0\n"),
              HasSubstr("a weather file"));
  EXPECT_THAT(*other_format("# gendaylit 6 21 12\nvoid light solar\n"), HasSubstr("Radiance"));
  EXPECT_THAT(*other_format("direct irradiance, global irradiance\n400, 1\n"),
              HasSubstr("irradiances"));
  EXPECT_THAT(*other_format("# a day\nsun_zenith_deg,direct_normal_lx\n40,80000\n"),
              HasSubstr("fit --irradiance"));
  EXPECT_THAT(*other_format("PRC Krochmann sky scanner\n1 2 3\n"),
              HasSubstr("that a sidecar names"));
  EXPECT_THAT(*other_format("    2003  5 29  5 20  2   5.3339 : IY IM ID IHH IMM ISS TM(hr)\n"),
              HasSubstr(".DT5 of SKYRAD.pack"));
  EXPECT_THAT(*other_format("09:59:28,H,2006/03/07,Clalmanalco\n"), HasSubstr("POM-01L"));
  EXPECT_THAT(*other_format("{\"SkyAtmosphere\": {}}"), HasSubstr("JSON"));
  EXPECT_FALSE(other_format("sun_zenith_deg,view_zenith_deg,relative_azimuth_deg\n1,2,3\n"));
}

TEST(OtherFormats, WhatPeopleHaveBesideIsNamed) {
  const auto is = [](const std::string& text, const char* what) {
    EXPECT_THAT(other_format(text).value_or("not known"), HasSubstr(what)) << text;
  };
  is("1,\"Somewhere\",CO,-7.0,40.0,-105.0,1800\nDate (MM/DD/YYYY),Time (HH:MM),GHI (W/m^2)\n",
     "a weather file");
  is("place\tSomewhere Intl\nlatitude\t40\n", "a weather file");
  is(" 23062 DENVER                 CO  -7 N 39 46 W 104 52  1610\n 85 6210110001300\n",
     "a weather file");
  is("Source,Location ID,City\nNSRDB,1,-\n", "NSRDB");
  is("2013-05-27___10.15.00\nWavelength, Irradiance\n350,0.5\n", "spectrum of irradiance");
  is("Datetime,GHI,DNI,DHI\n2020-01-01,1,2,3\n", "direct_normal_w_m2");
  is("AERONET Version 3;\nNo data found for the requested site and period\n", "without data");
  is("AERONET Version 3;\nSite\nAll points, units in the columns\n", "without the columns");
  is("# a mesh\nmtllib a.mtl\no Box\nv 0 0 0\nv 100 0 0\n", "--mesh");
  is("ncols 3\nnrows 2\n", "--dem");
  is("newmtl red\nKd 1 0 0\n", "(MTL)");
  is("ply\nformat ascii 1.0\n", "(PLY or STL)");
  is("Data from sky.txt Node\n\nDate: Wed May 15\n", "OceanView");
  is("Latitude (decimal degrees):\t45.0\n", "PVGIS");
  is("/* DATA DESCRIPTION:\nCitation: BSRN */\n", "PANGAEA");
  is("sample;view_azimuth_deg;view_zenith_deg;radiance_340\n1;0;20;0,03812\n", "decimal_comma");
  is("\x89PNG\r\n\x1a\n", "PNG");
  is("PK\x03\x04 zip", "archive");
  is("\xff\xfe s k y", "UTF-16");
}

// A text with a character of code 0 is named, too.
TEST(OtherFormats, BinaryFilesAreNamed) {
  const TemporaryDirectory directory;
  const auto file = directory.path() / "sky.png";
  write_whole_file(file, std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16));
  EXPECT_THAT(complaint_of([&] { load_measured_sky(file, {}); }), HasSubstr("(PNG, JPEG"));
}

// Columns of samples between semicolons are no samples, whoever's scanner they are of.
TEST(OtherFormats, AreSeenBehindOurOwnNames) {
  const TemporaryDirectory directory;
  const auto file = directory.path() / "sky.csv";
  const auto complaint_about = [&](const std::string& text) {
    write_whole_file(file, text);
    return complaint_of([&] { load_measured_sky(file, {}); });
  };
  EXPECT_THAT(complaint_about("sample;view_azimuth_deg;view_zenith_deg;radiance_340\n1;0;20;0,1\n"),
              HasSubstr("columns between semicolons"));
  EXPECT_THAT(complaint_about("PRC Krochmann Sky Scanner SC\nDate;20.03.2010\n"),
              HasSubstr("Krochmann"));
}

// Patterns with repetitions of repetitions would try blank lines in all ways, for years.
TEST(OtherFormats, BlankLinesWithoutEndAreSoonDone) {
  for (const std::string blank : {"\n", " ", " \n", "#\n", "# x\n\n"}) {
    std::string text;
    while (text.size() < 100'000) text += blank;
    EXPECT_FALSE(other_format(text));
    EXPECT_TRUE(other_format(text.substr(0, 4000) + "\nvoid light solar\n"));
  }
}

}  // namespace
}  // namespace skyfit::refs
