// SPDX-License-Identifier: Apache-2.0
// foreach_target.h includes this file once per instruction set and must come before highway.h.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/atmosphere/column_kernels.cc"
#include "hwy/foreach_target.h"

#include "model/atmosphere/column_kernels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "hwy/contrib/math/math-inl.h"
#include "hwy/highway.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace skyfit::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<double>;
using V = hn::Vec<D>;

// (1 + 2 z) exp(z^2) erfc(z) for z = 0 .. kErfcEnd as a Chebyshev series in the variable
// (z - 3.75) / (z + 3.75) (Shepherd & Laframboise 1981), beyond as the asymptotic series.
HWY_INLINE V scaled_erfc(D d, V z, const double* series, std::size_t terms, double end) {
  const V one = hn::Set(d, 1.0);
  const V clipped = hn::Min(z, hn::Set(d, end));
  const V k = hn::Set(d, 3.75);
  const V t = hn::Div(hn::Sub(clipped, k), hn::Add(clipped, k));
  const double t_end = (end - 3.75) / (end + 3.75);
  const V u = hn::MulAdd(t, hn::Set(d, 2 / (t_end + 1)), hn::Set(d, (1 - t_end) / (t_end + 1)));
  const V twice = hn::Add(u, u);
  V b0 = hn::Zero(d), b1 = hn::Zero(d);
  for (std::size_t i = terms - 1; i > 0; --i) {  // Clenshaw's recursion
    const V next = hn::Add(hn::MulSub(twice, b0, b1), hn::Set(d, series[i]));
    b1 = b0;
    b0 = next;
  }
  const V sum = hn::Add(hn::MulSub(u, b0, b1), hn::Set(d, series[0]));
  const V near = hn::Div(sum, hn::MulAdd(hn::Set(d, 2.0), clipped, one));
  const V safe = hn::Max(z, hn::Set(d, end));
  const V q = hn::Div(hn::Set(d, 0.5), hn::Mul(safe, safe));
  V far = one;
  for (double n = 13; n > 0; n -= 2) far = hn::NegMulAdd(hn::Mul(hn::Set(d, n), q), far, one);
  far = hn::Div(far, hn::Mul(safe, hn::Set(d, std::sqrt(std::numbers::pi))));
  return hn::IfThenElse(hn::Lt(z, hn::Set(d, end)), near, far);
}

struct Erfc {
  const double* series;
  std::size_t terms;
  double end;
};

// chapman() of model/atmosphere/slant_column.cc.
HWY_INLINE void chapman(D d, V x, V mu, V erfc_of_z, double order_limit_x, V& value, V& by_x) {
  const V a = hn::Mul(hn::Set(d, 0.5), x);
  const V mu2 = hn::Mul(mu, mu);
  const V two_a = x;
  const V inverse = hn::Div(hn::Set(d, 1.0), two_a);
  const V c = hn::Mul(two_a, mu2);
  const V one = hn::Set(d, 1.0);
  V m[6];
  m[0] = hn::Mul(hn::Sqrt(hn::Div(hn::Set(d, std::numbers::pi / 4), a)), erfc_of_z);
  m[1] = hn::Mul(hn::MulAdd(hn::Sub(one, c), m[0], mu), inverse);
  for (int k = 1; k + 1 < 6; ++k) {
    m[k + 1] = hn::Mul(hn::MulAdd(hn::Sub(hn::Set(d, 1.0 + 2 * k), c), m[k],
                                  hn::Mul(hn::Mul(hn::Set(d, 2.0 * k), mu2), m[k - 1])),
                       inverse);
  }
  constexpr double kFirstOrder = 1e10, kSecondOrder = 1e5;  // as in chapman()
  V sum = m[0], slope = hn::Mul(hn::Set(d, -0.5), m[1]);
  if (order_limit_x < kFirstOrder) {
    sum = hn::MulAdd(hn::Mul(x, hn::Set(d, 1.0 / 8)), m[2], sum);
    slope = hn::Add(slope, hn::MulAdd(hn::Mul(x, hn::Set(d, -1.0 / 16)), m[3],
                                      hn::Mul(hn::Set(d, 1.0 / 8), m[2])));
  }
  if (order_limit_x < kSecondOrder) {
    const V x2 = hn::Mul(x, x);
    sum = hn::MulAdd(hn::Mul(x, hn::Set(d, -1.0 / 16)), m[3], sum);
    sum = hn::MulAdd(hn::Mul(x2, hn::Set(d, 1.0 / 128)), m[4], sum);
    slope = hn::MulAdd(hn::Set(d, -1.0 / 16), m[3], slope);
    slope = hn::MulAdd(hn::Mul(x, hn::Set(d, 3.0 / 64)), m[4], slope);
    slope = hn::NegMulAdd(hn::Mul(x2, hn::Set(d, 1.0 / 256)), m[5], slope);
  }
  value = hn::Mul(x, sum);
  by_x = hn::MulAdd(x, slope, sum);
}

struct Layer {
  double bottom_radius, scale_height;
  double order_limit_x;  // which orders of the expansion are worth their rounding
  Erfc erfc;
};

// column_to_infinity() of model/atmosphere/slant_column.cc.
HWY_INLINE void to_infinity(D d, const Layer& layer, V height, V mu, V& value, V& slope) {
  const V scale = hn::Set(d, layer.scale_height);
  const V x = hn::Div(hn::Add(hn::Set(d, layer.bottom_radius), height), scale);
  const V relative = hn::Div(height, scale);
  const V density = hn::Exp(d, hn::Neg(relative));
  const V z = hn::Mul(mu, hn::Sqrt(hn::Mul(hn::Set(d, 0.5), x)));
  V c, by_x;
  chapman(d, x, mu, scaled_erfc(d, z, layer.erfc.series, layer.erfc.terms, layer.erfc.end),
          layer.order_limit_x, c, by_x);
  value = hn::Mul(hn::Mul(density, scale), c);
  slope = hn::Mul(density, hn::NegMulAdd(x, by_x, hn::Mul(c, hn::Add(hn::Set(d, 1.0), relative))));
}

HWY_INLINE V tangent_height(D d, V radius, V height, V mu) {
  const V mu2 = hn::Mul(mu, mu), one = hn::Set(d, 1.0);
  const V sine = hn::Sqrt(hn::Max(hn::Sub(one, mu2), hn::Zero(d)));
  return hn::Sub(height, hn::Div(hn::Mul(radius, mu2), hn::Add(one, sine)));
}

// Calls f(first, lanes) for blocks of points; the last may be short.
template <class F>
HWY_INLINE void for_blocks(D d, std::size_t count, const F& f) {
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t i = 0; i < count; i += lanes) f(i, std::min(lanes, count - i));
}

HWY_INLINE V load(D d, const double* p, std::size_t lanes) {
  if (lanes == hn::Lanes(d)) return hn::LoadU(d, p);
  HWY_ALIGN double block[HWY_MAX_BYTES / sizeof(double)];
  for (std::size_t i = 0; i < hn::Lanes(d); ++i) block[i] = p[std::min(i, lanes - 1)];
  return hn::Load(d, block);
}

HWY_INLINE void store(D d, V v, double* p, std::size_t lanes) {
  if (lanes == hn::Lanes(d)) return hn::StoreU(v, d, p);
  HWY_ALIGN double block[HWY_MAX_BYTES / sizeof(double)];
  hn::Store(v, d, block);
  std::copy_n(block, lanes, p);
}

void ExponentialColumns(const Sphere& sphere, double scale_height, const double* series,
                        std::size_t terms, double erfc_end, std::size_t count, const double* height,
                        const double* mu, double* value, double* by_scale_height) {
  const D d;
  const double top = sphere.top, r_top = sphere.bottom_radius + top;
  const Layer layer{sphere.bottom_radius,
                    scale_height,
                    sphere.bottom_radius / scale_height,
                    {series, terms, erfc_end}};
  const V radius0 = hn::Set(d, sphere.bottom_radius);
  for_blocks(d, count, [&](std::size_t first, std::size_t lanes) {
    const V h = load(d, height + first, lanes), m = load(d, mu + first, lanes);
    const V r = hn::Add(radius0, h);
    V c, slope;
    to_infinity(d, layer, h, hn::Abs(m), c, slope);
    const auto descends = hn::Lt(m, hn::Zero(d));
    if (!hn::AllFalse(d, descends)) {
      V tangent, tangent_slope;
      to_infinity(d, layer, hn::IfThenElse(descends, tangent_height(d, r, h, m), h), hn::Zero(d),
                  tangent, tangent_slope);
      c = hn::IfThenElse(descends, hn::MulSub(hn::Set(d, 2.0), tangent, c), c);
      slope = hn::IfThenElse(descends, hn::MulSub(hn::Set(d, 2.0), tangent_slope, slope), slope);
    }
    constexpr double kNothingAbove = 40;  // as in exponential_column()
    const V below_top = hn::Sub(hn::Set(d, top), h);
    const auto cut = hn::Lt(below_top, hn::Set(d, kNothingAbove * scale_height));
    if (!hn::AllFalse(d, cut)) {
      const V lift = hn::Mul(below_top, hn::Add(h, hn::Set(d, top + 2 * sphere.bottom_radius)));
      const V along = hn::Mul(r, m);
      const V mu_top2 = hn::Mul(hn::MulAdd(along, along, lift), hn::Set(d, 1 / (r_top * r_top)));
      V above, above_slope;
      to_infinity(d, layer, hn::Set(d, top), hn::Sqrt(hn::Max(mu_top2, hn::Zero(d))), above,
                  above_slope);
      c = hn::IfThenElse(cut, hn::Sub(c, above), c);
      slope = hn::IfThenElse(cut, hn::Sub(slope, above_slope), slope);
    }
    store(d, c, value + first, lanes);
    store(d, slope, by_scale_height + first, lanes);
  });
}

// Mean height of the path between two heights of a ray that rises, times its length is taken by
// Gauss's rule in `parts` equal parts; column_between() of model/atmosphere/slant_column.cc.
HWY_INLINE V rising_piece(D d, double bottom_radius, V height, V along, double low_edge,
                          double high, double low_density, double high_density, double end,
                          int parts) {
  static constexpr double kNode[4] = {0.0694318442029737, 0.3300094782075719, 0.6699905217924281,
                                      0.9305681557970263};
  static constexpr double kWeight[4] = {0.1739274225687269, 0.3260725774312731, 0.3260725774312731,
                                        0.1739274225687269};
  const V zero = hn::Zero(d), along2 = hn::Mul(along, along);
  const V r0 = hn::Add(hn::Set(d, bottom_radius), height), r02 = hn::Mul(r0, r0);
  const auto distance_at = [&](V h) {
    const V lift =
        hn::Mul(hn::Sub(h, height), hn::Add(hn::Add(h, height), hn::Set(d, 2 * bottom_radius)));
    return hn::Sqrt(hn::Max(hn::Add(along2, lift), zero));
  };
  const V low = hn::Min(hn::Max(hn::Set(d, low_edge), height), hn::Set(d, end));
  const V begin = distance_at(low);
  const V length = hn::Sub(distance_at(hn::Set(d, end)), begin);
  V mean = zero;
  for (int part = 0; part < parts; ++part) {
    for (int i = 0; i < 4; ++i) {
      const V t = hn::MulAdd(length, hn::Set(d, (part + kNode[i]) / parts), begin);
      const V gain = hn::MulSub(t, t, along2);
      const V h =
          hn::Add(height, hn::Div(gain, hn::Add(r0, hn::Sqrt(hn::Max(hn::Add(r02, gain), zero)))));
      mean = hn::MulAdd(hn::Set(d, kWeight[i] / parts), h, mean);
    }
  }
  const double per_metre = (high_density - low_density) / (high - low_edge);
  const V density = hn::MulAdd(hn::Sub(mean, hn::Set(d, low_edge)), hn::Set(d, per_metre),
                               hn::Set(d, low_density));
  return hn::IfThenElse(hn::Lt(height, hn::Set(d, end)), hn::Mul(length, density), zero);
}

void LinearColumns(const Sphere& sphere, const double* edge, const double* density,
                   std::size_t corners, std::size_t count, const double* height, const double* mu,
                   double* value) {
  const D d;
  const double bottom = sphere.bottom_radius;
  const auto rising = [&](V h, V along) {
    V sum = hn::Zero(d);
    for (std::size_t i = 0; i + 1 < corners; ++i) {
      const double end = std::min(edge[i + 1], sphere.top);
      if (end <= edge[i] || (density[i] == 0 && density[i + 1] == 0)) continue;
      // Enough for the longest path through the piece, from its tangent point.
      const double longest = std::sqrt((end - edge[i]) * (2 * bottom + end + edge[i]));
      const int parts = static_cast<int>(std::ceil(4 * longest / (bottom + edge[i])));
      sum = hn::Add(sum, rising_piece(d, bottom, h, along, edge[i], edge[i + 1], density[i],
                                      density[i + 1], end, parts));
    }
    return sum;
  };
  for_blocks(d, count, [&](std::size_t first, std::size_t lanes) {
    const V h = load(d, height + first, lanes), m = load(d, mu + first, lanes);
    const V r = hn::Add(hn::Set(d, bottom), h);
    V c = rising(h, hn::Mul(r, hn::Abs(m)));
    const auto descends = hn::Lt(m, hn::Zero(d));
    if (!hn::AllFalse(d, descends)) {
      const V tangent = rising(tangent_height(d, r, h, m), hn::Zero(d));
      c = hn::IfThenElse(descends, hn::MulSub(hn::Set(d, 2.0), tangent, c), c);
    }
    store(d, c, value + first, lanes);
  });
}

void ExponentialDensities(double scale_height, std::size_t count, const double* height,
                          double* density) {
  const D d;
  const V scale = hn::Set(d, -1 / scale_height);
  for_blocks(d, count, [&](std::size_t first, std::size_t lanes) {
    store(d, hn::Exp(d, hn::Mul(load(d, height + first, lanes), scale)), density + first, lanes);
  });
}

void WeightedTransmittances(std::size_t count, const double* weight, std::size_t columns_count,
                            const double* const* columns, const double* extinction, double* e) {
  const D d;
  for_blocks(d, count, [&](std::size_t first, std::size_t lanes) {
    V tau = hn::Zero(d);
    for (std::size_t k = 0; k < columns_count; ++k)
      tau = hn::MulAdd(hn::Set(d, extinction[k]), load(d, columns[k] + first, lanes), tau);
    store(d, hn::Mul(hn::Exp(d, hn::Neg(tau)), load(d, weight + first, lanes)), e + first, lanes);
  });
}

double ProductAndSum(std::size_t count, const double* x, const double* y, double* out) {
  const D d;
  V sum = hn::Zero(d);
  for_blocks(d, count, [&](std::size_t first, std::size_t lanes) {
    const V product = hn::Mul(load(d, x + first, lanes), load(d, y + first, lanes));
    store(d, product, out + first, lanes);
    sum = hn::Add(sum, hn::IfThenElseZero(hn::FirstN(d, lanes), product));
  });
  return hn::GetLane(hn::SumOfLanes(d, sum));
}

double Dot(std::size_t count, const double* x, const double* y) {
  const D d;
  V sum = hn::Zero(d);
  for_blocks(d, count, [&](std::size_t first, std::size_t lanes) {
    const V a = hn::IfThenElseZero(hn::FirstN(d, lanes), load(d, x + first, lanes));
    sum = hn::MulAdd(a, load(d, y + first, lanes), sum);
  });
  return hn::GetLane(hn::SumOfLanes(d, sum));
}

}  // namespace skyfit::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skyfit::kernels {
namespace {

HWY_EXPORT(ExponentialColumns);
HWY_EXPORT(LinearColumns);
HWY_EXPORT(ExponentialDensities);
HWY_EXPORT(WeightedTransmittances);
HWY_EXPORT(ProductAndSum);
HWY_EXPORT(Dot);

constexpr double kErfcEnd = 9;  // there the first term left out of the other series is below 1e-14
constexpr std::size_t kErfcTerms = 26;  // the last are below 1e-17

// Interpolation at Chebyshev's points, with the C library's erfc.
std::array<double, kErfcTerms> erfc_series() {
  constexpr long double kPi = std::numbers::pi_v<long double>;
  constexpr int n = 64;
  const long double end = (kErfcEnd - 3.75L) / (kErfcEnd + 3.75L);
  std::array<double, kErfcTerms> series{};
  std::array<long double, kErfcTerms> sum{};
  for (int i = 0; i < n; ++i) {
    const long double angle = kPi * (i + 0.5L) / n;
    const long double t = 0.5L * (std::cos(angle) * (end + 1) + (end - 1));
    const long double z = 3.75L * (1 + t) / (1 - t);
    const long double f = (1 + 2 * z) * std::exp(z * z) * std::erfc(z);
    for (std::size_t k = 0; k < kErfcTerms; ++k)
      sum[k] += (k == 0 ? 1.0L : 2.0L) / n * f * std::cos(static_cast<long double>(k) * angle);
  }
  for (std::size_t k = 0; k < kErfcTerms; ++k) series[k] = static_cast<double>(sum[k]);
  return series;
}

}  // namespace

void exponential_columns(const Sphere& sphere, double scale_height, std::size_t count,
                         const double* height, const double* mu, double* value,
                         double* by_scale_height) {
  static const std::array<double, kErfcTerms> kSeries = erfc_series();
  HWY_DYNAMIC_DISPATCH(ExponentialColumns)
  (sphere, scale_height, kSeries.data(), kErfcTerms, kErfcEnd, count, height, mu, value,
   by_scale_height);
}

void linear_columns(const Sphere& sphere, const LinearProfile& profile, std::size_t count,
                    const double* height, const double* mu, double* value) {
  HWY_DYNAMIC_DISPATCH(LinearColumns)
  (sphere, profile.heights().data(), profile.densities().data(), profile.heights().size(), count,
   height, mu, value);
}

void exponential_densities(double scale_height, std::size_t count, const double* height,
                           double* density) {
  HWY_DYNAMIC_DISPATCH(ExponentialDensities)(scale_height, count, height, density);
}

void weighted_transmittances(std::size_t count, const double* weight, std::size_t columns_count,
                             const double* const* columns, const double* extinction, double* e) {
  HWY_DYNAMIC_DISPATCH(WeightedTransmittances)
  (count, weight, columns_count, columns, extinction, e);
}

double product_and_sum(std::size_t count, const double* x, const double* y, double* out) {
  return HWY_DYNAMIC_DISPATCH(ProductAndSum)(count, x, y, out);
}

double dot(std::size_t count, const double* x, const double* y) {
  return HWY_DYNAMIC_DISPATCH(Dot)(count, x, y);
}

}  // namespace skyfit::kernels
#endif  // HWY_ONCE
