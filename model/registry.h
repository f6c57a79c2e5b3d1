// SPDX-License-Identifier: Apache-2.0
// The sky models by name.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "model/sky_model.h"

namespace skyfit {

// What a model is made from.
struct SkyModelRequest {
  const SpectralData& spectra;  // what a model that speaks of luminance needs to speak of radiance
  int threads = 1;              // >= 1; results do not depend on it
  Transfer transfer = Transfer::kVector;   // of `reference` and `tables`; the others are scalar
  std::vector<std::string_view> variants;  // of the row's
};

// A choice that a source leaves open, written behind the model's name: "nielsen:mean-height". A
// name that ends in "=N" takes a whole number, as "oneil:samples=3".
struct SkyModelVariant {
  std::string_view name, meaning;
  bool draws_frames = true;  // of a renderer, with the ground in its light
  int least = 0, most = 0;   // N
};

struct SkyModelEntry {
  std::string_view name;
  std::string_view meaning;  // one line, with the source
  std::unique_ptr<SkyModel> (*make)(const SkyModelRequest& request);
  std::span<const SkyModelVariant> variants = {};
  bool sees_ground = true;  // radiance() knows rays below the horizon
};
// Whether a renderer can draw the model of that name with all its variants.
bool draws_frames(std::string_view name);
// Every model, the yardstick first.
std::span<const SkyModelEntry> sky_models();

// The row of a model, also by its name with variants. Throws std::invalid_argument that lists the
// known names.
const SkyModelEntry& sky_model_entry(std::string_view name);

// `name` is that of a row, with ":VARIANT" behind it for each of the row's variants that are
// wanted, each once. Throws std::invalid_argument that lists the known names.
std::unique_ptr<SkyModel> make_sky_model(std::string_view name, const SpectralData& spectra,
                                         int threads, Transfer transfer = Transfer::kVector);

}  // namespace skyfit
