// SPDX-License-Identifier: Apache-2.0
// An independent yardstick for the tests: backward Monte Carlo in spherical geometry. Photons leave
// the eye, the first event on the view ray is forced, and every later event looks at the sun.
#pragma once

#include <cstdint>
#include <vector>

#include "model/literature/evaluate.h"
#include "model/sky_model.h"

namespace skyfit::truth {

struct MonteCarloResult {
  double single, multiple;  // one event, and more than one (1/sr)
  double stderr_multiple;
};

class MonteCarlo {
 public:
  MonteCarlo(const Atmosphere<double>& atmosphere, const WavelengthNode& node);
  MonteCarloResult radiance(const SkyPoint& point, long histories, std::uint64_t seed) const;

 private:
  struct History;
  struct Step {
    double distance;  // -1: left through the top
    bool hits_ground;
  };
  // The next event of a ray after `depth` of extinction.
  Step fly(double height, double mu, double depth) const;
  template <class Layer>
  void walk(double height, double mu, const Layer& layer) const;
  int layer_of(double height) const;
  double to_sun(double height, double mu_s) const;

  Shells shells_;
  literature::ClearAir<0> optics_;
  double ground_albedo_;
  std::vector<double> heights_;  // of layers of constant density that keep each layer's column
  std::vector<double> air_, extinction_, scattering_;  // per layer, 1/m
};

}  // namespace skyfit::truth
