// SPDX-License-Identifier: Apache-2.0
#include "model/diffuse_field.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/mode_pack.h"
#include "model/parameters.h"

namespace skyfit {

std::vector<double> level_heights(double top, int count) {
  std::vector<double> h(count);
  for (int i = 0; i < count; ++i) {
    const double x = static_cast<double>(i) / (count - 1);
    h[i] = top * x * x;
  }
  return h;
}

void normalised_legendre(int m, int count, double mu, double* out) {
  const double sine = std::sqrt(std::max(1 - mu * mu, 0.0));
  double diagonal = std::sqrt(0.25 / std::numbers::pi);
  for (int k = 1; k <= m; ++k) diagonal *= sine * std::sqrt((2.0 * k + 1) / (2.0 * k));
  double before = 0, current = diagonal;
  const double m2 = static_cast<double>(m) * m;
  for (int l = m; l < count; ++l) {
    out[l - m] = current;
    const double n = l + 1.0, l2 = static_cast<double>(l) * l;
    const double next = std::sqrt((4 * n * n - 1) / (n * n - m2)) *
                        (mu * current - std::sqrt((l2 - m2) / (4 * l2 - 1)) * before);
    before = current;
    current =
        l == 0 ? std::sqrt(3.0) * mu * diagonal : next;  // at l = 0 the second root has no meaning
  }
}

namespace {

Shared<double> shared;  // stateless

// I = t I_far + near J_near + far J_far, J linear in optical depth.
template <int N>
LayerWeights<N> layer_weights(const Dual<N>& depth) {
  const double x = depth.v;
  const double t = std::exp(-x);
  double near, far, near_slope, far_slope;
  if (x < 1e-2) {  // series: (1 - exp(-x)) / x = 1 - x/2 + x^2/6 - ..
    near = x * (1.0 / 2 - x * (1.0 / 6 - x * (1.0 / 24 - x * (1.0 / 120 - x / 720))));
    near_slope = 1.0 / 2 - x * (1.0 / 3 - x * (1.0 / 8 - x * (1.0 / 30 - x / 144)));
    far = x * (1.0 / 2 - x * (1.0 / 3 - x * (1.0 / 8 - x * (1.0 / 30 - x / 144))));
    far_slope = 1.0 / 2 - x * (2.0 / 3 - x * (3.0 / 8 - x * (4.0 / 30 - x * 5.0 / 144)));
  } else {
    const double mean = -std::expm1(-x) / x, mean_slope = (t - mean) / x;
    near = 1 - mean;
    near_slope = -mean_slope;
    far = mean - t;
    far_slope = mean_slope + t;
  }
  return {depth.chain(t, -t), depth.chain(near, near_slope), depth.chain(far, far_slope)};
}

// Columns to the top of the fan's rays and of the suns at every level; they serve all wavelengths.
struct FieldColumns {
  std::vector<PathColumns> rays;  // [level][ray], upward
  std::vector<PathColumns> suns;  // [level][sun]
  std::vector<char> lit;          // [level][sun]: the planet is not in the way
};
FieldColumns field_columns(const Shells& shells, const std::vector<double>& heights,
                           const std::vector<double>& sun_mu, const RayFan& fan) {
  FieldColumns c;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const int level = static_cast<int>(i);
    for (int k = 0; k < fan.most(); ++k) {
      c.rays.push_back(k < fan.count(level) ? shells.columns_to_top(heights[i], fan.mu(level, k))
                                            : PathColumns{});
    }
    for (const double mu : sun_mu) {
      const bool lit =
          mu >= 0 || shared.sphere_discriminant(shells.bottom_radius, heights[i], mu, 0) < 0;
      c.lit.push_back(lit);
      c.suns.push_back(lit ? shells.columns_to_top(heights[i], mu) : PathColumns{});
    }
  }
  return c;
}

template <int N>
Dual<N> transmittance(const Dual<N>& tau) {
  const double t = std::exp(-tau.v);
  return tau.chain(t, -t);
}

template <int N>
WaveMedium<N> medium_of(const Optics<N>& optics, const std::vector<double>& heights,
                        const FieldColumns& columns, const RayFan& fan, int moments) {
  WaveMedium<N> medium;
  medium.ground_albedo = optics.ground_albedo;
  for (const double h : heights) {
    const Densities<N> rho = optics.densities(h);
    const Dual<N> air = optics.air * rho.air;
    const Dual<N> extinction =
        air + optics.aerosol_extinction * rho.aerosol + optics.ozone * rho.ozone;
    const bool empty = !(extinction.v > 0);
    const Dual<N> aerosol =
        empty ? Dual<N>() : optics.aerosol_scattering_cut * rho.aerosol / extinction;
    const Dual<N> air_share = empty ? Dual<N>() : air / extinction;
    for (int l = 0; l < moments; ++l) {
      Dual<N> omega = aerosol * optics.moments[l];
      if (l < static_cast<int>(optics.air_moments.size()))
        omega += air_share * optics.air_moments[l];
      medium.omega.push_back(omega);
    }
  }
  for (int i = 0; i + 1 < fan.levels(); ++i) {
    for (int k = 0; k < fan.most(); ++k) {
      if (k >= fan.count(i)) {
        medium.layers.emplace_back();
        continue;
      }
      PathColumns layer = columns.rays[i * fan.most() + k];
      layer += -columns.rays[(i + 1) * fan.most() + k];
      medium.layers.push_back(layer_weights(optics.optical_depth(layer)));
    }
  }
  for (std::size_t j = 0; j < columns.suns.size(); ++j) {
    medium.beam.push_back(columns.lit[j] ? transmittance(optics.optical_depth(columns.suns[j]))
                                         : Dual<N>());
  }
  return medium;
}

ModeBasis mode_basis(const RayFan& fan, const std::vector<double>& sun_mu, int m, int moments) {
  const int own = moments - m;
  ModeBasis basis;
  basis.at_rays.resize(static_cast<std::size_t>(fan.levels()) * fan.most() * own);
  for (int i = 0; i < fan.levels(); ++i) {
    for (int k = 0; k < fan.count(i); ++k)
      normalised_legendre(m, moments, fan.mu(i, k), &basis.at_rays[(i * fan.most() + k) * own]);
  }
  basis.at_suns.resize(sun_mu.size() * own);
  for (std::size_t j = 0; j < sun_mu.size(); ++j)
    normalised_legendre(m, moments, sun_mu[j], &basis.at_suns[j * own]);
  return basis;
}

// Modes that matter to the field of one wavelength: the moments of order m and above of light that
// the aerosol has scattered once, scattered again, as a share of all light.
template <int N>
int mode_count(const Optics<N>& optics, int moments, double tolerance) {
  const int least = std::min(moments, static_cast<int>(optics.air_moments.size()));
  const double aerosol = optics.aerosol_scattering_cut.v,
               share = aerosol / std::max(optics.air.v + aerosol, 1e-300);
  for (int m = least; m < moments; ++m) {
    double rest = 0;
    for (int l = m; l < moments; ++l)
      rest = std::max(rest, share * optics.moments[l].v * optics.moments[l].v);
    if (rest < tolerance) return m;
  }
  return moments;
}

template <int N>
void unpack(const ModePack<N>& pack, int lane, int m, DiffuseField& field) {
  const FieldShape& shape = field.shape;
  std::vector<double>& out = field.moments[m];
  out.reserve(shape.levels * shape.level(m));
  for (int i = 0; i < shape.levels; ++i) {
    for (int l = m; l < shape.moments; ++l) {
      for (int j = 0; j < shape.suns; ++j) {
        for (int p = 0; p < shape.slices; ++p) out.push_back(pack.moment(lane, i, l, j, p));
      }
    }
  }
  if (m > 0) return;
  for (int j = 0; j < shape.suns; ++j) {
    for (int p = 0; p < shape.slices; ++p)
      field.ground_irradiance.push_back(pack.ground_irradiance(lane, j, p));
  }
}

}  // namespace

template <int N>
std::vector<DiffuseField> solve_diffuse_fields(const Shells& shells,
                                               std::span<const Optics<N>> optics, int slices,
                                               const std::vector<double>& heights,
                                               const std::vector<double>& sun_mu,
                                               const RayFan& fan, const DiffuseOptions& options) {
  const int waves = static_cast<int>(optics.size()), moments = options.moments;
  const FieldShape shape{static_cast<int>(heights.size()), moments,
                         static_cast<int>(sun_mu.size()), slices};
  const FieldColumns columns = field_columns(shells, heights, sun_mu, fan);
  std::vector<WaveMedium<N>> media(waves);
  tbb::parallel_for(0, waves, [&](int w) {
    media[w] = medium_of(optics[w], heights, columns, fan, moments);
  });
  std::vector<DiffuseField> fields(waves);
  std::vector<ModeTask> tasks;
  int most = 0;
  for (int w = 0; w < waves; ++w) {
    fields[w].shape = shape;
    fields[w].moments.resize(mode_count(optics[w], moments, options.tolerance));
    most = std::max(most, static_cast<int>(fields[w].moments.size()));
  }
  std::vector<ModeBasis> bases(most);
  tbb::parallel_for(0, most, [&](int m) { bases[m] = mode_basis(fan, sun_mu, m, moments); });
  for (int m = 0; m < most; ++m) {
    for (int w = 0; w < waves; ++w) {
      if (m < static_cast<int>(fields[w].moments.size())) tasks.push_back({w, m});
    }
  }
  constexpr int kLanes = static_cast<int>(lanes::kLanes);
  const int count = static_cast<int>(tasks.size());
  const typename ModePack<N>::Inputs inputs{fan, moments, sun_mu, slices - 1, media, bases};
  tbb::parallel_for(0, (count + kLanes - 1) / kLanes, [&](int p) {
    const int first = p * kLanes, end = std::min(first + kLanes, count);
    typename ModePack<N>::Tasks lane_tasks;
    for (int k = 0; k < kLanes; ++k) lane_tasks[k] = tasks[std::min(first + k, end - 1)];
    ModePack<N> pack(inputs, lane_tasks);
    if (options.order == 0) pack.solve();
    for (int k = 0; k < options.order; ++k) pack.advance();
    for (int k = first; k < end; ++k)
      unpack(pack, k - first, tasks[k].mode, fields[tasks[k].wave]);
  });
  return fields;
}

template std::vector<DiffuseField> solve_diffuse_fields<0>(
    const Shells&, std::span<const Optics<0>>, int, const std::vector<double>&,
    const std::vector<double>&, const RayFan&, const DiffuseOptions&);
template std::vector<DiffuseField> solve_diffuse_fields<kParameterCount>(
    const Shells&, std::span<const Optics<kParameterCount>>, int, const std::vector<double>&,
    const std::vector<double>&, const RayFan&, const DiffuseOptions&);

}  // namespace skyfit
