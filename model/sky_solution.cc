// SPDX-License-Identifier: Apache-2.0
#include "model/sky_solution.h"

#include <cmath>
#include <numbers>

#include "model/parameter_field.h"

namespace skyfit {
namespace {

Shared<double> shared;  // stateless

// Sum over Fourier modes and the suns of the stencil of one node's series [mode][sun][slice].
template <int N>
Dual<N> series_sum(const double* series, int modes, const FieldShape& shape, double cos_azimuth,
                   const SunStencil& sun) {
  std::array<double, N + 1> sum{};
  double cosine = 1, before = cos_azimuth;  // cos m phi by Chebyshev's recursion
  for (int m = 0; m < modes; ++m) {
    const double factor = m == 0 ? 1 : 2 * cosine;
    const double* at = series + m * shape.row();
    for (int k = 0; k < 4; ++k) {
      const double weight = factor * sun.weight[k];
      const double* slices = at + sun.index[k] * shape.slices;
      for (int p = 0; p < shape.slices; ++p) sum[p] += weight * slices[p];
    }
    const double next = 2 * cos_azimuth * cosine - before;
    before = cosine;
    cosine = next;
  }
  Dual<N> result(sum[0]);
  for (std::size_t p = 0; p < N; ++p) result.d[p] = sum[p + 1];
  return result;
}

}  // namespace

template <int N>
SkySolution<N>::SkySolution(const Atmosphere<double>& atmosphere,
                            std::span<const WavelengthNode> wavelengths,
                            std::span<const Parameter> derivatives,
                            std::span<const double> mu_s_needed, const ReferenceOptions& options)
    : shells_(shells_of(atmosphere)),
      basis_(options.streams, options.moments),
      heights_(level_heights(shells_.top, options.levels)),
      slices_(1 + static_cast<int>(derivatives.size())),
      solved_(grid_.size(), -1) {
  for (const Parameter p : derivatives) shells_.ozone |= p == Parameter::kOzoneColumn;
  for (const double mu_s : mu_s_needed) {
    for (const int i : grid_.stencil(mu_s).index) solved_[i] = 0;
  }
  std::vector<double> suns;
  for (int i = 0; i < grid_.size(); ++i) {
    if (solved_[i] < 0) continue;
    solved_[i] = static_cast<int>(suns.size());
    suns.push_back(grid_.mu(i));
  }
  const Atmosphere<Dual<N>> seeded_atmosphere = seeded<N>(atmosphere, derivatives);
  for (const WavelengthNode& node : wavelengths) {
    optics_.push_back(optics_at(seeded_atmosphere, node, options.moments));
  }
  DiffuseOptions diffuse;
  diffuse.tolerance = options.tolerance;
  fields_ = solve_diffuse_fields<N>(shells_, optics_, slices_, heights_, suns, basis_, diffuse);
  for (const DiffuseField& field : fields_) {
    ground_series_.push_back(suns_first(field.ground_irradiance.data(), field.shape));
  }
}

template <int N>
PathSource<N> SkySolution<N>::source(const ViewPath& path, int wavelength) const {
  return path_source(shells_, optics_[wavelength], path, fields_[wavelength], basis_.moments());
}

template <int N>
SunStencil SkySolution<N>::stencil(double mu_s) const {
  SunStencil s = grid_.stencil(mu_s);
  for (int& i : s.index) i = solved_[i];
  return s;
}

template <int N>
Dual<N> SkySolution<N>::multiple(const ViewPath& path, const PathSource<N>& source,
                                 const SunAlongRay& sun, int wavelength) const {
  const FieldShape& shape = fields_[wavelength].shape;
  Dual<N> sum;
  for (std::size_t i = 0; i < path.nodes.size(); ++i) {
    const double mu_s = sun.mu_s(path.nodes[i]);
    const double azimuth = sun.cos_azimuth(path.nodes[i], mu_s);
    const SunStencil suns = stencil(mu_s);
    sum += source.air_weight[i] *
           series_sum<N>(source.air_series.data() + i * source.air_modes * shape.row(),
                         source.air_modes, shape, azimuth, suns);
    sum += source.aerosol_weight[i] *
           series_sum<N>(source.aerosol_series.data() + i * source.aerosol_modes * shape.row(),
                         source.aerosol_modes, shape, azimuth, suns);
  }
  return sum;
}

template <int N>
Dual<N> SkySolution<N>::ground(const ViewPath& path, const SunAlongRay& sun, int wavelength) const {
  if (!path.ray.hits_ground) return {};
  const Optics<N>& optics = optics_[wavelength];
  const RayPoint& end = path.nodes.back();
  const double mu_s = sun.mu_s(end);
  auto transmitted = [&](const PathColumns& c) {
    const Dual<N> tau = optics.optical_depth(c);
    const double t = std::exp(-tau.v);
    return tau.chain(t, -t);
  };
  const DiffuseField& field = fields_[wavelength];
  Dual<N> irradiance =
      series_sum<N>(ground_series_[wavelength].data(), 1, field.shape, 1, stencil(mu_s));
  if (mu_s > 0) irradiance += mu_s * transmitted(shells_.columns_to_top(0, mu_s));
  return optics.ground_albedo * (1 / std::numbers::pi) * irradiance *
         transmitted(path.columns_to_end);
}

template <int N>
RadianceParts<N> SkySolution<N>::radiance(const ViewPath& path, const PathSource<N>& source,
                                          const SunAlongRay& sun,
                                          const std::vector<SingleScatteringSample>& samples,
                                          int wavelength) const {
  return {single_scattering(optics_[wavelength], samples), multiple(path, source, sun, wavelength),
          ground(path, sun, wavelength)};
}

template <int N>
Dual<N> SkySolution<N>::sum(const RadianceParts<N>& parts, double nu, int wavelength) const {
  return parts.single.air * shared.rayleigh_phase(optics_[wavelength].depolarisation, nu) +
         parts.single.aerosol * aerosol_phase(optics_[wavelength].phase, nu) + parts.multiple +
         parts.ground;
}

template class SkySolution<0>;
template class SkySolution<kParameterCount>;

}  // namespace skyfit
