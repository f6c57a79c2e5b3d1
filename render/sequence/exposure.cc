// SPDX-License-Identifier: Apache-2.0
#include "render/sequence/exposure.h"

#include <algorithm>
#include <cmath>

#include "render/render.h"

namespace skyfit {
namespace {

// A mean of this becomes middle grey.
constexpr double kMiddleGrey = 0.18;
// At most one pixel in ten becomes brighter than this.
constexpr double kHighlights = 0.9, kHighlightLevel = 0.45;
// Below this luminance pictures stay dark, as for the eye; above, a camera stops down no further.
// cd/m^2.
constexpr double kDarkest = 0.02;
constexpr double kBrightest = 3e4;

}  // namespace

double metered_exposure(const Frame& frame) {
  std::vector<float> seen;
  double sum = 0;
  for (const float luminance : frame.luminance) {
    if (!(luminance > kDarkest * 1e-3)) continue;  // space
    seen.push_back(luminance);
    sum +=
        std::log(std::min<double>(luminance, kBrightest));  // the sun's disc counts as a bright sky
  }
  if (seen.empty()) return kMiddleGrey / kDarkest;
  const double mean = std::exp(sum / static_cast<double>(seen.size()));
  const auto high = seen.begin() +
                    static_cast<std::ptrdiff_t>(kHighlights * static_cast<double>(seen.size() - 1));
  std::nth_element(seen.begin(), high, seen.end());
  const double level = std::max(mean / kMiddleGrey, *high / kHighlightLevel);
  return 1 / std::clamp(level, kDarkest / kMiddleGrey, kBrightest / kMiddleGrey);
}

double Adaptation::next(double metered, double passed_s) {
  const double share = adaptation_s_ > 0 ? -std::expm1(-passed_s / adaptation_s_) : 1;
  exposure_ = exposure_ > 0 ? exposure_ * std::pow(metered / exposure_, share) : metered;
  return exposure_;
}

}  // namespace skyfit
