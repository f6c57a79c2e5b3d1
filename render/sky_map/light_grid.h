// SPDX-License-Identifier: Apache-2.0
// The model's light about an observer on a grid of directions, and between them: linear in the
// logarithms, apart above and below the horizon. Angles in radians, azimuths from the sun's.
#pragma once

#include <array>
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
  // Q / I and U / I of a direction, [polarised channel of MapChannels], clockwise from up; the
  // azimuth counts clockwise from above. Empty unless SkyMapOptions::stokes; 0 without light.
  std::vector<std::array<double, 2>> polarisation(double zenith, double azimuth) const;

 private:
  struct Place;  // between four nodes
  Place place_of(double zenith, double azimuth) const;

  std::size_t channels_, polarised_ = 0;
  double horizon_;
  std::vector<double> zeniths_;             // ascending; two of them touch the horizon
  std::vector<double> azimuths_;            // 0 .. pi
  std::size_t first_ground_;                // index of the first zenith angle below the horizon
  std::vector<double> logs_;                // [zenith][azimuth][channel]
  std::vector<std::array<double, 2>> q_u_;  // over I, [zenith][azimuth][polarised channel]
};

}  // namespace skyfit
