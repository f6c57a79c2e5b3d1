// SPDX-License-Identifier: Apache-2.0
// What the options of `skyfit fit` ask for of one reference, and the fit itself.
#pragma once

#include <memory>

#include "cli/fit_files.h"
#include "cli/fit_options.h"

namespace skyfit::cli {

struct FitRequest {
  refs::Reference reference;  // without the absorption bands, unless they are kept
  std::unique_ptr<SkyModel> model;
  fit::FitOptions options;
  fit::CheckOptions checks;
};

// A standard sky, known by its name, gets the bounds of its kind. Throws what fit_options() and
// make_sky_model() throw.
FitRequest fit_request(const FitArguments& arguments, refs::Reference reference,
                       const CLI::App& command);

// The fit and its checks by `model`, which is that of the request or one that hands on to it.
// Throws what fit_atmosphere() and run_checks() throw.
FinishedFit finished_fit(const FitRequest& request, const SkyModel& model);

}  // namespace skyfit::cli
