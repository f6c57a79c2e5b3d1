// SPDX-License-Identifier: Apache-2.0
// The units in which measured skies are accepted. A unit is stated, never guessed.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "data_refs/samples.h"

namespace skyfit::refs {

struct Unit {
  std::string_view name;
  Quantity quantity;
  double factor;  // value * factor is in the unit of the quantity (samples.h)
};

std::span<const Unit> units();

// "W m-2 sr-1 nm-1, mW m-2 sr-1 nm-1, ..." of those quantities; of all when none is named.
std::string unit_names(std::initializer_list<Quantity> quantities = {});

// The unit that a text spells: "W m^-2 sr^-1 nm^-1", "W/(m^2 sr nm)" and "W/m2/sr/nm" are one.
// Nothing when it is none of units().
std::optional<Unit> find_unit(std::string_view text);

// "spectral radiance", "luminance", "relative luminance", "illuminance", "irradiance"
std::string_view quantity_name(Quantity quantity);

}  // namespace skyfit::refs
