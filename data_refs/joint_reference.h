// SPDX-License-Identifier: Apache-2.0
// Several references become one, for a joint fit.
#pragma once

#include <string_view>
#include <vector>

#include "data_refs/samples.h"

namespace skyfit::refs {

// Scans are numbered on in the order given; each keeps what is known of it. Throws
// std::invalid_argument with one line when the quantities differ or there is none.
Reference joint_reference(const std::vector<Reference>& references);
// Whether a name is that of several references together, "cie:1 and 2 more", which none has alone.
bool is_joint_name(std::string_view name);

// The samples of a sky and irradiances (irradiance.h) as one reference, which keeps the name of the
// sky. Irradiances of the same minute as a scan belong to it; those without a time to the scan
// whose sun is nearest, within 1 deg; others are scans of their own. Throws std::invalid_argument
// with one line where suns of the same time are more than 1 deg apart, where irradiances of one sun
// without a time stand beside scans of other suns, and where `irradiances` are a sky or `sky` is
// none.
Reference with_irradiances(Reference sky, const Reference& irradiances);

// The same with the irradiances that belong to a scan of the sky alone. Throws also where there is
// none.
Reference with_irradiances_of_scans(Reference sky, const Reference& irradiances);

}  // namespace skyfit::refs
