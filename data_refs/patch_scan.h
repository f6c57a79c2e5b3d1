// SPDX-License-Identifier: Apache-2.0
// The 145 patches of a sky scanner: rows of 30, 30, 24, 24, 18, 12 and 6 at altitudes 6, 18 .. 78
// deg and one at the zenith (Tregenza 1987). A scanner goes to and fro: it measures the first row
// upward in azimuth, the second downward from its last patch, and so on (boustrophedon).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "data_refs/measured_sky.h"
#include "data_refs/sampling.h"

namespace skyfit::refs {

inline constexpr std::size_t kPatches = 145;

// Azimuths count from the zero of the file. Order of ImportOptions::patch_order, boustrophedon when
// it does not say.
std::vector<SkyDirection> patch_directions(const ImportOptions& facts);

// One scan: kPatches values in the unit of the file, and where the sun stands.
struct PatchScan {
  std::string name;
  ScanSun sun;
  std::vector<double> values;
  std::optional<double> stated_sun_azimuth = {};  // radians, as the file counts azimuths
};

// The samples of the scans. Where azimuth_zero is stated, throws std::invalid_argument when the
// brightest patches lie far from the sun and near it with the other zero; where it is not, they
// must tell which it is, or under a sky without a bright side the stated azimuths of the sun, and a
// note says so; else the error says which change of clock or place would let them tell.
Reference patch_reference(const std::string& source, const Unit& unit, ImportOptions facts,
                          std::span<const PatchScan> scans,
                          const std::vector<std::string>& notes = {});

}  // namespace skyfit::refs
