// SPDX-License-Identifier: Apache-2.0
#include "model/literature/bodare_update.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>

namespace skyfit {

using literature::BodareSizes;
using literature::BodareTables;

void validate(const BodareUpdateOptions& options) {
  const auto require = [](bool good, std::string_view name, int value, std::string_view expected) {
    if (!good) {
      throw std::invalid_argument(
          fmt::format("bodare_update.{} = {}: must be {}", name, value, expected));
    }
  };
  constexpr int kSlices[] = {2, 4, 8, 16, 32};
  require(options.orders >= 1, "orders", options.orders, ">= 1");
  require(std::ranges::count(kSlices, options.slices) > 0, "slices", options.slices,
          "2, 4, 8, 16 or 32");
}

namespace {

bool same_rays(const Shells& a, const Shells& b) {
  return a.bottom_radius == b.bottom_radius && a.top == b.top && a.sun_radius == b.sun_radius &&
         a.profiles == b.profiles && a.breaks == b.breaks && a.layer_depth == b.layer_depth &&
         a.profile_of == b.profile_of;
}

}  // namespace

BodareSet::BodareSet(const Atmosphere<double>& atmosphere,
                     std::span<const WavelengthNode> wavelengths, const BodareSet* before)
    : atmosphere_(atmosphere), wavelengths_(wavelengths.begin(), wavelengths.end()) {
  skyfit::validate(atmosphere);
  if (before != nullptr &&
      same_rays(before->geometry_->shells(), shells_of(atmosphere, Keep::kAll))) {
    geometry_ = before->geometry_;
  } else {
    geometry_ = std::make_shared<const literature::BodareGeometry>(atmosphere);
  }
  const auto air = seeded<0>(atmosphere, {});
  for (const WavelengthNode& node : wavelengths) {
    tables_.push_back(std::make_shared<BodareTables<0>>(
        *geometry_, literature::clear_air(geometry_->shells(), air, node)));
  }
}

std::unique_ptr<const SkyModel> BodareSet::model(int threads) const {
  auto model = std::make_unique<BodareModel>(threads);
  model->keep(atmosphere_, geometry_, wavelengths_, {tables_.begin(), tables_.end()});
  return model;
}

BodareUpdate::BodareUpdate(const Atmosphere<double>& atmosphere,
                           std::vector<WavelengthNode> wavelengths,
                           const BodareUpdateOptions& options)
    : options_(options), wavelengths_(std::move(wavelengths)) {
  validate(options);
  const auto first = std::make_shared<BodareSet>(atmosphere, wavelengths_, nullptr);
  for (int frame = 0; frame < frames_of_update(); ++frame) step(*first, frame);
  older_ = newer_ = first;
}

int BodareUpdate::frames_of_update() const {
  return (options_.orders - 1) * (options_.slices + 1) + options_.slices / 2;
}

void BodareUpdate::advance(const Atmosphere<double>& atmosphere) {
  if (frame_ == 0) next_ = std::make_shared<BodareSet>(atmosphere, wavelengths_, newer_.get());
  step(*next_, frame_++);
  if (frame_ < frames_of_update()) return;
  older_ = newer_;
  newer_ = std::move(next_);
  frame_ = 0;
}

double BodareUpdate::blend() const {
  const int ramp = frames_of_update() - frames_of_order(options_.orders) - (options_.orders > 1);
  return frame_ < ramp ? frame_ / static_cast<double>(ramp) : 1;
}

void BodareUpdate::step(BodareSet& set, int frame) const {
  int order = 1, part = frame;  // part -1 gathers
  while (part >= frames_of_order(order)) part -= frames_of_order(order++) + 1;
  const int parts = frames_of_order(order), slices = BodareSizes::height / parts;
  tbb::parallel_for(std::size_t{0}, set.tables().size(), [&](std::size_t w) {
    BodareTables<0>& tables = *set.tables()[w];
    if (part < 0) {
      tables.gather();
    } else if (order == 1) {
      tables.scatter_once(slices * part, slices * (part + 1));
    } else {
      tables.scatter_gathered(slices * part, slices * (part + 1));
    }
    if (part == parts - 1) tables.add_order();
    if (frame == frames_of_update() - 1) tables.finish();
  });
}

std::vector<double> BodareUpdate::radiance(const SkyPoint& point) const {
  check_point("bodare", point);
  std::vector<double> light(wavelengths_.size());
  const auto add = [&](const BodareSet& set, double weight) {
    const View view = literature::view_of(set.atmosphere(), point);
    for (std::size_t w = 0; w < light.size(); ++w)
      light[w] += weight * set.tables()[w]->light(view).sum().v;
  };
  add(*older_, 1 - blend());
  add(*newer_, blend());
  return light;
}

}  // namespace skyfit
