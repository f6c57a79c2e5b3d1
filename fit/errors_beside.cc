// SPDX-License-Identifier: Apache-2.0
#include "fit/errors_beside.h"

#include <cmath>

namespace skyfit::fit {

std::vector<PolarisationErrors> polarisation_errors(const Dataset& readings, const SkyModel& model,
                                                    const SkyState& start, const SkyState& fitted,
                                                    double factor) {
  const Eigen::VectorXd at_start = sky_values(model, readings, start, {}).value,
                        at_end = sky_values(model, readings, fitted, {}).value;
  std::vector<PolarisationErrors> result;
  for (const auto what :
       {refs::Polarisation::kQ, refs::Polarisation::kU, refs::Polarisation::kDegree}) {
    PolarisationErrors errors{what};
    for (std::size_t i = 0; i < readings.samples.size(); ++i) {
      const Sample& reading = readings.samples[i];
      if (reading.polarisation != what) continue;
      const auto row = static_cast<Eigen::Index>(i);
      ++errors.readings;
      errors.start_rms += std::pow(at_start(row) - reading.value, 2);
      errors.rms += std::pow(at_end(row) - reading.value, 2);
      errors.sigma += std::pow(factor * reading.sigma, 2);
    }
    if (errors.readings == 0) continue;
    for (double* const sum : {&errors.start_rms, &errors.rms, &errors.sigma})
      *sum = 100 * std::sqrt(*sum / errors.readings);
    result.push_back(errors);
  }
  return result;
}

std::vector<IrradianceErrors> irradiance_errors(const Dataset& data,
                                                const std::vector<double>& start_model,
                                                const std::vector<double>& model) {
  const std::vector<int> beside = irradiances_beside_sky(data);
  std::vector<IrradianceErrors> result;
  for (int kind = 0; kind < kIrradianceCount; ++kind) {
    IrradianceErrors errors{static_cast<Irradiance>(kind)};
    for (const int i : beside) {
      const Sample& sample = data.samples[static_cast<std::size_t>(i)];
      if (sample.irradiance != errors.what) continue;
      const double at_start = start_model[sample.index] / sample.value - 1,
                   at_end = model[sample.index] / sample.value - 1;
      ++errors.samples;
      errors.start_rms += at_start * at_start;
      errors.rms += at_end * at_end;
      errors.mean_bias += 100 * at_end;
      errors.sigma += std::pow(sample.sigma / sample.value, 2);
    }
    if (errors.samples == 0) continue;
    errors.mean_bias /= errors.samples;
    for (double* const sum : {&errors.start_rms, &errors.rms, &errors.sigma})
      *sum = 100 * std::sqrt(*sum / errors.samples);
    result.push_back(errors);
  }
  return result;
}

}  // namespace skyfit::fit
