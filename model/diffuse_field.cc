// SPDX-License-Identifier: Apache-2.0
#include "model/diffuse_field.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "model/kernels.h"
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

namespace {

Shared<double> shared;  // stateless

// Weights of a layer for one stream: I = t I_far + near Q_near + far Q_far, Q linear in optical
// depth.
template <int N>
struct LayerWeights {
  Dual<N> t, near, far;
};

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

template <int N>
class ModeSolver {
 public:
  ModeSolver(const Shells& shells, const Optics<N>& optics, const std::vector<double>& heights,
             const std::vector<double>& sun_mu, const StreamBasis& basis, const FieldShape& shape,
             int m)
      : shells_(shells),
        optics_(optics),
        heights_(heights),
        sun_mu_(sun_mu),
        basis_(basis),
        shape_(shape),
        m_(m) {
    rows_ = basis.moments() - m;
    moments_.assign(rows_ * shape.size(), 0.0);
    source_.resize(moments_.size());
    field_.resize(2 * basis.streams() * shape.size());
    ground_.assign(shape.row(), 0.0);
    set_albedos();
    set_layers();
    set_direct_beam();
  }

  // The next order: scatter what came before, transport it, take its moments.
  void advance() {
    scatter();
    synthesise();
    transport();
    analyse();
  }

  const std::vector<double>& moments() const { return moments_; }
  const std::vector<double>& ground() const { return ground_; }

 private:
  double* row(std::vector<double>& v, int r) const { return v.data() + r * shape_.size(); }
  std::size_t n_slices() const { return static_cast<std::size_t>(shape_.slices); }

  // Rows are kept by parity: l - m = 0, 2, 4, .. then 1, 3, 5, ..
  int row_of(int l) const {
    return (l - m_) % 2 == 0 ? (l - m_) / 2 : basis_.rows(m_, 0) + (l - m_) / 2;
  }

  // Source per extinction of each moment: omega_l = sum_i k_i rho_i chi_i,l / extinction.
  void set_albedos() {
    albedo_.resize(static_cast<std::size_t>(shape_.levels) * rows_);
    for (int i = 0; i < shape_.levels; ++i) {
      const Densities<N> rho = optics_.densities_at_level(
          heights_[std::max(i - 1, 0)], heights_[i], heights_[std::min(i + 1, shape_.levels - 1)]);
      const Dual<N> air = optics_.air * rho.air;
      const Dual<N> extinction =
          air + optics_.aerosol_extinction * rho.aerosol + optics_.ozone * rho.ozone;
      if (!(extinction.v > 0)) continue;
      const Dual<N> aerosol = optics_.aerosol_scattering_cut * rho.aerosol / extinction;
      const Dual<N> air_share = air / extinction;
      for (int l = m_; l < basis_.moments(); ++l) {
        Dual<N> omega = aerosol * optics_.moments[l];
        if (l < static_cast<int>(optics_.air_moments.size()))
          omega += air_share * optics_.air_moments[l];
        albedo_[i * rows_ + row_of(l)] = omega;
      }
    }
  }

  void set_layers() {
    std::vector<Dual<N>> above(shape_.levels);
    for (int i = 0; i < shape_.levels; ++i) above[i] = vertical_depth(heights_[i]);
    layers_.resize(static_cast<std::size_t>(shape_.levels - 1) * basis_.streams());
    for (int i = 0; i + 1 < shape_.levels; ++i) {
      for (int k = 0; k < basis_.streams(); ++k) {
        layers_[i * basis_.streams() + k] =
            layer_weights((above[i] - above[i + 1]) * (1 / basis_.mu(k)));
      }
    }
  }
  Dual<N> vertical_depth(double height) const {
    return optics_.optical_depth(shells_.columns_to_top(height, 1));
  }

  // Moments of the sun's beam, Lambda_lm(mu_s) exp(-tau), and its irradiance of the ground.
  void set_direct_beam() {
    std::vector<double> lambda(rows_);
    for (int j = 0; j < shape_.suns; ++j) {
      normalised_legendre(m_, basis_.moments(), sun_mu_[j], lambda.data());
      for (int i = 0; i < shape_.levels; ++i) {
        const double mu = sun_mu_[j];
        if (mu < 0 && shared.sphere_discriminant(shells_.bottom_radius, heights_[i], mu, 0) >= 0)
          continue;
        const Dual<N> tau = optics_.optical_depth(shells_.columns_to_top(heights_[i], mu));
        const double t = std::exp(-tau.v);
        const Dual<N> beam = tau.chain(t, -t);
        for (int l = m_; l < basis_.moments(); ++l)
          put(row(moments_, row_of(l)), i, j, lambda[l - m_], beam);
        if (m_ == 0 && i == 0) put(ground_.data(), 0, j, std::max(mu, 0.0), beam);
      }
    }
  }
  void put(double* row, int level, int sun, double factor, const Dual<N>& x) const {
    double* at = row + level * shape_.row() + sun;
    at[0] = factor * x.v;
    for (std::size_t p = 1; p < n_slices(); ++p)
      at[p * shape_.suns] = factor * derivative(x, p - 1);
  }
  static double derivative(const Dual<N>& x, std::size_t p) {
    if constexpr (N > 0) return x.d[p];
    return 0;
  }

  void scatter() {
    const std::size_t suns = shape_.suns;
    std::fill(source_.begin(), source_.end(), 0.0);
    for (int r = 0; r < rows_; ++r) {
      for (int i = 0; i < shape_.levels; ++i) {
        const Dual<N>& omega = albedo_[i * rows_ + r];
        const double* in = row(moments_, r) + i * shape_.row();
        double* out = row(source_, r) + i * shape_.row();
        kernels::add_scaled(omega.v, in, out, shape_.row());
        for (std::size_t p = 1; p < n_slices(); ++p) {
          kernels::add_scaled(derivative(omega, p - 1), in, out + p * suns, suns);
        }
      }
    }
  }

  // Source function at the streams: first half looks up, second half looks down.
  void synthesise() {
    const int n = basis_.streams(), even = basis_.rows(m_, 0), odd = basis_.rows(m_, 1);
    kernels::multiply(basis_.synthesis(m_, 0).data(), source_.data(), row(field_, 0), n, even,
                      shape_.size());
    kernels::multiply(basis_.synthesis(m_, 1).data(), row(source_, even), row(field_, n), n, odd,
                      shape_.size());
    kernels::butterfly(row(field_, 0), row(field_, n), n * shape_.size());
  }

  void transport() {
    const int n = basis_.streams();
    const std::vector<double> reflected = reflected_radiance();
    for (int k = 0; k < n; ++k) {
      sweep(row(field_, k), k, shape_.levels - 1, -1, std::vector<double>(shape_.row(), 0.0));
    }
    if (m_ == 0) collect_ground_irradiance();
    for (int k = 0; k < n; ++k) sweep(row(field_, n + k), k, 0, 1, reflected);
  }

  // Replaces the source function of one stream by its radiance, from the level `first` in steps of
  // `step`.
  void sweep(double* q, int stream, int first, int step, std::vector<double> radiance) const {
    const std::size_t width = shape_.row(), suns = shape_.suns;
    std::vector<double> far_source(q + first * width, q + (first + 1) * width), next(width);
    std::copy(radiance.begin(), radiance.end(), q + first * width);
    for (int i = first + step; i >= 0 && i < shape_.levels; i += step) {
      const LayerWeights<N>& w = layers_[std::min(i, i - step) * basis_.streams() + stream];
      double* near = q + i * width;
      kernels::blend(w.t.v, radiance.data(), w.near.v, near, w.far.v, far_source.data(),
                     next.data(), width);
      for (std::size_t p = 1; p < n_slices(); ++p) {
        kernels::add_blend(derivative(w.t, p - 1), radiance.data(), derivative(w.near, p - 1), near,
                           derivative(w.far, p - 1), far_source.data(), next.data() + p * suns,
                           suns);
      }
      std::copy(near, near + width, far_source.begin());
      std::copy(next.begin(), next.end(), near);
      radiance.swap(next);
    }
  }

  // albedo / pi times the irradiance that the order before left on the ground; the sun's mode 0
  // only.
  std::vector<double> reflected_radiance() const {
    std::vector<double> r(shape_.row(), 0.0);
    if (m_ != 0) return r;
    const Dual<N> f = optics_.ground_albedo * (1 / std::numbers::pi);
    kernels::add_scaled(f.v, ground_.data(), r.data(), r.size());
    for (std::size_t p = 1; p < n_slices(); ++p) {
      kernels::add_scaled(derivative(f, p - 1), ground_.data(), r.data() + p * shape_.suns,
                          shape_.suns);
    }
    return r;
  }

  void collect_ground_irradiance() {
    std::fill(ground_.begin(), ground_.end(), 0.0);
    for (int k = 0; k < basis_.streams(); ++k) {
      kernels::add_scaled(2 * std::numbers::pi * basis_.weight(k) * basis_.mu(k), row(field_, k),
                          ground_.data(), shape_.row());
    }
  }

  void analyse() {
    const int n = basis_.streams(), even = basis_.rows(m_, 0), odd = basis_.rows(m_, 1);
    kernels::butterfly(row(field_, 0), row(field_, n), n * shape_.size());
    kernels::multiply(basis_.analysis(m_, 0).data(), row(field_, 0), moments_.data(), even, n,
                      shape_.size());
    kernels::multiply(basis_.analysis(m_, 1).data(), row(field_, n), row(moments_, even), odd, n,
                      shape_.size());
  }

  const Shells& shells_;
  const Optics<N>& optics_;
  const std::vector<double>& heights_;
  const std::vector<double>& sun_mu_;
  const StreamBasis& basis_;
  const FieldShape shape_;
  const int m_;
  int rows_;
  std::vector<Dual<N>> albedo_;           // [level][row]
  std::vector<LayerWeights<N>> layers_;   // [layer][stream]
  std::vector<double> moments_, source_;  // [row][level][slice][sun]
  std::vector<double> field_;             // [stream up, stream down][level][slice][sun]
  std::vector<double> ground_;            // [slice][sun]
};

// The largest moment per [level][slice][sun].
std::vector<double> largest_moments(const std::vector<double>& moments, std::size_t size) {
  std::vector<double> top(size, 0.0);
  for (std::size_t at = 0; at < moments.size(); at += size) {
    for (std::size_t j = 0; j < size; ++j) top[j] = std::max(top[j], std::abs(moments[at + j]));
  }
  return top;
}

double largest_ratio(const std::vector<double>& x, const std::vector<double>& scale) {
  double worst = 0;
  for (std::size_t j = 0; j < x.size(); ++j) {
    if (scale[j] > 0) worst = std::max(worst, x[j] / scale[j]);
  }
  return worst;
}

// Back from the order of the parities to ascending l.
std::vector<double> by_ascending_l(const std::vector<double>& v, const StreamBasis& basis, int m,
                                   std::size_t size) {
  std::vector<double> r(v.size());
  for (int l = m; l < basis.moments(); ++l) {
    const int from = (l - m) % 2 == 0 ? (l - m) / 2 : basis.rows(m, 0) + (l - m) / 2;
    std::copy_n(v.begin() + from * size, size, r.begin() + (l - m) * size);
  }
  return r;
}

template <int N>
void solve_mode(ModeSolver<N> solver, const StreamBasis& basis, const DiffuseOptions& options,
                int m, DiffuseField& field) {
  const std::size_t row = field.shape.row();
  std::vector<double> total(solver.moments().size(), 0.0), ground(row, 0.0);
  for (int order = 1;; ++order) {
    solver.advance();
    const std::vector<double> step = largest_moments(solver.moments(), field.shape.size());
    kernels::add_scaled(1, solver.moments().data(), total.data(), total.size());
    kernels::add_scaled(1, solver.ground().data(), ground.data(), row);
    if (m == 0) {
      field.orders = order;
      field.scale = largest_moments(total, field.shape.size());
    }
    if (largest_ratio(step, field.scale) < options.tolerance) {
      if (m > 0 && order == 1) return;
      break;
    }
    if (order == options.max_orders) {
      throw std::runtime_error("reference model: multiple scattering did not converge in " +
                               std::to_string(options.max_orders) + " orders");
    }
  }
  field.moments[m] = by_ascending_l(total, basis, m, field.shape.size());
  if (m == 0) field.ground_irradiance = ground;
}

}  // namespace

template <int N>
std::vector<DiffuseField> solve_diffuse_fields(const Shells& shells,
                                               std::span<const Optics<N>> optics, int slices,
                                               const std::vector<double>& heights,
                                               const std::vector<double>& sun_mu,
                                               const StreamBasis& basis,
                                               const DiffuseOptions& options) {
  const int waves = static_cast<int>(optics.size()), modes = basis.moments();
  const FieldShape shape{static_cast<int>(heights.size()), slices, static_cast<int>(sun_mu.size())};
  std::vector<DiffuseField> fields(waves);
  auto solve = [&](int wave, int m) {
    solve_mode(ModeSolver<N>(shells, optics[wave], heights, sun_mu, basis, shape, m), basis,
               options, m, fields[wave]);
  };
  tbb::parallel_for(0, waves, [&](int w) {
    fields[w].shape = shape;
    fields[w].moments.resize(modes);
    solve(w, 0);
  });
  tbb::parallel_for(0, waves * (modes - 1),
                    [&](int task) { solve(task % waves, 1 + task / waves); });
  return fields;
}

template std::vector<DiffuseField> solve_diffuse_fields<0>(
    const Shells&, std::span<const Optics<0>>, int, const std::vector<double>&,
    const std::vector<double>&, const StreamBasis&, const DiffuseOptions&);
template std::vector<DiffuseField> solve_diffuse_fields<kParameterCount>(
    const Shells&, std::span<const Optics<kParameterCount>>, int, const std::vector<double>&,
    const std::vector<double>&, const StreamBasis&, const DiffuseOptions&);

}  // namespace skyfit
