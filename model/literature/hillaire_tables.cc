// SPDX-License-Identifier: Apache-2.0
#include "model/literature/hillaire_tables.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <numbers>
#include <stdexcept>

#include "model/atmosphere/phase_moments.h"
#include "model/geometry/sun_disc.h"
#include "model/literature/table_rays.h"
#include "model/shared/shared.h"

namespace skyfit::literature {
namespace {

using Sizes = HillaireSizes;
constexpr double kPi = std::numbers::pi;
constexpr double kIsotropic = 0.25 * std::numbers::inv_pi;  // 1/sr
constexpr int kHalfAzimuths = HillaireGeometry::kHalfAzimuths;

// Zenith angles that are even in their cosine, azimuths from the sun that are even.
double direction_mu(int zenith) { return 1 - 2 * (zenith + 0.5) / Sizes::zeniths; }
double direction_azimuth(int i) { return 2 * kPi * (i + 0.5) / Sizes::azimuths; }

double sine_of(double cosine) { return std::sqrt(std::max(1 - cosine * cosine, 0.0)); }

// Cosine of the sun's zenith angle at a distance along a ray from height h.
double sun_after(double bottom, double h, double mu_s, double nu, double s, double height) {
  return std::clamp(((bottom + h) * mu_s + s * nu) / (bottom + height), -1.0, 1.0);
}

// What a step lets through, exp(-x), and its mean over the step, (1 - exp(-x)) / x.
template <int N>
struct Passage {
  Dual<N> through, mean;
};
template <int N>
Passage<N> passage(const Dual<N>& depth) {
  const double x = depth.v, through = std::exp(-x);
  const Dual<N> passing = depth.chain(through, -through);
  if (x < 1e-3) return {passing, depth.chain(1 - x * (0.5 - x / 6), -0.5 + x / 3)};  // to 1e-7
  const double mean = (1 - through) / x;
  return {passing, depth.chain(mean, (through - mean) / x)};
}

}  // namespace

HillaireGeometry::HillaireGeometry(const Atmosphere<double>& atmosphere)
    : shells_(shells_of(atmosphere, Keep::kAll)),
      columns_(static_cast<std::size_t>(Sizes::transmittance_r) * Sizes::transmittance_mu),
      rays_(static_cast<std::size_t>(Sizes::multiple_r) * Sizes::zeniths) {
  Shared<double> shared;
  tbb::parallel_for(0, Sizes::transmittance_r, [&](int r) {
    const double height = std::min(
        shared.bruneton_height_from_unit(unit_of(r, Sizes::transmittance_r), bottom(), thickness()),
        thickness());
    for (int i = 0; i < Sizes::transmittance_mu; ++i) {
      const double mu = shared.mu_from_upward_unit(unit_of(i, Sizes::transmittance_mu), height,
                                                   bottom(), thickness());
      columns_[static_cast<std::size_t>(r * Sizes::transmittance_mu + i)] =
          shells_.columns_to_top(height, mu);
    }
  });
  tbb::parallel_for(0, Sizes::multiple_r * Sizes::zeniths, [&](int i) {
    rays_[static_cast<std::size_t>(i)] =
        make_ray(multiple_height(i / Sizes::zeniths), direction_mu(i % Sizes::zeniths));
  });
}

HillaireGeometry::Place HillaireGeometry::place_on_ray(double h, double mu, double s,
                                                       double step) const {
  const double height =
      std::clamp(Shared<double>{}.height_after(bottom(), h, mu, s), 0.0, thickness());
  Place place{step, height, transmittance_r(height), {}};
  for (int sun = 0; sun < Sizes::multiple_mu_s; ++sun) {
    const double mu_s = multiple_sun(sun);
    for (int k = 0; k < kHalfAzimuths; ++k) {
      const double nu = mu * mu_s + sine_of(mu) * sine_of(mu_s) * std::cos(direction_azimuth(k));
      place.suns.push_back(beam(height, sun_after(bottom(), h, mu_s, nu, s, height)));
    }
  }
  return place;
}

HillaireGeometry::Ray HillaireGeometry::make_ray(double h, double mu) const {
  Shared<double> shared;
  Ray ray;
  ray.hits_ground = shared.ray_hits_ground(h, mu, bottom());
  const double length = table_ray(shells_, h, mu, ray.hits_ground).length;
  const double step = length / Sizes::multiple_steps;
  for (int i = 0; i < Sizes::multiple_steps && length > 0; ++i)
    ray.steps.push_back(
        place_on_ray(h, mu, shared.hillaire_sample(i * step, (i + 1) * step), step));
  if (!ray.hits_ground) return ray;
  ray.ground = place_on_ray(h, mu, length, 0);
  for (std::size_t i = 0; i < ray.ground.suns.size(); ++i) {
    const int sun = static_cast<int>(i) / kHalfAzimuths, k = static_cast<int>(i) % kHalfAzimuths;
    const double mu_s = multiple_sun(sun);
    const double nu = mu * mu_s + sine_of(mu) * sine_of(mu_s) * std::cos(direction_azimuth(k));
    ray.ground.suns[i].weight *=
        static_cast<float>(std::max(sun_after(bottom(), h, mu_s, nu, length, 0), 0.0));
  }
  return ray;
}

HillaireGeometry::Beam HillaireGeometry::beam(double height, double mu_s) const {
  const double visible = visible_sun(bottom(), height, mu_s, shells_.sun_radius);
  if (visible <= 0) return {};
  const double mu = std::max(mu_s, horizon_cosine(bottom(), height));
  const Between at =
      between(Shared<double>{}.unit_from_upward_ray(height, mu, bottom(), thickness()),
              Sizes::transmittance_mu);
  return {static_cast<float>(visible), static_cast<float>(at.part), at.low};
}

Between HillaireGeometry::transmittance_r(double height) const {
  return between(Shared<double>{}.bruneton_unit_from_height(height, bottom(), thickness()),
                 Sizes::transmittance_r);
}

template <int N>
HillaireTables<N>::HillaireTables(const HillaireGeometry& geometry, const ClearAir<N>& air,
                                  std::span<const View>)
    : geometry_(geometry),
      air_(air),
      transmittance_({Sizes::transmittance_r, Sizes::transmittance_mu}),
      multiple_({Sizes::multiple_r, Sizes::multiple_mu_s}),
      transfer_(Sizes::multiple_r) {
  fill_transmittance();
  tbb::parallel_for(0, Sizes::multiple_r, [&](int r) { fill_multiple(r); });
}

template <int N>
void HillaireTables<N>::fill_transmittance() {
  tbb::parallel_for(0, Sizes::transmittance_r, [&](int r) {
    for (int i = 0; i < Sizes::transmittance_mu; ++i)
      transmittance_.at({r, i}) = exp(-air_.optical_depth(geometry_.columns(r, i)));
  });
}

template <int N>
typename HillaireTables<N>::Medium HillaireTables<N>::medium(double height) const {
  const Densities<N> density = static_cast<const Optics<N>&>(air_).densities(height);
  Medium medium;
  for (std::size_t i = 0; i < air_.extinction.size(); ++i)
    add_product(air_.extinction[i], density[i], medium.extinction);
  if (air_.air_profile >= 0)
    medium.air = air_.air * density[static_cast<std::size_t>(air_.air_profile)];
  if (air_.aerosol_profile >= 0)
    medium.aerosol =
        air_.aerosol_scattering * density[static_cast<std::size_t>(air_.aerosol_profile)];
  return medium;
}

// The sun's light at a place, mean over the azimuths.
template <int N>
Dual<N> HillaireTables<N>::mean_sun_light(const HillaireGeometry::Place& place, int sun) const {
  Dual<N> sum(0.0);
  for (int k = 0; k < kHalfAzimuths; ++k) {
    const HillaireGeometry::Beam& beam =
        place.suns[static_cast<std::size_t>(sun * kHalfAzimuths + k)];
    if (beam.weight <= 0) continue;
    add_scaled(static_cast<double>(beam.weight) / kHalfAzimuths,
               transmittance_.linear({place.r, beam.mu()}), sum);
  }
  return sum;
}

template <int N>
void HillaireTables<N>::fill_multiple(int r) {
  Dual<N> transfer(0.0), escaping(0.0);  // f_ms and 1 - f_ms, which keeps its digits
  std::vector<Dual<N>> second(Sizes::multiple_mu_s);
  for (int zenith = 0; zenith < Sizes::zeniths; ++zenith) {
    const HillaireGeometry::Ray& ray = geometry_.ray(r, zenith);
    Dual<N> through(1.0 / Sizes::zeniths);  // the share of the direction in the mean
    for (const HillaireGeometry::Place& step : ray.steps) {
      const Medium at = medium(step.height);
      const Passage<N> passing = passage(step.length * at.extinction);
      const Dual<N> reaching = step.length * through * passing.mean;
      const Dual<N> scattering = at.air + at.aerosol;
      transfer += reaching * scattering;
      escaping += reaching * (at.extinction - scattering);
      for (int sun = 0; sun < Sizes::multiple_mu_s; ++sun) {
        add_product(kIsotropic * reaching * scattering, mean_sun_light(step, sun),
                    second[static_cast<std::size_t>(sun)]);
      }
      through *= passing.through;
    }
    escaping += through;
    if (!ray.hits_ground) continue;
    const Dual<N> reflected = air_.ground_albedo * (1 / kPi) * through;
    for (int sun = 0; sun < Sizes::multiple_mu_s; ++sun)
      add_product(reflected, mean_sun_light(ray.ground, sun),
                  second[static_cast<std::size_t>(sun)]);
  }
  constexpr double kMostOrders = 1000;  // that light would be scattered on the average
  if (!(escaping.v * kMostOrders > 1)) {
    throw std::invalid_argument(fmt::format(
        "hillaire model: at {:.0f} m the air hands on {:.9g} of its light to the next order of "
        "scattering: expected less than {:.9g}, beyond which the sum of orders has no meaning",
        geometry_.multiple_height(r), transfer.v, 1 - 1 / kMostOrders));
  }
  transfer_[static_cast<std::size_t>(r)] = transfer;
  for (int sun = 0; sun < Sizes::multiple_mu_s; ++sun)
    multiple_.at({r, sun}) = second[static_cast<std::size_t>(sun)] / escaping;
}

template <int N>
Dual<N> HillaireTables<N>::transmittance(double height, double mu) const {
  return transmittance_.linear({geometry_.transmittance_r(height),
                                between(Shared<double>{}.unit_from_upward_ray(
                                            height, mu, geometry_.bottom(), geometry_.thickness()),
                                        Sizes::transmittance_mu)});
}

template <int N>
Dual<N> HillaireTables<N>::multiple(double height, double mu_s) const {
  return multiple_.linear({between(height / geometry_.thickness(), Sizes::multiple_r),
                           between(0.5 * (mu_s + 1), Sizes::multiple_mu_s)});
}

template <int N>
typename HillaireTables<N>::Marched HillaireTables<N>::march(double h, double mu, double mu_s,
                                                             double nu, double length) const {
  Shared<double> shared;
  const double bottom = geometry_.bottom();
  Marched marched;
  Dual<N> through(1.0);
  for (int i = 0; i < Sizes::view_steps; ++i) {
    const double begin = length * shared.hillaire_step_begin(i, Sizes::view_steps),
                 end = length * shared.hillaire_step_begin(i + 1, Sizes::view_steps),
                 s = shared.hillaire_sample(begin, end);
    const double height =
        std::clamp(shared.height_after(bottom, h, mu, s), 0.0, geometry_.thickness());
    const double sun = sun_after(bottom, h, mu_s, nu, s, height);
    const Medium at = medium(height);
    const Passage<N> passing = passage((end - begin) * at.extinction);
    const Dual<N> reaching = (end - begin) * through * passing.mean;
    const HillaireGeometry::Beam beam = geometry_.beam(height, sun);
    if (beam.weight > 0) {
      const Dual<N> light = static_cast<double>(beam.weight) * reaching *
                            transmittance_.linear({geometry_.transmittance_r(height), beam.mu()});
      add_product(light, at.air, marched.air);
      add_product(light, at.aerosol, marched.aerosol);
    }
    add_product(reaching * multiple(height, sun), at.air + at.aerosol, marched.multiple);
    through *= passing.through;
  }
  return marched;
}

template <int N>
RayLight<N> HillaireTables<N>::phased(const Marched& marched, double nu) const {
  RayLight<N> light;
  light.air =
      Shared<double>{}.rayleigh_phase(air_.depolarisation, nu) * marched.air + marched.multiple;
  light.aerosol = phase_value(air_.phase, nu) * marched.aerosol;
  return light;
}

template <int N>
RayLight<N> HillaireTables<N>::sky_view(const View& view) const {
  Shared<double> shared;
  const double h = view.ray.entry_height, bottom = geometry_.bottom();
  const double row = shared.hillaire_row_from_unit(
      shared.hillaire_unit_from_view(std::clamp(view.ray.entry_mu, -1.0, 1.0), h, bottom),
      Sizes::sky_view_rows);
  const Between across = between(shared.hillaire_unit_from_azimuth(shared.cosine_of_azimuth(
                                     view.ray.entry_mu, view.mu_s, view.nu)),
                                 Sizes::sky_view_azimuth);
  const int low = std::min(static_cast<int>(row), Sizes::sky_view_rows / 2 - 2);
  RayLight<N> light;
  for (int corner = 0; corner < 4; ++corner) {
    const int down = corner / 2, right = corner % 2;
    const double part = row - low;
    const double weight =
        (down == 1 ? part : 1 - part) * (right == 1 ? across.part : 1 - across.part);
    if (weight == 0) continue;
    const double mu = shared.hillaire_view_from_unit(
        shared.hillaire_unit_from_row(low + down, Sizes::sky_view_rows), h, bottom);
    const double cosine =
        shared.hillaire_azimuth_from_unit(unit_of(across.low + right, Sizes::sky_view_azimuth));
    const double nu =
        std::clamp(mu * view.mu_s + sine_of(mu) * sine_of(view.mu_s) * cosine, -1.0, 1.0);
    const double length = shared.distance_to_outer_sphere(bottom, h, mu, geometry_.thickness());
    const RayLight<N> texel = phased(march(h, mu, view.mu_s, nu, length), nu);
    add_scaled(weight, texel.air, light.air);
    add_scaled(weight, texel.aerosol, light.aerosol);
  }
  return light;
}

template <int N>
RayLight<N> HillaireTables<N>::scattered(const View& view) const {
  const ViewRay& ray = view.ray;
  return phased(march(ray.entry_height, ray.entry_mu, view.mu_s, view.nu, ray.length), view.nu);
}

template <int N>
RayLight<N> HillaireTables<N>::light(const View& view) const {
  const ViewRay& ray = view.ray;
  if (ray.length <= 0 && !ray.hits_ground) return {};
  if (ray.entry_distance <= 0 && !ray.hits_ground) return sky_view(view);
  RayLight<N> light = scattered(view);
  if (ray.hits_ground) {
    light.ground =
        ground_light(geometry_.shells(), air_, view, [](double) { return Dual<N>(0.0); });
  }
  return light;
}

template <int N>
SkyRayTexels HillaireTables<N>::sky_rays() const {
  SkyRayTexels sky;
  sky.air = {Sizes::transmittance_mu, Sizes::transmittance_r, 1, {}};
  sky.aerosol = {Sizes::multiple_mu_s, Sizes::multiple_r, 1, {}};
  for (std::size_t i = 0; i < transmittance_.count(); ++i)
    sky.air.values.push_back(static_cast<float>(transmittance_[i].v));
  for (std::size_t i = 0; i < multiple_.count(); ++i)
    sky.aerosol.values.push_back(static_cast<float>(multiple_[i].v));
  return sky;
}

template <int N>
std::size_t HillaireTables<N>::bytes() const {
  return transmittance_.bytes() + multiple_.bytes();
}

template class HillaireTables<0>;
template class HillaireTables<kTablesAtOnce>;

}  // namespace skyfit::literature
