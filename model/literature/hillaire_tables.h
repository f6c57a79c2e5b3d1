// SPDX-License-Identifier: Apache-2.0
// The look-ups of Hillaire 2020 at one wavelength, with derivatives. Values per unit solar
// irradiance.
//   Transmittance T(h, mu) to the top of the atmosphere, 256 x 64, mapping of Bruneton 2017.
//   Multiple scattering Psi(h, mu_s), 32 x 32, evenly over height and cosine of the sun's zenith
//   angle, from the mean <> over 64 directions of a sphere, scattering taken as isotropic:
//     L_2nd = < T albedo / pi mu_s T(sun) + integral sigma_s T T(sun) / (4 pi) ds >   (his eq. 5,
//     6) f_ms  = < integral sigma_s T ds >                                               (his eq.
//     7, 8) Psi   = L_2nd (1 + f_ms + f_ms^2 + ...) = L_2nd / (1 - f_ms)                    (his
//     eq. 9, 10)
//   View rays: L = integral T (sum_i sigma_i P_i(nu) T(sun) + sigma_s Psi) ds         (his eq. 11)
//   Sky view, 192 x 108 for one eye and one sun (model/shared/hillaire_mapping.glsl): L of rays to
//   the sky of an eye in the air. Its texels are computed when they are read.
#pragma once

#include <cstdint>
#include <vector>

#include "model/literature/evaluate.h"
#include "model/literature/grid.h"

namespace skyfit::literature {

struct HillaireSizes {
  static constexpr int transmittance_mu = 256, transmittance_r = 64;
  static constexpr int multiple_mu_s = 32, multiple_r = 32;
  static constexpr int zeniths = 8, azimuths = 8;  // of the 64 directions
  static constexpr int multiple_steps = 20, view_steps = 30;
  static constexpr int sky_view_azimuth = 192, sky_view_rows = 108;
};

// Everything that depends on radii and profiles alone, for all wavelengths.
class HillaireGeometry {
 public:
  explicit HillaireGeometry(const Atmosphere<double>& atmosphere);

  // A beam of the sun: the share of its disc above the horizon, on the ground times the cosine of
  // its zenith angle, and where it stands on the axis mu of the transmittance.
  struct Beam {
    float weight = 0, part = 0;
    std::int32_t low = 0;
    Between mu() const { return {low, static_cast<double>(part)}; }
  };
  Beam beam(double height, double mu_s) const;

  // A ray of the multiple scattering: its steps and, where it ends there, the ground.
  struct Place {
    double length = 0, height = 0;  // m; the length is that of the step
    Between r;                      // in the transmittance
    std::vector<Beam> suns;         // [mu_s][azimuth]
  };
  struct Ray {
    std::vector<Place> steps;
    bool hits_ground = false;
    Place ground;
  };
  static constexpr int kHalfAzimuths = HillaireSizes::azimuths / 2;  // the others mirror them

  const Shells& shells() const { return shells_; }
  double bottom() const { return shells_.bottom_radius; }
  double thickness() const { return shells_.top; }
  const Ray& ray(int r, int zenith) const {
    return rays_[static_cast<std::size_t>(r * HillaireSizes::zeniths + zenith)];
  }
  const PathColumns& columns(int r, int mu) const {
    return columns_[static_cast<std::size_t>(r * HillaireSizes::transmittance_mu + mu)];
  }
  Between transmittance_r(double height) const;
  double multiple_height(int r) const {
    return thickness() * unit_of(r, HillaireSizes::multiple_r);
  }
  static double multiple_sun(int i) { return 2 * unit_of(i, HillaireSizes::multiple_mu_s) - 1; }

 private:
  Place place_on_ray(double height, double mu, double s, double step) const;
  Ray make_ray(double height, double mu) const;

  Shells shells_;
  std::vector<PathColumns> columns_;  // of the transmittance's texels, to the top
  std::vector<Ray> rays_;             // [r][zenith]
};

template <int N>
class HillaireTables {
 public:
  // Runs on the threads of the task arena. `geometry` is that of the atmosphere, and outlives the
  // tables; the transmittance and the multiple scattering are filled, whatever the views. Throws
  // std::invalid_argument where f_ms is so near 1 that the series has no meaning.
  HillaireTables(const HillaireGeometry& geometry, const ClearAir<N>& air, std::span<const View>);

  // Of the whole ray: to the sky, from an eye in the air, by the sky-view look-up; else marched.
  // `air` holds all that was scattered more than once.
  RayLight<N> light(const View& view) const;
  // Marched, without the ground.
  RayLight<N> scattered(const View& view) const;

  // The single scattering without phase functions, and all further scattering, 1/sr.
  struct Marched {
    Dual<N> air, aerosol, multiple;
  };
  // Along `length` metres from a place; cosines there of view and sun zenith and of the angle
  // between them.
  Marched march(double height, double mu, double mu_s, double nu, double length) const;

  Dual<N> transmittance(double height, double mu) const;  // to the top; the ray misses the ground
  Dual<N> multiple(double height, double mu_s) const;     // Psi, 1/sr
  Dual<N> transfer(int r) const { return transfer_[static_cast<std::size_t>(r)]; }  // f_ms

  // air: the transmittance [r][mu]; aerosol: the multiple scattering [r][mu_s].
  SkyRayTexels sky_rays() const;

  std::size_t bytes() const;

 private:
  struct Medium {
    Dual<N> air, aerosol, extinction;  // 1/m
  };
  Medium medium(double height) const;
  void fill_transmittance();
  void fill_multiple(int r);
  Dual<N> mean_sun_light(const HillaireGeometry::Place& place, int sun) const;
  RayLight<N> phased(const Marched& marched, double nu) const;
  RayLight<N> sky_view(const View& view) const;

  const HillaireGeometry& geometry_;
  ClearAir<N> air_;
  Grid<N, 2> transmittance_;       // [r][mu]
  Grid<N, 2> multiple_;            // [r][mu_s]
  std::vector<Dual<N>> transfer_;  // [r]
};

extern template class HillaireTables<0>;
extern template class HillaireTables<kTablesAtOnce>;

}  // namespace skyfit::literature
