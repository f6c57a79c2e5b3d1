// SPDX-License-Identifier: Apache-2.0
#include "render/image/tone.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace skyfit {
namespace {

// Narkowicz 2015, a fit of the ACES film curve; 0 to 0, about 0.8 at 1.
double film(double x) {
  x *= 0.8;
  return std::clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

double srgb_transfer(double x) {
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

// Uniform in 0..1 from a pixel and channel, without a visible pattern.
double white_noise(std::uint32_t index) {
  index ^= index >> 16;
  index *= 0x7feb352du;
  index ^= index >> 15;
  index *= 0x846ca68bu;
  index ^= index >> 16;
  return index * (1.0 / 4294967296.0);
}

// Colours that the display cannot show move toward grey of the same luminance.
std::array<double, 3> into_gamut(std::array<double, 3> rgb, double luminance) {
  const double lowest = std::min({rgb[0], rgb[1], rgb[2]});
  if (lowest >= 0 || luminance <= 0) {
    for (double& c : rgb) c = std::max(c, 0.0);
    return rgb;
  }
  const double keep = luminance / (luminance - lowest);
  for (double& c : rgb) c = std::max(luminance + keep * (c - luminance), 0.0);
  return rgb;
}

}  // namespace

std::vector<std::uint8_t> tone_mapped(const Frame& frame, const ToneOptions& tone) {
  const double exposure = tone.exposure.value() * std::exp2(tone.exposure_stops);
  const auto curve = [&](double x) {
    return tone.curve == ToneCurve::kFilmic ? film(x) : 1 - std::exp(-std::max(x, 0.0));
  };
  std::vector<std::uint8_t> bytes(frame.rgb.size());
  for (std::size_t pixel = 0; pixel < frame.luminance.size(); ++pixel) {
    std::array<double, 3> rgb{};
    for (std::size_t k = 0; k < 3; ++k) rgb[k] = exposure * frame.rgb[3 * pixel + k];
    rgb = into_gamut(rgb, exposure * frame.luminance[pixel]);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto index = static_cast<std::uint32_t>(3 * pixel + k);
      const double noise = white_noise(2 * index) - white_noise(2 * index + 1);
      const double level = 255 * srgb_transfer(curve(rgb[k])) + 0.5 + noise;
      bytes[3 * pixel + k] = static_cast<std::uint8_t>(std::clamp(std::floor(level), 0.0, 255.0));
    }
  }
  return bytes;
}

}  // namespace skyfit
