// SPDX-License-Identifier: Apache-2.0
// How the rows of render_features.h are written, and the lists that they stand in.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "render/features/render_features.h"

namespace skyfit {

std::vector<RenderFeature> scene_features();
std::vector<RenderFeature> block_features();  // of the ground
std::vector<RenderFeature> picture_features();

template <class T>
struct Stored {
  using Type = T;
  static std::optional<double> read(const T& value) { return static_cast<double>(value); }
};
template <class T>
struct Stored<std::optional<T>> {
  using Type = T;
  static std::optional<double> read(const std::optional<T>& value) {
    return value ? std::optional<double>(*value) : std::nullopt;
  }
};

// A row of one value, the member of FrameOptions that a lambda without captures returns.
template <class Member>
RenderFeature with_value(Member, RenderFeature row) {
  using Value = std::remove_reference_t<std::invoke_result_t<Member, FrameOptions&>>;
  row.get = [](const FrameOptions& options) { return Stored<Value>::read(Member{}(options)); };
  row.set = [](FrameOptions& options, double value) {
    Member{}(options) = static_cast<typename Stored<Value>::Type>(value);
  };
  std::vector<std::string_view> words;
  for (const FeatureWord& each : row.words) words.push_back(each.word);
  if (!words.empty()) row.options.front().type = fmt::format("{}", fmt::join(words, "|"));
  return row;
}

template <class Enum>
FeatureWord word(std::string_view text, Enum value) {
  return {text, static_cast<int>(value)};
}

}  // namespace skyfit
