// SPDX-License-Identifier: Apache-2.0
// A preset survives writing and reading bit by bit, and every fault of a file is one line that
// names its place.
#include "model/atmosphere/preset.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "model/atmosphere/parameters.h"

namespace skyfit {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr std::string_view kText = R"({
  "skyfit_preset": 1,
  "name": "test",
  "planet": {"bottom_radius_m": 6360000, "top_radius_m": 6460000},
  "rayleigh": {
    "scattering_per_m": {"wavelength_nm": 550, "value": 1.216e-5, "exponent": 4.08},
    "scale_height_m": 8000
  },
  "mie": {
    "scattering_per_m": {"wavelength_nm": 550, "value": 4e-6, "exponent": 0},
    "single_scattering_albedo": 0.9,
    "scale_height_m": 1200,
    "phase": {"type": "cornette-shanks", "g": 0.76}
  },
  "ozone": {"column_du": 0, "profile": "tent"},
  "ground": {"albedo": 0.1}
}
)";

std::string with(std::string_view from, std::string_view to) {
  std::string text(kText);
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string complaint(const std::string& text) {
  try {
    parse_preset(text, "my.json");
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

// It is shown on terminals.
TEST(PresetTest, NameIsPrintable) {
  const std::string text = with("\"test\"", "\"a\\u001b[31m\\nb\"");
  EXPECT_EQ(parse_preset(text, "a.json").name, "a?[31m b");
}

TEST(Preset, ReadsEveryField) {
  const Preset preset = parse_preset(kText, "my.json");
  EXPECT_EQ(preset.name, "test");
  EXPECT_EQ(preset.atmosphere.top_radius_m, 6460000);
  EXPECT_EQ(preset.atmosphere.at("rayleigh").angstrom_exponent, 4.08);
  EXPECT_EQ(preset.atmosphere.at("mie").amount, 4e-6);
  EXPECT_EQ(preset.atmosphere.at("mie").phase.g, 0.76);
  EXPECT_EQ(preset.atmosphere.at("ozone").profile.type, ProfileType::kCorners);
  EXPECT_EQ(preset.atmosphere.ground_albedo, 0.1);
  EXPECT_TRUE(preset.fit.is_null());
}

TEST(Preset, RoundTripIsExactForEveryPhaseAndProfile) {
  for (const PhaseType type :
       {PhaseType::kCornetteShanks, PhaseType::kHenyeyGreenstein, PhaseType::kTwoLobe}) {
    for (const ProfileType profile : {ProfileType::kCorners, ProfileType::kSameAs}) {
      Preset preset;
      preset.name = "a \"quoted\" name, caf\xc3\xa9";
      preset.atmosphere.at("mie").phase.type = type;
      preset.atmosphere.at("ozone").profile.type = profile;
      preset.atmosphere.at("ozone").profile.of = "rayleigh";
      for (const Parameter& id : standard_parameters()) {
        // Neighbours of thirds need all 17 digits.
        set_parameter(preset.atmosphere, id,
                      std::nextafter(get_parameter(preset.atmosphere, id) / 3, 1e9));
      }
      preset.fit = {{"rms", 1.0 / 3}, {"covariance", {{1e-300, 2}, {0.1, -4.9e-324}}}};
      const Preset again = parse_preset(preset_to_json(preset), "again.json");
      EXPECT_EQ(again.name, preset.name);
      EXPECT_EQ(again.fit, preset.fit);
      EXPECT_EQ(again.atmosphere.at("mie").phase.type, type);
      EXPECT_EQ(again.atmosphere.at("ozone").profile.type, profile);
      for (const Parameter& id : standard_parameters()) {
        if (!has_parameter(preset.atmosphere, id)) continue;
        EXPECT_EQ(get_parameter(again.atmosphere, id), get_parameter(preset.atmosphere, id))
            << id.name();
      }
      EXPECT_EQ(preset_to_json(again), preset_to_json(preset));
    }
  }
}

TEST(Preset, TwoLobesAreOfCornetteAndShanksUnlessNamed) {
  constexpr std::string_view kOneLobe = R"("type": "cornette-shanks", "g": 0.76)",
                             kTwo = R"("type": "two-lobe", "g1": 0.8, "g2": 0.1, "weight": 0.5)";
  EXPECT_EQ(parse_preset(with(kOneLobe, kTwo), "my.json").atmosphere.at("mie").phase.lobe,
            PhaseType::kCornetteShanks);
  const Preset preset = parse_preset(
      with(kOneLobe, std::string(kTwo) + R"(, "lobe": "henyey-greenstein")"), "my.json");
  EXPECT_EQ(preset.atmosphere.at("mie").phase.lobe, PhaseType::kHenyeyGreenstein);
  EXPECT_EQ(parse_preset(preset_to_json(preset), "again.json").atmosphere.at("mie").phase.lobe,
            PhaseType::kHenyeyGreenstein);
  EXPECT_EQ(complaint(with(kOneLobe, std::string(kTwo) + R"(, "lobe": "two-lobe")")),
            "my.json:13: mie.phase.lobe = \"two-lobe\": expected one of cornette-shanks, "
            "henyey-greenstein");
}

TEST(Preset, AirMayDepolariseAndHaveAPressure) {
  const Preset preset = parse_preset(
      with("\"scale_height_m\": 8000",
           "\"scale_height_m\": 8000, \"depolarisation\": 0.0279, \"site_pressure_hpa\": 880"),
      "my.json");
  const Preset again = parse_preset(preset_to_json(preset), "again.json");
  EXPECT_EQ(again.atmosphere.at("rayleigh").phase.depolarisation, 0.0279);
  EXPECT_EQ(again.atmosphere.at("rayleigh").site_pressure_hpa, 880);
}

constexpr std::string_view kTablesPhase =
    R"("type": "tabulated", "scattering_angle_deg": [0, 90, 180], "phase_per_sr": [0.08, 0.079, 0.08])";
constexpr std::string_view kTablesProfile =
    R"("profile": {"type": "tabulated", "height_m": [0, 800.5, 2000], "relative_density": [1, 0.7, 0]},)";

TEST(Preset, RoundTripOfTablesIsExact) {
  std::string text = with(R"("scale_height_m": 1200,)", kTablesProfile);
  const std::string_view lobe = R"("type": "cornette-shanks", "g": 0.76)";
  text.replace(text.find(lobe), lobe.size(), kTablesPhase);
  const Preset preset = parse_preset(text, "my.json");
  EXPECT_EQ(preset.atmosphere.at("mie").profile.table->table(),
            (TwoColumns{{0, 800.5, 2000}, {1, 0.7, 0}}));
  const Preset again = parse_preset(preset_to_json(preset), "again.json");
  EXPECT_EQ(again.atmosphere.at("mie").profile.table->table(),
            preset.atmosphere.at("mie").profile.table->table());
  EXPECT_EQ(again.atmosphere.at("mie").phase.table->table(),
            preset.atmosphere.at("mie").phase.table->table());
  EXPECT_EQ(preset_to_json(again), preset_to_json(preset));
}

TEST(Preset, CsvIsReadBesideThePresetAndWrittenAsArrays) {
  const std::string text =
      with(R"("profile": "tent")", R"("profile": {"type": "tabulated", "csv": "ozone.csv"})");
  const TwoColumns table{{0, 20e3, 50e3}, {0, 2, 0}};
  const auto reader = [&](const std::filesystem::path& file, const TableFormat& format) {
    EXPECT_EQ(file, std::filesystem::path("folder/ozone.csv"));
    EXPECT_EQ(format.columns[0], "height_m");
    return table;
  };
  const Preset preset = parse_preset(text, "folder/my.json", reader);
  EXPECT_EQ(preset.atmosphere.at("ozone").profile.type, ProfileType::kTabulated);
  const Preset again = parse_preset(preset_to_json(preset), "again.json");
  EXPECT_EQ(again.atmosphere.at("ozone").profile.table->table(), table);
  EXPECT_EQ(complaint(text),
            "my.json:15: ozone.profile.csv = \"ozone.csv\": expected height_m and "
            "relative_density instead of a file");
}

TEST(Preset, FaultsOfTablesAreNamed) {
  const auto profile = [](std::string_view text) {
    return complaint(with(R"("scale_height_m": 1200,)", text));
  };
  EXPECT_EQ(
      profile(
          R"("profile": {"type": "tabulated", "height_m": [0, 1], "relative_density": [1, -2]},)"),
      "my.json:12: mie.profile.relative_density[1] = -2: expected a density >= 0");
  EXPECT_EQ(
      profile(
          R"("profile": {"type": "tabulated", "height_m": [0, "x"], "relative_density": [1, 2]},)"),
      "my.json:12: mie.profile.height_m = [0,\"x\"]: expected an array of numbers");
  EXPECT_EQ(
      profile(R"("profile": {"type": "tabulated", "height_m": [0, 1], "relative_density": [1]},)"),
      "my.json:12: mie.profile.relative_density: 1 values: expected as many as of height_m, 2");
  EXPECT_EQ(profile(R"("profile": "tent",)"),
            "my.json:12: mie.profile = \"tent\": expected exponential or an object");
  EXPECT_EQ(profile(R"("profile": {"type": "tent"},)"),
            "my.json:12: mie.profile.type = \"tent\": expected tabulated");
  EXPECT_EQ(profile(std::string(R"("scale_height_m": 1200,)") + std::string(kTablesProfile)),
            "my.json:12: mie.scale_height_m = 1200: expected no scale height beside a tabulated "
            "profile");
}

TEST(Preset, UnphysicalAtmosphereIsNotWritten) {
  Preset preset;
  preset.atmosphere.ground_albedo = std::nan("");
  EXPECT_THROW(preset_to_json(preset), std::invalid_argument);
}

TEST(Preset, UnknownNameIsNamedWithItsFullPath) {
  EXPECT_EQ(complaint(with("\"g\": 0.76", "\"g\": 0.76, \"gg\": 1")),
            "my.json:13: mie.phase.gg: unknown name, expected one of type, g");
  EXPECT_THAT(complaint(with("\"ground\"", "\"grounds\"")),
              StartsWith("my.json:16: grounds: unknown name"));
}

TEST(Preset, UnknownNameIsOneLineWhateverItHolds) {
  EXPECT_EQ(complaint(with("\"g\": 0.76", "\"g\": 0.76, \"\\n\": 1")),
            "my.json:13: mie.phase. : unknown name, expected one of type, g");
}

TEST(Preset, PhaseHasExactlyTheFieldsOfItsType) {
  EXPECT_EQ(complaint(with("cornette-shanks", "two-lobe")),
            "my.json:13: mie.phase.g: unknown name, expected one of type, lobe, g1, g2, weight");
  EXPECT_EQ(complaint(with("cornette-shanks", "mie")),
            "my.json:13: mie.phase.type = \"mie\": expected one of cornette-shanks, "
            "henyey-greenstein, two-lobe, tabulated, rayleigh, tabulated-by-wavelength, "
            "size-distribution");
}

TEST(Preset, MissingNameIsNamed) {
  EXPECT_EQ(complaint(with("\"scale_height_m\": 1200,", "")),
            "my.json:9: mie.scale_height_m: missing, expected a number");
  EXPECT_EQ(complaint("{}"), "my.json: skyfit_preset: missing, expected a number");
}

TEST(Preset, DuplicateNameIsAnError) {
  EXPECT_EQ(complaint(with("\"scale_height_m\": 1200,",
                           "\"scale_height_m\": 1200,\n\"scale_height_m\": 1,")),
            "my.json:13: mie.scale_height_m: expected once, found twice");
}

TEST(Preset, WrongTypesAreNamed) {
  EXPECT_EQ(complaint(with("0.76", "\"0.76\"")),
            "my.json:13: mie.phase.g = \"0.76\": expected a number");
  EXPECT_EQ(complaint(with("0.76", "null")), "my.json:13: mie.phase.g = null: expected a number");
  EXPECT_EQ(complaint(with("0.76", "true")), "my.json:13: mie.phase.g = true: expected a number");
  EXPECT_EQ(complaint(with("{\"albedo\": 0.1}", "0.1")),
            "my.json:16: ground = 0.1: expected an object");
  EXPECT_EQ(complaint(with("\"test\"", "7")), "my.json:3: name = 7: expected a text");
  EXPECT_EQ(complaint(with("\"ground\"", "\"fit\": 3, \"ground\"")),
            "my.json:16: fit = 3: expected an object");
  EXPECT_EQ(complaint("[1]"), "my.json: expected a JSON object, got [1]");
}

TEST(Preset, UnphysicalValuesAreNamed) {
  EXPECT_EQ(
      complaint(with("4e-6", "-4e-6")),
      "my.json:10: mie.scattering_per_m.value = -4e-06: expected a coefficient from 0 to 10 1/m");
  EXPECT_EQ(complaint(with("0.76", "1.0")),
            "my.json:13: mie.phase.g = 1: expected an asymmetry from -0.8 to 0.999");
}

TEST(Preset, OtherVersionIsRefused) {
  EXPECT_EQ(complaint(with("\"skyfit_preset\": 1", "\"skyfit_preset\": 3")),
            "my.json:2: skyfit_preset = 3: expected 1 or 2, the versions this program reads");
}

TEST(Preset, BrokenJsonNamesTheLine) {
  for (const std::string_view not_a_number : {"NaN", "-Infinity", "1e999", "0.7.6", "nul"}) {
    EXPECT_THAT(complaint(with("0.76", not_a_number)),
                AllOf(StartsWith("my.json:13: expected JSON, got "), Not(HasSubstr("\n"))))
        << not_a_number;
  }
  EXPECT_THAT(complaint(with("\"scale_height_m\": 1200,", "\"scale_height_m\": 1200")),
              StartsWith("my.json:13: expected JSON, got "));
  EXPECT_THAT(complaint(""), StartsWith("my.json:1: expected JSON"));
  EXPECT_THAT(complaint(std::string(kText.substr(0, 200))), StartsWith("my.json:6: expected JSON"));
  EXPECT_THAT(complaint(std::string(kText) + "x"), StartsWith("my.json:18: expected JSON"));
}

TEST(Preset, EndlessNestingIsRefused) {
  EXPECT_EQ(complaint(std::string(100000, '[')), "my.json:1: expected at most 64 nested values");
  EXPECT_THAT(complaint(with("\"test\"", std::string(70, '[') + std::string(70, ']'))),
              StartsWith("my.json:3: expected at most 64 nested values"));
}

TEST(Preset, NameThatIsNotUtf8IsWrittenAsReadableText) {
  Preset preset;
  preset.name = "a\xff";
  EXPECT_EQ(parse_preset(preset_to_json(preset), "my.json").name, "a\xef\xbf\xbd");
}

TEST(LoadPreset, FileThatCannotBeReadIsNamed) {
  const std::filesystem::path folder = testing::TempDir();
  const auto complaint_of = [](const std::filesystem::path& file) -> std::string {
    try {
      load_preset(file);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(complaint_of("no/such.json"),
            "no/such.json: cannot be read (No such file or directory), expected a preset");
  EXPECT_EQ(complaint_of(folder),
            folder.string() + ": cannot be read (Is a directory), expected a preset");
}

TEST(LoadPreset, ReadsAFile) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / "skyfit_preset_test.json";
  std::ofstream(file) << kText;
  EXPECT_EQ(load_preset(file).name, "test");
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace skyfit
