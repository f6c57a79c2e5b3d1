// SPDX-License-Identifier: Apache-2.0
#include "model/numerics/wigner.h"

#include <algorithm>
#include <cmath>

namespace skyfit {
namespace {

// The square root of (2 j) over k.
double root_of_binomial(int j, int k) {
  double root = 1;
  for (int i = 1; i <= k; ++i) root *= std::sqrt((2.0 * j - k + i) / i);
  return root;
}

// d^j_{2n} of the lowest j that there is, max(2, |n|).
double lowest(int n, double cosine, double sine) {
  if (n > 2) return root_of_binomial(n, n - 2) * std::pow(cosine, n + 2) * std::pow(sine, n - 2);
  if (n < -2)
    return root_of_binomial(-n, -n - 2) * std::pow(cosine, -n - 2) * std::pow(-sine, 2 - n);
  return root_of_binomial(2, 2 - n) * std::pow(cosine, 2 + n) * std::pow(-sine, 2 - n);
}

}  // namespace

void wigner_d2(int n, int count, double mu, double* out) {
  const int first = std::max(2, std::abs(n));
  std::fill(out, out + std::min(count, first), 0.0);
  const double cosine = std::sqrt(std::max(0.5 * (1 + mu), 0.0)),
               sine = std::sqrt(std::max(0.5 * (1 - mu), 0.0)), n2 = static_cast<double>(n) * n;
  double before = 0, current = lowest(n, cosine, sine);
  for (int j = first; j < count; ++j) {
    out[j] = current;
    const double l = j, up = l + 1;
    const double next = ((2 * l + 1) * (l * up * mu - 2 * n) * current -
                         up * std::sqrt((l * l - 4) * (l * l - n2)) * before) /
                        (l * std::sqrt((up * up - 4) * (up * up - n2)));
    before = current;
    current = next;
  }
}

}  // namespace skyfit
