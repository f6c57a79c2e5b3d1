// SPDX-License-Identifier: Apache-2.0
#include "model/view_path.h"

#include <algorithm>
#include <cmath>

#include "model/kernels.h"
#include "model/parameters.h"

namespace skyfit {
namespace {

void set_interpolation(const std::vector<double>& node_s, ViewPath::Sample& sample) {
  const int size = static_cast<int>(node_s.size());
  sample.count = std::min(4, size);
  const int above = static_cast<int>(
      std::upper_bound(node_s.begin(), node_s.end(), sample.point.s) - node_s.begin());
  sample.first = std::clamp(above - 2, 0, size - sample.count);
  lagrange_weights(&node_s[sample.first], sample.count, sample.point.s, sample.share);
}

// Crossings that nearly coincide with an end or the lowest point of the ray say nothing new and
// spoil the interpolation.
std::vector<double> without_near_pairs(const std::vector<double>& s, double lowest) {
  std::vector<double> kept = {s.front()};
  auto fixed = [&](std::size_t i) { return i == 0 || i + 1 == s.size() || s[i] == lowest; };
  constexpr double kLeastShare = 0.25;  // of the neighbouring distance
  for (std::size_t i = 1; i + 1 < s.size(); ++i) {
    const double left = s[i] - s[i - 1], right = s[i + 1] - s[i];
    const bool near = (fixed(i - 1) && left < kLeastShare * right) ||
                      (fixed(i + 1) && right < kLeastShare * left);
    if (fixed(i) || !near) kept.push_back(s[i]);
  }
  if (s.size() > 1) kept.push_back(s.back());
  return kept;
}

// Moments of mode m at a height, for all slices and suns: Lagrange's cubic in the levels' own
// coordinate sqrt(h).
class MomentsAtHeight {
 public:
  MomentsAtHeight(const DiffuseField& field, double top, double height) : field_(field) {
    const int levels = field.shape.levels;
    double x = std::sqrt(height / top) * (levels - 1);
    constexpr double kOnLevel = 1e-6;  // of the distance of two levels: three of the weights are 0
    if (std::abs(x - std::round(x)) < kOnLevel) x = std::round(x);
    first_ = std::clamp(static_cast<int>(x) - 1, 0, levels - 4);
    const double nodes[4] = {0, 1, 2, 3};
    lagrange_weights(nodes, 4, x - first_, weight_);
  }
  // out += factor * M_{m + row, m}
  void add(int m, int row, double factor, double* out, std::size_t count) const {
    const double* from =
        field_.moments[m].data() + row * field_.shape.size() + first_ * field_.shape.row();
    for (int i = 0; i < 4; ++i) {
      if (weight_[i] != 0)
        kernels::add_scaled(factor * weight_[i], from + i * field_.shape.row(), out, count);
    }
  }

 private:
  const DiffuseField& field_;
  int first_;
  double weight_[4];
};

double derivative_of(const Dual<kParameterCount>& x, std::size_t p) { return x.d[p]; }
double derivative_of(const Dual<0>&, std::size_t) { return 0; }

template <int N>
void set_series(const Shells& shells, const Optics<N>& optics, const ViewPath& path,
                const DiffuseField& field, int moments, PathSource<N>& source) {
  const std::size_t row = field.shape.row(), suns = field.shape.suns;
  std::vector<double> lambda(moments), sum(row);
  for (std::size_t i = 0; i < path.nodes.size(); ++i) {
    const MomentsAtHeight at(field, shells.top, path.nodes[i].height);
    for (int m = 0; m < source.aerosol_modes; ++m) {
      normalised_legendre(m, moments, path.nodes[i].mu, lambda.data());
      std::fill(sum.begin(), sum.end(), 0.0);
      for (int l = m; l < moments; ++l) {
        const Dual<N>& chi = optics.moments[l];
        at.add(m, l - m, lambda[l - m] * chi.v, sum.data(), row);
        for (std::size_t p = 0; p + 1 < static_cast<std::size_t>(field.shape.slices); ++p) {
          const double slope = derivative_of(chi, p);
          if (slope != 0)
            at.add(m, l - m, lambda[l - m] * slope, sum.data() + (p + 1) * suns, suns);
        }
      }
      std::ranges::copy(suns_first(sum.data(), field.shape),
                        &source.aerosol_series[(i * source.aerosol_modes + m) * row]);
      if (m >= source.air_modes) continue;
      std::fill(sum.begin(), sum.end(), 0.0);
      for (int l = m; l < static_cast<int>(optics.air_moments.size()); ++l) {
        if (optics.air_moments[l] != 0)
          at.add(m, l - m, lambda[l - m] * optics.air_moments[l], sum.data(), row);
      }
      std::ranges::copy(suns_first(sum.data(), field.shape),
                        &source.air_series[(i * source.air_modes + m) * row]);
    }
  }
}

}  // namespace

std::vector<double> suns_first(const double* row, const FieldShape& shape) {
  std::vector<double> r(shape.row());
  for (int p = 0; p < shape.slices; ++p) {
    for (int j = 0; j < shape.suns; ++j) r[j * shape.slices + p] = row[p * shape.suns + j];
  }
  return r;
}

ViewPath view_path(const Shells& shells, const std::vector<double>& heights, double altitude,
                   double mu) {
  ViewPath path;
  path.ray = view_ray(shells.bottom_radius, shells.top, altitude, mu);
  if (path.ray.length <= 0) return path;
  const std::vector<double> s = without_near_pairs(
      shell_crossings(path.ray, shells.bottom_radius, heights), path.ray.tangent_s);
  for (const double x : s) path.nodes.push_back(ray_point(path.ray, shells.bottom_radius, x));
  for (const QuadratureNode& q : composite_gauss(with_table_breaks(shells, path.ray, s), 2)) {
    ViewPath::Sample sample{ray_point(path.ray, shells.bottom_radius, q.s), q.weight, {}};
    sample.columns = columns_along(shells, path.ray, sample.point);
    set_interpolation(s, sample);
    path.samples.push_back(sample);
  }
  path.columns_to_end = columns_along(shells, path.ray, path.nodes.back());
  return path;
}

template <int N>
PathSource<N> path_source(const Shells& shells, const Optics<N>& optics, const ViewPath& path,
                          const DiffuseField& field, int moments) {
  PathSource<N> source;
  const std::size_t nodes = path.nodes.size();
  source.air_weight.resize(nodes);
  source.aerosol_weight.resize(nodes);
  for (const ViewPath::Sample& sample : path.samples) {
    const Dual<N> tau = optics.optical_depth(sample.columns);
    const double t = std::exp(-tau.v);
    const Dual<N> transmitted = tau.chain(t * sample.weight, -t * sample.weight);
    const Densities<N> rho = optics.densities(sample.point.height);
    const Dual<N> air = transmitted * optics.air * rho.air;
    const Dual<N> aerosol = transmitted * optics.aerosol_scattering_cut * rho.aerosol;
    for (int k = 0; k < sample.count; ++k) {
      source.air_weight[sample.first + k] += air * sample.share[k];
      source.aerosol_weight[sample.first + k] += aerosol * sample.share[k];
    }
  }
  while (source.aerosol_modes < static_cast<int>(field.moments.size()) &&
         !field.moments[source.aerosol_modes].empty()) {
    ++source.aerosol_modes;
  }
  source.air_modes = std::min(source.aerosol_modes, static_cast<int>(optics.air_moments.size()));
  source.air_series.assign(nodes * source.air_modes * field.shape.row(), 0.0);
  source.aerosol_series.assign(nodes * source.aerosol_modes * field.shape.row(), 0.0);
  set_series(shells, optics, path, field, moments, source);
  return source;
}

template PathSource<0> path_source<0>(const Shells&, const Optics<0>&, const ViewPath&,
                                      const DiffuseField&, int);
template PathSource<kParameterCount> path_source<kParameterCount>(const Shells&,
                                                                  const Optics<kParameterCount>&,
                                                                  const ViewPath&,
                                                                  const DiffuseField&, int);

}  // namespace skyfit
