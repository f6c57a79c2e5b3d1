// SPDX-License-Identifier: Apache-2.0
#include "model/tables.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/gauss.h"
#include "model/ray.h"
#include "model/shared/shared.h"
#include "model/table_lookup.h"

namespace skyfit {
namespace {

Table make_table(int width, int height, int depth) {
  Table table{width, height, depth, {}};
  table.rgba.resize(4 * static_cast<std::size_t>(width) * height * depth);
  return table;
}

void store(Table& table, int x, int y, int z, const NodeValues& value) {
  const std::size_t texel = (static_cast<std::size_t>(z) * table.height + y) * table.width + x;
  for (std::size_t k = 0; k < 4; ++k) table.rgba[4 * texel + k] = static_cast<float>(value[k]);
}

NodeValues logarithm(NodeValues value) {
  for (double& v : value) v = std::log(std::max(v, kDarkestScattering));
  return value;
}

// Coefficients at the four nodes.
struct Coefficients {
  NodeValues air, aerosol_scattering, aerosol_extinction, ozone;

  NodeValues optical_depth(const PathColumns& c) const {
    NodeValues tau;
    for (std::size_t k = 0; k < 4; ++k) {
      tau[k] =
          air[k] * c.air.value + aerosol_extinction[k] * c.aerosol.value + ozone[k] * c.ozone.value;
    }
    return tau;
  }
};

double at(const PowerLaw<double>& law, double wavelength_nm) {
  return law.value * std::pow(wavelength_nm / law.wavelength_nm, -law.exponent);
}

Coefficients coefficients_of(const Atmosphere<double>& a, const ColorRule& color) {
  constexpr double kMoleculesPerDobson = 2.687e20;  // 1/m^2
  Coefficients c;
  const double ozone_depth = a.ozone.profile == OzoneProfile::kExponential
                                 ? a.rayleigh.scale_height_m
                                 : 0.5 * (kTentTop - kTentBottom);
  for (std::size_t k = 0; k < 4; ++k) {
    const WavelengthNode& node = color.nodes[k];
    c.air[k] = at(a.rayleigh.scattering_per_m, node.wavelength_nm);
    c.aerosol_scattering[k] = at(a.mie.scattering_per_m, node.wavelength_nm);
    c.aerosol_extinction[k] = c.aerosol_scattering[k] / a.mie.single_scattering_albedo;
    c.ozone[k] =
        a.ozone.column_du * kMoleculesPerDobson * node.ozone_cross_section_m2 / ozone_depth;
  }
  return c;
}

// One step of the quadrature along a ray: what does not depend on the sun.
struct Step {
  double distance, height;
  NodeValues air,
      aerosol;  // scattered toward the eye per unit of light from the sun and of phase function
};

class TableBuilder {
 public:
  TableBuilder(const Atmosphere<double>& atmosphere, const ColorRule& color,
               const TableSizes& sizes)
      : bottom_(atmosphere.bottom_radius_m),
        thickness_(atmosphere.top_radius_m - atmosphere.bottom_radius_m),
        coefficients_(coefficients_of(atmosphere, color)) {
    out_.atmosphere = atmosphere;
    out_.color = color;
    out_.sizes = sizes;
    const auto& a = atmosphere;
    shells_ = {bottom_,
               thickness_,
               a.rayleigh.scale_height_m,
               a.mie.scale_height_m,
               a.ozone.column_du > 0,
               a.ozone.profile == OzoneProfile::kExponential};
    for (const double part : {0.0, 0.25, 0.6, 1.0, 1.7, 2.5, 4.0}) {
      add_break(part * a.mie.scale_height_m);
      add_break(part * a.rayleigh.scale_height_m);
    }
    add_break(7 * a.rayleigh.scale_height_m);
    add_break(thickness_);
    std::sort(breaks_.begin(), breaks_.end());
  }

  AtmosphereTables build(const std::function<void(double)>& progress) {
    make_optical_depth();
    const TableSizes& s = out_.sizes;
    const int width = s.scattering_mu_s * s.scattering_nu;
    out_.rayleigh_like = make_table(width, s.scattering_mu, s.scattering_r);
    out_.single_mie = make_table(width, s.scattering_mu, s.scattering_r);
    for (int r = 0; r < s.scattering_r; ++r) {
      tbb::parallel_for(0, s.scattering_mu, [&](int mu) { scatter(mu, r); });
      if (progress) progress(0.9 * (r + 1) / s.scattering_r);
    }
    make_irradiance();
    if (progress) progress(1);
    return std::move(out_);
  }

 private:
  void add_break(double height) {
    if (height <= thickness_) breaks_.push_back(height);
  }

  double height_of(int index, int size) const {
    Shared<double> shared;
    return std::min(shared.height_from_unit(index / (size - 1.0), bottom_, thickness_), thickness_);
  }

  void make_optical_depth() {
    const TableSizes& s = out_.sizes;
    out_.optical_depth = make_table(s.optical_depth_mu, s.optical_depth_r, 1);
    tbb::parallel_for(0, s.optical_depth_r, [&](int y) {
      Shared<double> shared;
      const double h = height_of(y, s.optical_depth_r);
      for (int x = 0; x < s.optical_depth_mu; ++x) {
        const double unit = x / (s.optical_depth_mu - 1.0);
        const double mu = shared.mu_from_upward_unit(unit, h, bottom_, thickness_);
        store(out_.optical_depth, x, y, 0,
              coefficients_.optical_depth(shells_.columns_to_top(h, mu)));
      }
    });
  }

  // The ray of a texel; which half of the table it is in says whether it ends on the ground.
  ViewRay texel_ray(double h, double mu, bool hits_ground) const {
    Shared<double> shared;
    ViewRay ray;
    ray.entry_height = h;
    ray.entry_mu = mu;
    ray.hits_ground = hits_ground;
    ray.length = hits_ground ? shared.distance_to_inner_sphere(bottom_, h, mu, 0.0)
                             : shared.distance_to_outer_sphere(bottom_, h, mu, thickness_);
    ray.tangent_s = hits_ground ? ray.length : std::clamp(-(bottom_ + h) * mu, 0.0, ray.length);
    ray.tangent_height =
        hits_ground ? 0 : std::max(shared.height_after(bottom_, h, mu, ray.tangent_s), 0.0);
    return ray;
  }

  std::vector<Step> steps_along(const ViewRay& ray) const {
    constexpr int kOrder = 3;
    std::vector<Step> steps;
    for (const QuadratureNode& node :
         composite_gauss(shell_crossings(ray, bottom_, breaks_), kOrder)) {
      const RayPoint point = ray_point(ray, bottom_, node.s);
      const NodeValues tau = coefficients_.optical_depth(columns_along(shells_, ray, point));
      const double air = std::exp(-point.height / shells_.air_scale_height);
      const double aerosol = std::exp(-point.height / shells_.aerosol_scale_height);
      Step step{node.s, std::min(point.height, thickness_), {}, {}};
      for (std::size_t k = 0; k < 4; ++k) {
        const double reaches_eye = node.weight * std::exp(-tau[k]);
        step.air[k] = coefficients_.air[k] * air * reaches_eye;
        step.aerosol[k] = coefficients_.aerosol_scattering[k] * aerosol * reaches_eye;
      }
      steps.push_back(step);
    }
    return steps;
  }

  void scatter(int mu_index, int r_index) {
    Shared<double> shared;
    const TableSizes& s = out_.sizes;
    const double h = height_of(r_index, s.scattering_r);
    const double v = (mu_index + 0.5) / s.scattering_mu;
    const double mu = shared.mu_from_texture(v, h, s.scattering_mu, bottom_, thickness_);
    const std::vector<Step> steps = steps_along(texel_ray(h, mu, v < 0.5));
    for (int nu_index = 0; nu_index < s.scattering_nu; ++nu_index) {
      for (int sun_index = 0; sun_index < s.scattering_mu_s; ++sun_index) {
        const double mu_s = shared.sun_from_unit(sun_index / (s.scattering_mu_s - 1.0),
                                                 kTableLowestSun, bottom_, thickness_);
        // Not every angle between sun and view is possible.
        const double widest = std::sqrt((1 - mu * mu) * (1 - mu_s * mu_s));
        const double nu = std::clamp(shared.cosine_from_unit(nu_index / (s.scattering_nu - 1.0)),
                                     mu * mu_s - widest, mu * mu_s + widest);
        NodeValues rayleigh{}, mie{};
        for (const Step& step : steps) {
          const double r = bottom_ + step.height;
          const double mu_s_there =
              std::clamp(((bottom_ + h) * mu_s + step.distance * nu) / r, -1.0, 1.0);
          const NodeValues sun = lookup_sun_transmittance(out_, step.height, mu_s_there);
          for (std::size_t k = 0; k < 4; ++k) {
            rayleigh[k] += step.air[k] * sun[k];
            mie[k] += step.aerosol[k] * sun[k];
          }
        }
        const int x = nu_index * s.scattering_mu_s + sun_index;
        store(out_.rayleigh_like, x, mu_index, r_index, logarithm(rayleigh));
        store(out_.single_mie, x, mu_index, r_index, logarithm(mie));
      }
    }
  }

  // The hemisphere above a horizontal surface.
  void make_irradiance() {
    const TableSizes& s = out_.sizes;
    out_.irradiance = make_table(s.irradiance_mu_s, s.irradiance_r, 1);
    static const GaussRule kZenith = gauss_legendre(20);
    constexpr int kAzimuths = 24;
    tbb::parallel_for(0, s.irradiance_r, [&](int y) {
      Shared<double> shared;
      const double h = height_of(y, s.irradiance_r);
      for (int x = 0; x < s.irradiance_mu_s; ++x) {
        const double mu_s = shared.sun_from_unit(x / (s.irradiance_mu_s - 1.0), kTableLowestSun,
                                                 bottom_, thickness_);
        NodeValues sum{};
        for (std::size_t i = 0; i < kZenith.node.size(); ++i) {
          const double mu = kZenith.node[i];
          const double widest = std::sqrt((1 - mu * mu) * (1 - mu_s * mu_s));
          for (int j = 0; j < kAzimuths; ++j) {
            const double nu =
                mu * mu_s + widest * std::cos(std::numbers::pi * (j + 0.5) / kAzimuths);
            const NodeValues l = lookup_radiance(out_, h, mu, mu_s, nu, false);
            const double weight = 2 * std::numbers::pi * kZenith.weight[i] * mu / kAzimuths;
            for (std::size_t k = 0; k < 4; ++k) sum[k] += weight * l[k];
          }
        }
        store(out_.irradiance, x, y, 0, sum);
      }
    });
  }

  double bottom_, thickness_;
  Coefficients coefficients_;
  Shells shells_{};
  std::vector<double> breaks_;  // heights between which the quadrature has its nodes
  AtmosphereTables out_;
};

}  // namespace

AtmosphereTables compute_tables(const Atmosphere<double>& atmosphere, const ColorRule& color,
                                const TableSizes& sizes, int threads,
                                const std::function<void(double)>& progress) {
  validate(atmosphere);
  tbb::task_arena arena(threads);
  return arena.execute([&] { return TableBuilder(atmosphere, color, sizes).build(progress); });
}

}  // namespace skyfit
