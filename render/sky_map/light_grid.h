// SPDX-License-Identifier: Apache-2.0
// The model's light about an observer on a grid of directions, and between them: linear in the
// logarithms, apart above and below the horizon. Angles in radians, azimuths from the sun's.
#pragma once

#include <cstddef>
#include <vector>

#include "model/sky_model.h"

namespace skyfit {

struct MapChannels;
struct SkyMapOptions;

class LightGrid {
 public:
  // Throws as SkyModel::radiance() does.
  LightGrid(const SkyModel& model, const Atmosphere<double>& atmosphere,
            const MapChannels& channels, const SkyMapOptions& options);

  double horizon() const { return horizon_; }  // zenith angle
  // Adds a share of the light of a direction, [channel].
  void add(double zenith, double azimuth, double share, std::vector<double>& light) const;

 private:
  std::size_t channels_;
  double horizon_;
  std::vector<double> zeniths_;   // ascending; two of them touch the horizon
  std::vector<double> azimuths_;  // 0 .. pi
  std::size_t first_ground_;      // index of the first zenith angle below the horizon
  std::vector<double> logs_;      // [zenith][azimuth][channel]
};

}  // namespace skyfit
