// SPDX-License-Identifier: Apache-2.0
// Values of a sky at points, and irradiances, as `skyfit sky` computes them.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include "cli/arguments.h"
#include "cli/inputs.h"
#include "cli/light_check.h"
#include "cli/sky_table.h"
#include "data_refs/spectra.h"
#include "model/atmosphere/parameters.h"
#include "model/polarisation.h"
#include "model/registry.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/interruptible.h"

namespace skyfit::python {
namespace {

using cli::NodeSum;
using cli::SkyTable;

// Arrays by the names of the columns of `skyfit sky`.
using NamedArrays = std::vector<std::pair<std::string, py::array_t<double>>>;

struct How {
  std::string model;
  std::vector<std::string> derivatives;
  bool scalar, refraction;
  int threads;
};

struct Evaluation {
  Atmosphere<double> atmosphere;
  SpectralData spectra;
  std::unique_ptr<SkyModel> model;
  std::vector<Parameter> derivatives;
};

Evaluation evaluation(const Preset& preset, const How& how) {
  if (how.threads < 1)
    throw std::invalid_argument(fmt::format("threads = {}: must be >= 1", how.threads));
  Evaluation result{preset.atmosphere, refs::spectral_data_of(preset.atmosphere), nullptr, {}};
  result.model = cli::sky_model_named(how.model, result.spectra, how.threads,
                                      cli::transfer_of(how.scalar), how.refraction);
  for (const std::string& name : how.derivatives) {
    result.derivatives.push_back(parameter_from_name(name));
    require_parameter(preset.atmosphere, result.derivatives.back());
  }
  return result;
}

std::vector<double> wavelengths_of(const Evaluation& evaluation,
                                   const std::optional<Input<double>>& wavelength_nm) {
  if (!wavelength_nm) return {};
  std::vector<double> nm(wavelength_nm->data(), wavelength_nm->data() + wavelength_nm->size());
  const std::vector<double>& known = evaluation.spectra.ozone_cross_section.wavelength_nm;
  for (const double one : nm) {
    if (one >= known.front() && one <= known.back()) continue;
    throw std::invalid_argument(fmt::format("wavelength_nm = {}: must be within {} .. {}", one,
                                            known.front(), known.back()));
  }
  return nm;
}

// The value of every line of the table at `count` points from `first` by `step`: [point][line].
std::vector<double> values_of(const SkyTable& table, const SkyValues& sky, int first, int step) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(sky.points / step) * table.lines.size());
  for (int point = first; point < sky.points; point += step) {
    for (const cli::SkyLine& line : table.lines)
      values.push_back(value_of(line.sums.front(), sky, point));
  }
  return values;
}

// The same of the derivatives: [parameter][point][line].
std::vector<double> derivatives_of(const SkyTable& table, const SkyValues& sky, int first,
                                   int step) {
  std::vector<double> values;
  for (int parameter = 0; parameter < sky.parameters; ++parameter) {
    for (int point = first; point < sky.points; point += step) {
      for (const cli::SkyLine& line : table.lines)
        values.push_back(derivative_of(line.sums.front(), sky, parameter, point));
    }
  }
  return values;
}

// Derivatives by so many parameters; without points there are none, but of that many.
void add(NamedArrays& arrays, const std::string& name, std::vector<double> values,
         std::vector<double> derivatives, std::size_t parameters) {
  arrays.emplace_back(name, array_of(std::move(values)));
  if (parameters > 0) arrays.emplace_back("d_" + name, array_of(std::move(derivatives)));
}

std::vector<SkyPoint> points_of(const Input<double>& altitude_m,
                                const Input<double>& sun_zenith_deg,
                                const Input<double>& view_zenith_deg,
                                const Input<double>& azimuth_deg) {
  std::vector<SkyPoint> points;
  points.reserve(static_cast<std::size_t>(altitude_m.size()));
  for (py::ssize_t i = 0; i < altitude_m.size(); ++i) {
    points.push_back({altitude_m.data()[i], cli::radians(sun_zenith_deg.data()[i]),
                      cli::radians(view_zenith_deg.data()[i]),
                      cli::radians(azimuth_deg.data()[i])});
  }
  return points;
}

// All inputs have as many elements; the arrays that come back are flat.
NamedArrays sky(const Preset& preset, const Input<double>& altitude_m,
                const Input<double>& sun_zenith_deg, const Input<double>& view_zenith_deg,
                const Input<double>& azimuth_deg, const std::optional<Input<double>>& wavelength_nm,
                const How& how) {
  const Evaluation with = evaluation(preset, how);
  const std::vector<double> nm = wavelengths_of(with, wavelength_nm);
  const SkyTable table =
      wavelength_nm ? cli::radiance_table(with.spectra, nm) : cli::luminance_table(with.spectra);
  const auto points = points_of(altitude_m, sun_zenith_deg, view_zenith_deg, azimuth_deg);
  struct {
    std::vector<double> value, derivative;
  } result;
  interruptible([&](const std::atomic<bool>& stop) {
    const SkyValues values = InterruptibleModel(*with.model, stop)
                                 .radiance(with.atmosphere, table.nodes, points, with.derivatives);
    cli::check_light(values, table.nodes, points);
    result = {values_of(table, values, 0, 1), derivatives_of(table, values, 0, 1)};
  });
  NamedArrays arrays;
  add(arrays, table.columns.front().name, std::move(result.value), std::move(result.derivative),
      with.derivatives.size());
  return arrays;
}

NamedArrays stokes(const Preset& preset, const Input<double>& altitude_m,
                   const Input<double>& sun_zenith_deg, const Input<double>& view_zenith_deg,
                   const Input<double>& azimuth_deg, const Input<double>& wavelength_nm,
                   const How& how) {
  const Evaluation with = evaluation(preset, how);
  const auto nodes = spectral_nodes(with.spectra, wavelengths_of(with, wavelength_nm));
  const auto points = points_of(altitude_m, sun_zenith_deg, view_zenith_deg, azimuth_deg);
  StokesValues light;
  std::vector<double> degree, angle_deg;
  interruptible([&](const std::atomic<bool>& stop) {
    light = InterruptibleModel(*with.model, stop)
                .stokes(with.atmosphere, nodes, points, with.derivatives);
    cli::check_light(light.i, nodes, points);
    for (std::size_t k = 0; k < light.i.value.size(); ++k) {
      const LinearPolarisation linear =
          linear_polarisation(light.i.value[k], light.q.value[k], light.u.value[k]);
      degree.push_back(linear.degree);
      angle_deg.push_back(linear.angle_deg);
    }
  });
  NamedArrays arrays;
  for (auto& [name, values] :
       {std::pair<std::string, SkyValues&>{"radiance_per_irradiance_sr", light.i},
        {"q_per_irradiance_sr", light.q},
        {"u_per_irradiance_sr", light.u}})
    add(arrays, name, std::move(values.value), std::move(values.derivative),
        with.derivatives.size());
  add(arrays, "degree_of_linear_polarisation", std::move(degree), {}, 0);
  add(arrays, "angle_of_linear_polarisation_deg", std::move(angle_deg), {}, 0);
  return arrays;
}

NamedArrays irradiance(const Preset& preset, const Input<double>& altitude_m,
                       const Input<double>& sun_zenith_deg,
                       const std::optional<Input<double>>& wavelength_nm, const How& how) {
  const Evaluation with = evaluation(preset, how);
  const SkyTable table =
      wavelength_nm ? cli::irradiance_table(with.spectra, wavelengths_of(with, wavelength_nm))
                    : cli::illuminance_table(with.spectra);
  // Of all observers; points: [observer][kind of irradiance].
  SkyValues all;
  const auto observers = static_cast<std::size_t>(altitude_m.size());
  interruptible([&](const std::atomic<bool>& stop) {
    const InterruptibleModel model(*with.model, stop);
    std::vector<SkyValues> each;
    for (std::size_t i = 0; i < observers; ++i) {
      const double altitude = altitude_m.data()[i], sun = cli::radians(sun_zenith_deg.data()[i]);
      each.push_back(
          model.irradiance(with.atmosphere, table.nodes, altitude, sun, with.derivatives));
      cli::check_irradiance(each.back(), table.nodes, altitude, sun);
      all.value.insert(all.value.end(), each.back().value.begin(), each.back().value.end());
    }
    all.points = static_cast<int>(observers) * kIrradianceCount;
    all.wavelengths = static_cast<int>(table.nodes.size());
    all.parameters = static_cast<int>(with.derivatives.size());
    const std::size_t size = static_cast<std::size_t>(kIrradianceCount) * table.nodes.size();
    for (std::size_t p = 0; p < with.derivatives.size(); ++p) {
      for (const SkyValues& one : each) {
        const auto begin = one.derivative.begin() + static_cast<std::ptrdiff_t>(p * size);
        all.derivative.insert(all.derivative.end(), begin,
                              begin + static_cast<std::ptrdiff_t>(size));
      }
    }
  });
  NamedArrays arrays;
  for (int kind = 0; kind < kIrradianceCount; ++kind) {
    add(arrays, table.columns[static_cast<std::size_t>(kind)].name,
        values_of(table, all, kind, kIrradianceCount),
        derivatives_of(table, all, kind, kIrradianceCount), with.derivatives.size());
  }
  return arrays;
}

}  // namespace

void bind_sky(py::module_& module) {
  py::class_<How>(module, "How")
      .def(py::init<std::string, std::vector<std::string>, bool, bool, int>(), py::arg("model"),
           py::arg("derivatives"), py::arg("scalar"), py::arg("refraction"), py::arg("threads"));
  module.def("sky", &sky);
  module.def("stokes", &stokes);
  module.def("irradiance", &irradiance);
  module.def("default_threads", &cli::default_threads, "Processors of this machine.");
  module.def(
      "models",
      [] {
        std::map<std::string, std::string> rows;
        for (const SkyModelEntry& entry : sky_models()) rows.emplace(entry.name, entry.meaning);
        return rows;
      },
      "Name and meaning of every sky model.");
}

}  // namespace skyfit::python
