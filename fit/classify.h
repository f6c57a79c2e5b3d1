// SPDX-License-Identifier: Apache-2.0
// Which standard sky a reference is: the 15 types of CIE S 011 against it, and the free fit of the
// coefficients a to e of their formula (data_refs/cie_sky.h).
//
// Compared are logarithms of luminance with one free scale per scan. A spectral scan's luminance is
// the sum of y_bar times radiance over the wavelengths at hand, up to that factor.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "data_refs/cie_sky.h"
#include "data_refs/samples.h"
#include "model/photometry/photometry.h"

namespace skyfit::fit {

struct ClassifyOptions {
  double exclude_sun = 0.05235987755982988;  // radians (3 deg) around the sun that are left out
  bool free_azimuth = false;  // an azimuth offset per scan is fitted, for every type anew
};

struct SkyMatch {
  refs::CieSky sky;                    // type 0: the free fit
  double rms_log_percent = 0;          // of log(formula / measured), the scans' means subtracted
  std::vector<double> rms_of_scan;     // percent
  std::vector<double> azimuth_offset;  // of each scan, radians
};

struct Classification {
  std::vector<std::string> scans;
  int directions = 0;
  std::vector<SkyMatch> types;  // 1 to 15
  SkyMatch free;
  const SkyMatch& nearest() const;
  int nearest_of_scan(std::size_t scan) const;  // a type
};

// Throws std::invalid_argument when no direction with weight is left or values are not > 0.
Classification classify(const refs::Reference& reference, const SpectralData& spectra,
                        const ClassifyOptions& options);

std::string classification_text(const Classification& classification);
nlohmann::json classification_json(const Classification& classification);

}  // namespace skyfit::fit
