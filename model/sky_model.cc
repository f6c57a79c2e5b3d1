// SPDX-License-Identifier: Apache-2.0
#include "model/sky_model.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

#include "model/bruneton_model.h"
#include "model/reference_model.h"

namespace skyfit {

std::vector<std::string_view> sky_model_names() { return {"reference", "bruneton"}; }

std::unique_ptr<SkyModel> make_sky_model(std::string_view name, int threads) {
  if (name == "reference") {
    ReferenceOptions options;
    options.threads = threads;
    return std::make_unique<ReferenceModel>(options);
  }
  if (name == "bruneton") return std::make_unique<BrunetonModel>(threads);
  throw std::invalid_argument(
      fmt::format("model \"{}\": expected one of {}", name, fmt::join(sky_model_names(), ", ")));
}

}  // namespace skyfit
