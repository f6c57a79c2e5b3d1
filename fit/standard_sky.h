// SPDX-License-Identifier: Apache-2.0
// What a CIE standard sky (CIE S 011) is fitted with where nothing else is asked for: clear air,
// haze under a cloud, or a thick cloud alone. These skies are formulas without an uncertainty, so
// that physical bounds take the place of priors, and Rayleigh scattering, which the pressure fixes,
// is not free.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fit/problem/options.h"
#include "model/sky_model.h"

namespace skyfit::fit {

struct StandardSkyKind {
  std::string_view name;     // "cloud over haze"
  std::string_view meaning;  // one line
  std::string_view preset;   // shipped, where the fit starts; empty: the defaults of FitOptions
  std::vector<int> types;    // that are fitted with it
  std::map<Parameter, Bounds> free;
};

// Every kind; help texts and documents follow it. Every type from 1 to 15 has exactly one.
std::span<const StandardSkyKind> standard_sky_kinds();

// The type of "cie:12"; nothing for another name.
std::optional<int> standard_sky_type(std::string_view reference);

// The kind of a type, 1 to 15, by a model; one of the literature fits clear air to all of them.
const StandardSkyKind& standard_sky_kind(int type, const SkyModel& model);

// The options with what the kind says and they leave open: start, free parameters, bounds, no
// priors. Those that name a start stay as they are.
FitOptions with_standard_sky(const FitOptions& options, const StandardSkyKind& kind,
                             const SkyModel& model);

}  // namespace skyfit::fit
