// SPDX-License-Identifier: Apache-2.0
// The names by which a preset calls the kinds of phase functions and profiles; those of
// corner_profiles() join them.
#pragma once

#include <fmt/format.h>

#include <array>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "model/atmosphere/constituent.h"
#include "model/atmosphere/star.h"
#include "model/base/preset_reader.h"

namespace skyfit {

template <class Enum>
struct Named {
  std::string_view name;
  Enum value;
};

inline constexpr std::array<Named<PhaseType>, 7> kPhaseTypes = {
    {{"cornette-shanks", PhaseType::kCornetteShanks},
     {"henyey-greenstein", PhaseType::kHenyeyGreenstein},
     {"two-lobe", PhaseType::kTwoLobe},
     {"tabulated", PhaseType::kTabulated},
     {"rayleigh", PhaseType::kRayleigh},
     {"tabulated-by-wavelength", PhaseType::kByWavelength},
     {"size-distribution", PhaseType::kSizeDistribution}}};
inline constexpr std::array<Named<PhaseType>, 2> kLobeTypes = {kPhaseTypes[0], kPhaseTypes[1]};
inline constexpr std::array<Named<ProfileType>, 5> kProfileTypes = {
    {{"exponential", ProfileType::kExponential},
     {"layer", ProfileType::kLayer},
     {"tabulated", ProfileType::kTabulated},
     {"same-as", ProfileType::kSameAs},
     {"square-of", ProfileType::kSquareOf}}};
inline constexpr std::array<Named<Absorber>, 2> kAbsorbers = {
    {{"ozone", Absorber::kOzone}, {"nitrogen-dioxide", Absorber::kNitrogenDioxide}}};

inline constexpr std::array<Named<StarSpectrum>, 3> kStarSpectra = {
    {{"solar", StarSpectrum::kSolar},
     {"black-body", StarSpectrum::kBlackBody},
     {"tabulated", StarSpectrum::kTabulated}}};

// `others`: names that are choices, too, and have been looked for.
template <class Enum, std::size_t N>
Enum read_choice(const PresetReader& object, std::string_view field,
                 const std::array<Named<Enum>, N>& choices,
                 std::span<const std::string_view> others = {}) {
  const std::string text = object.text(field);
  std::string names;
  for (const auto& choice : choices) {
    if (choice.name == text) return choice.value;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", choice.name);
  }
  for (const std::string_view name : others) names += fmt::format(", {}", name);
  object.fail_value(field, "one of " + names);
}

template <class Enum, std::size_t N>
std::string_view name_of(Enum value, const std::array<Named<Enum>, N>& choices) {
  for (const auto& choice : choices) {
    if (choice.value == value) return choice.name;
  }
  throw std::invalid_argument("an enumerator without a name");
}

}  // namespace skyfit
