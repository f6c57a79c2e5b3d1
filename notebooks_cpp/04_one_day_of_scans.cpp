// SPDX-License-Identifier: Apache-2.0
// %% [markdown]
// # One day of spectral scans
//
// An instrument measures the spectrum of the clear sky in 81 directions, four times on one day. Its
// compass was off, its readings are noisy, and the haze grew through the morning. This notebook
// makes such scans with an air that is known, writes them as files, and then walks the way of
// somebody who found the files: look at them, fit them together, ask how far the answer can be
// trusted.

// %%
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <fstream>
#include <iostream>
#include <numbers>
#include <random>
#include <sstream>
#include <stdexcept>

#include "cli/app.h"
#include "data_refs/ground_spectra.h"
#include "data_refs/references.h"
#include "data_refs/solar_position.h"
#include "data_refs/spectra.h"
#include "fit/classify.h"
#include "model/atmosphere/preset.h"
#include "model/registry.h"
#include "model/sky_model.h"
#include "notebooks_cpp/notebook.h"

using namespace skyfit;

constexpr double kDegree = std::numbers::pi / 180;

// Prints what was checked; a check that fails ends the notebook.
void check(bool holds, const std::string& what) {
  if (!holds) throw std::runtime_error("does not hold: " + what);
  std::cout << "holds: " << what << '\n';
}

// Runs the program as a shell would.
void skyfit_command(std::vector<std::string> words) {
  words.insert(words.begin(), "skyfit");
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  if (cli::run(static_cast<int>(arguments.size()), arguments.data()) != 0)
    throw std::runtime_error("skyfit failed");
}

nlohmann::json read_json(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return nlohmann::json::parse(stream);
}

// %% [markdown]
// ## The day
//
// Munich in June, four scans an hour apart. The truth: the shipped preset `earth-clear` over grass,
// whose aerosol grows from scan to scan; the instrument's azimuths are 8 degrees too small, and
// every reading is off by 2 %.

// %%
struct ScanOfDay {
  std::string name, local_time;
  double mie_scattering;  // 1/m at 550 nm
};
const std::array<ScanOfDay, 4> kDay = {{{"0800", "2024-06-01T08:00:00", 5.0e-5},
                                        {"0900", "2024-06-01T09:00:00", 6.0e-5},
                                        {"1000", "2024-06-01T10:00:00", 8.0e-5},
                                        {"1100", "2024-06-01T11:00:00", 9.0e-5}}};
constexpr double kLatitude = 48.15, kLongitude = 11.57, kOffsetDeg = 8, kNoise = 0.02;

struct Ring {
  double zenith_deg;
  int azimuths;
};
const std::array<Ring, 5> kRings = {{{78, 32}, {56, 24}, {37, 16}, {18, 8}, {0, 1}}};

Atmosphere<double> true_atmosphere(const ScanOfDay& scan) {
  Atmosphere<double> air =
      parse_preset(refs::shipped_preset_json("earth-clear"), "earth-clear").atmosphere;
  air.at("mie").amount = scan.mie_scattering;
  air.ground_spectrum = refs::ground_spectrum("grass");
  air.ground_albedo = 0.09;
  return air;
}

// A scan as the instrument's software would write it.
std::string scan_text(const SkyModel& model, const ScanOfDay& scan, std::mt19937& generator) {
  const SpectralData& spectra = refs::standard_spectral_data();
  const refs::SolarPosition sun = refs::solar_position(
      *refs::instant(scan.local_time, 2), {kLatitude * kDegree, kLongitude * kDegree, 0});
  std::vector<double> wavelengths;
  for (double nm = 400; nm <= 780; nm += 20) wavelengths.push_back(nm);
  std::vector<SkyPoint> points;
  std::vector<double> azimuth_deg;
  for (const Ring& ring : kRings) {
    for (int k = 0; k < ring.azimuths; ++k) {
      azimuth_deg.push_back(360.0 * k / ring.azimuths);
      points.push_back({0, sun.zenith, ring.zenith_deg * kDegree,
                        (azimuth_deg.back() + kOffsetDeg) * kDegree - sun.azimuth});
    }
  }
  const SkyValues sky =
      model.radiance(true_atmosphere(scan), spectral_nodes(spectra, wavelengths), points, {});
  std::normal_distribution<double> noise(1, kNoise);
  std::string text = fmt::format(
      "# local_time={} utc_offset_h=2 latitude_deg={} longitude_deg={}\n"
      "# radiance_<nm> in W m^-2 sr^-1 nm^-1\n"
      "sample,view_azimuth_deg,view_zenith_deg",
      scan.local_time, kLatitude, kLongitude);
  for (const double nm : wavelengths) text += fmt::format(",radiance_{}", nm);
  for (std::size_t i = 0; i < points.size(); ++i) {
    text += fmt::format("\n{},{:.6g},{:.6g}", i, azimuth_deg[i], points[i].view_zenith / kDegree);
    for (std::size_t w = 0; w < wavelengths.size(); ++w) {
      const double radiance = sky.at(static_cast<int>(i), static_cast<int>(w)) *
                              spectra.solar_irradiance.at(wavelengths[w]) /
                              (sun.distance_au * sun.distance_au);
      text += fmt::format(",{:.6g}", radiance * noise(generator));
    }
  }
  return text + "\n";
}

void run_notebook(notebook::Page& page) {
  // %%
  page.cell();
  const auto model = make_sky_model("reference", refs::standard_spectral_data(), 2);
  std::mt19937 generator(2024);
  std::string files;
  for (const ScanOfDay& scan : kDay) {
    const auto file = page.scratch(scan.name + ".csv");
    std::ofstream(file) << scan_text(*model, scan, generator);
    if (!files.empty()) files += ',';
    files += file.string();
    const refs::Reference read = refs::load_reference(file.string(), {}, refs::Sampling::kTregenza);
    std::cout << fmt::format("{}: {} samples, sun zenith {:.2f} deg at {}, {:.4f} au away\n",
                             scan.name, read.samples.size(),
                             read.samples.front().sun_zenith / kDegree, read.scans.front().time_utc,
                             read.scans.front().sun_distance_au);
  }

  // %% [markdown]
  // ## One fit of all four
  //
  // The aerosol's amount is free for every scan, everything else of the air is shared; every scan
  // has an azimuth offset of its own. The ground is grass of unknown brightness. The fit starts
  // from the preset of the truth; without it the air would be dry air of the site's pressure, with
  // the absorption of O2-O2 and nitrogen dioxide, which this truth has not. On the command line:
  //
  //     skyfit fit --reference 0800.csv,0900.csv,1000.csv,1100.csv
  //       --preset earth-clear --per-scan mie.scattering --ground grass --fix mie.scale_height=1200
  //       --out day

  // %%
  page.cell();
  const auto day = page.scratch("day");
  skyfit_command({"fit", "--reference", files, "--preset", "earth-clear", "--per-scan",
                  "mie.scattering", "--ground", "grass", "--fix", "mie.scale_height=1200",
                  "--noise", "0.02", "--hold-out", "5", "--out", day.string()});
  const nlohmann::json report = read_json(day / "report.json");
  std::cout << fmt::format(
      "luminance error {:.2f} %, spectral error {:.2f} %, chi^2 per degree of "
      "freedom {:.3f}\n\n",
      report["luminance_error_percent"].get<double>(),
      report["spectral_error_percent"].get<double>(), report["chi_square_per_dof"].get<double>());
  std::cout << fmt::format("{:<32}{:>12}{:>12}\n", "unknown", "fitted", "one sigma");
  for (const auto& row : report["unknowns"]) {
    std::cout << fmt::format(
        "{:<32}{:>12.4g}{:>12}\n", row["name"].get<std::string>(), row["fitted"].get<double>(),
        row["sigma"].is_null() ? "-" : fmt::format("{:.2g}", row["sigma"].get<double>()));
  }

  // %% [markdown]
  // The noise was stated, and it is all that is left: the errors are the 2 % of the readings, and
  // $\chi^2$ per degree of freedom is 1. The truth lies where the error bars say.

  // %%
  page.cell();
  const auto row_of = [&](const std::string& name) {
    for (const auto& row : report["unknowns"])
      if (row["name"] == name) return row;
    throw std::runtime_error("no unknown " + name);
  };
  check(std::abs(report["chi_square_per_dof"].get<double>() - 1) < 0.1, "chi^2 per freedom is 1");
  for (int scan = 1; scan <= 4; ++scan) {
    const auto row = row_of(fmt::format("instrument.azimuth_offset[{}]", scan));
    check(std::abs(row["fitted"].get<double>() - kOffsetDeg) < 4 * row["sigma"].get<double>(),
          fmt::format("azimuth offset of scan {} within 4 sigma of 8 deg", scan));
  }

  // %% [markdown]
  // ## Look at it
  //
  // Measured, model and their ratio, scan by scan. A ratio with a pattern would be physics that the
  // model lacks; here it is noise.

  // %%
  page.cell();
  page.figure(day / "maps.png");

  // %%
  page.cell();
  page.figure(day / "spectra.png");

  // %% [markdown]
  // The residuals have no trend in scattering angle, zenith angle or wavelength.

  // %%
  page.cell();
  page.figure(day / "residuals.png");

  // %% [markdown]
  // ## The day
  //
  // The haze grows; the compass stays where it was.

  // %%
  page.cell();
  page.figure(day / "series.png");
  check(row_of("mie.scattering[4]")["fitted"].get<double>() >
            1.4 * row_of("mie.scattering[1]")["fitted"].get<double>(),
        "the haze grew");

  // %% [markdown]
  // ## How sure, and of what
  //
  // The corner shows which unknowns the scans cannot tell apart.

  // %%
  page.cell();
  page.figure(day / "corner.png");

  // %% [markdown]
  // Directions that were left out of the fit, a fifth at a time, are predicted as well as the noise
  // allows: nothing was fitted that is not there.

  // %%
  page.cell();
  for (const auto& held : report["checks"]["hold_outs"]) {
    const double error = held["predicted"]["spectral_error_percent"];
    std::cout << fmt::format("{}: spectral error {:.2f} %\n", held["name"].get<std::string>(),
                             error);
    check(error < 3, "as the noise");
  }

  // %% [markdown]
  // ## Which standard sky is it?

  // %%
  page.cell();
  for (const ScanOfDay& scan : kDay) {
    const refs::Reference reference = refs::load_reference(
        page.scratch(scan.name + ".csv").string(), {}, refs::Sampling::kTregenza);
    fit::ClassifyOptions options;
    options.free_azimuth = true;
    const fit::Classification found =
        fit::classify(reference, refs::standard_spectral_data(), options);
    std::cout << fmt::format("{}: CIE type {}, {:.1f} % RMS; with free coefficients {:.1f} %\n",
                             scan.name, found.nearest().sky.type, found.nearest().rms_log_percent,
                             found.free.rms_log_percent);
  }
}
