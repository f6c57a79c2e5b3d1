// SPDX-License-Identifier: Apache-2.0
// Bad input ends with one line that says where, what was found and what was expected, a status that
// is not 0, and nothing left behind.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "data_refs/references.h"
#include "tests/cli/program.h"

namespace skyfit::cli {
namespace {

constexpr const char* kHeader =
    "sun_zenith_deg,view_zenith_deg,relative_azimuth_deg,luminance_cd_m2\n";

class BadInputTest : public ProgramTest {
 protected:
  // A preset file with one field changed, or added.
  void write_preset(const std::string& name, const std::string& pointer,
                    const nlohmann::json& value) const {
    auto preset = nlohmann::json::parse(refs::shipped_preset_json("earth-clear"));
    preset[nlohmann::json::json_pointer(pointer)] = value;
    write(name, preset.dump(2));
  }
  void expect_fit_refusal(const std::string& reference,
                          const std::vector<std::string>& texts) const {
    expect_refusal({"fit", "--reference", reference, "--out", "fitted"}, texts);
  }
  void expect_sky_refusal(const std::vector<std::string>& arguments,
                          const std::vector<std::string>& texts) const {
    std::vector<std::string> all = {"sky", "--preset", "earth-clear"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    expect_refusal(all, texts);
  }
};

TEST_F(BadInputTest, CommandLine) {
  expect_refusal({}, {"expected a command"});
  expect_refusal({"fot"}, {"fot"});
  expect_refusal({"fit"}, {"--out is required"});
  expect_refusal({"fit", "--out", "x"}, {"--reference or --irradiance is required"});
  expect_refusal({"fit", "--out", "x", "--irradiance", "direct=800"}, {"direct=800", "no unit"});
  expect_refusal({"fit", "--reference", "cie:12"}, {"--out is required"});
  expect_refusal({"fit", "--reference", "cie:12,cie:12", "--out", "x"},
                 {"--reference \"cie:12\"", "given twice"});
  expect_refusal({"references", "cie:12", "--json"}, {"--json", "without a name"});
  expect_refusal({"presets", "earth-clear", "--schema"}, {"--schema", "excludes"});
  expect_refusal({"fit", "--reference", "cie:12", "--out", "x", "--lobes", "abc"},
                 {"--lobes", "abc", "whole number"});
  expect_sky_refusal({"--sun-zenith-deg", "40", ""}, {"\"\": unknown, expected options"});
  expect_sky_refusal({"--sun-zenith-deg", "40", "noon"}, {"\"noon\": unknown, expected options"});
  expect_sky_refusal({"--sun-zenith-deg", "40", "--refraction="}, {"--refraction \"\"", "no ="});
  expect_sky_refusal(
      {"--sun-zenith-deg", "40", "--view-zenith-deg", "0", "--refraction", "--model", "preetham"},
      {"--refraction: expected with the model reference, not preetham"});
  expect_refusal({"fit", "--reference", "cie:12", "--out", "x", "--wings", "2"}, {"--wings"});
}

TEST_F(BadInputTest, MissingFiles) {
  expect_fit_refusal("missing.csv", {"missing.csv"});
  expect_refusal({"check", "missing.json"}, {"missing.json", "no such file"});
  expect_refusal({"check", "missing.csv"}, {"missing.csv", "no such file"});
  write("folder/file", "");
  expect_refusal({"check", "folder"}, {"folder", "no measured sky"});
  expect_refusal({"plot", "missing", "--out", "figure.svg"}, {"missing"});
  expect_refusal(
      {"sky", "--preset", "missing.json", "--sun-zenith-deg", "0", "--view-zenith-deg", "0"},
      {"missing.json", "no such file", "earth-clear"});
  expect_refusal({"render", "--preset", "earth-bright", "--out", "frame.png"},
                 {"earth-bright", "bodare-2014"});
}

TEST_F(BadInputTest, UnknownNames) {
  expect_refusal({"presets", "venus"}, {"venus", "earth-clear"});
  expect_refusal({"references", "cie:16"}, {"cie:16"});
  expect_fit_refusal("cie:16", {"cie:16"});
  expect_refusal({"fit", "--reference", "cie:12", "--free", "mie.beta", "--out", "x"},
                 {"--free", "mie.beta", "mie.scattering"});
  expect_refusal({"fit", "--reference", "cie:12", "--sampling", "random", "--out", "x"},
                 {"--sampling", "random", "tregenza"});
  expect_sky_refusal({"--sun-zenith-deg", "0", "--view-zenith-deg", "0", "--model", "magic"},
                     {"magic", "reference"});
  expect_sky_refusal({"--sun-zenith-deg", "0", "--view-zenith-deg", "0", "--model", ":"},
                     {"expected one of reference"});
  expect_refusal({"render", "--preset", "earth-clear", "--view", "moon", "--out", "frame.png"},
                 {"--view \"moon\"", "ground", "space"});
}

TEST_F(BadInputTest, EmptyValues) {
  for (const char* const option :
       {"--link", "--scale", "--pointing", "--noise", "--ground", "--per-scan", "--hold-out"})
    expect_refusal({"fit", "--reference", "cie:12", "--out", "x", option, ""},
                   {fmt::format("{} \"\": expected ", option), "(see skyfit fit --help)"});
  expect_sky_refusal({"--sun-zenith-deg", "0", "--view-zenith-deg", "0", "--model", ""},
                     {"--model \"\": expected NAME"});
  expect_refusal({"fit", "--reference", "cie:12", "--irradiance", "", "--out", "x"},
                 {"--irradiance \"\": expected NAME=VALUE"});
  expect_refusal({"fit", "--reference", "", "--irradiance", "direct=96klx", "--out", "x"},
                 {"--reference \"\": expected NAME|FILE"});
  expect_refusal({"compare", "--reference", "", "--out", "x"},
                 {"--reference \"\": expected NAME|FILE"});
  expect_refusal({"render", "--preset", "earth-clear", "--dem", "", "--out", "frame.png"},
                 {"--dem \"\": expected FILE"});
  expect_refusal({"campaign", "", "--out", "x"}, {"plan \"\": expected PLAN"});
  expect_refusal({"fit", "--reference", "cie:12", "--out", ""}, {"--out \"\": expected DIR"});
}

TEST_F(BadInputTest, VariantsOfAModelTwice) {
  const auto refused = [&](const char* model, const char* row) {
    expect_sky_refusal({"--sun-zenith-deg", "0", "--view-zenith-deg", "0", "--model", model},
                       {model, row, "once"});
  };
  refused("oneil:samples=3:samples=4", "samples=N");
  refused("oneil:no-shadow:no-shadow", "no-shadow");
}

TEST_F(BadInputTest, OptionsThatMeasuringTablesHasNoUseFor) {
  for (const auto& [option, value] :
       {std::pair{"--size", "small"}, {"--precision", "half"}, {"--format", "dds"}})
    expect_refusal({"tables", "earth-clear", "--measure", option, value},
                   {option, value, "without --measure"});
}

TEST_F(BadInputTest, SamplesWithTheWrongUnit) {
  write("unit.csv",
        "sun_zenith_deg,view_zenith_deg,relative_azimuth_deg,luminance_kcd_m2\n30,10,0,5\n");
  expect_fit_refusal("unit.csv", {"unit.csv:1", "luminance_kcd_m2", "luminance_cd_m2"});
  expect_refusal({"check", "unit.csv"}, {"unit.csv:1", "luminance_kcd_m2"});
  write("sky.csv",
        "sun_zenith_deg,view_zenith_deg,relative_azimuth_deg,luminance_cd_m2\n40,30,20,5000\n");
  expect_refusal({"check", "sky.csv", "--unit", "kcd/m2"}, {"sky.csv: unit = kcd", "luminance"});
  write("word.csv", kHeader + std::string("30,10,0,bright\n"));
  expect_fit_refusal("word.csv", {"word.csv:2", "luminance_cd_m2", "bright"});
}

TEST_F(BadInputTest, SamplesThatAreNotNumbers) {
  for (const char* value : {"nan", "NaN", "inf", "-5", "0", ""}) {
    write("sky.csv", kHeader + std::string("30,10,0,5000\n30,20,0,") + value + "\n");
    expect_fit_refusal("sky.csv", {"sky.csv:3", "luminance_cd_m2", "expected"});
  }
}

TEST_F(BadInputTest, EmptyReferences) {
  write("empty.csv", "");
  expect_fit_refusal("empty.csv", {"empty.csv", "expected"});
  write("header.csv", kHeader);
  expect_fit_refusal("header.csv", {"header.csv", "expected"});
  expect_refusal({"check", "header.csv"}, {"header.csv", "expected"});
}

TEST_F(BadInputTest, SunsBelowTheHorizon) {
  expect_refusal({"fit", "--reference", "cie:12", "--sun-zenith-deg", "80,95", "--out", "x"},
                 {"--sun-zenith-deg", "95", "above the horizon"});
  write("night.csv", kHeader + std::string("95,10,0,5000\n"));
  expect_fit_refusal("night.csv", {"night.csv:2", "sun_zenith_deg", "95", "above the horizon"});
}

TEST_F(BadInputTest, PresetsWithUnphysicalValues) {
  write_preset("bad.json", "/mie/scattering_per_m/value", -4e-6);
  expect_refusal({"check", "bad.json"},
                 {"bad.json", "mie.scattering_per_m.value", "-4e-06", "expected"});
  expect_refusal({"sky", "--preset", "bad.json", "--sun-zenith-deg", "0", "--view-zenith-deg", "0"},
                 {"bad.json", "mie.scattering_per_m.value"});
  expect_refusal({"render", "--preset", "bad.json", "--out", "frame.exr"},
                 {"bad.json", "mie.scattering_per_m.value"});
  expect_refusal({"fit", "--reference", "cie:12", "--preset", "bad.json", "--out", "x"},
                 {"bad.json", "mie.scattering_per_m.value"});
}

TEST_F(BadInputTest, PresetsWithBadTables) {
  write("bad.csv", "scattering_angle_deg,phase_per_sr\n0,0.2\n180,0.2\n");
  write_preset("bad.json", "/mie/phase", {{"type", "tabulated"}, {"csv", "bad.csv"}});
  expect_refusal({"check", "bad.json"}, {"bad.csv:1", "phase_per_sr", "2.51327", "within 5 %"});
  write_preset("bad.json", "/mie/phase", {{"type", "tabulated"}, {"csv", "missing.csv"}});
  expect_refusal({"check", "bad.json"}, {"missing.csv", "No such file"});
  expect_sky_refusal(
      {"--sun-zenith-deg", "0", "--view-zenith-deg", "0", "--site-pressure-hpa", "0"},
      {"--site-pressure-hpa", "0", "expected a pressure > 0 hPa"});
}

TEST_F(BadInputTest, PresetsWithUnknownMissingOrWrongFields) {
  write_preset("bad.json", "/mie/turbidity", 2.5);
  expect_refusal({"check", "bad.json"}, {"bad.json", "mie.turbidity"});
  write_preset("bad.json", "/rayleigh/scale_height_m", "8 km");
  expect_refusal({"check", "bad.json"},
                 {"bad.json", "rayleigh.scale_height_m", "8 km", "expected"});
  write_preset("bad.json", "/rayleigh/scale_height_m", nullptr);
  expect_refusal({"check", "bad.json"}, {"bad.json", "rayleigh.scale_height_m", "expected"});
  write_preset("bad.json", "/skyfit_preset", 2);
  expect_refusal({"check", "bad.json"}, {"bad.json", "skyfit_preset"});
  write("bad.json", "{ \"skyfit_preset\": 1,");
  expect_refusal({"check", "bad.json"}, {"bad.json"});
  write("bad.json", "");
  expect_refusal({"check", "bad.json"}, {"bad.json"});
}

TEST_F(BadInputTest, Lists) {
  expect_sky_refusal({"--sun-zenith-deg", "0:80:0", "--view-zenith-deg", "0"},
                     {"--sun-zenith-deg", "0:80:0", "step that is not zero"});
  expect_sky_refusal({"--sun-zenith-deg", "0", "--view-zenith-deg", "80:0:5"},
                     {"--view-zenith-deg", "80:0:5", "sign"});
  expect_sky_refusal({"--sun-zenith-deg", "0", "--view-zenith-deg", "0", "--azimuth-deg", "nan"},
                     {"--azimuth-deg", "nan"});
  expect_sky_refusal({"--sun-zenith-deg", "200", "--view-zenith-deg", "0"},
                     {"--sun-zenith-deg", "200", "from 0 to 180"});
  expect_sky_refusal({"--sun-zenith-deg", "-1", "--view-zenith-deg", "0"},
                     {"--sun-zenith-deg", "-1", "from 0 to 180"});
  expect_sky_refusal({"--sun-zenith-deg", "0", "--view-zenith-deg", "0", "--altitude-m", ""},
                     {"--altitude-m"});
  expect_sky_refusal({"--sun-zenith-deg", "0", "--view-zenith-deg", "0", "--altitude-m", "-5"},
                     {"-5"});
  expect_sky_refusal({"--sun-zenith-deg", "0"}, {"--view-zenith-deg", "expected"});
  expect_sky_refusal({"--sun-zenith-deg", "0:90:0.001", "--view-zenith-deg", "0:90:0.001"},
                     {"combinations", "at most"});
  expect_refusal({"fit", "--reference", "cie:12", "--sun-zenith-deg", "0:80:0", "--out", "x"},
                 {"--sun-zenith-deg", "0:80:0"});
}

TEST_F(BadInputTest, Wavelengths) {
  expect_sky_refusal({"--sun-zenith-deg", "0", "--view-zenith-deg", "0", "--wavelength-nm", "200"},
                     {"--wavelength-nm", "200", "from 300 to 2500"});
  expect_sky_refusal(
      {"--sun-zenith-deg", "0", "--view-zenith-deg", "0", "--wavelength-nm", "550", "--luminance"},
      {"--luminance"});
  expect_sky_refusal(
      {"--sun-zenith-deg", "0", "--view-zenith-deg", "0", "--wavelength-nm", "550", "--color"},
      {"--color", "expected without --wavelength-nm"});
}

TEST_F(BadInputTest, OneKindOfValue) {
  const std::vector<std::string> kinds = {"--luminance", "--color", "--irradiance"};
  for (const std::string& first : kinds) {
    for (const std::string& second : kinds) {
      if (first == second) continue;
      expect_sky_refusal({"--sun-zenith-deg", "0", "--view-zenith-deg", "0", first, second},
                         {first, second});
    }
  }
}

TEST_F(BadInputTest, Altitudes) {
  for (const char* altitude : {"high", "-5", "nan", "inf", "1e13", "0:10:-1", ""}) {
    expect_sky_refusal(
        {"--sun-zenith-deg", "0", "--view-zenith-deg", "0", "--altitude-m", altitude},
        {"--altitude-m", altitude});
  }
}

TEST_F(BadInputTest, FitOptions) {
  const auto refuse = [&](std::vector<std::string> extra, const std::vector<std::string>& texts) {
    extra.insert(extra.begin(), {"fit", "--reference", "cie:12", "--out", "x"});
    expect_refusal(extra, texts);
  };
  refuse({"--starts", "0"}, {"starts = 0", "must be >= 1"});
  refuse({"--lobes", "3"}, {"lobes = 3", "must be 1 or 2"});
  refuse({"--max-iterations", "0"}, {"max_iterations = 0", "must be >= 1"});
  refuse({"--exclude-sun-deg", "nan"}, {"--exclude-sun-deg", "nan"});
  refuse({"--exclude-sun-deg", "-1"}, {"exclude_sun_deg = -1"});
  refuse({"--fix", "ground.albedo"}, {"--fix", "ground.albedo", "name=value"});
  refuse({"--prior", "ground.albedo=0.1:-1"}, {"--prior", "sigma > 0"});
  refuse({"--threads", "0"}, {"--threads", "0"});
  // An option given without a value, as by an unset variable, is not one that was left out.
  refuse({"--free", ""}, {"--free \"\"", "expected NAME,NAME"});
  refuse({"--free", "ground.albedo,"}, {"--free", "names of parameters"});
  refuse({"--preset", ""}, {"--preset \"\"", "expected FILE|NAME"});
}

TEST_F(BadInputTest, UnwritableOutputs) {
  write("file", "text");
  expect_refusal({"fit", "--reference", "cie:12", "--out", "file"},
                 {"file", "expected a directory"});
  expect_refusal({"fit", "--reference", "cie:12", "--out", "file/below"},
                 {"file/below", "cannot be written"});
  expect_refusal({"fit", "--reference", "cie:12", "--out", "/proc/fitted"},
                 {"/proc/fitted", "cannot be written"});
  const std::string long_name(300, 'a');
  expect_refusal({"fit", "--reference", "cie:12", "--out", long_name}, {long_name + ": "});
  expect_refusal({"render", "--preset", "earth-clear", "--out", "missing/frame.png"},
                 {"missing/frame.png", "folder"});
  expect_refusal({"render", "--preset", "earth-clear", "--out", "/proc/frame.png"},
                 {"/proc/frame.png", "cannot be written"});
  expect_refusal({"plot", "file", "--out", "/proc/figure.svg"},
                 {"/proc/figure.svg", "cannot be written"});
}

TEST_F(BadInputTest, ADirectoryWithOtherFilesIsNotTouched) {
  write("mine/thesis.tex", "words");
  expect_refusal({"fit", "--reference", "cie:12", "--out", "mine"},
                 {"mine", "thesis.tex", "--force"});
  EXPECT_EQ(read("mine/thesis.tex"), "words");
}

TEST_F(BadInputTest, OutputsOfAnotherKind) {
  expect_refusal({"render", "--preset", "earth-clear", "--out", "frame.jpg"},
                 {"--out", "frame.jpg", ".png, .exr or .npy"});
  expect_refusal(
      {"plot", "x", "--out", "f.svg", "--figure", "pie"},
      {"--figure", "pie", "expected one of comparison, polarisation, mean-density, maps"});
  expect_refusal({"plot", "x", "--out", "f.svg", "--style", "poster"},
                 {"--style", "poster", "expected one of paper, slides"});
  expect_refusal({"plot", "x", "--out", "f.svg", "--width-mm", "60", "--font-size", "12"},
                 {"--width-mm", "60", "84.67 mm for 12 pt"});
  expect_refusal({"plot", "x", "--out", "f.svg", "--panels", "1,0"}, {"--panels", "1,0"});
  expect_refusal({"plot", "x", "--out", "f.svg", "--panels", "3-1"}, {"--panels", "3-1"});
  expect_refusal({"plot", "x", "--out", "figure.gif"},
                 {"--out", "figure.gif", ".svg, .png or .pdf"});
}

TEST_F(BadInputTest, OutputsNamedTwice) {
  expect_refusal(
      {"render", "--preset", "earth-clear", "--out", "frame.png", "--out", "./frame.png"},
      {"--out", "./frame.png", "once"});
  expect_refusal({"plot", "x", "--out", "figure.svg", "--out", "figure.svg"},
                 {"--out", "figure.svg", "once"});
}

TEST_F(BadInputTest, ImagesOfNoOrAbsurdSize) {
  for (const char* size :
       {"0x720", "1280x0", "1280", "-1x-1", "1000000x1000000", "16384x16384", "bigxsmall"}) {
    expect_refusal({"render", "--preset", "earth-clear", "--size", size, "--out", "frame.png"},
                   {"--size", size, "expected WIDTHxHEIGHT"});
  }
}

TEST_F(BadInputTest, RenderNumbers) {
  const auto refuse = [&](const std::string& option, const std::string& value) {
    expect_refusal({"render", "--preset", "earth-clear", option, value, "--out", "frame.png"},
                   {option, value});
  };
  refuse("--sun-zenith-deg", "181");
  refuse("--sun-zenith-deg", "10,20");
  refuse("--sun-zenith-deg", "nan");
  refuse("--sun-zenith-deg", "");
  refuse("--field-of-view-deg", "0");
  refuse("--field-of-view-deg", "160");
  refuse("--altitude-m", "high");
  refuse("--altitude-m", "");
  refuse("--exposure-ev", "1e6");
}

TEST_F(BadInputTest, WhatAModelCannotDo) {
  const auto sky = [&](const std::string& model, std::vector<std::string> more) {
    std::vector<std::string> arguments = {"sky", "--preset", "earth-clear", "--model", model};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  };
  expect_refusal(sky("nielsen", {"--sun-zenith-deg", "92", "--view-zenith-deg", "0"}),
                 {"nielsen model", "92", "twilight"});
  expect_refusal(sky("preetham",
                     {"--sun-zenith-deg", "30", "--view-zenith-deg", "170", "--altitude-m", "1e6"}),
                 {"preetham model", "altitude_m", "1000000"});
  expect_refusal(
      {"fit", "--reference", "cie:12", "--model", "nielsen", "--lobes", "2", "--out", "x"},
      {"fit.lobes = 2", "nielsen"});
  expect_refusal(
      {"fit", "--reference", "cie:12", "--model", "oneil", "--free", "ozone.column", "--out", "x"},
      {"ozone.column", "oneil"});
  for (const char* model : {"preetham", "hosek-wilkie"}) {
    expect_refusal(
        {"sky-map", "earth-clear", "--model", model, "--sun-zenith-deg", "40", "--out", "x.exr"},
        {"--ground", "filled", "expected black", model, "the sky alone"});
  }
  expect_refusal({"compare", "--reference", "model:reference", "--out", "x"}, {"--preset"});
  expect_refusal({"compare", "--reference", "cie:12", "--models", "nonsense", "--out", "x"},
                 {"nonsense", "expected one of"});
}

}  // namespace
}  // namespace skyfit::cli
