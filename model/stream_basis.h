// SPDX-License-Identifier: Apache-2.0
// Normalised associated Legendre functions at the streams of the multiple-scattering solver.
// Lambda_lm = sqrt((2 l + 1) / (4 pi) (l - m)! / (l + m)!) P_lm, so that a phase function with
// moments chi_l is
//   P(v . w) = sum_m (2 - delta_m0) cos m(phi_v - phi_w) sum_l chi_l Lambda_lm(mu_v)
//   Lambda_lm(mu_w).
#pragma once

#include <vector>

#include "model/gauss.h"

namespace skyfit {

// Lambda_lm(mu) for l = m .. count - 1, written to out[0 .. count - m).
void normalised_legendre(int m, int count, double mu, double* out);

class StreamBasis {
 public:
  // `streams` cosines per hemisphere (double Gauss), `moments` <= 2 streams Legendre moments.
  StreamBasis(int streams, int moments);

  int streams() const { return static_cast<int>(rule_.node.size()); }
  int moments() const { return moments_; }
  double mu(int stream) const { return rule_.node[stream]; }
  double weight(int stream) const { return rule_.weight[stream]; }

  // For mode m and parity 0 (l - m even) or 1 (odd): rows of streams, columns of l = m + parity, m
  // + parity + 2, ..
  const std::vector<double>& synthesis(int m, int parity) const {
    return synthesis_[2 * m + parity];
  }
  // The transpose times 2 pi and the stream weights: rows of l, columns of streams.
  const std::vector<double>& analysis(int m, int parity) const { return analysis_[2 * m + parity]; }
  int rows(int m, int parity) const { return (moments_ - m - parity + 1) / 2; }

 private:
  GaussRule rule_;
  int moments_;
  std::vector<std::vector<double>> synthesis_, analysis_;
};

}  // namespace skyfit
