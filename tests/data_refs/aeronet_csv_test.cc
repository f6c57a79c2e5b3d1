// SPDX-License-Identifier: Apache-2.0
// An almucantar becomes samples at the sun's height, one scan for the wavelengths taken together;
// every fault is one line.
#include "data_refs/aeronet_csv.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "complaint.h"
#include "data_refs/csv.h"
#include "model/base/input_file.h"

namespace skyfit::refs {
namespace {

using testing::StartsWith;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kRounding = 1e-12;
const std::string kHead =
    "AERONET Version 3;\nSomewhere\nfree text\n"
    "AERONET_Site,Date(dd:mm:yyyy),Time(hh:mm:ss),Instrument_Number,Nominal_Wavelength(nm),"
    "Exact_Wavelength(um),Solar_Zenith_Angle(Degrees),Sky_Scan_Type,";
const std::string kBare = kHead + "-6.000000,0.000000,6.000000,6.000000,90.000000\n";

std::string line(const std::string& time, const std::string& nominal, const std::string& zenith,
                 const std::string& values, const std::string& type = "Almucantar") {
  return "Somewhere,03:01:2019," + time + ",620," + nominal + ",-999," + zenith + "," + type + "," +
         values + "\n";
}

Reference parse(const std::string& text, const ImportOptions& options = {}) {
  return parse_aeronet_csv(text, "sky.alm", options);
}

std::string complaint(const std::string& text, const ImportOptions& options = {}) {
  return complaint_of([&] { parse(text, options); });
}

TEST(AeronetCsv, HoldsTheAlmucantarAtTheSunsHeight) {
  const Reference sky = parse(kBare + line("11:11:49", "440", "60", "22,-999,20,21,2"));
  EXPECT_EQ(sky.quantity, Quantity::kSpectralRadiance);
  ASSERT_EQ(sky.samples.size(), 5u);
  EXPECT_NEAR(sky.samples[0].value, 0.22, kRounding);  // 22 uW cm-2 sr-1 nm-1
  for (const Sample& sample : sky.samples) {
    EXPECT_NEAR(sample.view_zenith, 60 * kDegree, kRounding);
    EXPECT_NEAR(sample.sun_zenith, 60 * kDegree, kRounding);
    EXPECT_EQ(sample.wavelength_nm, 440);
  }
  EXPECT_NEAR(sky.samples[0].relative_azimuth, -6 * kDegree, kRounding);
  EXPECT_NEAR(sky.samples[4].relative_azimuth, 90 * kDegree, kRounding);
  EXPECT_EQ(sky.samples[1].zero_weight_reason, "missing");
  EXPECT_EQ(sky.scans[0].time_utc, "2019-01-03T11:11:49Z");
  EXPECT_FALSE(sky.scans[0].sun_azimuth.has_value());  // the file does not say where it was
  EXPECT_NEAR(sky.scans[0].sun_distance_au, 0.9833, 1e-4);
}

TEST(AeronetCsv, ReadsTheLongNamesAndTheSite) {
  const std::string head = kHead +
                           "Latitude(Degrees),Longitude(Degrees),Elevation(m),"
                           "Radiance_for_Azimuth_Angle_in_Degrees(uW/cm^2/sr/nm)_-90.000,"
                           "Radiance_for_Azimuth_Angle_in_Degrees(uW/cm^2/sr/nm)_6.000,"
                           "Scattering_Angle_for_Nominal_Azimuth_Angle(Degrees)_6.000\n";
  const auto with_zenith = [&](const std::string& zenith) {
    return head + line("11:00:00", "440", zenith, "48,16,200,3,20,5.5");
  };
  const Reference sky = parse(with_zenith("-999"));
  ASSERT_EQ(sky.samples.size(), 2u);
  EXPECT_NEAR(sky.samples[0].relative_azimuth, -90 * kDegree, 1e-9);
  EXPECT_NEAR(sky.samples[0].view_zenith, sky.samples[0].sun_zenith, kRounding);
  EXPECT_EQ(sky.scans[0].elevation_m, 200);
  EXPECT_NEAR(*sky.scans[0].sun_azimuth / kDegree, 180, 3);  // an hour before noon UTC, 16 deg E
  EXPECT_THAT(complaint(with_zenith("60")),
              StartsWith("sky.alm:5: sun_zenith_deg = 60: expected the sun of "
                         "2019-01-03T11:00:00Z at this site, zenith 70."));
}

TEST(AeronetCsv, WavelengthsTakenTogetherAreAScan) {
  const std::string values = "22,-999,20,21,2";
  const Reference sky = parse(
      kBare + line("11:11:49", "440", "60", values) + line("11:13:00", "675", "60.1", values) +
      line("11:14:00", "870", "60.2", values) + line("11:16:00", "440", "60.3", values) +  // again
      line("12:16:00", "675", "65", values));  // an hour later
  ASSERT_EQ(sky.scans.size(), 3u);
  EXPECT_EQ(sky.samples[5].scan, 0);
  EXPECT_NEAR(sky.samples[5].sun_zenith, 60.1 * kDegree, kRounding);
  EXPECT_EQ(sky.samples[15].scan, 1);
  EXPECT_EQ(sky.samples[20].scan, 2);
  EXPECT_EQ(sky.samples[20].direction, 0);
  EXPECT_EQ(sky.samples[24].direction, 4);
}

TEST(AeronetCsv, FaultsNameLineAndColumn) {
  const std::string values = "22,-999,20,21,2";
  EXPECT_EQ(complaint(kBare + line("11:11:49", "440", "60", values, "Hybrid")),
            "sky.alm:5: Sky_Scan_Type = \"Hybrid\": expected Almucantar or Principal Plane, whose "
            "directions are known");
  EXPECT_EQ(complaint(kBare + line("11:11:61", "440", "60", values)),
            "sky.alm:5: Time(hh:mm:ss) = \"11:11:61\": expected hh:mm:ss of a day that exists");
  EXPECT_EQ(complaint(kBare + line("11:11:49", "440", "60", "bright,-999,20,21,2")),
            "sky.alm:5: -6.000000 = \"bright\": expected a number, -999 where there is none");
  EXPECT_EQ(complaint(kBare + line("11:11:49", "0", "60", values)),
            "sky.alm:5: Nominal_Wavelength(nm) = \"0\": expected a wavelength");
  EXPECT_EQ(complaint(kBare + line("11:11:49", "440", "60", "22")),
            "sky.alm:5: expected 13 fields, got 9");
  EXPECT_THAT(complaint(kBare + line("11:11:49", "440", "-999", values)),
              StartsWith("sky.alm:5: the sun is not known: expected latitude_deg, longitude_deg"));
  EXPECT_EQ(complaint(kHead + "note\n" + line("11:11:49", "440", "60", "a")),
            "sky.alm:4: expected columns of radiances, named by their angle from the sun");
  EXPECT_EQ(complaint(kBare),
            "sky.alm: none of 0 samples can be used, expected at least 1: there "
            "is none");
  ImportOptions options;
  options.unit = "W m-2 sr-1 nm-1";
  EXPECT_THAT(complaint(kBare + line("11:11:49", "440", "60", values), options),
              StartsWith("sky.alm: unit = \"uW cm-2 sr-1 nm-1\": expected \"W m-2 sr-1 nm-1\""));
}

// The angles of a principal plane count from the sun, upward > 0; beyond the zenith the azimuth
// turns.
TEST(AeronetCsv, PrincipalPlaneGoesThroughTheZenith) {
  const Reference sky =
      parse(kBare + line("11:11:49", "440", "60", "22,-999,20,21,2", "Principal Plane"));
  EXPECT_NEAR(sky.samples[0].view_zenith, 66 * kDegree, kRounding);
  EXPECT_NEAR(sky.samples[2].view_zenith, 54 * kDegree, kRounding);
  EXPECT_NEAR(sky.samples[2].relative_azimuth, 0, kRounding);
  EXPECT_NEAR(sky.samples[4].view_zenith, 30 * kDegree, kRounding);
  EXPECT_NEAR(std::abs(sky.samples[4].relative_azimuth), 180 * kDegree, kRounding);
}

TEST(AeronetCsv, TypesOfScansAreKnownInTheirSpellings) {
  const auto view_zenith_deg = [&](const std::string& type) {
    const Reference sky = parse(kBare + line("11:11:49", "440", "60", "22,-999,20,21,2", type));
    return sky.samples[0].view_zenith / kDegree;  // toward -6
  };
  for (const std::string type : {"Principal_Plane", "PrincipalPlane", "PPL", "principal plane 1"})
    EXPECT_NEAR(view_zenith_deg(type), 66, 1e-9) << type;
  for (const std::string type : {"ALM", "almucantar", "Almucantar_Right"})
    EXPECT_NEAR(view_zenith_deg(type), 60, 1e-9) << type;
  for (const std::string type : {"HYB", "Hybrid_1"})
    EXPECT_THAT(complaint(kBare + line("11:11:49", "440", "60", "22,-999,20,21,2", type)),
                StartsWith("sky.alm:5: Sky_Scan_Type = \"" + type + "\": expected Almucantar"));
}

// Each under its own columns, whether a line of titles or a head stands above them.
TEST(AeronetCsv, TablesOfSeveralTypesMayFollowEachOther) {
  const std::string columns = kHead.substr(kHead.find("AERONET_Site"));
  const std::string second =
      columns + "-6.0,2.0\n" + line("11:30:00", "440", "60", "30,40", "Principal Plane");
  for (const std::string above : {"", ",,,,,,,,Radiance_for_Azimuth_Angle(uW/cm^2/sr/nm),\n",
                                  "AERONET Version 3;\nSomewhere\nVersion 3: Raw Plane\n"}) {
    const Reference sky =
        parse(kBare + line("11:11:49", "440", "60", "22,-999,20,21,2") + above + second);
    ASSERT_EQ(sky.samples.size(), 7u) << above;
    ASSERT_EQ(sky.scans.size(), 2u);
    EXPECT_NEAR(sky.samples[4].relative_azimuth, 90 * kDegree, kRounding);
    EXPECT_NEAR(sky.samples[5].view_zenith, 66 * kDegree, kRounding);
    EXPECT_NEAR(sky.samples[6].view_zenith, 58 * kDegree, kRounding);
    EXPECT_NEAR(sky.samples[6].value, 0.4, kRounding);
    EXPECT_TRUE(sky.notes.empty()) << sky.notes.front();
  }
  const std::string other = columns + "note\n" + line("11:30:00", "675", "60", "1");
  EXPECT_THAT(parse(kBare + line("11:11:49", "440", "60", "22,-999,20,21,2") + other).notes,
              testing::ElementsAre(StartsWith("a table is left out: sky.alm:6: expected columns")));
  EXPECT_EQ(complaint(kBare + line("11:11:49", "440", "60", "22,-999,20,21,2") + columns +
                      "Radiance_for_Angle(mW/m^2/sr/nm)_6.0\n"),
            "sky.alm:6: unit = \"mW/m^2/sr/nm\": expected uW cm-2 sr-1 nm-1 as before");
}

// As files of version 2 do without types of scans, when one follows the other.
TEST(AeronetCsv, AHeadBelowSaysAnotherPlaceAndPath) {
  const std::string columns =
      "Date(dd:mm:yyyy),Time(hh:mm:ss),Wavelength,SolarZenithAngle,-6.0,6.0\n";
  const auto part = [&](const std::string& head, const std::string& clock) {
    return head + columns + "03:01:2019," + clock + ",440,-999,22,20\n";
  };
  const Reference sky =
      parse(part("Level 1.5 Almucantar\nLocation=A,long=11.0,lat=47.0,elev=500\n", "11:00:00") +
            part("Level 1.5 Principal Plane\nLocation=B,long=-60.0,lat=-3.0\n", "16:00:00"));
  ASSERT_EQ(sky.scans.size(), 2u);
  EXPECT_NEAR(sky.scans[0].site->longitude / kDegree, 11, 1e-9);
  EXPECT_NEAR(sky.scans[1].site->longitude / kDegree, -60, 1e-9);
  EXPECT_NEAR(sky.samples[1].view_zenith, sky.samples[1].sun_zenith, kRounding);
  EXPECT_NEAR(sky.samples[3].view_zenith, sky.samples[3].sun_zenith - 6 * kDegree, 1e-9);
}

TEST(AeronetCsv, ALineThatCannotBeUsedIsLeftOutAndSaid) {
  const std::string values = "22,-999,20,21,2";
  const Reference sky =
      parse(kBare + line("11:11:49", "440", "60", values) +
            line("11:12:49", "675", "60", values, "Hybrid") + line("11:13:49", "870", "60", "22"));
  EXPECT_EQ(sky.samples.size(), 5u);
  ASSERT_EQ(sky.notes.size(), 2u);
  EXPECT_THAT(sky.notes[0], StartsWith("a line is left out: sky.alm:6: Sky_Scan_Type"));
  EXPECT_EQ(sky.notes[1], "a line is left out: sky.alm:7: expected 13 fields, got 9");
}

// The web service ends lines with ",<br>" and the text with tags; wavelengths may be in um.
TEST(AeronetCsv, DownloadsOfTheWebServiceAreRead) {
  const std::string text = "<html><body>\n" + kBare.substr(0, kBare.size() - 1) + ",<br>\n" +
                           "Somewhere,03:01:2019,11:11:49,620,0.44,-999,60,Almucantar,"
                           "22,-999,20,21,2,<br>\n</body></html>\n";
  const Reference sky = parse(text);
  ASSERT_EQ(sky.samples.size(), 5u);
  EXPECT_NEAR(sky.samples[0].wavelength_nm, 440, 1e-9);
}

// A second block of the same names, or under the title of scattering angles, holds no radiances.
TEST(AeronetCsv, ScatteringAnglesAreNoRadiances) {
  const std::string twice = kHead + "-6.0,6.0,90.0,-6.0,6.0,90.0\n" +
                            line("11:11:49", "440", "60", "22,20,2,5.2,5.2,75.5");
  EXPECT_EQ(parse(twice).samples.size(), 3u);
  std::string titles = ",,,,,,,,Radiance,,,Scattering_Angle,,\n";
  const std::size_t columns = kHead.find("AERONET_Site");
  const std::string titled = kHead.substr(0, columns) + titles + kHead.substr(columns) +
                             "-6.0,6.0,90.0,5.2,5.3,75.5\n" +
                             line("11:11:49", "440", "60", "22,20,2,5.2,5.2,75.5");
  EXPECT_EQ(parse(titled).samples.size(), 3u);
}

// Along the principal plane both angles are the same; along the almucantar they are not.
TEST(AeronetCsv, RadiancesMayBeNamedByScatteringAngles) {
  const auto named = [&](const std::string& type) {
    const std::size_t columns = kHead.find("AERONET_Site");
    return kHead.substr(0, columns) + ",,,,,,,,Radiance_for_Scattering_Angle(uW/cm^2/sr/nm),\n" +
           kHead.substr(columns) + "-6.0,6.0\n" + line("11:11:49", "440", "60", "22,20", type);
  };
  const Reference sky = parse(named("Principal Plane"));
  ASSERT_EQ(sky.samples.size(), 2u);
  EXPECT_NEAR(sky.samples[0].view_zenith, 66 * kDegree, kRounding);
  EXPECT_EQ(complaint(named("Almucantar")),
            "sky.alm:6: Sky_Scan_Type = \"Almucantar\": expected Principal Plane under radiances "
            "that are named by scattering angles");
}

// A block under another title, before or behind, is none of radiances.
TEST(AeronetCsv, OtherBlocksAreNoRadiances) {
  const auto titled = [&](const std::string& titles, const std::string& angles,
                          const std::string& values) {
    const std::size_t columns = kHead.find("AERONET_Site");
    return kHead.substr(0, columns) + ",,,,,,,," + titles + "\n" + kHead.substr(columns) + angles +
           "\n" + line("11:11:49", "440", "60", values);
  };
  const Reference sky =
      parse(titled("Elevation_Angle,,Radiance,", "-6.0,6.0,-6.0,6.0", "30,31,22,20"));
  ASSERT_EQ(sky.samples.size(), 2u);
  EXPECT_NEAR(sky.samples[0].value, 0.22, kRounding);
  EXPECT_THAT(complaint(titled("P1_Radiance,,P2_Radiance,", "-6.0,6.0,-6.0,6.0", "30,31,22,20")),
              testing::HasSubstr("expected columns of radiances"));
}

TEST(AeronetCsv, DatesStandAsTheirColumnSays) {
  const auto time_of = [&](const std::string& form, const std::string& date) {
    std::string text = kBare + line("11:11:49", "440", "60", "22,,,20,2");
    text.replace(text.find("dd:mm:yyyy"), 10, form);
    const std::size_t row = text.find(kBare.back(), text.find("-6.000000")) + 1,
                      comma = text.find(',', row);
    text.replace(comma + 1, text.find(',', comma + 1) - comma - 1, date);
    return parse(text).scans[0].time_utc;
  };
  const std::string day_first = time_of("dd:mm:yyyy", "15:05:2024");
  EXPECT_THAT(day_first, StartsWith("2024-05-15T11:11:49"));
  EXPECT_EQ(time_of("mm:dd:yyyy", "05:15:2024"), day_first);
  EXPECT_EQ(time_of("yyyy-mm-dd", "2024-05-15"), day_first);
}

// Whose names hold all that radiances' have.
TEST(AeronetCsv, OpticalDepthsAreNoRadiances) {
  EXPECT_FALSE(
      is_aeronet_csv("Date(dd:mm:yyyy),Time(hh:mm:ss),AOD_440nm,Solar_Zenith_Angle(Degrees),"
                     "Exact_Wavelengths_of_AOD(um)_440nm\n"));
}

TEST(AeronetCsv, TheHeadMayStateTheUnit) {
  std::string text = kBare + line("11:11:49", "440", "60", "22,,,20,2");
  text.insert(text.find("free text"), "Level 1.5 sky radiances, units W/m^2/sr/um\n");
  EXPECT_NEAR(parse(text).samples[0].value, 0.022, kRounding);
}

// 1 uW/cm^2 is 0.01 W/m^2, 1/um is 0.001/nm.
TEST(AeronetCsv, TitlesAndNamesStateTheUnit) {
  const std::string values = line("11:11:49", "440", "60", "22,20");
  const auto titled = [&](const std::string& title) {
    const std::size_t columns = kHead.find("AERONET_Site");
    return kHead.substr(0, columns) + ",,,,,,,,Radiance_for_Azimuth_Angle" + title + ",\n" +
           kHead.substr(columns) + "-6.0(Degrees),6.0\n" + values;
  };
  for (const auto& [unit, factor] : {std::pair{"(uW/cm^2/sr/nm)", 1e-2},
                                     {"(W/m^2/sr/um)", 1e-3},
                                     {"[mW/m^2/sr/nm]", 1e-3},
                                     {"", 1e-2}}) {
    const Reference sky = parse(titled(unit));
    ASSERT_EQ(sky.samples.size(), 2u);
    EXPECT_NEAR(sky.samples[0].value, 22 * factor, 22 * kRounding) << unit;
    EXPECT_NEAR(sky.samples[0].relative_azimuth, -6 * kDegree, kRounding);
  }
  EXPECT_THAT(complaint(titled("(counts)")),
              StartsWith("sky.alm:4: unit = \"counts\": expected one of W m-2 sr-1 nm-1"));
  EXPECT_EQ(complaint(kHead +
                      "Radiance_for_Angle(uW/cm^2/sr/nm)_-6.0,"
                      "Radiance_for_Angle(mW/m^2/sr/nm)_6.0\n" +
                      values),
            "sky.alm:4: unit = \"mW/m^2/sr/nm\": expected uW cm-2 sr-1 nm-1 as before");
  ImportOptions options;
  options.unit = "W m-2 sr-1 nm-1";
  EXPECT_THAT(complaint_of([&] { parse(titled("(W/m^2/sr/um)"), options); }),
              StartsWith("sky.alm: unit = \"W m-2 sr-1 um-1\": expected \"W m-2 sr-1 nm-1\""));
}

TEST(AeronetCsv, APlaceThatIsNoneIsNamed) {
  EXPECT_EQ(complaint(kHead + "Latitude(Degrees),Longitude(Degrees),-6.0,6.0\n" +
                      line("11:11:49", "440", "60", "147.5,11,22,20")),
            "sky.alm:5: latitude_deg = 147.5: expected -90 to 90");
}

TEST(AeronetCsv, AColumnOfRadiancesWithoutAnAngleIsNamed) {
  EXPECT_EQ(complaint(kHead + "-6.0,0.0x,6.0\n" + line("11:11:49", "440", "60", "22,20,2")),
            "sky.alm:4: column 10 = \"0.0x\": expected the angle of radiances from the sun, in "
            "degrees");
}

// Patterns of std::regex would go down the stack with each character.
TEST(AeronetCsv, LinesOfAMegabyteAreNoDanger) {
  const std::string megabyte(1'000'000, '1');
  const std::string values = "22,-999,20,21,<" + megabyte;
  EXPECT_THAT(complaint(kBare + line("11:11:49", "440", "60", values)),
              testing::HasSubstr("expected a number"));
  const std::string head = "Location=S,long=" + megabyte + ",lat =47.5 N\n";
  EXPECT_EQ(parse(head + kBare + line("11:11:49", "440", "60", "22,-999,20,21,2")).samples.size(),
            5u);
}

TEST(AeronetCsv, FilesOfBothVersionsHoldTheSameSky) {
  const auto read = [](const std::string& name) {
    const std::string file = std::string(SKYFIT_TEST_DATA) + "/" + name;
    return parse_aeronet_csv(read_text_file(file, "an almucantar"), file, {});
  };
  const Reference third = read("aeronet_named_two_blocks.csv"), second = read("aeronet_v2.alm");
  ASSERT_EQ(third.samples.size(), 308u);
  ASSERT_EQ(second.samples.size(), 308u);
  EXPECT_EQ(third.scans.size(), 2u);
  EXPECT_EQ(third.samples[2 * 77].zero_weight_reason, "missing");  // the sun itself
  EXPECT_EQ(third.samples[2 * 77 + 1].zero_weight_reason, "one value in every direction");
  for (std::size_t i = 0; i < second.samples.size(); ++i) {
    EXPECT_EQ(second.samples[i].value, third.samples[i].value);
    EXPECT_NEAR(second.samples[i].sun_zenith, third.samples[i].sun_zenith, kRounding);
  }
}

}  // namespace
}  // namespace skyfit::refs
