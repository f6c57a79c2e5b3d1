// SPDX-License-Identifier: Apache-2.0
// Whether the stated sun of each scan, or that of its time and place, is where the scan's light
// says (seen_sun.h), and which single change of clock, place or azimuths would mend it.
#pragma once

#include <string>

#include "data_refs/import_options.h"
#include "data_refs/samples.h"

namespace skyfit::refs {

// Notes each scan whose sun is seen elsewhere. One that sees it more than 8 deg away is left out:
// its samples have weight 0. Throws std::invalid_argument in one line when these are most of the
// scans that can tell. With facts.accept_sun scans are noted alone.
void check_suns(const ImportOptions& facts, Reference& sky);

// Of a sky whose azimuths count from north or from south, nobody knows which: the change of clock
// or place that would bring the sun of one of both where the light of the clearest scan puts it.
// `from_north` has them from north. Empty where the light does not tell.
std::string mends_from_either_zero(const Reference& from_north);

}  // namespace skyfit::refs
