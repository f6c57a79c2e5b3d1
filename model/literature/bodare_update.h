// SPDX-License-Identifier: Apache-2.0
// Bodare & Sandberg 2014, chapter 5: an update of the tables spread over frames; what a sequence
// shows of it is render/sequence/table_updates.h. Two finished sets are there to interpolate
// between while a third is built; a set that is not finished is never shown.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "model/literature/bodare.h"

namespace skyfit {

struct BodareUpdateOptions {
  int orders = literature::BodareTables<0>::kOrders;  // K, >= 1
  int slices = 8;                                     // X in {2, 4, 8, 16, 32}
};
// Throws std::invalid_argument `bodare_update.slices = 3: must be ...`.
void validate(const BodareUpdateOptions& options);

// The tables of one atmosphere at several wavelengths.
class BodareSet {
 public:
  // Empty. Its rays are those of `before`, which may be null, where radii and profiles are the
  // same.
  BodareSet(const Atmosphere<double>& atmosphere, std::span<const WavelengthNode> wavelengths,
            const BodareSet* before);
  const Atmosphere<double>& atmosphere() const { return atmosphere_; }
  std::span<const std::shared_ptr<literature::BodareTables<0>>> tables() const { return tables_; }

  // The model of a finished set, which has no other tables; it shares these.
  std::unique_ptr<const SkyModel> model(int threads) const;

 private:
  Atmosphere<double> atmosphere_;
  std::vector<WavelengthNode> wavelengths_;
  std::shared_ptr<const literature::BodareGeometry> geometry_;
  std::vector<std::shared_ptr<literature::BodareTables<0>>> tables_;  // one per wavelength
};

class BodareUpdate {
 public:
  // Fills the first set at once. Throws std::invalid_argument.
  BodareUpdate(const Atmosphere<double>& atmosphere, std::vector<WavelengthNode> wavelengths,
               const BodareUpdateOptions& options);

  // F = (K - 1) X + X / 2 + (K - 1): X frames of one slice for every order but the last, X / 2 of
  // two slices for the last, and before each but the first one frame that gathers.
  int frames_of_update() const;

  // One frame's share of the next set (the first frame also lays out its rays where radii or
  // profiles have changed, which costs as much as an order), which is of the atmosphere given to
  // the first of its frames. After the last one the set becomes newer(), the one before it older().
  void advance(const Atmosphere<double>& atmosphere);

  // The two finished sets and the weight of the newer, which grows from 0 to 1 over the orders but
  // the last and rests there: picture = (1 - blend) of older + blend of newer.
  const BodareSet& older() const { return *older_; }
  const BodareSet& newer() const { return *newer_; }
  double blend() const;

  // Of the set that is being built, 0 .. frames_of_update() - 1; at 0 newer() is new.
  int frame() const { return frame_; }

  // Radiance (1/sr) of a point at every wavelength, interpolated between the two sets.
  std::vector<double> radiance(const SkyPoint& point) const;

 private:
  // Of one order, from 1, without the one that gathers.
  int frames_of_order(int order) const {
    return order < options_.orders ? options_.slices : options_.slices / 2;
  }
  void step(BodareSet& set, int frame) const;
  BodareUpdateOptions options_;
  std::vector<WavelengthNode> wavelengths_;
  std::shared_ptr<const BodareSet> older_, newer_;
  std::shared_ptr<BodareSet> next_;
  int frame_ = 0;  // of the set that is being built
};

}  // namespace skyfit
