// SPDX-License-Identifier: Apache-2.0
// The source of multiple scattering as a table: light that has been scattered or reflected before
// and is scattered here toward the eye, per unit of scattering coefficient (1/sr) of each
// scatterer, at four wavelengths. From the diffuse field of model/solver/diffuse_field.h, whose
// Fourier series in the azimuth between view and sun is kept as a polynomial in its cosine.
// Streams, moments, levels and suns of the field, and what lies between them, are those of the
// reference model.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "model/solver/diffuse_field.h"
#include "model/solver/level_grid.h"
#include "model/solver/reference_model.h"
#include "model/solver/sun_grid.h"

namespace skyfit {

using NodeOptics = std::array<Optics<0>, 4>;
using NodeValues = std::array<double, 4>;  // at the nodes of a colour rule, blue to red

// Which light of the reference the tables hold.
struct TableLight {
  Transfer transfer = Transfer::kVector;
  // 0: all of it. k > 0: what met air or ground k times at most; approximate for suns below 86 deg,
  // as `order` in model/solver/reference_model.h.
  int orders = 0;
};

class DiffuseSource {
 public:
  static constexpr int kPowers = 4;  // of the cosine in a block: 1, c, c^2, c^3
  // Floats of one block: [wavelength][power].
  static constexpr std::size_t kBlock = 4 * kPowers;

  // Kept at `heights`, which ascend from 0 to the top; `options` are those of options_for(), and
  // the optics have as many moments. Of light of k orders, the source of all but the first.
  DiffuseSource(const Shells& shells, const NodeOptics& optics, const std::vector<double>& heights,
                const ReferenceOptions& options, const TableLight& light);

  const SunGrid& suns() const { return suns_; }
  // Block b holds powers times cos 4 b phi, docs/theory (9.12).
  int blocks() const { return blocks_; }

  // The source at one of the heights toward a view direction (mu is that of the view ray), with a
  // factor per scatterer and wavelength, added to out[1 + sun][block][wavelength][power] for all
  // suns of the grid; out[0] is the second sun seen across the zenith, at the opposite azimuth.
  void add_slice(int height, double mu, std::span<const NodeValues> factors,
                 std::vector<float>& out) const;
  std::size_t slice_size() const {
    return static_cast<std::size_t>(suns_.size() + 1) * blocks_ * kBlock;
  }

 private:
  // Of one scatterer: [height][zenith] as a slice of so many blocks; one for Rayleigh's moments.
  struct Kept {
    int blocks;
    std::vector<float> values;
  };
  void tabulate(int height, double level, const NodeOptics& optics,
                const std::vector<DiffuseField>& fields);
  std::size_t index(int height, int zenith, int blocks) const;

  int moments_, blocks_;
  SunGrid suns_;
  LevelGrid levels_;
  std::vector<Kept> kept_;
};

}  // namespace skyfit
