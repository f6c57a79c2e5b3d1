// SPDX-License-Identifier: Apache-2.0
#include "cli/feature_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/arguments.h"
#include "render/features/render_features.h"

namespace skyfit::cli {
namespace {

// A PNG is what an eye sees.
FrameOptions usual_frame() {
  FrameOptions frame;
  frame.glare = Glare::kEye;
  return frame;
}

std::string usual_text(const RenderFeature& feature) {
  if (feature.get == nullptr) return "";
  const auto value = feature.get(usual_frame());
  if (!value) return "";
  const auto word = std::ranges::find(feature.words, static_cast<int>(*value), &FeatureWord::value);
  return word != feature.words.end() ? std::string(word->word) : fmt::format("{:.9g}", *value);
}

double value_of(const RenderFeature& feature, const CLI::Option& typed) {
  const std::string& option = feature.options.front().name;
  if (feature.words.empty() && !feature.limits) return typed.as<bool>() ? 1 : 0;
  const std::string text = typed.results().front();
  if (feature.limits) {
    const double value = parse_number(option, text);
    if (!feature.limits->hold(value))
      throw UsageError(option, text, fmt::format("expected {}", feature.limits->text()));
    return value;
  }
  const auto found = std::ranges::find(feature.words, text, &FeatureWord::word);
  if (found != feature.words.end()) return found->value;
  std::vector<std::string_view> words;
  for (const FeatureWord& word : feature.words) words.push_back(word.word);
  throw UsageError(option, text,
                   fmt::format("expected {} or {}", fmt::join(words.begin(), words.end() - 1, ", "),
                               words.back()));
}

template <class Others>
std::vector<OptionPair> pairs(Others FeatureOption::*others) {
  std::vector<OptionPair> all;
  for (const RenderFeature& feature : render_features())
    for (const FeatureOption& option : feature.options)
      for (const std::string& other : option.*others) all.push_back({option.name, other});
  return all;
}

}  // namespace

void add_feature_options(CLI::App& command) {
  for (const RenderFeature& feature : render_features()) {
    for (const FeatureOption& option : feature.options) {
      CLI::Option* added =
          option.type.empty() ? command.add_flag(option.name) : command.add_option(option.name);
      added->description(option.meaning)->group(std::string(feature.group));
      if (option.type.empty()) continue;
      added->type_name(option.type)->default_str(usual_text(feature));
      if (option.repeats)
        added->expected(1, CLI::detail::expected_max_vector_size)
            ->allow_extra_args(false)
            ->take_all();
    }
  }
}

FrameOptions frame_with_features(const CLI::App& command) {
  FrameOptions frame = usual_frame();
  for (const RenderFeature& feature : render_features()) {
    if (feature.set == nullptr) continue;
    const CLI::Option& typed = *command.get_option(feature.options.front().name);
    if (typed.count() > 0) feature.set(frame, value_of(feature, typed));
  }
  return frame;
}

std::vector<OptionPair> feature_needs() { return pairs(&FeatureOption::needs); }
std::vector<OptionPair> feature_excludes() { return pairs(&FeatureOption::excludes); }

}  // namespace skyfit::cli
