// SPDX-License-Identifier: Apache-2.0
#include "model/tables.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "model/diffuse_source.h"
#include "model/gauss.h"
#include "model/parameter_field.h"
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

// Even steps of the angle, in which the logarithm is piecewise linear.
Table phase_table(const AerosolPhase<double>& phase) {
  constexpr int kSteps = 4095;  // of 0.044 degrees
  if (phase.type != PhaseType::kTabulated) return make_table(1, 1, 1);
  Table table = make_table(kSteps + 1, 1, 1);
  for (int i = 0; i <= kSteps; ++i) {
    const double value = std::log(phase.table->phase(std::numbers::pi * i / kSteps));
    store(table, i, 0, 0, {value, value, value, value});
  }
  return table;
}

// Coefficients at the four nodes, 1/m.
struct Coefficients {
  NodeValues air, aerosol_scattering, aerosol_scattering_cut, aerosol_extinction,
      aerosol_extinction_cut, ozone;
};

NodeValues optical_depth(const Coefficients& c, const NodeValues& aerosol_extinction,
                         const PathColumns& columns) {
  NodeValues tau;
  for (std::size_t k = 0; k < 4; ++k) {
    tau[k] = c.air[k] * columns.air.value + aerosol_extinction[k] * columns.aerosol.value +
             c.ozone[k] * columns.ozone.value;
  }
  return tau;
}

NodeOptics optics_of(const Atmosphere<double>& atmosphere, const ColorRule& color) {
  const Atmosphere<Dual<0>> plain = seeded<0>(atmosphere, {});
  NodeOptics optics;
  for (std::size_t k = 0; k < 4; ++k)
    optics[k] = optics_at<0>(plain, color.nodes[k], kSourceMoments);
  return optics;
}

Coefficients coefficients_of(const NodeOptics& optics, double single_scattering_albedo) {
  Coefficients c;
  for (std::size_t k = 0; k < 4; ++k) {
    c.air[k] = optics[k].air.v;
    c.aerosol_scattering[k] = optics[k].aerosol_scattering.v;
    c.aerosol_scattering_cut[k] = optics[k].aerosol_scattering_cut.v;
    c.aerosol_extinction[k] = c.aerosol_scattering[k] / single_scattering_albedo;
    c.aerosol_extinction_cut[k] = optics[k].aerosol_extinction.v;
    c.ozone[k] = optics[k].ozone.v;
  }
  return c;
}

// One step of the quadrature along a ray: what does not depend on the sun.
struct Step {
  double distance, height, mu;
  NodeValues air,
      aerosol;  // scattered toward the eye per unit of light from the sun and of phase function
  NodeValues aerosol_cut;  // the same without the forward peak: for light that was scattered before
};

// A texel's ray. The ends of the table's halves, where rays have no length, stand for rays of a
// decimetre's height.
struct TexelRay {
  double height, mu;
  ViewRay ray;
};

class TableBuilder {
 public:
  TableBuilder(const Atmosphere<double>& atmosphere, const ColorRule& color,
               const TableSizes& sizes)
      : bottom_(atmosphere.bottom_radius_m),
        thickness_(atmosphere.top_radius_m - atmosphere.bottom_radius_m),
        shells_(shells_of(atmosphere)) {
    out_.atmosphere = atmosphere;
    out_.color = color;
    out_.sizes = sizes;
    out_.phase = phase_table(atmosphere.mie.phase);
    const NodeOptics optics = optics_of(atmosphere, color);
    coefficients_ = coefficients_of(optics, atmosphere.mie.single_scattering_albedo);
    source_ = std::make_unique<DiffuseSource>(shells_, optics);
    for (const double height : shells_.profiles.air.quadrature_heights()) add_break(height);
    for (const double height : shells_.profiles.aerosol.quadrature_heights()) add_break(height);
    add_break(thickness_);
    std::sort(breaks_.begin(), breaks_.end());
  }

  AtmosphereTables build(const std::function<void(double)>& progress) {
    // Single scattering keeps the true phase function under the cut extinction (TMS, see
    // model/optics.h).
    make_optical_depth(coefficients_.aerosol_extinction_cut);
    const TableSizes& s = out_.sizes;
    const int width = s.scattering_mu_s * s.scattering_nu;
    out_.rayleigh_like = make_table(width, s.scattering_mu, s.scattering_r);
    out_.single_mie = make_table(width, s.scattering_mu, s.scattering_r);
    for (int r = 0; r < s.scattering_r; ++r) {
      tbb::parallel_for(0, s.scattering_mu, [&](int mu) { scatter(mu, r); });
      if (progress) progress(0.1 + 0.8 * (r + 1) / s.scattering_r);
    }
    make_irradiance();
    make_optical_depth(coefficients_.aerosol_extinction);
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

  void make_optical_depth(const NodeValues& aerosol_extinction) {
    const TableSizes& s = out_.sizes;
    out_.optical_depth = make_table(s.optical_depth_mu, s.optical_depth_r, 1);
    tbb::parallel_for(0, s.optical_depth_r, [&](int y) {
      Shared<double> shared;
      const double h = height_of(y, s.optical_depth_r);
      for (int x = 0; x < s.optical_depth_mu; ++x) {
        const double unit = x / (s.optical_depth_mu - 1.0);
        const double mu = shared.mu_from_upward_unit(unit, h, bottom_, thickness_);
        store(out_.optical_depth, x, y, 0,
              optical_depth(coefficients_, aerosol_extinction, shells_.columns_to_top(h, mu)));
      }
    });
  }

  // Which half of the table the texel is in says whether its ray ends on the ground.
  TexelRay texel_ray(int mu_index, int r_index) const {
    Shared<double> shared;
    const TableSizes& s = out_.sizes;
    const double v = (mu_index + 0.5) / s.scattering_mu;
    const bool hits_ground = v < 0.5;
    const double least = std::min(0.1, 1e-6 * thickness_);
    const double h = hits_ground ? std::max(height_of(r_index, s.scattering_r), least)
                                 : std::min(height_of(r_index, s.scattering_r), thickness_ - least);
    const double mu = shared.mu_from_texture(v, h, s.scattering_mu, bottom_, thickness_);
    return {h, mu, ray_of(h, mu, hits_ground)};
  }

  ViewRay ray_of(double h, double mu, bool hits_ground) const {
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
      const NodeValues tau = optical_depth(coefficients_, coefficients_.aerosol_extinction_cut,
                                           columns_along(shells_, ray, point));
      const double air = shells_.profiles.air.density(point.height).value;
      const double aerosol = shells_.profiles.aerosol.density(point.height).value;
      Step step{node.s, std::min(point.height, thickness_), point.mu, {}, {}, {}};
      for (std::size_t k = 0; k < 4; ++k) {
        const double reaches_eye = node.weight * std::exp(-tau[k]);
        step.air[k] = coefficients_.air[k] * air * reaches_eye;
        step.aerosol[k] = coefficients_.aerosol_scattering[k] * aerosol * reaches_eye;
        step.aerosol_cut[k] = coefficients_.aerosol_scattering_cut[k] * aerosol * reaches_eye;
      }
      steps.push_back(step);
    }
    return steps;
  }

  // One sun and scattering angle of a ray, and what has been added up for it.
  struct Cell {
    double mu_s, nu;
    double table_nu;  // the table's, which may be impossible for this ray; then nu is the nearest
                      // possible
    NodeValues rayleigh, mie;
    std::array<float, 4> multiple;
  };

  std::vector<Cell> cells_of(double mu) const {
    Shared<double> shared;
    const TableSizes& s = out_.sizes;
    std::vector<Cell> cells;
    for (int nu_index = 0; nu_index < s.scattering_nu; ++nu_index) {
      for (int sun_index = 0; sun_index < s.scattering_mu_s; ++sun_index) {
        const double mu_s = shared.sun_from_unit(sun_index / (s.scattering_mu_s - 1.0),
                                                 kTableLowestSun, bottom_, thickness_);
        const double widest = std::sqrt((1 - mu * mu) * (1 - mu_s * mu_s));
        const double table_nu = shared.cosine_from_unit(nu_index / (s.scattering_nu - 1.0));
        const double nu = std::clamp(table_nu, mu * mu_s - widest, mu * mu_s + widest);
        cells.push_back({mu_s, nu, table_nu, {}, {}, {}});
      }
    }
    return cells;
  }

  void add_step(const Step& step, const DiffuseSource::Slice& slice, double height,
                Cell& cell) const {
    const double mu_s = std::clamp(
        ((bottom_ + height) * cell.mu_s + step.distance * cell.nu) / (bottom_ + step.height), -1.0,
        1.0);
    const NodeValues sun = lookup_sun_transmittance(out_, step.height, mu_s);
    for (std::size_t k = 0; k < 4; ++k) {
      cell.rayleigh[k] += step.air[k] * sun[k];
      cell.mie[k] += step.aerosol[k] * sun[k];
    }
    const double widest = std::sqrt((1 - step.mu * step.mu) * (1 - mu_s * mu_s));
    slice.add(mu_s, widest > 1e-9 ? (cell.nu - step.mu * mu_s) / widest : 1.0,
              cell.multiple.data());
  }

  void scatter(int mu_index, int r_index) {
    Shared<double> shared;
    const TexelRay texel = texel_ray(mu_index, r_index);
    std::vector<Cell> cells = cells_of(texel.mu);
    DiffuseSource::Slice slice;
    for (const Step& step : steps_along(texel.ray)) {
      source_->slice(step.height, step.mu, step.air, step.aerosol_cut, slice);
      for (Cell& cell : cells) add_step(step, slice, texel.height, cell);
    }
    const double per_kilometre = 1e3 / texel.ray.length;
    for (std::size_t x = 0; x < cells.size(); ++x) {
      Cell& cell = cells[x];
      const double rayleigh_phase =
          shared.rayleigh_phase(out_.atmosphere.rayleigh.depolarisation, cell.table_nu);
      for (std::size_t k = 0; k < 4; ++k) {
        // The series of the diffuse field may swing below 0 where the field is dark.
        cell.rayleigh[k] += std::max(cell.multiple[k], 0.0f) / rayleigh_phase;
        cell.rayleigh[k] = std::log(std::max(cell.rayleigh[k] * per_kilometre, kDarkestScattering));
        cell.mie[k] = std::log(std::max(cell.mie[k] * per_kilometre, kDarkestScattering));
      }
      store(out_.rayleigh_like, static_cast<int>(x), mu_index, r_index, cell.rayleigh);
      store(out_.single_mie, static_cast<int>(x), mu_index, r_index, cell.mie);
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
  Shells shells_;
  Coefficients coefficients_{};
  std::unique_ptr<DiffuseSource> source_;
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
