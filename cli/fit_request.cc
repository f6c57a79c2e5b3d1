// SPDX-License-Identifier: Apache-2.0
#include "cli/fit_request.h"

#include "data_refs/absorption_bands.h"
#include "data_refs/spectra.h"
#include "fit/fit.h"
#include "fit/problem/free_parameters.h"
#include "fit/standard_sky.h"

namespace skyfit::cli {

FitRequest fit_request(const FitArguments& arguments, refs::Reference reference,
                       const CLI::App& command) {
  FitRequest request;
  request.model =
      sky_model_named(arguments.model, refs::standard_spectral_data(), arguments.threads,
                      transfer_for(reference, arguments.scalar), arguments.refraction);
  request.options = fit_options(arguments, *request.model, command);
  request.options.aerosol = known_aerosol(arguments, reference);
  if (const std::optional<int> type = fit::standard_sky_type(reference.name)) {
    request.options = fit::with_standard_sky(
        request.options, fit::standard_sky_kind(*type, *request.model), *request.model);
  }
  request.checks = check_options(arguments);
  if (!arguments.keep_absorption_bands) refs::mask_absorption_bands(reference);
  request.reference = std::move(reference);
  return request;
}

FinishedFit finished_fit(const FitRequest& request, const SkyModel& model) {
  const SpectralData spectra = refs::spectral_data_of(fit::start_atmosphere(request.options));
  FinishedFit finished{fit::fit_atmosphere(request.reference, spectra, model, request.options), {}};
  fit::FitOptions options = request.options;
  options.progress = {};
  finished.checks = fit::run_checks(spectra, model, options, finished.result, request.checks);
  return finished;
}

}  // namespace skyfit::cli
