// SPDX-License-Identifier: Apache-2.0
#include "model/literature/bruneton_tables.h"

#include <tbb/parallel_for.h>

#include <numbers>

#include "model/atmosphere/phase_moments.h"
#include "model/literature/slab_kernels.h"
#include "model/literature/sun_columns.h"
#include "model/numerics/hemisphere.h"
#include "model/shared/shared.h"

namespace skyfit::literature {
namespace {

using Sizes = BrunetonSizes;
constexpr double kPi = std::numbers::pi;
constexpr int kSunNu = Sizes::mu_s * Sizes::nu;  // texels of one ray
constexpr int kTheta = 16, kPhi = 16;            // incoming directions; azimuths of half the circle
constexpr int kModes = kPhi;                     // cosines of the azimuth

// cos(m x) for m below kModes and `count` angles x.
template <class Angle>
std::vector<double> mode_cosines(int count, const Angle& angle) {
  std::vector<double> cosines;
  for (int i = 0; i < count; ++i) {
    for (int m = 0; m < kModes; ++m) cosines.push_back(std::cos(m * angle(i)));
  }
  return cosines;
}

double theta_of(int i) { return kPi * (i + 0.5) / kTheta; }
double phi_of(int k) { return kPi * (k + 0.5) / kPhi; }

}  // namespace

// Fills the tables order by order.
template <int N>
class BrunetonSolver {
 public:
  explicit BrunetonSolver(BrunetonTables<N>& tables)
      : tables_(tables),
        geometry_(tables.geometry_),
        air_(tables.air_),
        source_({Sizes::r, Sizes::mu, Sizes::mu_s, Sizes::nu}),
        order_({Sizes::r, Sizes::mu, Sizes::mu_s, Sizes::nu}),
        ground_(Sizes::irradiance_mu_s) {}

  void solve(int orders) {
    fill_optical_depth();
    const SunColumns<N> sun(geometry_.shells(), [&](double height, double mu) {
      return tables_.optical_depth(height, mu);
    });
    for (int i = 0; i < Sizes::irradiance_mu_s; ++i) {
      const double mu_s = irradiance_sun(i);
      if (mu_s > 0) ground_[static_cast<std::size_t>(i)] = mu_s * sun.light(0, mu_s);
    }
    single_scattering(sun);
    if (orders > 1) make_phase_modes();
    std::vector<Dual<N>> sky = add_irradiance(1);
    for (int k = 2; k <= orders; ++k) {
      tbb::parallel_for(0, Sizes::r, [&](int r) { scattering_density(r, k); });
      ground_ = sky;
      integrate();
      sky = add_irradiance(k);
    }
  }

 private:
  static double irradiance_sun(int i) { return 2 * unit_of(i, Sizes::irradiance_mu_s) - 1; }

  void fill_optical_depth() {
    Shared<double> shared;
    const double bottom = geometry_.bottom(), thickness = geometry_.thickness();
    tbb::parallel_for(0, Sizes::transmittance_r, [&](int r) {
      const double height = std::min(
          shared.bruneton_height_from_unit(unit_of(r, Sizes::transmittance_r), bottom, thickness),
          thickness);
      for (int i = 0; i < Sizes::transmittance_mu; ++i) {
        const double mu = shared.mu_from_upward_unit(unit_of(i, Sizes::transmittance_mu), height,
                                                     bottom, thickness);
        tables_.optical_depth_.at({r, i}) =
            air_.optical_depth(geometry_.shells().columns_to_top(height, mu));
      }
    });
  }

  void single_scattering(const SunColumns<N>& sun) {
    tbb::parallel_for(0, Sizes::r * Sizes::mu, [&](int i) {
      const int r = i / Sizes::mu, mu = i % Sizes::mu;
      const BrunetonGeometry::Ray& ray = geometry_.ray(r, mu);
      Dual<N>* rayleigh = &tables_.rayleigh_like_.at({r, mu, 0, 0});
      Dual<N>* mie = &tables_.single_mie_.at({r, mu, 0, 0});
      for (const BrunetonGeometry::Node& node : ray.nodes) {
        const auto density = air_.densities(node.at.height);
        const Dual<N> through = node.at.weight * exp(-air_.optical_depth(node.at.columns));
        const Dual<N> by_air = through * air_.air * density.air,
                      by_aerosol = through * air_.aerosol_scattering * density.aerosol;
        const Between row = sun.row(node.at.height);
        for (int k = 0; k < kSunNu; ++k) {
          const Dual<N> light = sun.light(
              row, geometry_.sun_along(ray, node.at, ray.suns[static_cast<std::size_t>(k)]));
          add_product(by_air, light, rayleigh[k]);
          add_product(by_aerosol, light, mie[k]);
        }
      }
    });
  }

  // P(mu, theta, difference of azimuths) = sum_m modes_[r][mu][theta][m] cos(m difference), of the
  // aerosol, scaled so that what a direction scatters in all over the sphere adds up to 1: the
  // sixteen polar angles do not resolve a forward peak.
  void make_phase_modes() {
    constexpr int kDifferences = 2 * kModes + 1;  // of half the circle
    const auto difference_of = [](int d) { return kPi * unit_of(d, kDifferences); };
    const std::vector<double> cosines = mode_cosines(kDifferences, difference_of);
    modes_.resize(static_cast<std::size_t>(Sizes::r) * Sizes::mu * kTheta * kModes);
    tbb::parallel_for(0, Sizes::r * Sizes::mu, [&](int i) {
      const double mu = geometry_.ray(i / Sizes::mu, i % Sizes::mu).mu;
      const double sine = std::sqrt(std::max(1 - mu * mu, 0.0));
      Dual<N>* modes = &modes_[static_cast<std::size_t>(i) * kTheta * kModes];
      Dual<N> sum(0.0);
      for (int t = 0; t < kTheta; ++t) {
        const double z = std::cos(theta_of(t)), z_sine = std::sin(theta_of(t));
        for (int d = 0; d < kDifferences; ++d) {
          const Dual<N> phase = phase_value(
              air_.phase,
              std::clamp(mu * z + sine * z_sine * cosines[static_cast<std::size_t>(d * kModes + 1)],
                         -1.0, 1.0));
          const double share = (d == 0 || d == kDifferences - 1 ? 0.5 : 1.0) / (kDifferences - 1);
          for (int m = 0; m < kModes; ++m) {
            add_scaled((m == 0 ? 1 : 2) * share * cosines[static_cast<std::size_t>(d * kModes + m)],
                       phase, modes[t * kModes + m]);
          }
        }
        add_scaled(2 * kPi * (kPi / kTheta) * z_sine, modes[t * kModes], sum);
      }
      for (int k = 0; k < kTheta * kModes; ++k) modes[k] /= sum;
    });
  }

  // The light of order k - 1 that comes from the direction (theta, phi), of the sun's texel.
  // `single` is P_M of the directions over their sum, `k` 2 for the first.
  Dual<N> incoming(int r, const Between& mu, int sun, double nu, int k,
                   const Dual<N>& single) const {
    const Between at = between(Shared<double>{}.bruneton_unit_from_nu(nu), Sizes::nu);
    const std::array<Between, 4> place = {
        Between{std::min(r, Sizes::r - 2), r == Sizes::r - 1 ? 1.0 : 0.0},
        mu,
        {std::min(sun, Sizes::mu_s - 2), sun == Sizes::mu_s - 1 ? 1.0 : 0.0},
        at};
    if (k > 2) return order_.linear(place);
    return Shared<double>{}.rayleigh_phase(air_.depolarisation, nu) *
               tables_.rayleigh_like_.linear(place) +
           single * tables_.single_mie_.linear(place);
  }

  // The aerosol's phase function toward the sun over its sum, [theta][phi].
  std::vector<Dual<N>> phase_to_sun(double mu_s) const {
    std::vector<Dual<N>> phase(static_cast<std::size_t>(kTheta) * kPhi);
    const double sun_sine = std::sqrt(std::max(1 - mu_s * mu_s, 0.0));
    Dual<N> sum(0.0);
    for (int t = 0; t < kTheta; ++t) {
      for (int f = 0; f < kPhi; ++f) {
        const double nu =
            std::cos(theta_of(t)) * mu_s + std::sin(theta_of(t)) * sun_sine * std::cos(phi_of(f));
        Dual<N>& p = phase[static_cast<std::size_t>(t * kPhi + f)];
        p = phase_value(air_.phase, std::clamp(nu, -1.0, 1.0));
        add_scaled(solid_angle(t), p, sum);
      }
    }
    for (Dual<N>& p : phase) p /= sum;
    return phase;
  }
  static double solid_angle(int theta) {  // of a direction and its mirror image
    return 2 * (kPi / kTheta) * (kPi / kPhi) * std::sin(theta_of(theta));
  }

  struct Incoming {
    std::array<Dual<N>, kTheta * kModes> modes;  // cosines of the azimuth, times solid angle
    Dual<N> mean, zz, xx, yy, xz;                // integrals of L and of L w_i w_j
  };
  Incoming incoming_light(int r, int sun, int k, const std::vector<Dual<N>>& single) const {
    Shared<double> shared;
    const double height = geometry_.ray(r, 0).height, mu_s = geometry_.sun_of_texel(sun);
    const double sun_sine = std::sqrt(std::max(1 - mu_s * mu_s, 0.0));
    const double bottom = geometry_.bottom();
    Incoming in{};
    for (int t = 0; t < kTheta; ++t) {
      const double z = std::cos(theta_of(t)), sine = std::sin(theta_of(t));
      const bool ground = shared.ray_hits_ground(height, z, bottom);
      const Between mu = geometry_.mu_texel(height, z, ground);
      Dual<N> reflected(0.0);
      double distance = 0;
      if (ground) {
        const ViewRay down = table_ray(geometry_.shells(), height, z, true);
        distance = down.length;
        reflected = air_.ground_albedo * (1 / kPi) *
                    exp(-air_.optical_depth(columns_along(geometry_.shells(), down,
                                                          ray_point(down, bottom, distance))));
      }
      for (int f = 0; f < kPhi; ++f) {
        const double nu = std::clamp(z * mu_s + sine * sun_sine * std::cos(phi_of(f)), -1.0, 1.0);
        Dual<N> light = incoming(r, mu, sun, nu, k, single[static_cast<std::size_t>(t * kPhi + f)]);
        if (ground) {
          add_product(reflected, ground_light(((bottom + height) * mu_s + distance * nu) / bottom),
                      light);
        }
        light = solid_angle(t) * light;
        const double x = sine * std::cos(phi_of(f)), y = sine * std::sin(phi_of(f));
        in.mean += light;
        add_scaled(z * z, light, in.zz);
        add_scaled(x * x, light, in.xx);
        add_scaled(y * y, light, in.yy);
        add_scaled(x * z, light, in.xz);
        for (int m = 0; m < kModes; ++m) {
          add_scaled(cosines_[static_cast<std::size_t>(f * kModes + m)], light,
                     in.modes[static_cast<std::size_t>(t * kModes + m)]);
        }
      }
    }
    return in;
  }
  Dual<N> ground_light(double mu_s) const {
    const Between at = between(0.5 * (mu_s + 1), Sizes::irradiance_mu_s);
    Dual<N> light = (1 - at.part) * ground_[static_cast<std::size_t>(at.low)];
    add_scaled(at.part, ground_[static_cast<std::size_t>(at.low + 1)], light);
    return light;
  }

  // Light of order k - 1 that air and aerosol at the height of r scatter, per metre.
  void scattering_density(int r, int k) {
    const double height = geometry_.ray(r, 0).height;
    const auto density = air_.densities(height);
    const Dual<N> air = air_.air * density.air, aerosol = air_.aerosol_scattering * density.aerosol;
    const double rho = air_.depolarisation, scale = 3 / (8 * kPi * (2 + rho));
    for (int sun = 0; sun < Sizes::mu_s; ++sun) {
      const double mu_s = geometry_.sun_of_texel(sun);
      const double sun_sine = std::sqrt(std::max(1 - mu_s * mu_s, 0.0));
      const std::vector<Dual<N>> single = phase_to_sun(mu_s);
      const Incoming in = incoming_light(r, sun, k, single);
      for (int i = 0; i < Sizes::mu; ++i) {
        const double mu = geometry_.ray(r, i).mu, sine = std::sqrt(std::max(1 - mu * mu, 0.0));
        const std::array<Dual<N>, kModes> modes = outgoing_modes(r, i, in);
        Dual<N>* out = &source_.at({r, i, sun, 0});
        for (int n = 0; n < Sizes::nu; ++n) {
          const double cosine = std::clamp(
              (geometry_.ray(r, i).suns[static_cast<std::size_t>(sun * Sizes::nu + n)].nu -
               mu * mu_s) /
                  std::max(sine * sun_sine, 1e-7),
              -1.0, 1.0);
          Dual<N> by_aerosol(0.0), second(0.0);
          double now = 1, before = cosine;  // Chebyshev: cos(m phi)
          for (std::size_t m = 0; m < kModes; ++m) {
            add_scaled(now, modes[m], by_aerosol);
            const double next = 2 * cosine * now - before;
            before = now;
            now = next;
          }
          const double x = sine * cosine, y2 = sine * sine * (1 - cosine * cosine);
          add_scaled(mu * mu, in.zz, second);
          add_scaled(x * x, in.xx, second);
          add_scaled(y2, in.yy, second);
          add_scaled(2 * x * mu, in.xz, second);
          Dual<N> by_air = scale * (1 + rho) * in.mean;
          add_scaled(scale * (1 - rho), second, by_air);
          out[n] = air * by_air;
          add_product(aerosol, by_aerosol, out[n]);
        }
      }
    }
  }
  std::array<Dual<N>, kModes> outgoing_modes(int r, int mu, const Incoming& in) const {
    std::array<Dual<N>, kModes> out{};
    const Dual<N>* phase =
        &modes_[(static_cast<std::size_t>(r) * Sizes::mu + static_cast<std::size_t>(mu)) * kTheta *
                kModes];
    for (int t = 0; t < kTheta; ++t) {
      for (std::size_t m = 0; m < kModes; ++m) {
        const std::size_t at = static_cast<std::size_t>(t) * kModes + m;
        add_product(phase[at], in.modes[at], out[m]);
      }
    }
    return out;
  }

  // The source along every ray: the light of the next order, added to the table.
  void integrate() {
    tbb::parallel_for(0, Sizes::r * Sizes::mu, [&](int i) {
      const int r = i / Sizes::mu, mu = i % Sizes::mu;
      const BrunetonGeometry::Ray& ray = geometry_.ray(r, mu);
      Dual<N>* out = &order_.at({r, mu, 0, 0});
      std::fill_n(out, kSunNu, Dual<N>(0.0));
      std::vector<Dual<N>> slab(kSunNu);
      for (const BrunetonGeometry::Node& node : ray.nodes) {
        const Dual<N> through = node.at.weight * exp(-air_.optical_depth(node.at.columns));
        SlabNode term{{}, {}, node.sun.data(), &through.v};
        for (int c = 0; c < 4; ++c) {
          term.corner[c] = &source_.at({node.r.low + c / 2, node.mu.low + c % 2, 0, 0}).v;
          term.weight[c] =
              (c / 2 ? node.r.part : 1 - node.r.part) * (c % 2 ? node.mu.part : 1 - node.mu.part);
        }
        add_node(N, term, &slab[0].v, &out->v);
      }
      Dual<N>* sum = &tables_.rayleigh_like_.at({r, mu, 0, 0});
      for (int k = 0; k < kSunNu; ++k) {
        add_scaled(1 / Shared<double>{}.rayleigh_phase(air_.depolarisation,
                                                       ray.suns[static_cast<std::size_t>(k)].nu),
                   out[k], sum[k]);
      }
    });
  }
  // Of order k, on the horizontal at a height, over the cosine of the sun.
  std::vector<Dual<N>> irradiance_row(double height, int k) const {
    constexpr int kPolar = 20, kAzimuth = 12;
    Shared<double> shared;
    std::vector<Dual<N>> row(Sizes::irradiance_mu_s);
    const Between r = geometry_.r_texel(height, Sizes::r);
    tbb::parallel_for(0, Sizes::irradiance_mu_s, [&](int i) {
      const double mu_s = irradiance_sun(i);
      const Between sun = geometry_.sun_texel(mu_s);
      for (const SkySample& sample : sky_samples(mu_s, kPolar, kAzimuth)) {
        const std::array<Between, 4> at = {
            r, geometry_.mu_texel(height, sample.mu, false), sun,
            between(shared.bruneton_unit_from_nu(sample.nu), Sizes::nu)};
        Dual<N> light;
        if (k > 1) {
          light = order_.linear(at);
        } else {
          light = shared.rayleigh_phase(air_.depolarisation, sample.nu) *
                      tables_.rayleigh_like_.linear(at) +
                  phase_value(air_.phase, sample.nu) * tables_.single_mie_.linear(at);
        }
        add_scaled(sample.weight, light, row[static_cast<std::size_t>(i)]);
      }
    });
    return row;
  }
  // Returns that of the ground, the one row of which derivatives are known.
  std::vector<Dual<N>> add_irradiance(int k) {
    std::vector<Dual<N>> ground;
    for (int r = 0; r < (N == 0 ? Sizes::irradiance_r : 1); ++r) {
      const double height = geometry_.thickness() * unit_of(r, Sizes::irradiance_r);
      const std::vector<Dual<N>> row = irradiance_row(height, k);
      for (int i = 0; i < Sizes::irradiance_mu_s; ++i)
        tables_.irradiance_.at({r, i}) += row[static_cast<std::size_t>(i)];
      if (r == 0) ground = row;
    }
    return ground;
  }

  BrunetonTables<N>& tables_;
  const BrunetonGeometry& geometry_;
  const ClearAir<N>& air_;
  Grid<N, 4> source_, order_;    // [r][mu][mu_s][nu]
  std::vector<Dual<N>> ground_;  // irradiance of the ground whose reflection comes next
  std::vector<Dual<N>> modes_;   // [r][mu][theta][m]
  const std::vector<double> cosines_ = mode_cosines(kPhi, phi_of);  // [phi][m]
};

template <int N>
BrunetonTables<N>::BrunetonTables(const BrunetonGeometry& geometry, const ClearAir<N>& air,
                                  std::span<const View>, const BrunetonChoices& choices)
    : geometry_(geometry),
      air_(air),
      choices_(choices),
      optical_depth_({Sizes::transmittance_r, Sizes::transmittance_mu}),
      half_transmittance_({0, 0}),
      irradiance_({Sizes::irradiance_r, Sizes::irradiance_mu_s}),
      rayleigh_like_({Sizes::r, Sizes::mu, Sizes::mu_s, Sizes::nu}),
      single_mie_({Sizes::r, Sizes::mu, Sizes::mu_s, Sizes::nu}) {
  BrunetonSolver<N>(*this).solve(kOrders);
  round_to_half();
}

template class BrunetonTables<0>;
template class BrunetonTables<kTablesAtOnce>;

}  // namespace skyfit::literature
