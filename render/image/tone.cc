// SPDX-License-Identifier: Apache-2.0
#include "render/image/tone.h"

#include <algorithm>
#include <cmath>

#include "render/image/gamut.h"

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

}  // namespace

std::vector<std::uint8_t> tone_mapped(const Frame& frame, const ToneOptions& tone) {
  const double exposure = tone.exposure.value() * std::exp2(tone.exposure_stops);
  const ColorSpace& display = color_space(Primaries::kRec709);
  const auto curve = [&](double x) {
    return tone.curve == ToneCurve::kFilmic ? film(x) : 1 - std::exp(-std::max(x, 0.0));
  };
  std::vector<std::uint8_t> bytes(frame.rgb.size());
  for (std::size_t pixel = 0; pixel < frame.luminance.size(); ++pixel) {
    ColorChannels rgb;
    for (std::size_t k = 0; k < 3; ++k) rgb[k] = exposure * frame.rgb[3 * pixel + k];
    rgb = into_gamut(converted(rgb, color_space(frame.primaries), display),
                     exposure * frame.luminance[pixel], display.white);
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
