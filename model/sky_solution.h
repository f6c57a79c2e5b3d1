// SPDX-License-Identifier: Apache-2.0
// The reference model's work for one atmosphere: fields once per wavelength, view rays once per
// altitude and zenith angle, then any number of suns. What radiance(), irradiance() and the tables
// stand on.
#pragma once

#include <span>
#include <vector>

#include "model/reference_model.h"
#include "model/single_scattering.h"
#include "model/view_path.h"

namespace skyfit {

// Radiance per unit solar irradiance in its parts.
template <int N>
struct RadianceParts {
  SingleScattering<N> single;  // amplitudes without phase functions (sr^0)
  Dual<N> multiple;            // scattered twice or more, ground included (1/sr)
  Dual<N> ground;              // straight from the ground (1/sr)
};

template <int N>
class SkySolution {
 public:
  // Solves the diffuse field for every sun of the grid that `mu_s_needed` touches (cosines of local
  // sun zenith angles).
  SkySolution(const Atmosphere<double>& atmosphere, std::span<const WavelengthNode> wavelengths,
              std::span<const Parameter> derivatives, std::span<const double> mu_s_needed,
              const ReferenceOptions& options);

  const Shells& shells() const { return shells_; }
  const std::vector<double>& heights() const { return heights_; }
  int wavelengths() const { return static_cast<int>(optics_.size()); }
  const Optics<N>& optics(int wavelength) const { return optics_[wavelength]; }

  PathSource<N> source(const ViewPath& path, int wavelength) const;
  // Samples of single scattering do not depend on the wavelength.
  RadianceParts<N> radiance(const ViewPath& path, const PathSource<N>& source,
                            const SunAlongRay& sun,
                            const std::vector<SingleScatteringSample>& samples,
                            int wavelength) const;
  Dual<N> sum(const RadianceParts<N>& parts, double nu, int wavelength) const;

 private:
  SunStencil stencil(double mu_s) const;  // indices into the solved suns
  Dual<N> multiple(const ViewPath& path, const PathSource<N>& source, const SunAlongRay& sun,
                   int wavelength) const;
  Dual<N> ground(const ViewPath& path, const SunAlongRay& sun, int wavelength) const;

  Shells shells_;
  StreamBasis basis_;
  std::vector<double> heights_;
  int slices_;
  SunGrid grid_;
  std::vector<int> solved_;  // grid index -> solved index, -1 when not needed
  std::vector<Optics<N>> optics_;
  std::vector<DiffuseField> fields_;
  std::vector<std::vector<double>>
      ground_series_;  // diffuse irradiance of the ground, [sun][slice]
};

}  // namespace skyfit
