// SPDX-License-Identifier: Apache-2.0
// Refractive indices n + i k by wavelength (nm), k >= 0 absorbs: of a table, or of a named material
// with published constants. Linear between the wavelengths, constant beyond the first and the last.
#pragma once

#include <cmath>
#include <complex>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace skyfit {

// What spheres of a real part >= 1 and a finite index scatter; nothing is denser than some metals.
inline constexpr double kLeastReal = 1, kMostIndex = 20;
inline constexpr std::string_view kRealIndex = "a real part from 1 to 20",
                                  kImaginaryIndex = "an imaginary part from 0 to 20";
// Of what is as air: such spheres scatter and absorb nothing, and have no optical depth.
inline bool is_as_air(double real, double imaginary) {
  constexpr double kLeastContrast = 1e-3;
  return std::hypot(real - 1, imaginary) < kLeastContrast;
}
inline constexpr std::string_view kNotAsAir = "an index that differs from that of air by 0.001";

class RefractiveIndex {
 public:
  // `material`: its name, empty for a table of somebody's own. Throws std::invalid_argument unless
  // there are as many values as wavelengths, at least one, the wavelengths > 0 and ascending, n >=
  // 1 and k >= 0.
  RefractiveIndex(std::string material, std::vector<double> wavelength_nm, std::vector<double> real,
                  std::vector<double> imaginary);

  const std::string& material() const { return material_; }
  const std::vector<double>& wavelength_nm() const { return wavelength_nm_; }
  const std::vector<double>& real() const { return real_; }
  const std::vector<double>& imaginary() const { return imaginary_; }

  std::complex<double> at(double wavelength_nm) const;

  bool operator==(const RefractiveIndex&) const = default;

 private:
  std::string material_;
  std::vector<double> wavelength_nm_, real_, imaginary_;
};

struct Material {
  std::string_view name, meaning;  // with the source
  struct Row {
    double wavelength_nm, real, imaginary;
  };
  std::span<const Row> rows;
};
std::span<const Material> materials();

// Null for a name that none has.
std::shared_ptr<const RefractiveIndex> index_of_material(std::string_view name);

}  // namespace skyfit
