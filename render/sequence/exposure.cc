// SPDX-License-Identifier: Apache-2.0
#include "render/sequence/exposure.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "render/render.h"

namespace skyfit {
namespace {

// A picture whose mean logarithm is that of kOrdinary, cd/m^2, has middle grey as its mean;
// brighter ones are shown brighter and darker ones darker, as to the eye.
constexpr double kMiddleGrey = 0.18, kOrdinary = 500, kKeyPower = 0.15;
// At most one pixel in a hundred becomes brighter than this, which films and eyes see as white.
constexpr double kHighlights = 0.99, kHighlightLevel = 3;
// At most one in seven becomes brighter than this: land in the sun is not shown as snow.
constexpr double kBrightPart = 0.86, kBrightLevel = 0.5;
// Below this luminance pictures stay dark, as for the eye; above, a camera stops down no further.
// cd/m^2.
constexpr double kDarkest = 0.02;
constexpr double kBrightest = 3e4;
// Space is darker than this share of the highlights. A picture with a tenth of it, or more, is
// exposed for a white surface in the sun, as a photograph of a planet, or for four times the
// highlights where they are darker: the planet does not become grey because nothing on it is white.
constexpr double kSpace = 1e-4, kSpaceShare = 0.1, kSunlitWhite = 3e4, kPlanetHighlight = 4;
// A disc as wide as the second share of the picture's height is what the picture is exposed for,
// one below the first does not count.
constexpr double kSmallDisc = 0.08, kLargeDisc = 0.16, kDiscLevel = 0.8;

double quantile(std::vector<double>& values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// Luminances of what is shown, without the suns' discs.
void add_without_discs(const Frame& frame, std::vector<double>& luminances) {
  std::vector<double> all(frame.luminance.begin(), frame.luminance.end());
  for (const DiscPixel& disc : frame.discs)
    all[disc.pixel] = std::max(all[disc.pixel] - disc.luminance, 0.0);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (frame.view_zenith_deg.empty() || !std::isnan(frame.view_zenith_deg[i]))
      luminances.push_back(all[i]);
  }
}

// That the picture of a planet in space is exposed for; `level` otherwise.
double level_in_space(double level, double highlight, double space) {
  const double planet = std::min(kPlanetHighlight * highlight, kSunlitWhite);
  const double share = std::min(space / kSpaceShare, 1.0);
  return planet > level ? level * std::pow(planet / level, share) : level;
}

double level_of_disc(double level, std::span<const Frame* const> frames) {
  double area = 0, light = 0;  // area: in squared heights of the frame, summed over them
  for (const Frame* frame : frames) {
    for (const DiscPixel& disc : frame->discs) {
      area += disc.cover / std::pow(frame->height, 2);
      light += disc.luminance / std::pow(frame->height, 2);
    }
  }
  const double across = 2 * std::sqrt(area / static_cast<double>(frames.size()) / std::numbers::pi);
  const double part = std::clamp((across - kSmallDisc) / (kLargeDisc - kSmallDisc), 0.0, 1.0);
  if (part <= 0) return level;
  return std::max(level, level * std::pow(light / area / kDiscLevel / level, part));
}

}  // namespace

double metered_exposure(const Frame& frame) {
  const Frame* const alone = &frame;
  return metered_exposure(std::span(&alone, 1));
}

double metered_exposure(std::span<const Frame* const> frames) {
  std::vector<double> luminances;
  for (const Frame* frame : frames) add_without_discs(*frame, luminances);
  const double highlight = quantile(luminances, kHighlights);
  const double space_level = std::max(kSpace * highlight, 1e-3 * kDarkest);
  double sum = 0, seen = 0;
  for (const double luminance : luminances) {
    if (!(luminance > space_level)) continue;
    sum += std::log(std::min(luminance, kBrightest));
    ++seen;
  }
  if (seen == 0) return 1 / level_of_disc(kDarkest / kMiddleGrey, frames);
  const double mean = std::exp(sum / seen);
  const double key = kMiddleGrey * std::pow(std::max(mean, kDarkest) / kOrdinary, kKeyPower);
  const double bright = quantile(luminances, kBrightPart);
  double level = std::max({mean / key, highlight / kHighlightLevel, bright / kBrightLevel});
  level = level_in_space(level, highlight, 1 - seen / static_cast<double>(luminances.size()));
  level = std::clamp(level, kDarkest / kMiddleGrey, kBrightest / kMiddleGrey);
  return 1 / level_of_disc(level, frames);
}

double Adaptation::next(double metered, double passed_s) {
  const double share = adaptation_s_ > 0 ? -std::expm1(-passed_s / adaptation_s_) : 1;
  exposure_ = exposure_ > 0 ? exposure_ * std::pow(metered / exposure_, share) : metered;
  return exposure_;
}

}  // namespace skyfit
