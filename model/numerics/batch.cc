// SPDX-License-Identifier: Apache-2.0
#include "model/numerics/batch.h"

#include "model/numerics/clones.h"

namespace skyfit::batch {
namespace {

typedef double Vector
    __attribute__((vector_size(kBatchWidth * sizeof(double)), aligned(8), may_alias));

}  // namespace

SKYFIT_CLONES
void multiply(const double* __restrict a, const double* __restrict b, const double* __restrict d,
              double* __restrict c, std::size_t rows, std::size_t inner, std::size_t columns) {
  const Vector* const va = reinterpret_cast<const Vector*>(a);
  const Vector* const vb = reinterpret_cast<const Vector*>(b);
  const Vector* const vd = reinterpret_cast<const Vector*>(d);
  Vector* const vc = reinterpret_cast<Vector*>(c);
  constexpr std::size_t kRows = 3, kColumns = 4;  // a block of C that stays in registers
  if (rows < kRows || columns < kColumns) {
    for (std::size_t i = 0; i < rows; ++i) {
      for (std::size_t j = 0; j < columns; ++j) {
        Vector sum = d ? vd[i * columns + j] : Vector{};
        for (std::size_t k = 0; k < inner; ++k) sum += va[i * inner + k] * vb[k * columns + j];
        vc[i * columns + j] = sum;
      }
    }
    return;
  }
  // The last blocks overlap the ones before and write the same numbers again.
  for (std::size_t column = 0; column < columns; column += kColumns) {
    const std::size_t j = column + kColumns <= columns ? column : columns - kColumns;
    for (std::size_t row = 0; row < rows; row += kRows) {
      const std::size_t i = row + kRows <= rows ? row : rows - kRows;
      Vector s00{}, s01{}, s02{}, s03{}, s10{}, s11{}, s12{}, s13{}, s20{}, s21{}, s22{}, s23{};
      const Vector* x = va + i * inner;
      const Vector* y = vb + j;
      for (std::size_t k = 0; k < inner; ++k, ++x, y += columns) {
        const Vector x0 = x[0], x1 = x[inner], x2 = x[2 * inner];
        s00 += x0 * y[0], s01 += x0 * y[1], s02 += x0 * y[2], s03 += x0 * y[3];
        s10 += x1 * y[0], s11 += x1 * y[1], s12 += x1 * y[2], s13 += x1 * y[3];
        s20 += x2 * y[0], s21 += x2 * y[1], s22 += x2 * y[2], s23 += x2 * y[3];
      }
      Vector* out = vc + i * columns + j;
      if (d) {
        const Vector* add = vd + i * columns + j;
        s00 += add[0], s01 += add[1], s02 += add[2], s03 += add[3];
        add += columns;
        s10 += add[0], s11 += add[1], s12 += add[2], s13 += add[3];
        add += columns;
        s20 += add[0], s21 += add[1], s22 += add[2], s23 += add[3];
      }
      out[0] = s00, out[1] = s01, out[2] = s02, out[3] = s03;
      out += columns;
      out[0] = s10, out[1] = s11, out[2] = s12, out[3] = s13;
      out += columns;
      out[0] = s20, out[1] = s21, out[2] = s22, out[3] = s23;
    }
  }
}

SKYFIT_CLONES
void solve(double* __restrict a, double* __restrict b, std::size_t n, std::size_t columns) {
  Vector* const va = reinterpret_cast<Vector*>(a);
  Vector* const vb = reinterpret_cast<Vector*>(b);
  for (std::size_t k = 0; k < n; ++k) {
    const Vector inverse = 1.0 / va[k * n + k];
    for (std::size_t j = k + 1; j < n; ++j) va[k * n + j] *= inverse;
    for (std::size_t j = 0; j < columns; ++j) vb[k * columns + j] *= inverse;
    for (std::size_t i = k + 1; i < n; ++i) {
      const Vector factor = va[i * n + k];
      for (std::size_t j = k + 1; j < n; ++j) va[i * n + j] -= factor * va[k * n + j];
      for (std::size_t j = 0; j < columns; ++j) vb[i * columns + j] -= factor * vb[k * columns + j];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t i = 0; i < k; ++i) {
      const Vector factor = va[i * n + k];
      for (std::size_t j = 0; j < columns; ++j) vb[i * columns + j] -= factor * vb[k * columns + j];
    }
  }
}

SKYFIT_CLONES
void butterfly(double* __restrict x, double* __restrict y, std::size_t count) {
  for (std::size_t i = 0; i < count * kBatchWidth; ++i) {
    const double sum = x[i] + y[i];
    y[i] = x[i] - y[i];
    x[i] = sum;
  }
}

SKYFIT_CLONES
void blend(const double* __restrict near, const double* __restrict q_near,
           const double* __restrict far, const double* __restrict q_far, double* __restrict out,
           std::size_t count) {
  for (std::size_t i = 0; i < count * kBatchWidth; ++i)
    out[i] = near[i] * q_near[i] + far[i] * q_far[i];
}

SKYFIT_CLONES
void add_scaled(const double* __restrict a, const double* __restrict x, double* __restrict out,
                std::size_t count) {
  const Vector factor = *reinterpret_cast<const Vector*>(a);
  const Vector* const vx = reinterpret_cast<const Vector*>(x);
  Vector* const o = reinterpret_cast<Vector*>(out);
  for (std::size_t i = 0; i < count; ++i) o[i] += factor * vx[i];
}

SKYFIT_CLONES
void add_blend(const double* __restrict near, const double* __restrict q_near,
               const double* __restrict far, const double* __restrict q_far, double* __restrict out,
               std::size_t rows, std::size_t columns) {
  const Vector* const n = reinterpret_cast<const Vector*>(near);
  const Vector* const f = reinterpret_cast<const Vector*>(far);
  const Vector* const qn = reinterpret_cast<const Vector*>(q_near);
  const Vector* const qf = reinterpret_cast<const Vector*>(q_far);
  Vector* const o = reinterpret_cast<Vector*>(out);
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t j = r * columns; j < (r + 1) * columns; ++j)
      o[j] += n[r] * qn[j] + f[r] * qf[j];
  }
}

namespace {

inline __attribute__((always_inline)) const Vector* vectors(const double* p) {
  return reinterpret_cast<const Vector*>(p);
}

// docs/theory (6.2) and (6.3).
// K: how many scatterers, known to the compiler where there are few.
template <std::size_t K>
inline __attribute__((always_inline)) void layer_tangent_of(const LayerTangent& in, double* out,
                                                            std::size_t rows, std::size_t suns,
                                                            std::size_t parameters) {
  Vector* o = reinterpret_cast<Vector*>(out);
  const std::size_t scatterers = K > 0 ? K : in.scatterers;
  constexpr std::size_t kRoom = K > 0 ? K : kMostScatterers;
  for (std::size_t r = 0; r < rows; ++r) {
    const Vector* const depth = vectors(in.depth) + r * parameters;
    for (std::size_t j = 0; j < suns; ++j) {
      const std::size_t k = r * suns + j;
      Vector g = -vectors(in.t)[r] * vectors(in.x)[k], g_near{}, g_far{}, by_share[2][kRoom];
      for (std::size_t i = 0; i < 2; ++i) {
        const LayerEndTangent& e = in.end[i];
        Vector diffuse{}, beam{};
        for (std::size_t s = 0; s < scatterers; ++s) {
          const ScattererTangent& of = e.scatterer[s];
          const Vector d = vectors(of.diffuse)[k], b = vectors(of.beam)[k];
          diffuse += *vectors(of.share) * d;
          beam += *vectors(of.share) * b;
          by_share[i][s] = vectors(e.weight)[r] * d + vectors(e.beam)[k] * b;
        }
        g += vectors(e.slope)[r] * diffuse + vectors(e.beam_slopes[0])[k] * beam;
        g_near += vectors(e.beam_slopes[1])[k] * beam;
        g_far += vectors(e.beam_slopes[2])[k] * beam;
      }
      const Vector *sn = vectors(in.sun_near) + j * parameters,
                   *sf = vectors(in.sun_far) + j * parameters;
      for (std::size_t p = 0; p < parameters; ++p) {
        Vector sum = g * depth[p] + g_near * sn[p] + g_far * sf[p];
        for (std::size_t s = 0; s < scatterers; ++s) {
          sum += by_share[0][s] * vectors(in.end[0].scatterer[s].share_tangent)[p] +
                 by_share[1][s] * vectors(in.end[1].scatterer[s].share_tangent)[p];
        }
        *o++ = sum;
      }
    }
  }
}

}  // namespace

SKYFIT_CLONES
void layer_tangent(const LayerTangent& in, double* __restrict out, std::size_t rows,
                   std::size_t suns, std::size_t parameters) {
  if (in.scatterers == 1) return layer_tangent_of<1>(in, out, rows, suns, parameters);
  if (in.scatterers == 2) return layer_tangent_of<2>(in, out, rows, suns, parameters);
  if (in.scatterers == 3) return layer_tangent_of<3>(in, out, rows, suns, parameters);
  layer_tangent_of<0>(in, out, rows, suns, parameters);
}

SKYFIT_CLONES
void add_phase_tangent(const PhaseTangent end[2], double* __restrict out, std::size_t rows,
                       std::size_t suns, std::size_t parameters, std::size_t p) {
  const auto at = [](const double* x) __attribute__((always_inline)) {
    return reinterpret_cast<const Vector*>(x);
  };
  Vector* const o = reinterpret_cast<Vector*>(out) + p;
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t k = r * suns; k < (r + 1) * suns; ++k) {
      for (int i = 0; i < 2; ++i)
        o[k * parameters] += *at(end[i].share) * (at(end[i].weight)[r] * at(end[i].diffuse)[k] +
                                                  at(end[i].beam)[k] * at(end[i].beam_source)[k]);
    }
  }
}

SKYFIT_CLONES
void scale_rows(const double* __restrict d, const double* __restrict x, double* __restrict out,
                std::size_t rows, std::size_t columns) {
  const Vector* const vd = reinterpret_cast<const Vector*>(d);
  const Vector* const vx = reinterpret_cast<const Vector*>(x);
  Vector* const o = reinterpret_cast<Vector*>(out);
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t j = r * columns; j < (r + 1) * columns; ++j) o[j] = vd[r] * vx[j];
  }
}

}  // namespace skyfit::batch
