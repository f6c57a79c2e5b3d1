// SPDX-License-Identifier: Apache-2.0
// `skyfit sky`: evaluates a model at every combination of the given altitudes, suns and views.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <numbers>
#include <string>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/leave_netcdf.h"
#include "cli/light_check.h"
#include "cli/output.h"
#include "cli/sky_netcdf.h"
#include "cli/sky_options.h"
#include "cli/sky_table.h"
#include "cli/stokes_table.h"
#include "data_refs/spectra.h"
#include "model/atmosphere/derived.h"
#include "model/atmosphere/refraction.h"
#include "model/registry.h"
#include "model/sky_model.h"
#include "model/solver/reference_model.h"

namespace skyfit::cli {
namespace {

constexpr std::size_t kMaxRows = 20'000'000;  // some 3 GB of CSV

constexpr double kMaxAltitude = 1e12;  // metres, beyond any atmosphere

struct SkyGrid {
  std::vector<double> altitude_m, sun_zenith_deg, view_zenith_deg, azimuth_deg;
  std::vector<double> wavelength_nm;  // empty: luminances
  // Of suns that are stated as they are seen; at 550 nm.
  std::optional<Refraction> refraction;

  // Where the sun stands without air, radians.
  double true_sun_zenith(double altitude, double sun_deg) const {
    const double zenith = radians(sun_deg);
    if (!refraction) return zenith;
    return std::min(zenith + refraction->bending(refraction->refractive_height(altitude), zenith),
                    std::numbers::pi);
  }
  const char* sun_column() const { return refraction ? "apparent_sun_zenith" : "sun_zenith"; }

  // Of the observers, or of their directions.
  std::vector<GridAxis> axes(bool directions) const {
    std::vector<GridAxis> all = {
        {"altitude", "height of the observer above the ground", "m", altitude_m},
        {sun_column(),
         refraction ? "zenith angle of the sun as it is seen" : "zenith angle of the sun", "degree",
         sun_zenith_deg}};
    if (directions) {
      all.push_back(
          {"view_zenith", "zenith angle of the line of sight", "degree", view_zenith_deg});
      all.push_back({"relative_azimuth", "azimuth of the line of sight from the sun's", "degree",
                     azimuth_deg});
    }
    if (!wavelength_nm.empty())
      all.push_back({"wavelength", "wavelength in air", "nm", wavelength_nm});
    return all;
  }
};

SkyGrid parse_grid(const SkyOptions& options) {
  SkyGrid grid;
  grid.altitude_m = parse_list_within("--altitude-m", options.altitude, 0, kMaxAltitude,
                                      "a height above the ground in metres");
  grid.sun_zenith_deg =
      parse_list_within("--sun-zenith-deg", options.sun_zenith, 0, 180, "an angle in degrees");
  if (options.view_zenith.empty() && !options.irradiance) {
    throw UsageError("--view-zenith-deg", "expected a list of angles in degrees");
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

SkyTable parse_table(const SkyOptions& options, const SpectralData& data, SkyGrid& grid) {
  if (options.wavelength.empty()) {
    if (options.irradiance) return illuminance_table(data);
    return options.color ? color_table(data) : luminance_table(data);
  }
  for (const auto& [given, name] :
       {std::pair{options.luminance, "--luminance"}, std::pair{options.color, "--color"}}) {
    if (given) throw UsageError(name, "", "expected without --wavelength-nm");
  }
  const auto& table = data.ozone_cross_section.wavelength_nm;
  const std::vector<double> nm =
      parse_list_within("--wavelength-nm", options.wavelength, table.front(), table.back(),
                        "a wavelength in nm that the tables hold,");
  grid.wavelength_nm = nm;
  return options.irradiance ? irradiance_table(data, nm) : radiance_table(data, nm);
}

// `values` are kept at once for each point.
std::vector<SkyPoint> points_of(const SkyGrid& grid, std::size_t values) {
  const std::size_t count = grid.altitude_m.size() * grid.sun_zenith_deg.size() *
                            grid.view_zenith_deg.size() * grid.azimuth_deg.size();
  const std::size_t most = kMaxRows / values;
  if (count > most) {
    throw std::invalid_argument(
        fmt::format("{} combinations of the lists: expected at most {}", count, most));
  }
  std::vector<SkyPoint> points;
  points.reserve(count);
  for (const double altitude : grid.altitude_m) {
    for (const double sun : grid.sun_zenith_deg) {
      for (const double view : grid.view_zenith_deg) {
        for (const double azimuth : grid.azimuth_deg) {
          points.push_back(
              {altitude, grid.true_sun_zenith(altitude, sun), radians(view), radians(azimuth)});
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

ReferenceOptions reference_options(const SkyOptions& options) {
  ReferenceOptions result;
  result.threads = options.threads;
  result.transfer = transfer_of(options.scalar);
  result.refraction = options.refraction;
  return result;
}

// The light of each order of scattering at the points.
std::vector<SkyValues> orders_of(const Atmosphere<double>& atmosphere, const SkyTable& table,
                                 const std::vector<SkyPoint>& points, ReferenceOptions options) {
  std::vector<SkyValues> orders;
  for (options.order = 1; options.order <= table.orders; ++options.order)
    orders.push_back(ReferenceModel(options).radiance(atmosphere, table.nodes, points, {}));
  return orders;
}

std::string place_columns(const SkyGrid& grid) {
  return fmt::format("altitude_m,{}_deg,view_zenith_deg,relative_azimuth_deg,", grid.sun_column());
}
std::string place(double altitude, double sun, double view, double azimuth) {
  return fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},", altitude, sun, view, azimuth);
}

void leave_arrays(const SkyOptions& options, const fit::NetcdfFile& sky) {
  if (!options.netcdf.empty()) leave_netcdf(options.netcdf, sky);
  if (!options.npz.empty()) write_sky_npz(options.npz, sky);
}

void leave_stokes(const SkyModel& model, const Atmosphere<double>& atmosphere, const SkyGrid& grid,
                  const SkyTable& table, const SkyOptions& options) {
  const PolarisationAngle angle =
      options.iau ? PolarisationAngle::kIau : PolarisationAngle::kClockwise;
  constexpr std::size_t kParameters = 3;  // I, Q, U
  const std::vector<SkyPoint> points = points_of(grid, kParameters);
  const StokesValues stokes = model.stokes(atmosphere, table.nodes, points, {});
  check_light(stokes.i, table.nodes, points);
  if (!options.prints_csv()) {
    std::vector<double> all;
    for (int p = 0; p < stokes.i.points; ++p) {
      for (int w = 0; w < stokes.i.wavelengths; ++w) {
        const auto row = stokes_row(stokes, p, w, angle);
        all.insert(all.end(), row.begin(), row.end());
      }
    }
    leave_arrays(options, sky_netcdf("Polarised sky of " + options.preset, grid.axes(true),
                                     stokes_columns(), all));
    return;
  }
  print(stokes_header(place_columns(grid)));
  int point = 0;
  std::string text;
  for_each_point(grid, [&](double altitude, double sun, double view, double azimuth) {
    text.clear();
    append_stokes(place(altitude, sun, view, azimuth), stokes, table.nodes, point++, angle, text);
    print(text);
  });
}

void leave_sky(const SkyModel& model, const Atmosphere<double>& atmosphere, const SkyGrid& grid,
               const SkyTable& table, const SkyOptions& options) {
  const std::vector<SkyPoint> points = points_of(grid, 1 + table.orders);
  const SkyValues sky = model.radiance(atmosphere, table.nodes, points, table.derivatives());
  check_light(sky, table.nodes, points);
  const std::vector<SkyValues> orders =
      orders_of(atmosphere, table, points, reference_options(options));
  if (!options.prints_csv()) {
    std::vector<double> all;
    for (int p = 0; p < sky.points; ++p) {
      const std::vector<double> values = place_values(table, sky, orders, p, 1);
      all.insert(all.end(), values.begin(), values.end());
    }
    leave_arrays(options,
                 sky_netcdf("Sky of " + options.preset, grid.axes(true), table.all_columns(), all));
    return;
  }
  print(header(table, place_columns(grid)));
  int point = 0;
  fmt::memory_buffer text;
  for_each_point(grid, [&](double altitude, double sun, double view, double azimuth) {
    text.clear();
    append_place(table, place(altitude, sun, view, azimuth), sky, orders, point++, 1, text);
    print({text.data(), text.size()});
  });
}

void leave_irradiance(const SkyModel& model, const Atmosphere<double>& atmosphere,
                      const SkyGrid& grid, const SkyTable& table, const SkyOptions& options) {
  fmt::memory_buffer text;
  std::vector<double> all;
  for (const double altitude : grid.altitude_m) {
    for (const double sun : grid.sun_zenith_deg) {
      const SkyValues irradiance =
          model.irradiance(atmosphere, table.nodes, altitude, grid.true_sun_zenith(altitude, sun),
                           table.derivatives());
      check_irradiance(irradiance, table.nodes, altitude, grid.true_sun_zenith(altitude, sun));
      append_place(table, fmt::format("{:.9g},{:.9g},", altitude, sun), irradiance, {}, 0,
                   kIrradianceCount, text);
      const std::vector<double> values = place_values(table, irradiance, {}, 0, kIrradianceCount);
      all.insert(all.end(), values.begin(), values.end());
    }
  }
  if (!options.prints_csv()) {
    leave_arrays(options, sky_netcdf("Irradiance under " + options.preset, grid.axes(false),
                                     table.all_columns(), all));
    return;
  }
  print(header(table, fmt::format("altitude_m,{}_deg,", grid.sun_column())));
  print({text.data(), text.size()});
}

void run_sky(const SkyOptions& options) {
  require_netcdf(options.netcdf);
  if (!options.npz.empty()) require_output_files({options.npz}, {".npz"}, "--npz");
  SkyGrid grid = parse_grid(options);
  Preset preset = preset_named(options.preset);
  const SpectralData spectra = refs::spectral_data_of(preset.atmosphere);
  SkyTable table = parse_table(options, spectra, grid);
  table.orders = options.orders;
  if (options.orders > 0 && options.model != "reference")
    throw UsageError("--model", options.model, "expected reference with --orders");
  if (options.stokes && options.scalar) throw UsageError("--scalar", "", kScalarStokes);
  if (options.stokes && options.wavelength.empty())
    throw UsageError("--wavelength-nm", "", "expected wavelengths with --stokes");
  if (options.sigma) table.covariance = fit::fitted_covariance(preset, options.preset);
  if (const auto pressure = parse_site_pressure(options.site_pressure))
    set_site_pressure(preset.atmosphere, *pressure);
  if (options.apparent_sun) {
    constexpr double kGreen = 550;
    grid.refraction.emplace(preset.atmosphere, kGreen);
  }
  const auto model = sky_model_named(options.model, spectra, options.threads,
                                     transfer_of(options.scalar), options.refraction);
  if (options.stokes) {
    leave_stokes(*model, preset.atmosphere, grid, table, options);
  } else if (options.irradiance) {
    leave_irradiance(*model, preset.atmosphere, grid, table, options);
  } else {
    leave_sky(*model, preset.atmosphere, grid, table, options);
  }
}

}  // namespace

void add_sky_command(CLI::App& app) {
  const auto options = std::make_shared<SkyOptions>();
  CLI::App* const command = app.add_subcommand(
      "sky", "Evaluates a preset and prints CSV: luminance, colour, radiance or irradiance.");
  add_sky_options(*command, *options);
  add_particle_cache_option(*command);
  command->callback([options, command] {
    for (const char* unused : {"--view-zenith-deg", "--azimuth-deg"}) {
      if (options->irradiance && command->count(unused) > 0)
        warn(fmt::format("{} is not used: irradiances have no direction", unused));
    }
    of_preset(options->preset, [&] { run_sky(*options); });
  });
}

}  // namespace skyfit::cli
