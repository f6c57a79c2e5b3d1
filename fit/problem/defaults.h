// SPDX-License-Identifier: Apache-2.0
// What a fit starts from and what is free where its options do not say, by the kind of the data:
// the tables of docs/fits.md.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/problem/free_parameters.h"
#include "fit/problem/options.h"

namespace skyfit::fit {

// The options' start, or the default of the kind of data, with the site's air, the ground and the
// aerosol that are known. Throws std::invalid_argument where the start has no aerosol of which
// something is known.
Atmosphere<double> given_atmosphere(const refs::Reference& reference, const FitOptions& options);

// With what the options fix; parameters that it lacks are left out.
Atmosphere<double> as_given(Atmosphere<double> atmosphere, const FitOptions& options);

// What is assumed of a measured sky whose site does not state enough, in sentences.
std::vector<std::string> assumptions(const refs::Reference& reference, const FitOptions& options);

// A sentence where samples repeat others: of one direction under one sun, one wavelength and one
// value.
std::optional<std::string> repeated_samples(const Dataset& data);

// A sentence where nothing is said of what is free, the main aerosol is not named `mie` and so
// stays as it is, and the model could fit it: what would free it.
std::optional<std::string> held_aerosol(const FitOptions& options, const SkyModel& model,
                                        const Atmosphere<double>& atmosphere,
                                        const std::vector<FreeParameter>& parameters);

// Of irradiances only what they tell is free, and what has a prior.
FitOptions with_free_of_irradiances(FitOptions options, const refs::Reference& reference,
                                    const SkyModel& model, const Atmosphere<double>& atmosphere);

// With the parameters that are free and the priors that hold by default: the table's
// (model/atmosphere/parameters.h) and those of options.h.
FitOptions with_default_parameters(const FitOptions& options, const SkyModel& model,
                                   bool several_wavelengths, bool pointing_is_unknown,
                                   const Atmosphere<double>& atmosphere);

}  // namespace skyfit::fit
