// SPDX-License-Identifier: Apache-2.0
// Homogeneous spheres of one lognormal mode: how a unit of their volume weakens and scatters light,
// docs/theory (2.19) to (2.22). With the radius r_V, the median of the volume, and the width sigma,
//   dV / d ln r = V / (sqrt(2 pi) sigma) exp(-ln(r / r_V)^2 / (2 sigma^2)).
// The median radius of their number is r_V exp(-3 sigma^2), the effective radius r_V exp(-sigma^2 /
// 2). Radii in um, wavelengths in nm, coefficients per volume in 1/um.
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

#include "model/atmosphere/angle_panels.h"

namespace skyfit {

class ContentCache;

struct ParticleMode {
  double wavelength_nm, radius_um, width;
  std::complex<double> index;
  friend bool operator==(const ParticleMode&, const ParticleMode&) = default;
};

// A value and its derivatives by the radius (1/um), by the width, and by the real and the imaginary
// part of the index; those by the index are 0 unless they were asked for.
inline constexpr std::size_t kParticleSlopes = 5;
using ParticleValue = std::array<double, kParticleSlopes>;

// At one wavelength.
class ParticleOptics {
 public:
  ParticleValue extinction{}, scattering{};  // per volume
  // P11 and P12 of the scattering matrix, 1/sr, at an angle in radians: the phase function, and
  // what it makes of unpolarised light (positive in the scattering plane). P11 integrates to 1.
  ParticleValue phase(double angle) const { return at(phase_, angle); }
  ParticleValue polarising_phase(double angle) const { return at(polarising_, angle); }

  // Legendre moment chi_l of the phase function, l < AnglePanels::kMostMoments.
  ParticleValue moment(int l) const;
  // Those of the scattering matrix of spheres, with its elements P12 and P33, docs/theory (13.18).
  struct MatrixMoments {
    ParticleValue alpha, zeta, gamma;
  };
  MatrixMoments matrix_moments(int l) const;

 private:
  friend class ParticleSums;
  friend class KeptOptics;
  using OfAngles = std::array<std::vector<double>, kParticleSlopes>;

  ParticleValue at(const OfAngles& values, double angle) const;
  ParticleValue integral(const double* weights, const OfAngles& values) const;

  std::shared_ptr<const AnglePanels> panels_;
  OfAngles phase_, polarising_, turning_;  // P11, P12 and P33
};

// Keeps what was computed: the spheres of an index over a fixed grid of the logarithm of the size
// parameter, and the optics of the latest modes. Any number of threads.
class ParticleTables {
 public:
  ParticleTables();
  ~ParticleTables();

  // Throws std::invalid_argument unless largest_radius_um() has a size parameter of at most
  // kLargestSizeParameter.
  std::shared_ptr<const ParticleOptics> optics(const ParticleMode& mode, bool by_index) const;

 private:
  struct Spheres;  // of one index
  struct Made {
    ParticleMode mode;
    bool by_index;
    std::shared_ptr<const ParticleOptics> optics;
  };

  Spheres& spheres_of(std::complex<double> index) const;

  std::shared_ptr<const AnglePanels> panels_;
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<Spheres>> spheres_;  // the latest ones last
  mutable std::vector<Made> made_;                         // the latest ones last
};

// Where the optics of modes are kept from one process to the next; null, as at first: nowhere. For
// atmospheres that stay as they are: a fit of radii would leave what is never asked for again.
void keep_particles_in(std::shared_ptr<ContentCache> cache);

// The distribution is cut off here, four widths above its median: 1e-5 of the extinction of large
// spheres and 2e-4 of what they scatter straight ahead lie beyond.
double largest_radius_um(double radius_um, double width);

}  // namespace skyfit
