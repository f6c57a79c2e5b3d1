// SPDX-License-Identifier: Apache-2.0
// Several references become one, for a joint fit.
#pragma once

#include <vector>

#include "data_refs/samples.h"

namespace skyfit::refs {

// Scans are numbered on in the order given; each keeps what is known of it. Throws
// std::invalid_argument with one line when the quantities differ or there is none.
Reference joint_reference(const std::vector<Reference>& references);

}  // namespace skyfit::refs
