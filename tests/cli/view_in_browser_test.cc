// SPDX-License-Identifier: Apache-2.0
// The page of `skyfit view` in a browser, drawn in software: the pixels' luminances and spectral
// radiances are those of `skyfit sky`, sliders give the sky of a preset so changed, and the console
// stays silent. Skipped where there is no Chromium.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "data_refs/references.h"
#include "data_refs/spectra.h"
#include "model/atmosphere/parameters.h"
#include "model/atmosphere/preset.h"
#include "model/base/process.h"
#include "tests/cli/program.h"

namespace skyfit::cli {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kPage = 0.03;       // what docs/view.md promises of the preset
constexpr double kSliderEnd = 0.03;  // the same of a slider at its end

std::optional<std::filesystem::path> browser() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"}) {
    if (auto found = program_in_path(name)) return found;
  }
  return {};
}

class ViewInBrowser : public ProgramTest {
 protected:
  // What a script, the body of an asynchronous function, returns in the page.
  json evaluated(const std::string& page, const std::string& script,
                 const std::string& ready = "skyfit.ready") const {
    std::string html = read(page);
    html.insert(html.rfind("</body>"),
                "<script type=\"module\">\nconst result = document.createElement('pre');\n"
                "try {\n  await " +
                    ready +
                    ";\n  result.textContent = 'RESULT' + JSON.stringify("
                    "await (async () => {" +
                    script +
                    "})()) + 'END';\n"
                    "} catch (error) { result.textContent = String(error); }\n"
                    "document.body.append(result);\n</script>\n");
    const std::filesystem::path file = write("in_browser.html", html);
    const skyfit::Outcome shown = skyfit::run(
        {*browser(),
         {"--headless=new", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader",
          "--enable-unsafe-swiftshader", "--disable-dev-shm-usage", "--window-size=390,844",
          "--user-data-dir=" + (capture_ / "browser").string(), "--enable-logging=stderr",
          "--virtual-time-budget=30000", "--dump-dom", "file://" + file.string()},
         "",
         folder_});
    EXPECT_TRUE(shown.succeeded()) << shown.ending();
    EXPECT_THAT(shown.output, Not(HasSubstr("CONSOLE")));
    const std::size_t begin = shown.output.rfind("RESULT{"), end = shown.output.rfind("}END");
    if (begin == std::string::npos || end == std::string::npos || end < begin) {
      ADD_FAILURE() << "the page says nothing: "
                    << shown.output.substr(shown.output.size() -
                                           std::min<std::size_t>(shown.output.size(), 2000));
      return {};
    }
    return json::parse(shown.output.substr(begin + 6, end - begin - 5));
  }

  // altitude_m, sun zenith, view zenith, azimuth (deg), value: the rows of `skyfit sky`.
  std::vector<std::vector<double>> sky(const std::string& preset, const std::string& altitudes,
                                       const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"sky",
                                          "--preset",
                                          preset,
                                          "--sun-zenith-deg",
                                          "0,30,60,75,85,88",
                                          "--view-zenith-deg",
                                          "5,40,70,85,89",
                                          "--azimuth-deg",
                                          "0,60,180",
                                          "--altitude-m",
                                          altitudes};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome printed = run(arguments);
    EXPECT_EQ(printed.status, 0) << printed.err;
    std::vector<std::vector<double>> rows;
    for (const std::string& line : lines(printed.out)) {
      if (!std::isdigit(static_cast<unsigned char>(line.front()))) continue;
      std::vector<double>& row = rows.emplace_back();
      for (const std::string& field : fields(line)) row.push_back(std::stod(field));
    }
    return rows;
  }

  static std::string luminances_script(const std::vector<std::vector<double>>& rows,
                                       const json& parameters) {
    json asked = json::array();
    for (const auto& row : rows) {
      asked.push_back({{"altitudeM", row[0]},
                       {"sunZenithDeg", row[1]},
                       {"viewZenithDeg", row[2]},
                       {"azimuthDeg", row[3]},
                       {"parameters", parameters}});
    }
    return "return {luminances: " + asked.dump() +
           ".map((at) => skyfit.light(at).luminance_cd_m2)};";
  }

  void expect_luminances(const std::vector<std::vector<double>>& rows, const json& luminances,
                         double tolerance) const {
    ASSERT_EQ(luminances.size(), rows.size());
    double worst = 0;
    std::string where;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double error = luminances[i].get<double>() / rows[i][4] - 1;
      if (std::abs(error) < std::abs(worst)) continue;
      worst = error;
      where = fmt::format("{} m, sun {}, view {}, azimuth {} deg", rows[i][0], rows[i][1],
                          rows[i][2], rows[i][3]);
    }
    std::printf("[ worst  ] %.2f %% of %zu skies at %s\n", 100 * worst, rows.size(), where.c_str());
    EXPECT_LT(std::abs(worst), tolerance) << where;
  }
};

TEST_F(ViewInBrowser, PixelsAreTheSky) {
  if (!browser()) GTEST_SKIP() << "needs chromium in PATH";
  ASSERT_EQ(
      run({"view", "earth-clear", "--parameters", "ozone.column", "--out", "sky.html"}).status, 0);
  const auto rows = sky("earth-clear", "0,2000,10000");
  const json result = evaluated("sky.html", luminances_script(rows, json::object()));
  ASSERT_TRUE(result.contains("luminances"));
  expect_luminances(rows, result["luminances"], kPage);
}

TEST_F(ViewInBrowser, SpectralRadiancesAreTheSky) {
  if (!browser()) GTEST_SKIP() << "needs chromium in PATH";
  ASSERT_EQ(
      run({"view", "earth-clear", "--parameters", "ozone.column", "--out", "sky.html"}).status, 0);
  const json light = evaluated("sky.html",
                               "return skyfit.light({sunZenithDeg: 60, viewZenithDeg: 40, "
                               "azimuthDeg: 60});");
  ASSERT_EQ(light["spectral_radiance"].size(), 4);
  const Spectrum& sun = refs::standard_spectral_data().solar_irradiance;
  for (const json& at : light["spectral_radiance"]) {
    const double nm = at["wavelength_nm"];
    const Outcome printed =
        run({"sky", "--preset", "earth-clear", "--sun-zenith-deg", "60", "--view-zenith-deg", "40",
             "--azimuth-deg", "60", "--wavelength-nm", fmt::format("{}", nm)});
    const double expected = sun.at(nm) * std::stod(fields(lines(printed.out).back()).back());
    EXPECT_NEAR(at["value"].get<double>() / expected, 1, kPage) << nm << " nm";
  }
}

TEST_F(ViewInBrowser, SlidersGiveTheSkyOfAChangedPreset) {
  if (!browser()) GTEST_SKIP() << "needs chromium in PATH";
  ASSERT_EQ(run({"view", "earth-clear", "--parameters", "mie.scattering,mie.phase.g1,ground.albedo",
                 "--out", "sky.html"})
                .status,
            0);
  const std::vector<std::pair<Parameter, double>> ends = {{Parameter::kMieScattering, 1.8e-4},
                                                          {Parameter::kMiePhaseG1, 0.75},
                                                          {Parameter::kGroundAlbedo, 0.3}};
  for (const auto& [parameter, value] : ends) {
    Preset preset = parse_preset(refs::shipped_preset_json("earth-clear"), "earth-clear");
    set_parameter(preset.atmosphere, parameter, value);
    write("changed.json", preset_to_json(preset));
    const auto rows = sky("./changed.json", "0");
    const json result = evaluated("sky.html", luminances_script(rows, {{parameter.name(), value}}));
    ASSERT_TRUE(result.contains("luminances"));
    std::printf("[ slider ] %s\n", parameter.name().c_str());
    expect_luminances(rows, result["luminances"], kSliderEnd);
  }
}

TEST_F(ViewInBrowser, AReportHasItsSkyBesideIt) {
  if (!browser()) GTEST_SKIP() << "needs chromium in PATH";
  ASSERT_EQ(run({"fit", "--reference", "cie:12", "--sun-zenith-deg", "40", "--lobes", "1",
                 "--starts", "1", "--out", "fitted"})
                .status,
            0);
  ASSERT_EQ(run({"report", "fitted", "--out", "report.html"}).status, 0);
  const json linked = evaluated(
      "report.html", "return {urls: [...document.links].map((link) => link.getAttribute('href'))};",
      "Promise.resolve()");
  EXPECT_EQ(linked["urls"], json({"./report-sky.html"}));
  const json sky =
      evaluated("report-sky.html", "return skyfit.light({sunZenithDeg: 40, viewZenithDeg: 20});");
  EXPECT_GT(sky["luminance_cd_m2"].get<double>(), 0);
}

TEST_F(ViewInBrowser, AFittedPresetHasItsParametersAsSliders) {
  if (!browser()) GTEST_SKIP() << "needs chromium in PATH";
  ASSERT_EQ(run({"fit", "--reference", "cie:12", "--sun-zenith-deg", "40", "--lobes", "1",
                 "--starts", "1", "--out", "fitted"})
                .status,
            0);
  ASSERT_EQ(run({"view", "fitted/preset.json", "--out", "sky.html"}).status, 0);
  const json shown = evaluated(
      "sky.html",
      "return {names: [...document.querySelectorAll('#sliders code')].map("
      "(code) => code.textContent), words: document.getElementById('sliders').textContent};");
  const json record = json::parse(read("fitted/preset.json"))["fit"]["covariance"]["parameters"];
  EXPECT_EQ(shown["names"], record);
  EXPECT_THAT(shown["words"].get<std::string>(), HasSubstr("one sigma"));
}

}  // namespace
}  // namespace skyfit::cli
