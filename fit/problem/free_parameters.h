// SPDX-License-Identifier: Apache-2.0
// Which parameters are free, between which bounds, held by which prior, and the pure numbers in
// 0..1 that the solver sees in their place: logarithmic for coefficients and scale heights, linear
// otherwise, 0 at the lower and 1 at the upper bound.
#pragma once

#include <optional>
#include <vector>

#include "fit/problem/options.h"
#include "fit/problem/variable.h"

namespace skyfit::fit {

struct FreeParameter : Variable {
  Parameter id;
};

// Whether the solver sees the logarithm of the parameter: of coefficients, optical depths and scale
// heights with a lower bound above 0.
bool is_logarithmic(const Parameter& id, double lower);

// With the bounds of `info`.
FreeParameter free_parameter(Parameter id, const ParameterInfo& info,
                             const std::optional<Prior>& prior);

// The atmosphere before the fit: the start preset as given (coefficients moved to 550 nm along
// their power laws, because the bounds are meant there), or the table's defaults with the phase
// function that `lobes` asks for; without what problem.cc makes of it for measured skies.
Atmosphere<double> start_atmosphere(const FitOptions& options);

// Sets the fixed values. Throws std::invalid_argument for a value that is not physical, and for a
// parameter that the atmosphere does not have.
Atmosphere<double> with_fixed_values(const Atmosphere<double>& atmosphere,
                                     const FitOptions& options);

// The same with the phase function of `lobes`: of two lobes made one with their weighted mean g, of
// one lobe made two with it as the stronger one. A tabulated phase function stays.
Atmosphere<double> with_lobes(const Atmosphere<double>& atmosphere, int lobes);

// Throws std::invalid_argument when the model has fewer lobes than the options ask for.
void check_lobes(const FitOptions& options, const SkyModel& model);

// Of those that the model can fit. Throws std::invalid_argument when options
// name a parameter that the atmosphere does not have or the model cannot fit, or contradict
// each other, when the parameter of a prior or of bounds is not free, and when the value of a free
// parameter is outside its bounds.
std::vector<FreeParameter> choose_free_parameters(const FitOptions& options, const SkyModel& model,
                                                  const Atmosphere<double>& atmosphere);

// g1, g2 or weight of a phase function.
bool is_of_two_lobes(const Parameter& id);
// Whether exchanging the two lobes leaves the problem as it is: g1, g2 and weight are free and have
// no prior.
bool lobes_interchangeable(const std::vector<FreeParameter>& parameters);
// Exchanges the lobes when g1 < g2, so that g1 is the forward one; true when it did.
bool order_lobes(Atmosphere<double>& atmosphere);

}  // namespace skyfit::fit
