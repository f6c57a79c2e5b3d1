// SPDX-License-Identifier: Apache-2.0
#include "model/stream_basis.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skyfit {

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

StreamBasis::StreamBasis(int streams, int moments)
    : rule_(gauss_legendre(streams)),
      moments_(moments),
      synthesis_(2 * moments),
      analysis_(2 * moments) {
  std::vector<double> column(moments);
  for (int m = 0; m < moments; ++m) {
    for (int parity = 0; parity < 2; ++parity) {
      const int count = rows(m, parity);
      synthesis_[2 * m + parity].resize(static_cast<std::size_t>(streams) * count);
      analysis_[2 * m + parity].resize(static_cast<std::size_t>(streams) * count);
    }
    for (int i = 0; i < streams; ++i) {
      normalised_legendre(m, moments, rule_.node[i], column.data());
      for (int l = m; l < moments; ++l) {
        const int parity = (l - m) % 2, row = (l - m) / 2, count = rows(m, parity);
        synthesis_[2 * m + parity][i * count + row] = column[l - m];
        analysis_[2 * m + parity][row * streams + i] =
            2 * std::numbers::pi * rule_.weight[i] * column[l - m];
      }
    }
  }
}

}  // namespace skyfit
