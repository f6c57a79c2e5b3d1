// SPDX-License-Identifier: Apache-2.0
// The model's value of every sample of a dataset, with derivatives by the unknowns.
//
// Derivatives by the atmosphere are the model's own, exact. Those by the pointing are central
// differences of the model over +-0.25 deg of each angle: the model has none by angles, and the
// sky's third derivatives make that good to some 1e-4 of a value per degree outside the aureole.
// Those of polarisation are the same, of Q, U and I. Its reference plane is the meridian plane of
// the direction that is truly seen, so that a tilt of the instrument does not turn Q and U.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fit/problem/dataset.h"
#include "fit/problem/unknowns.h"

namespace skyfit::fit {

struct SampleValues {
  Eigen::VectorXd value;       // in the reference's unit; of polarisation a pure number
  Eigen::MatrixXd derivative;  // [sample][unknown], per unit of the unknown
};

// Without unknowns no derivatives. Readings of polarisation need a model that gives_stokes().
// Throws what the model throws.
SampleValues sky_values(const SkyModel& model, const Dataset& data, const SkyState& state,
                        const std::vector<Unknown>& unknowns);

}  // namespace skyfit::fit
