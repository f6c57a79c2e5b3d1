// SPDX-License-Identifier: Apache-2.0
// Every command does what its help says, and what one command writes another reads.
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "model/version.h"
#include "tests/cli/program.h"

namespace skyfit::cli {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

class CommandsTest : public ProgramTest {};

TEST_F(CommandsTest, EveryCommandHasHelpWithAnExample) {
  const Outcome unknown = run({"nonsense"});
  EXPECT_EQ(unknown.status, 2);
  const std::string known = unknown.err.substr(unknown.err.find("one of ") + 7);
  std::istringstream list(known);
  int count = 0;
  for (std::string command; std::getline(list >> std::ws, command, ','); ++count) {
    if (command.ends_with('\n')) command.pop_back();
    if (command == "doctor") continue;  // takes nothing
    EXPECT_THAT(output({command, "--help"}), HasSubstr(std::string("skyfit ") + command + " "))
        << command;
    EXPECT_THAT(output({command, "--help"}), HasSubstr("Example")) << command;
    EXPECT_THAT(output({"--help"}), HasSubstr(command));
  }
  EXPECT_GE(count, 16);
}

TEST_F(CommandsTest, CompletionKnowsCommandsAndOptions) {
  for (const char* shell : {"bash", "zsh", "fish"}) {
    const std::string script = output({"completion", shell});
    for (const char* word : {"sky-map", "export", "primaries", "sun-zenith-deg"})
      EXPECT_THAT(script, HasSubstr(word)) << shell;
  }
}

TEST_F(CommandsTest, ManualPagesNameCommandsAndOptions) {
  output({"man", "--out-dir", "man"});
  const std::string all = read("man/skyfit.1");
  for (const char* command : {"fit", "sky", "sky\\-map", "render", "campaign"})
    EXPECT_THAT(all, HasSubstr(std::string(".BR skyfit\\-") + command + " (1)\n"));
  const std::string fit = read("man/skyfit-fit.1");
  EXPECT_THAT(fit, HasSubstr(".TH skyfit-fit 1"));
  EXPECT_THAT(fit, HasSubstr(".B \\-\\-lobes INT\nLobes of the aerosol's phase function"));
  EXPECT_THAT(fit, HasSubstr("Examples:\n  skyfit fit \\-\\-reference cie:12"));
  EXPECT_EQ(output({"man", "fit"}), fit);
  const Outcome unknown = run({"man", "fitt"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.err, HasSubstr("expected one of fit, "));
}

TEST_F(CommandsTest, TablesAreWrittenWithTheirShadersAndParameters) {
  const std::string said = output({"tables", "earth-clear", "--size", "tiny", "--format", "ktx2",
                                   "--primaries", "rec2020", "--out", "sky"});
  EXPECT_THAT(said, HasSubstr("sky/rayleigh_like.ktx2: 256 x 32 x 16, half\n"));
  EXPECT_THAT(said, HasSubstr("suns 0 to 88 deg: "));
  EXPECT_THAT(files(),
              UnorderedElementsAre("sky", "sky/optical_depth.ktx2", "sky/irradiance.ktx2",
                                   "sky/rayleigh_like.ktx2", "sky/single.ktx2", "sky/phase.ktx2",
                                   "sky/tables.json", "sky/sky.glsl", "sky/sky.hlsl"));
  const json parameters = json::parse(read("sky/tables.json"));
  EXPECT_EQ(parameters["primaries"], "rec2020");
  EXPECT_EQ(parameters["tables"][2]["file"], "rayleigh_like.ktx2");
  EXPECT_THAT(read("sky/sky.glsl"), HasSubstr("linear, Rec. 2020"));
  output({"tables", "earth-clear", "--size", "tiny", "--format", "npy", "--out", "sky"});
  EXPECT_THAT(files(), ::testing::SizeIs(9)) << "one result in the place of the other";
  expect_refusal({"tables", "earth-clear"}, {"--out", "expected a directory, or --measure alone"});
  expect_refusal({"tables", "earth-clear", "--out", "x", "--format", "tga"},
                 {"--format \"tga\": expected one of exr, dds, npy, ktx2"});
  expect_refusal({"tables", "earth-clear", "--out", "x", "--precision", "8bit"},
                 {"--precision \"8bit\": expected float or half"});
}

TEST_F(CommandsTest, SkyMapIsWrittenWithItsSun) {
  EXPECT_THAT(output({"sky-map", "earth-clear", "--sun-zenith-deg", "40", "--size", "16", "--out",
                      "sky.hdr", "--sun-file", "sun.json"}),
              HasSubstr("diffuse horizontal: "));
  EXPECT_THAT(files(), UnorderedElementsAre("sky.hdr", "sun.json"));
  EXPECT_NEAR(json::parse(read("sun.json"))["zenith_deg"].get<double>(), 40, 1e-9);
  const std::string two = output({"sky-map", "earth-clear", "--sun-zenith-deg", "40", "--size",
                                  "16", "--wavelength-nm", "450,700", "--out", "two.npy"});
  for (const char* wavelength : {"irradiance at 450nm, diffuse", "irradiance at 700nm, diffuse"})
    EXPECT_THAT(two, HasSubstr(wavelength));
  const Outcome no_layers =
      run({"sky-map", "earth-clear", "--sun-zenith-deg", "40", "--stokes", "--out", "sky.hdr"});
  EXPECT_EQ(no_layers.status, 2);
  EXPECT_THAT(no_layers.err, HasSubstr("expected with an .exr or .npy file"));
  expect_refusal({"sky-map", "earth-clear", "--sun-zenith-deg", "40", "--wavelength-nm", "450",
                  "--out", "sky.ktx2"},
                 {"--wavelength-nm \"450\": expected with an .exr or .npy file"});
  const Outcome wrong = run({"sky-map", "earth-clear", "--sun-zenith-deg", "40", "--projection",
                             "mercator", "--out", "sky.exr"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("equirectangular, fisheye"));
}

TEST_F(CommandsTest, ExportIsReadBack) {
  output({"export", "hillaire-2020", "--to", "bruneton", "--out", "sky.json"});
  output({"import", "sky.json", "--out", "back.json"});
  EXPECT_THAT(output({"check", "back.json"}), HasSubstr("valid preset"));
  const Outcome taken = run({"check", "sky.json"});
  EXPECT_EQ(taken.status, 1);
  EXPECT_THAT(taken.err, HasSubstr("`skyfit import` reads it"));
}

// Their sky is drawn from the samples: the name of both is that of no formula.
TEST_F(CommandsTest, AnAllWeatherSkyIsFittedAloneAndBesideAnother) {
  for (const auto& [reference, name] :
       {std::pair{"perez:4,0.15", "perez:4,0.15"},
        std::pair{"perez:4,0.15,cie:12", "perez:4,0.15 and 1 more"}}) {
    output({"fit", "--reference", reference, "--sun-zenith-deg", "40", "--free", "none", "--model",
            "hoffman-preetham", "--out", "all-weather"});
    const json report = json::parse(read("all-weather/report.json"));
    EXPECT_EQ(report.at("reference").at("name"), name);
    EXPECT_THAT(files(), ::testing::Contains("all-weather/comparison.svg"));
  }
}

// Monte Carlo of unpolarised light is compared with scalar transfer without being asked to.
TEST_F(CommandsTest, ModelsFitWhatTheyHave) {
  output({"fit", "--reference", "cie:12", "--model", "nielsen", "--sun-zenith-deg", "20,50",
          "--out", "fitted"});
  const json report = json::parse(read("fitted/report.json"));
  EXPECT_FALSE(report.at("unknowns").empty());
  for (const json& unknown : report.at("unknowns")) {
    const std::string name = unknown.at("name");
    EXPECT_NE(name, "rayleigh.scale_height");
    EXPECT_NE(name, "mie.single_scattering_albedo");
  }
}

TEST_F(CommandsTest, AllStandardSkiesAreFittedIntoOneTableAndOneFigure) {
  const std::vector<std::string> fit = {
      "fit",   "--reference", "cie:all", "--model",          "nielsen", "--out",
      "skies", "--starts",    "1",       "--sun-zenith-deg", "20,50"};
  const std::string text = output(fit);
  EXPECT_THAT(text, HasSubstr("of the 15 standard skies within 10 %"));
  EXPECT_EQ(read("skies/standard_skies.txt"), text);
  EXPECT_THAT(files(),
              ::testing::IsSupersetOf({"skies/standard_skies.svg", "skies/standard_skies.png",
                                       "skies/cie-1.json", "skies/cie-15.json"}));
  EXPECT_THAT(output({"check", "skies/cie-12.json"}), HasSubstr("valid preset"));
  const std::vector<std::string> rows = lines(read("skies/standard_skies.csv"));
  ASSERT_EQ(rows.size(), 16u);
  EXPECT_THAT(rows[0], ::testing::StartsWith("type,fitted_with,rms_log_percent,"
                                             "rms_log_percent_sun_20,rms_log_percent_sun_50,"));
  for (std::size_t row = 1; row < rows.size(); ++row)
    EXPECT_EQ(std::ranges::count(rows[row], ','), std::ranges::count(rows[0], ',')) << rows[row];
  const json skies = json::parse(read("skies/standard_skies.json"));
  ASSERT_EQ(skies.size(), 15u);
  // The sentences follow the numbers.
  const std::size_t cannot = text.find("It cannot be:");
  for (const json& sky : skies) {
    const std::size_t at = text.find("  CIE S 011 type " + sky.at("type").dump() + ":");
    EXPECT_EQ(at < cannot, sky.at("rms_log_percent_fitted").at("all").get<double>() <= 10)
        << sky.at("type");
  }
  std::vector<std::string> with_profile = fit;
  with_profile.insert(with_profile.end(), {"--force", "--profile", "ground.albedo"});
  const Outcome refused = run(with_profile);
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("expected one sky, such as cie:12, with --profile"));
}

TEST_F(CommandsTest, VersionIsTheProjects) {
  EXPECT_EQ(output({"--version"}), std::string("skyfit ") + kVersion + "\n");
}

TEST_F(CommandsTest, PresetsPrintWhatCheckAccepts) {
  const json names = json::parse(output({"presets", "--json"}));
  EXPECT_GE(names.size(), 4u);
  EXPECT_EQ(lines(output({"presets"})).size(), names.size());
  for (const std::string name : names) {
    write("preset.json", output({"presets", name}));
    EXPECT_EQ(json::parse(output({"check", "--json", "preset.json"})).at("name"), name);
  }
  EXPECT_THAT(output({"check", "earth-clear"}), HasSubstr("valid preset \"earth-clear\""));
}

TEST_F(CommandsTest, SkyTakesTablesBesideThePresetAndASitePressure) {
  auto preset = json::parse(output({"presets", "earth-clear"}));
  preset["mie"]["phase"] = {{"type", "tabulated"}, {"csv", "phase.csv"}};
  std::filesystem::create_directory(folder_ / "mine");
  write("mine/phase.csv", "# isotropic\nscattering_angle_deg,phase_per_sr\n0,0.08\n180,0.08\n");
  write("mine/preset.json", preset.dump());
  const auto zenith = [&](const std::string& pressure) {
    const auto out = lines(output({"sky", "--preset", "mine/preset.json", "--sun-zenith-deg", "60",
                                   "--view-zenith-deg", "0", "--site-pressure-hpa", pressure}));
    return std::stod(fields(out.at(1)).back());
  };
  EXPECT_GT(zenith("1013.25"), 1.1 * zenith("600"));
}

TEST_F(CommandsTest, ReferencesPrintWhatCheckAccepts) {
  const json list = json::parse(output({"references", "--json"}));
  EXPECT_EQ(list.size(), 23u);
  write("sky.csv",
        output({"references", "cie:12", "--sampling", "tregenza", "--sun-zenith-deg", "0:80:10"}));
  const json summary = json::parse(output({"check", "--json", "sky.csv"}));
  EXPECT_EQ(summary.at("samples"), 9 * 145);
  EXPECT_EQ(summary.at("scans"), 9);
  EXPECT_EQ(summary.at("quantity"), "relative luminance");
  EXPECT_THAT(summary.at("sun_zenith_deg"), ElementsAre(0, 80));

  // Read back and printed again it is the same, but for azimuths, which come back between -180 and
  // 180.
  const auto first = lines(read("sky.csv")), second = lines(output({"references", "sky.csv"}));
  ASSERT_EQ(first.size(), second.size());
  EXPECT_EQ(first[1], second[1]);
  for (std::size_t i = 2; i < first.size(); ++i) {
    auto a = fields(first[i]), b = fields(second[i]);
    EXPECT_NEAR(std::remainder(std::stod(a[2]) - std::stod(b[2]), 360), 0, 1e-6);
    a[2] = b[2];
    EXPECT_EQ(a, b);
  }
}

// A file of samples has its own directions: options that would choose them are not passed over in
// silence.
TEST_F(CommandsTest, UnusedSamplingIsSaid) {
  write("sky.csv", output({"references", "cie:12", "--sun-zenith-deg", "40"}));
  const Outcome outcome = run({"references", "sky.csv", "--sampling", "tregenza"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err,
            "skyfit: warning: --sampling is not used: sky.csv has its own directions\n");
}

TEST_F(CommandsTest, SkyPrintsEveryCombinationWithTheAnglesAsGiven) {
  const auto rows = lines(output({"sky", "--preset", "earth-clear", "--sun-zenith-deg", "30,60",
                                  "--view-zenith-deg", "0:80:40", "--azimuth-deg", "-90,0,270",
                                  "--altitude-m", "0,1000", "--wavelength-nm", "450,550.5"}));
  ASSERT_EQ(rows.size(), 1u + 2 * 3 * 3 * 2 * 2);
  EXPECT_EQ(rows[0],
            "altitude_m,sun_zenith_deg,view_zenith_deg,relative_azimuth_deg,wavelength_nm,radiance_"
            "per_irradiance_sr");
  std::set<std::vector<std::string>> combinations;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    auto row = fields(rows[i]);
    ASSERT_EQ(row.size(), 6u);
    EXPECT_GT(std::stod(row[5]), 0);
    row.pop_back();
    combinations.insert(row);
  }
  EXPECT_EQ(combinations.size(), rows.size() - 1);
  EXPECT_TRUE(combinations.contains({"1000", "60", "40", "-90", "550.5"}));
}

// Luminance is the default; azimuth -90 mirrors 270, and both are the same direction.
TEST_F(CommandsTest, SkyPrintsLuminanceByDefault) {
  const std::vector<std::string> arguments = {
      "sky", "--preset",      "earth-clear", "--sun-zenith-deg", "30", "--view-zenith-deg",
      "45",  "--azimuth-deg", "-90,270,90"};
  const auto rows = lines(output(arguments));
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0],
            "altitude_m,sun_zenith_deg,view_zenith_deg,relative_azimuth_deg,luminance_cd_m2");
  const double luminance = std::stod(fields(rows[1])[4]);
  constexpr double kRounding = 1e-6;  // nine digits, and cosines of 270 degrees
  EXPECT_NEAR(std::stod(fields(rows[2])[4]) / luminance, 1, kRounding);
  EXPECT_NEAR(std::stod(fields(rows[3])[4]) / luminance, 1, kRounding);
  auto explicit_arguments = arguments;
  explicit_arguments.emplace_back("--luminance");
  EXPECT_EQ(lines(output(explicit_arguments)), rows);
}

// global = direct + diffuse; direct horizontal = direct normal * cos(sun zenith).
TEST_F(CommandsTest, SkyPrintsIrradiance) {
  for (const bool spectral : {false, true}) {
    std::vector<std::string> arguments = {"sky", "--preset",    "earth-clear", "--sun-zenith-deg",
                                          "60",  "--irradiance"};
    if (spectral) arguments.insert(arguments.end(), {"--wavelength-nm", "550"});
    const auto rows = lines(output(arguments));
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0],
              spectral
                  ? "altitude_m,sun_zenith_deg,wavelength_nm,direct_normal_w_m2_nm,"
                    "direct_horizontal_w_m2_nm,diffuse_horizontal_w_m2_nm,global_horizontal_w_m2_nm"
                  : "altitude_m,sun_zenith_deg,direct_normal_lx,direct_horizontal_lx,"
                    "diffuse_horizontal_lx,global_horizontal_lx");
    const auto row = fields(rows[1]);
    const std::size_t first = spectral ? 3 : 2;
    const double normal = std::stod(row[first]), direct = std::stod(row[first + 1]);
    const double diffuse = std::stod(row[first + 2]), global = std::stod(row[first + 3]);
    constexpr double kNineDigits = 1e-8;
    EXPECT_NEAR(direct / normal, 0.5, kNineDigits);
    EXPECT_NEAR((direct + diffuse) / global, 1, kNineDigits);
    EXPECT_GT(diffuse, 0);
  }
}

TEST_F(CommandsTest, FitLeavesItsFilesAndNothingElse) {
  const std::vector<std::string> fit = {"fit",   "--reference", "cie:12",  "--sun-zenith-deg",
                                        "20,60", "--lobes",     "1",       "--starts",
                                        "1",     "--out",       "a/fitted"};
  EXPECT_THAT(output(fit), HasSubstr("cie:12"));
  EXPECT_THAT(files(),
              UnorderedElementsAre("a", "a/fitted", "a/fitted/preset.json", "a/fitted/report.json",
                                   "a/fitted/report.txt", "a/fitted/samples.csv",
                                   "a/fitted/comparison.svg", "a/fitted/comparison.png"));
  EXPECT_THAT(output({"check", "a/fitted/preset.json"}), HasSubstr("result of a fit"));
  const json report = json::parse(read("a/fitted/report.json"));
  EXPECT_GT(report.at("rms_log_percent"), 0.0);
  EXPECT_LT(report.at("rms_log_percent"), 30.0);  // the baseline preset, not fitted, has 25
  EXPECT_FALSE(report.at("unknowns").empty());

  output(fit);  // an earlier result may be replaced
  EXPECT_EQ(files().size(), 8u);
  output({"plot", "a/fitted", "--out", "figure.svg", "--out", "figure.pdf"});
  EXPECT_THAT(read("figure.svg"), HasSubstr("<svg"));
  EXPECT_THAT(read("figure.pdf"), ::testing::StartsWith("%PDF"));
  output({"plot", "a/fitted", "--style", "paper", "--width-mm", "85", "--panels", "2", "--out",
          "page.svg"});
  EXPECT_THAT(read("page.svg"), HasSubstr("width=\"85mm\""));
  EXPECT_THAT(run({"plot", "a/fitted", "--panels", "3", "--out", "page.svg"}).err,
              HasSubstr("panel 3: expected one of 1 (sun zenith 20°), 2 (sun zenith 60°)"));
}

// RMS of the residuals of samples.csv, weighted, is the RMS of the report.
TEST_F(CommandsTest, SamplesGiveTheReportedRms) {
  output({"fit", "--reference", "cie:9", "--sun-zenith-deg", "30,50", "--lobes", "1", "--starts",
          "1", "--out", "fitted"});
  const auto rows = lines(read("fitted/samples.csv"));
  ASSERT_GT(rows.size(), 2u);
  double squares = 0, weights = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto row = fields(rows[i]);
    EXPECT_NEAR(std::log(std::stod(row[7]) / std::stod(row[5])), std::stod(row[8]), 1e-12);
    squares += std::stod(row[9]) * std::pow(std::stod(row[8]), 2);
    weights += std::stod(row[9]);
  }
  const double rms = json::parse(read("fitted/report.json")).at("rms_log_percent");
  EXPECT_NEAR(100 * std::sqrt(squares / weights), rms, 1e-6 * rms);
}

TEST_F(CommandsTest, FitPrintsItsReportAsJson) {
  const json report = json::parse(
      output({"fit", "--reference", "cie:12", "--sun-zenith-deg", "40", "--lobes", "1", "--starts",
              "1", "--fix", "ground.albedo=0.25", "--json", "--out", "fitted"}));
  EXPECT_EQ(report, json::parse(read("fitted/report.json")));
  const json preset = json::parse(read("fitted/preset.json"));
  EXPECT_EQ(preset.at("ground").at("albedo"), 0.25);
}

TEST_F(CommandsTest, RenderWritesPicturesOfTheGivenSize) {
  output({"render", "--preset", "earth-clear", "--view", "ground", "--sun-zenith-deg", "50",
          "--size", "64x36", "--samples-per-side", "1", "--out", "frame.png", "--out",
          "frame.exr"});
  EXPECT_THAT(files(), UnorderedElementsAre("frame.png", "frame.exr"));
  const std::string png = read("frame.png");
  ASSERT_GT(png.size(), 24u);
  EXPECT_EQ(png.substr(0, 4), "\x89PNG");
  EXPECT_EQ(png.substr(16, 8), std::string("\0\0\0\x40\0\0\0\x24", 8));  // IHDR: width, height
  EXPECT_EQ(read("frame.exr").substr(0, 4), "\x76\x2f\x31\x01");
}

}  // namespace
}  // namespace skyfit::cli
