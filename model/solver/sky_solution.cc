// SPDX-License-Identifier: Apache-2.0
#include "model/solver/sky_solution.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/atmosphere/parameter_field.h"

namespace skyfit {
template <int N>
SkySolution<N>::SkySolution(const Shells& shells, const LevelGrid& levels,
                            const std::vector<Optics<N>>& optics, std::size_t derivatives,
                            std::span<const SunRange> needed, const ReferenceOptions& options,
                            FieldsOf kind)
    : shells_(shells), levels_(levels), grid_(shells), solved_(grid_.size(), -1), optics_(optics) {
  for (const SunRange& range : needed) {
    const SunStencil high = grid_.stencil(range.highest), low = grid_.stencil(range.lowest);
    const auto first = *std::ranges::min_element(high.index),
               last = *std::ranges::max_element(low.index);
    std::fill(solved_.begin() + first, solved_.begin() + last + 1, 0);
  }
  // Suns that are coupled need their neighbours, down to the dark.
  const int first = first_coupled_sun(grid_, shells_);
  if (std::ranges::any_of(solved_.begin() + first, solved_.end(), [](int i) { return i >= 0; })) {
    std::fill(solved_.begin() + std::max(first - 2, 0), solved_.end(), 0);
  }
  std::vector<double> suns;
  for (int i = 0; i < grid_.size(); ++i) {
    if (solved_[i] < 0) continue;
    solved_[i] = static_cast<int>(suns.size());
    suns.push_back(grid_.mu(i));
  }
  const bool deep_twilight = kind == FieldsOf::kDeepTwilight;
  const int shifted =
      shifted_modes(options.moments, kind == FieldsOf::kDay && is_extended(shells_));
  const Streams streams(shells_.bottom_radius, levels_.heights(), options.streams,
                        field_grid(shells_, options.levels, deep_twilight).limb_rays);
  fields_ = solve_diffuse_fields<N>(
      shells_, optics_, 1 + static_cast<int>(derivatives), levels_.heights(), suns, streams,
      sun_coupling(grid_, shells_, solved_, streams, first, shifted),
      {options.moments, options.tolerance, std::max(options.order - 1, 0), deep_twilight, shifted,
       options.transfer == Transfer::kVector, levels_.asked()});
}

// docs/theory (8.6).
template <int N>
Dual<N> SkySolution<N>::ground(const ViewPath& path, const SunAlongRay& sun, int wavelength,
                               bool beam, bool diffuse) const {
  if (!path.ray.hits_ground) return {};
  const Optics<N>& optics = optics_[wavelength];
  const double mu_s = sun.mu_s(path.nodes.back());
  auto transmitted = [&](const PathColumns& c) {
    const Dual<N> tau = optics.scaled_optical_depth(c);
    const double t = std::exp(-tau.v);
    return tau.chain(t, -t);
  };
  const DiffuseField& field = fields_[wavelength];
  Dual<N> irradiance;
  const SunStencil stencil = grid_.stencil(mu_s);
  for (int k = 0; k < 4 && diffuse; ++k) {
    const double* at = field.ground_irradiance.data() +
                       solved_[stencil.index[k]] * static_cast<std::ptrdiff_t>(field.shape.slices);
    irradiance.v += stencil.even[k] * at[0];
    for (int p = 1; p < field.shape.slices; ++p) irradiance.d[p - 1] += stencil.even[k] * at[p];
  }
  if (beam && mu_s > 0) irradiance += mu_s * transmitted(shells_.columns_to_top(0, mu_s));
  return optics.ground_albedo * (1 / std::numbers::pi) * irradiance *
         transmitted(path.columns_to_end);
}

template class SkySolution<0>;
template class SkySolution<kDerivativesAtOnce>;

}  // namespace skyfit
