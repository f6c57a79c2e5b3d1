// SPDX-License-Identifier: Apache-2.0
// `skyfit fit` of spectral scans leaves its files and figures and says how far off it is; plot
// draws from them, classify names a standard sky, and bad options are refused in one line.
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "data_refs/spectra.h"
#include "tests/cli/program.h"

namespace skyfit::cli {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class MeasuredTest : public ProgramTest {
 protected:
  // A scan of a preset's own sky in the layout of spectral scans, absolute and turned by 8 deg; a
  // few directions and wavelengths.
  void write_scan(const std::string& name, double sun_zenith_deg) {
    const std::string views = "15,45,75", wavelengths = "440,480,520,560,600,640,670";
    const Outcome sky = run({"sky", "--preset", "earth-clear", "--sun-zenith-deg",
                             fmt_number(sun_zenith_deg), "--view-zenith-deg", views,
                             "--azimuth-deg", "8:308:60", "--wavelength-nm", wavelengths});
    EXPECT_EQ(sky.status, 0) << sky.err;
    std::string text = "# sun_zenith_deg=" + fmt_number(sun_zenith_deg) +
                       " sun_azimuth_deg=180\n# radiance_<nm> in W m^-2 sr^-1 nm^-1\n"
                       "sample,view_azimuth_deg,view_zenith_deg";
    // altitude, sun zenith, view zenith, azimuth, wavelength, radiance per irradiance
    std::map<std::pair<double, double>, std::map<double, double>> spectra;
    const std::vector<std::string> rows = lines(sky.out);
    for (std::size_t r = 1; r < rows.size(); ++r) {
      const std::vector<std::string> row = fields(rows[r]);
      spectra[{std::stod(row[2]), std::stod(row[3])}][std::stod(row[4])] = std::stod(row[5]);
    }
    for (const auto& [nm, ignored] : spectra.begin()->second) text += ",radiance_" + fmt_number(nm);
    const Spectrum& sun = refs::standard_spectral_data().solar_irradiance;
    int sample = 0;
    for (const auto& [look, spectrum] : spectra) {
      text += "\n" + std::to_string(sample++) + "," +
              fmt_number(std::fmod(look.second - 8 + 180, 360)) + "," + fmt_number(look.first);
      for (const auto& [nm, radiance] : spectrum) text += "," + fmt_number(sun.at(nm) * radiance);
    }
    write(name, text + "\n");
  }

  static std::string fmt_number(double value) {
    std::ostringstream out;
    out.precision(10);
    out << value;
    return out.str();
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
};

TEST_F(MeasuredTest, JointFitLeavesReportsAndFigures) {
  write_scan("a.csv", 40);
  write_scan("b.csv", 60);
  const Outcome fit = run({"fit",
                           "--reference",
                           "a.csv,b.csv",
                           "--free",
                           "mie.scattering,ground.albedo",
                           "--preset",
                           "earth-clear",
                           "--scale",
                           "shared",
                           "--prior",
                           "instrument.scale=1:0.2",
                           "--starts",
                           "1",
                           "--hold-out",
                           "scans",
                           "--bootstrap",
                           "2",
                           "--profile",
                           "mie.scattering",
                           "--out",
                           "fitted"});
  ASSERT_EQ(fit.status, 0) << fit.err;
  EXPECT_THAT(fit.out, HasSubstr("luminance error"));
  const json report = json::parse(read("fitted/report.json"));
  EXPECT_LT(report["luminance_error_percent"], 1);
  EXPECT_EQ(report["scan_results"].size(), 2u);
  EXPECT_NEAR(report["scan_results"][0]["instrument.azimuth_offset"], 8, 0.5);
  EXPECT_EQ(report["checks"]["hold_outs"].size(), 2u);
  EXPECT_EQ(report["checks"]["profiles"].size(), 1u);
  for (const char* file : {"maps.png", "spectra.svg", "residuals.png", "corner.png", "samples.csv",
                           "preset.json", "report.txt"})
    EXPECT_TRUE(exists(std::string("fitted/") + file)) << file;
  EXPECT_EQ(run({"check", "fitted/preset.json"}).status, 0);
  EXPECT_EQ(run({"plot", "fitted", "--figure", "spectra", "--scan", "2", "--out", "s.png"}).status,
            0);
  const Outcome text = run({"report", "fitted"}), again = run({"report", "fitted", "--json"});
  EXPECT_EQ(text.out, read("fitted/report.txt")) << text.err;
  EXPECT_EQ(again.out, read("fitted/report.json")) << again.err;
  const Outcome evaluated =
      run({"fit", "--reference", "a.csv", "--preset", "fitted/preset.json", "--free", "none",
           "--pointing", "azimuth", "--out", "evaluated", "--json"});
  ASSERT_EQ(evaluated.status, 0) << evaluated.err;
  EXPECT_EQ(json::parse(evaluated.out)["unknowns"].size(), 1u);
}

// From the command line to the samples, the report and the figure of irradiances.
TEST_F(MeasuredTest, IrradiancesAreFitted) {
  const Outcome fit = run({"fit", "--irradiance", "direct=96klx,diffuse=14klx", "--sun-zenith-deg",
                           "32", "--scalar", "--out", "fitted", "--json"});
  ASSERT_EQ(fit.status, 0) << fit.err;
  const json report = json::parse(fit.out);
  EXPECT_EQ(report["reference"]["quantity"], "illuminance_lx");
  ASSERT_EQ(report["unknowns"].size(), 2u);
  EXPECT_EQ(report["unknowns"][0]["name"], "mie.optical_depth");
  for (const char* file : {"irradiances.png", "corner.png", "preset.json", "report.txt"})
    EXPECT_TRUE(exists(std::string("fitted/") + file)) << file;
  EXPECT_FALSE(exists("fitted/maps.png") || exists("fitted/residuals.png"));
  EXPECT_THAT(read("fitted/samples.csv"), HasSubstr(",diffuse_horizontal\n"));
  EXPECT_EQ(run({"report", "fitted"}).out, read("fitted/report.txt"));
  EXPECT_EQ(run({"plot", "fitted", "--out", "i.png"}).status, 0);
  EXPECT_THAT(run({"plot", "fitted", "--figure", "maps", "--out", "m.png"}).err,
              HasSubstr("irradiances have no directions"));
}

// A scan and the illuminances of one preset: both are within the report, and give back the preset.
TEST_F(MeasuredTest, IrradiancesBesideASkyAreFittedWithIt) {
  write_scan("a.csv", 40);
  const std::vector<std::string> light = fields(
      lines(run({"sky", "--preset", "earth-clear", "--sun-zenith-deg", "40", "--irradiance"}).out)
          .at(1));
  const std::string both = "direct=" + light[2] + "lx,diffuse=" + light[4] + "lx";
  const auto fit = [&](const std::string& sun) {
    return run({"fit", "--reference", "a.csv", "--irradiance", both, "--sun-zenith-deg", sun,
                "--preset", "earth-clear", "--free", "mie.scattering,ground.albedo", "--scale",
                "shared", "--starts", "1", "--out", "both", "--json"});
  };
  const Outcome outcome = fit("40");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const json report = json::parse(outcome.out);
  EXPECT_EQ(report["reference"]["irradiance_quantity"], "illuminance_lx");
  for (const char* kind : {"direct_normal", "diffuse_horizontal"})
    EXPECT_LT(report["irradiances"][kind]["rms_percent"].get<double>(), 0.1) << kind;
  const json& scale = report["unknowns"].back();
  EXPECT_EQ(scale["name"], "instrument.scale");
  EXPECT_NEAR(scale["fitted"].get<double>(), 1, 1e-3);
  for (const char* file : {"irradiances.png", "maps.png", "spectra.png"})
    EXPECT_TRUE(exists(std::string("both/") + file)) << file;
  EXPECT_EQ(run({"report", "both"}).out, read("both/report.txt"));
  EXPECT_EQ(run({"plot", "both", "--figure", "irradiances", "--out", "i.png"}).status, 0);
  EXPECT_THAT(fit("42").err, HasSubstr("expected within 1 deg of a scan"));
}

TEST_F(MeasuredTest, ClassifyNamesTheType) {
  const Outcome found =
      run({"classify", "--reference", "cie:9", "--sun-zenith-deg", "40", "--json"});
  ASSERT_EQ(found.status, 0) << found.err;
  EXPECT_EQ(json::parse(found.out)["nearest_type"], 9);
}

// The figures are not the result.
TEST_F(MeasuredTest, AFigureThatCannotBeDrawnDoesNotLoseTheFit) {
  write_scan("a.csv", 40);
  const Outcome outcome = run({"fit", "--reference", "a.csv", "--free", "none", "--out", "kept"},
                              {"SKYFIT_GNUPLOT=/bin/false"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, HasSubstr("the result is complete but for figures"));
  EXPECT_THAT(outcome.err,
              HasSubstr("maps (maps.svg: cannot be written: /bin/false: exit status 1"));
  EXPECT_TRUE(exists("kept/preset.json") && exists("kept/samples.csv"));
  EXPECT_FALSE(exists("kept/maps.png"));
}

// Every wavelength of an almucantar has its own sun; a scan of one wavelength has figures. The
// example was made without polarisation.
TEST_F(MeasuredTest, AlmucantarsAreFitted) {
  const Outcome outcome =
      run({"fit", "--reference", std::string(SKYFIT_EXAMPLES) + "aeronet_almucantar.csv",
           "--preset", "earth-clear", "--free", "mie.scattering", "--starts", "1", "--out",
           "almucantar", "--json", "--scalar"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json report = json::parse(outcome.out);
  EXPECT_LT(report["spectral_error_percent"].get<double>(), 0.01);  // five digits
  EXPECT_EQ(report["samples_not_used"]["missing"], 6);
  EXPECT_TRUE(exists("almucantar/spectra.png"));
}

TEST_F(MeasuredTest, BadOptionsAreRefusedInOneLine) {
  write_scan("a.csv", 40);
  const auto refused = [&](std::vector<std::string> more, const std::string& message) {
    std::vector<std::string> arguments = {"fit", "--reference", "a.csv", "--out", "never"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(arguments);
    EXPECT_NE(outcome.status, 0);
    EXPECT_THAT(outcome.err, HasSubstr(message));
    EXPECT_EQ(lines(outcome.err).size(), 1u) << outcome.err;
    EXPECT_FALSE(exists("never"));
  };
  refused({"--scale", "loose"},
          "--scale \"loose\": expected one of fixed, shared, per-scan, profiled");
  refused({"--noise", "-1"}, "--noise \"-1\": expected RELATIVE[:FLOOR]");
  refused({"--hold-out", "1"}, "--hold-out \"1\": expected scans, or into how many parts");
  refused({"--ground", "lawn"}, "ground \"lawn\": no such file");
  refused({"--per-scan", "ozone.column"}, "fit.per_scan: ozone.column: must be a free parameter");
  refused({"--profile", "nothing"}, "fit: nothing: not an unknown of this fit");
  refused({"--link", "cubic"}, "--link \"cubic\": expected one of log, linear");
  const Outcome relative =
      run({"fit", "--reference", "cie:12", "--scale", "shared", "--out", "never"});
  EXPECT_THAT(relative.err,
              HasSubstr("fit.scale = shared: must be profiled for a relative luminance (cie:12)"));
}

}  // namespace
}  // namespace skyfit::cli
