// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere/refractive_index.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace skyfit {
namespace {

using Row = Material::Row;

// 75 % by weight at 300 K: the droplets of the stratosphere.
constexpr Row kSulphuricAcid[] = {{359.7122, 1.452, 1.949e-15}, {408.1633, 1.438, 1.002e-13},
                                  {449.4382, 1.432, 1.471e-12}, {555.5556, 1.431, 2.352e-10},
                                  {701.7544, 1.428, 2.070e-8},  {746.2687, 1.427, 6.830e-8},
                                  {806.4516, 1.427, 8.790e-8},  {862.0690, 1.425, 1.830e-7},
                                  {909.0909, 1.424, 2.840e-7},  {1000.000, 1.422, 1.530e-6}};

constexpr Row kSulphate[] = {{200, 1.5650, 1e-7},
                             {400, 1.5403, 1e-7},
                             {600, 1.5273, 1e-7},
                             {800, 1.5197, 1e-7},
                             {1000, 1.5123, 3.50026e-7}};

constexpr Row kSoot[] = {{250, 1.62, 0.450}, {300, 1.74, 0.470}, {350, 1.75, 0.465},
                         {400, 1.75, 0.460}, {450, 1.75, 0.455}, {500, 1.75, 0.450},
                         {550, 1.75, 0.440}, {600, 1.75, 0.435}, {650, 1.75, 0.435},
                         {700, 1.75, 0.430}, {750, 1.75, 0.430}, {800, 1.75, 0.430},
                         {900, 1.75, 0.435}, {1000, 1.76, 0.440}};

constexpr Row kDust[] = {
    {440, 1.55, 0.0025}, {670, 1.55, 0.0014}, {870, 1.55, 0.0010}, {1020, 1.55, 0.0010}};

constexpr Row kSeaSalt[] = {{250, 1.51, 5.00e-6}, {300, 1.51, 2.00e-6}, {350, 1.51, 3.24e-7},
                            {400, 1.50, 3.00e-8}, {450, 1.50, 2.43e-8}, {500, 1.50, 1.55e-8},
                            {550, 1.50, 1.00e-8}, {600, 1.49, 1.60e-8}, {650, 1.49, 4.24e-8},
                            {700, 1.49, 2.00e-7}, {750, 1.49, 1.08e-6}, {800, 1.48, 1.95e-6},
                            {900, 1.48, 4.24e-5}, {1000, 1.47, 1.41e-4}};

constexpr Row kWater[] = {{200, 1.396, 1.10e-7}, {250, 1.362, 3.35e-8}, {300, 1.349, 1.60e-8},
                          {350, 1.343, 6.50e-9}, {400, 1.339, 1.86e-9}, {450, 1.337, 1.02e-9},
                          {500, 1.335, 1.00e-9}, {550, 1.333, 1.96e-9}, {600, 1.332, 1.09e-8},
                          {650, 1.331, 1.64e-8}, {700, 1.331, 3.35e-8}, {750, 1.330, 1.56e-7},
                          {800, 1.329, 1.25e-7}, {850, 1.329, 2.93e-7}, {900, 1.328, 4.86e-7},
                          {950, 1.327, 2.93e-6}, {1000, 1.327, 2.89e-6}};

constexpr Material kMaterials[] = {
    {"sulphate",
     "dry ammonium sulphate (Toon, Pollack & Khare 1976, J. Geophys. Res. 81, 5733-5748)",
     kSulphate},
    {"sulphuric-acid",
     "75 % sulphuric acid, droplets of the stratosphere (Palmer & Williams 1975, Appl. Opt. 14, "
     "208-219)",
     kSulphuricAcid},
    {"soot", "soot (Hess, Koepke & Schult 1998, OPAC, Bull. Amer. Meteor. Soc. 79, 831-844)",
     kSoot},
    {"dust",
     "desert dust as seen from the ground (Dubovik et al. 2002, J. Atmos. Sci. 59, 590-608)",
     kDust},
    {"sea-salt", "dry sea salt (Hess, Koepke & Schult 1998, OPAC)", kSeaSalt},
    {"water", "drops of clouds and fog (Hale & Querry 1973, Appl. Opt. 12, 555-563)", kWater}};

}  // namespace

RefractiveIndex::RefractiveIndex(std::string material, std::vector<double> wavelength_nm,
                                 std::vector<double> real, std::vector<double> imaginary)
    : material_(std::move(material)),
      wavelength_nm_(std::move(wavelength_nm)),
      real_(std::move(real)),
      imaginary_(std::move(imaginary)) {
  const std::size_t count = wavelength_nm_.size();
  if (count == 0 || real_.size() != count || imaginary_.size() != count) {
    throw std::invalid_argument(
        fmt::format("wavelength_nm: {} values: expected at least 1 and as many as real, {}, and "
                    "imaginary, {}",
                    count, real_.size(), imaginary_.size()));
  }
  double before = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto expect = [i](bool holds, std::string_view column, double value,
                            std::string_view expectation) {
      if (!holds || !std::isfinite(value)) {
        throw std::invalid_argument(
            fmt::format("{}[{}] = {}: expected {}", column, i, value, expectation));
      }
    };
    expect(wavelength_nm_[i] > before, "wavelength_nm", wavelength_nm_[i],
           fmt::format("more than {} nm", before));
    expect(real_[i] >= kLeastReal && real_[i] <= kMostIndex, "real", real_[i], kRealIndex);
    expect(imaginary_[i] >= 0 && imaginary_[i] <= kMostIndex, "imaginary", imaginary_[i],
           kImaginaryIndex);
    expect(!is_as_air(real_[i], imaginary_[i]), "real", real_[i], kNotAsAir);
    before = wavelength_nm_[i];
  }
}

std::complex<double> RefractiveIndex::at(double wavelength_nm) const {
  if (wavelength_nm <= wavelength_nm_.front()) return {real_.front(), imaginary_.front()};
  if (wavelength_nm >= wavelength_nm_.back()) return {real_.back(), imaginary_.back()};
  const auto above = std::upper_bound(wavelength_nm_.begin(), wavelength_nm_.end(), wavelength_nm);
  const auto i = static_cast<std::size_t>(above - wavelength_nm_.begin());
  const double share =
      (wavelength_nm - wavelength_nm_[i - 1]) / (wavelength_nm_[i] - wavelength_nm_[i - 1]);
  return {std::lerp(real_[i - 1], real_[i], share),
          std::lerp(imaginary_[i - 1], imaginary_[i], share)};
}

std::span<const Material> materials() { return kMaterials; }

std::shared_ptr<const RefractiveIndex> index_of_material(std::string_view name) {
  const auto found = std::ranges::find(kMaterials, name, &Material::name);
  if (found == std::end(kMaterials)) return nullptr;
  std::vector<double> wavelength_nm, real, imaginary;
  for (const Row& row : found->rows) {
    wavelength_nm.push_back(row.wavelength_nm);
    real.push_back(row.real);
    imaginary.push_back(row.imaginary);
  }
  return std::make_shared<const RefractiveIndex>(std::string(name), std::move(wavelength_nm),
                                                 std::move(real), std::move(imaginary));
}

}  // namespace skyfit
