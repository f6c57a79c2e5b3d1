// SPDX-License-Identifier: Apache-2.0
// `skyfit sky`: evaluates a model at every combination of the given altitudes, suns and views.
#include <fmt/format.h>

#include <iterator>
#include <memory>
#include <string>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/output.h"
#include "data_refs/spectra.h"
#include "model/sky_model.h"

namespace skyfit::cli {
namespace {

constexpr std::size_t kMaxRows = 20'000'000;  // some 3 GB of CSV

constexpr double kMaxAltitude = 1e12;  // metres, beyond any atmosphere

struct SkyOptions {
  std::string preset, site_pressure, model = "reference";
  std::string altitude = "0", sun_zenith, view_zenith, azimuth = "0", wavelength;
  bool luminance = false, irradiance = false;
  int threads = default_threads();
};

struct SkyGrid {
  std::vector<double> altitude_m, sun_zenith_deg, view_zenith_deg, azimuth_deg;
};

// What the values are evaluated at and multiplied by. In the spectral case there is one row per
// wavelength; otherwise one row that sums over the nodes with the rule's weights.
struct Wavelengths {
  std::vector<double> nm;  // empty: photometric
  LuminanceRule rule;      // spectral: the nodes, weights empty
};

SkyGrid parse_grid(const SkyOptions& options) {
  SkyGrid grid;
  grid.altitude_m = parse_list_within("--altitude-m", options.altitude, 0, kMaxAltitude,
                                      "a height above the ground in metres");
  grid.sun_zenith_deg =
      parse_list_within("--sun-zenith-deg", options.sun_zenith, 0, 180, "an angle in degrees");
  if (options.view_zenith.empty() && !options.irradiance) {
    throw UsageError("--view-zenith-deg", "", "expected a list of angles in degrees");
  }
  grid.view_zenith_deg = {0.0};
  if (!options.view_zenith.empty()) {
    grid.view_zenith_deg =
        parse_list_within("--view-zenith-deg", options.view_zenith, 0, 180, "an angle in degrees");
  }
  grid.azimuth_deg =
      parse_list_within("--azimuth-deg", options.azimuth, -360, 360, "an angle in degrees");
  return grid;
}

Wavelengths parse_wavelengths(const SkyOptions& options) {
  const SpectralData& data = refs::standard_spectral_data();
  if (options.wavelength.empty()) return {{}, luminance_rule(data)};
  if (options.luminance) throw UsageError("--luminance", "", "expected without --wavelength-nm");
  const auto& table = data.ozone_cross_section.wavelength_nm;
  Wavelengths wavelengths;
  wavelengths.nm = parse_list_within("--wavelength-nm", options.wavelength, table.front(),
                                     table.back(), "a wavelength in nm that the tables hold,");
  wavelengths.rule.nodes = spectral_nodes(data, wavelengths.nm);
  return wavelengths;
}

std::vector<SkyPoint> points_of(const SkyGrid& grid) {
  const std::size_t count = grid.altitude_m.size() * grid.sun_zenith_deg.size() *
                            grid.view_zenith_deg.size() * grid.azimuth_deg.size();
  if (count > kMaxRows) {
    throw std::invalid_argument(
        fmt::format("{} combinations of the lists: expected at most {}", count, kMaxRows));
  }
  std::vector<SkyPoint> points;
  points.reserve(count);
  for (const double altitude : grid.altitude_m) {
    for (const double sun : grid.sun_zenith_deg) {
      for (const double view : grid.view_zenith_deg) {
        for (const double azimuth : grid.azimuth_deg) {
          points.push_back({altitude, radians(sun), radians(view), radians(azimuth)});
        }
      }
    }
  }
  return points;
}

// Calls row(altitude, sun, view, azimuth) with the angles as the user gave them, in the order of
// points_of().
template <class Row>
void for_each_point(const SkyGrid& grid, const Row& row) {
  for (const double altitude : grid.altitude_m) {
    for (const double sun : grid.sun_zenith_deg) {
      for (const double view : grid.view_zenith_deg) {
        for (const double azimuth : grid.azimuth_deg) row(altitude, sun, view, azimuth);
      }
    }
  }
}

double weighted_sum(const std::vector<double>& weights, const double* values) {
  double sum = 0;
  for (std::size_t k = 0; k < weights.size(); ++k) sum += weights[k] * values[k];
  return sum;
}

void print_sky(const SkyModel& model, const Atmosphere<double>& atmosphere, const SkyGrid& grid,
               const Wavelengths& wavelengths) {
  const std::vector<SkyPoint> points = points_of(grid);
  const SkyValues sky = model.radiance(atmosphere, wavelengths.rule.nodes, points, {});
  print("altitude_m,sun_zenith_deg,view_zenith_deg,relative_azimuth_deg,");
  print(wavelengths.nm.empty() ? "luminance_cd_m2\n"
                               : "wavelength_nm,radiance_per_irradiance_sr\n");
  int point = 0;
  fmt::memory_buffer text;
  for_each_point(grid, [&](double altitude, double sun, double view, double azimuth) {
    text.clear();
    const auto out = std::back_inserter(text);
    const auto angles = fmt::format("{:.9g},{:.9g},{:.9g},{:.9g}", altitude, sun, view, azimuth);
    if (wavelengths.nm.empty()) {
      const double* const values =
          sky.value.data() + static_cast<std::ptrdiff_t>(point) * sky.wavelengths;
      fmt::format_to(out, "{},{:.9g}\n", angles, weighted_sum(wavelengths.rule.weight, values));
    }
    for (std::size_t k = 0; k < wavelengths.nm.size(); ++k) {
      fmt::format_to(out, "{},{:.9g},{:.9g}\n", angles, wavelengths.nm[k],
                     sky.at(point, static_cast<int>(k)));
    }
    print({text.data(), text.size()});
    ++point;
  });
}

void print_irradiance(const SkyModel& model, const Atmosphere<double>& atmosphere,
                      const SkyGrid& grid, const Wavelengths& wavelengths) {
  const bool spectral = !wavelengths.nm.empty();
  const std::string_view unit = spectral ? "w_m2_nm" : "lx";
  print(fmt::format(
      "altitude_m,sun_zenith_deg,{}direct_normal_{},direct_horizontal_{},diffuse_horizontal_{},"
      "global_horizontal_{}\n",
      spectral ? "wavelength_nm," : "", unit, unit, unit, unit));
  const Spectrum& solar = refs::standard_spectral_data().solar_irradiance;
  for (const double altitude : grid.altitude_m) {
    for (const double sun : grid.sun_zenith_deg) {
      const SkyIrradiance light =
          model.irradiance(atmosphere, wavelengths.rule.nodes, altitude, radians(sun));
      if (!spectral) {
        const auto sum = [&](const std::vector<double>& values) {
          return weighted_sum(wavelengths.rule.weight, values.data());
        };
        print(fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", altitude, sun,
                          sum(light.direct_normal), sum(light.direct_horizontal),
                          sum(light.diffuse_horizontal), sum(light.global_horizontal)));
      }
      for (std::size_t k = 0; k < wavelengths.nm.size(); ++k) {
        const double scale = solar.at(wavelengths.nm[k]);
        print(fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", altitude, sun,
                          wavelengths.nm[k], scale * light.direct_normal[k],
                          scale * light.direct_horizontal[k], scale * light.diffuse_horizontal[k],
                          scale * light.global_horizontal[k]));
      }
    }
  }
}

void run_sky(const SkyOptions& options) {
  const SkyGrid grid = parse_grid(options);
  const Wavelengths wavelengths = parse_wavelengths(options);
  Preset preset = preset_named(options.preset);
  if (const auto pressure = parse_site_pressure(options.site_pressure))
    preset.atmosphere.rayleigh.site_pressure_hpa = *pressure;
  const auto model = make_sky_model(options.model, options.threads);
  if (options.irradiance) {
    print_irradiance(*model, preset.atmosphere, grid, wavelengths);
  } else {
    print_sky(*model, preset.atmosphere, grid, wavelengths);
  }
}

void add_sky_options(CLI::App& command, SkyOptions& options) {
  command.add_option("--preset", options.preset, "Shipped preset or preset file")
      ->required()
      ->type_name("FILE|NAME");
  add_site_pressure_option(command, options.site_pressure);
  command.add_option("--model", options.model, "Sky model")
      ->type_name("NAME")
      ->capture_default_str();
  command.add_option("--sun-zenith-deg", options.sun_zenith, "Sun zenith angles, 0 to 180")
      ->required()
      ->type_name("LIST");
  command
      .add_option("--view-zenith-deg", options.view_zenith,
                  "View zenith angles, 0 to 180; over 90 looks down")
      ->type_name("LIST");
  command
      .add_option("--azimuth-deg", options.azimuth,
                  "View azimuths relative to the sun's, -360 to 360; 0 = toward it")
      ->type_name("LIST")
      ->capture_default_str();
  command.add_option("--altitude-m", options.altitude, "Heights of the observer above the ground")
      ->type_name("LIST")
      ->capture_default_str();
  command
      .add_option("--wavelength-nm", options.wavelength,
                  "Print radiance per unit solar irradiance (1/sr) at these wavelengths")
      ->type_name("LIST");
  auto* const luminance =
      command.add_flag("--luminance", options.luminance, "Print luminance in cd/m^2 (the default)");
  command
      .add_flag("--irradiance", options.irradiance,
                "Print direct, diffuse and global irradiance (no view directions): lx,\n"
                "or W m^-2 nm^-1 with --wavelength-nm")
      ->excludes(luminance);
  add_threads_option(command, options.threads);
}

}  // namespace

void add_sky_command(CLI::App& app) {
  const auto options = std::make_shared<SkyOptions>();
  CLI::App* const command = app.add_subcommand(
      "sky", "Evaluates a preset and prints CSV: luminance, radiance or irradiance.");
  add_sky_options(*command, *options);
  command->footer(
      "Prints every combination of the lists. A LIST is a,b,c or "
      "start:stop:step, stop included.\n"
      "Light is diffuse, that reflected by the ground included, the sun's "
      "disc not, the sun at 1 au.\n"
      "\n"
      "Examples:\n"
      "  skyfit sky --preset earth-clear --sun-zenith-deg 30 --view-zenith-deg 0:85:5 "
      "--azimuth-deg 0,180\n"
      "  skyfit sky --preset fitted/preset.json --sun-zenith-deg 0:80:10 --irradiance");
  command->callback([options] { run_sky(*options); });
}

}  // namespace skyfit::cli
