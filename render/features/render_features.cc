// SPDX-License-Identifier: Apache-2.0
#include "render/features/render_features.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "render/features/feature_rows.h"

namespace skyfit {

bool FeatureLimits::hold(double value) const {
  return value >= lower && value <= upper && (!is_whole || value == std::floor(value));
}

std::string FeatureLimits::text() const {
  return fmt::format("{:.9g} to {:.9g}{}", lower, upper,
                     unit == "1" ? "" : fmt::format(" {}", unit));
}

std::span<const RenderFeature> render_features() {
  static const std::vector<RenderFeature> kRows = [] {
    std::vector<RenderFeature> rows = scene_features();
    std::ranges::move(block_features(), std::back_inserter(rows));
    std::ranges::move(picture_features(), std::back_inserter(rows));
    return rows;
  }();
  return kRows;
}

nlohmann::ordered_json feature_key(const RenderFeature& feature, const FrameOptions& options) {
  if (feature.get == nullptr) return feature.numbers(options);
  const auto value = feature.get(options);
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

std::vector<std::string> feature_defines(const FeatureShader& shader) {
  std::vector<std::string> defined;
  for (const RenderFeature& feature : render_features()) {
    if (feature.defines != nullptr)
      std::ranges::move(feature.defines(shader), std::back_inserter(defined));
  }
  return defined;
}

}  // namespace skyfit
