// SPDX-License-Identifier: Apache-2.0
#include "fit/classify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <tuple>

#include "fit/problem/likelihood.h"
#include "fit/solve/least_squares.h"
#include "model/base/counted.h"
#include "model/base/misfit.h"
#include "model/numerics/angles.h"

namespace skyfit::fit {
namespace {

constexpr int kCoefficients = 5;
constexpr std::size_t kStarts = 3;  // the free fit starts from so many of the nearest types

// Luminances of directions, one scan after the other.
struct Directions {
  std::vector<refs::Sample> at;
  std::vector<int> scan;
  Eigen::VectorXd log_luminance, weight;
  std::vector<std::string> names;
};

struct Sum {
  refs::Sample at;
  double luminance = 0;
};

Directions directions_of(const refs::Reference& reference, const SpectralData& spectra,
                         double exclude_sun) {
  constexpr double kRounding = 1e-9;
  std::map<refs::DirectionFromSun, Sum> sums;
  for (const refs::Sample& s : reference.samples) {
    if (s.weight == 0 || refs::scattering_angle(s) < exclude_sun - kRounding) continue;
    Sum& sum = sums[refs::direction_from_sun(s)];
    sum.at = s;
    sum.luminance +=
        s.value * (s.wavelength_nm > 0 ? spectra.y_bar.at_or_zero(s.wavelength_nm) : 1.0);
  }
  if (sums.empty()) {
    throw std::invalid_argument(fmt::format(
        "{}: no direction with weight is farther than {:.6g} deg from the sun, expected "
        "at least one",
        reference.name, exclude_sun * kDegreesPerRadian));
  }
  if (!refs::gives_luminance(reference)) {
    throw std::invalid_argument(
        fmt::format("{}: its wavelengths give no luminance, expected 450 to 660 nm in steps of at "
                    "most 41 nm: the standard skies are luminances",
                    reference.name));
  }
  Directions result;
  std::vector<double> logs;
  int last_scan = -1;
  for (const auto& [look, sum] : sums) {
    if (!(sum.luminance > 0)) {
      throw std::invalid_argument(
          fmt::format("{}: a luminance of {:.6g}: must be > 0", reference.name, sum.luminance));
    }
    if (sum.at.scan != last_scan) {
      last_scan = sum.at.scan;
      const auto known = static_cast<std::size_t>(last_scan) < reference.scans.size();
      const std::string name =
          known ? reference.scans[static_cast<std::size_t>(last_scan)].name : std::string();
      result.names.push_back(
          name.empty() ? fmt::format("sun zenith {:.4g} deg", sum.at.sun_zenith * kDegreesPerRadian)
                       : name);
    }
    result.at.push_back(sum.at);
    result.scan.push_back(static_cast<int>(result.names.size()) - 1);
    logs.push_back(std::log(sum.luminance));
  }
  result.log_luminance =
      Eigen::Map<const Eigen::VectorXd>(logs.data(), static_cast<Eigen::Index>(logs.size()));
  result.weight = Eigen::VectorXd::Ones(result.log_luminance.size());
  return result;
}

// log(formula / measured), the scans' means subtracted.
Eigen::VectorXd residuals_of(const Directions& directions, const refs::CieSky& sky,
                             const std::vector<double>& offset) {
  Eigen::MatrixXd residual(directions.log_luminance.size(), 1);
  for (std::size_t i = 0; i < directions.at.size(); ++i) {
    refs::Sample at = directions.at[i];
    at.relative_azimuth += offset[static_cast<std::size_t>(directions.scan[i])];
    const double value = refs::cie_gradation(sky, at.view_zenith) *
                         refs::cie_indicatrix(sky, refs::scattering_angle(at));
    if (!(value > 0)) throw std::domain_error("classify: the formula is not positive here");
    residual(static_cast<Eigen::Index>(i), 0) =
        std::log(value) - directions.log_luminance(static_cast<Eigen::Index>(i));
  }
  subtract_scan_means(directions.scan, static_cast<int>(directions.names.size()), directions.weight,
                      residual);
  return residual.col(0);
}

// The variables are the azimuth offsets of the scans (none when they are as stated), after the
// coefficients when those are free. Derivatives are central differences of the closed form.
class CieFormula : public ResidualFunction {
 public:
  CieFormula(const Directions& directions, const refs::CieSky& sky, bool free_coefficients,
             bool free_azimuth)
      : directions_(directions), sky_(sky), free_coefficients_(free_coefficients) {
    // Around the range of the standard skies; e may vanish, c too.
    constexpr double kBounds[kCoefficients][2] = {
        {-1, 10}, {-3, -0.01}, {0, 60}, {-12, -0.2}, {0, 3}};
    for (const auto& [lower, upper] : kBounds) {
      if (free_coefficients) variables_.push_back({lower, upper, false, std::nullopt});
    }
    constexpr double kLargestOffset = 60 / kDegreesPerRadian;
    for (std::size_t s = 0; s < directions.names.size() && free_azimuth; ++s)
      variables_.push_back({-kLargestOffset, kLargestOffset, false, std::nullopt});
  }

  const std::vector<Variable>& variables() const { return variables_; }

  Eigen::VectorXd start() const {
    const double coefficient[kCoefficients] = {sky_.a, sky_.b, sky_.c, sky_.d, sky_.e};
    Eigen::VectorXd scaled(variables_.size());
    for (std::size_t v = 0; v < variables_.size(); ++v) {
      const bool is_coefficient = free_coefficients_ && v < kCoefficients;
      scaled(static_cast<Eigen::Index>(v)) =
          std::clamp(variables_[v].scaled(is_coefficient ? coefficient[v] : 0.0), 0.0, 1.0);
    }
    return scaled;
  }

  Residuals evaluate(const Eigen::VectorXd& scaled, bool with_jacobian) override {
    constexpr double kStep = 1e-5;
    Residuals result{at(scaled), {}};
    if (!with_jacobian) return result;
    result.jacobian.resize(result.value.size(), scaled.size());
    for (Eigen::Index v = 0; v < scaled.size(); ++v) {
      Eigen::VectorXd below = scaled, above = scaled;
      below(v) = std::max(0.0, scaled(v) - kStep);
      above(v) = std::min(1.0, scaled(v) + kStep);
      result.jacobian.col(v) = (at(above) - at(below)) / (above(v) - below(v));
    }
    return result;
  }

  refs::CieSky sky_at(const Eigen::VectorXd& scaled) const {
    refs::CieSky sky = sky_;
    if (!free_coefficients_) return sky;
    double* const coefficient[kCoefficients] = {&sky.a, &sky.b, &sky.c, &sky.d, &sky.e};
    for (std::size_t v = 0; v < kCoefficients; ++v)
      *coefficient[v] = variables_[v].value(scaled(static_cast<Eigen::Index>(v)));
    return sky;
  }

  std::vector<double> offsets_at(const Eigen::VectorXd& scaled) const {
    std::vector<double> offset(directions_.names.size(), 0.0);
    const std::size_t first = free_coefficients_ ? kCoefficients : 0;
    for (std::size_t v = first; v < variables_.size(); ++v)
      offset[v - first] = variables_[v].value(scaled(static_cast<Eigen::Index>(v)));
    return offset;
  }

 private:
  Eigen::VectorXd at(const Eigen::VectorXd& scaled) const {
    return residuals_of(directions_, sky_at(scaled), offsets_at(scaled));
  }

  const Directions& directions_;
  refs::CieSky sky_;
  bool free_coefficients_;
  std::vector<Variable> variables_;
};

SkyMatch match(const Directions& directions, const refs::CieSky& sky, bool free_coefficients,
               bool free_azimuth) {
  CieFormula formula(directions, sky, free_coefficients, free_azimuth);
  Eigen::VectorXd scaled = formula.start();
  if (scaled.size() > 0) {
    scaled = minimise({&formula, {static_cast<int>(directions.at.size())}, formula.variables()},
                      scaled, {200, 1e-10})
                 .scaled;
  }
  SkyMatch result{formula.sky_at(scaled), 0, {}, formula.offsets_at(scaled)};
  const Eigen::VectorXd residual = residuals_of(directions, result.sky, result.azimuth_offset);
  result.rms_log_percent = 100 * residual.norm() / std::sqrt(static_cast<double>(residual.size()));
  std::vector<double> squares(directions.names.size(), 0.0), counts = squares;
  for (std::size_t i = 0; i < directions.at.size(); ++i) {
    squares[static_cast<std::size_t>(directions.scan[i])] +=
        std::pow(residual(static_cast<Eigen::Index>(i)), 2);
    ++counts[static_cast<std::size_t>(directions.scan[i])];
  }
  for (std::size_t s = 0; s < squares.size(); ++s)
    result.rms_of_scan.push_back(100 * std::sqrt(squares[s] / counts[s]));
  return result;
}

SkyMatch free_match(const Directions& directions, std::vector<SkyMatch> types, bool free_azimuth) {
  std::ranges::sort(types, {}, &SkyMatch::rms_log_percent);
  SkyMatch best;
  for (std::size_t k = 0; k < std::min(kStarts, types.size()); ++k) {
    SkyMatch found = match(directions, types[k].sky, true, free_azimuth);
    found.sky.type = 0;
    found.sky.description = "free coefficients";
    if (k == 0 || found.rms_log_percent < best.rms_log_percent) best = found;
  }
  return best;
}

nlohmann::json match_json(const SkyMatch& match) {
  nlohmann::json offsets = nlohmann::json::array();
  for (const double offset : match.azimuth_offset) offsets.push_back(offset * kDegreesPerRadian);
  return {{"type", match.sky.type},
          {"description", match.sky.description},
          {"rms_log_percent", match.rms_log_percent},
          {"rms_log_percent_of_scan", match.rms_of_scan},
          {"azimuth_offset_deg", offsets},
          {"a", match.sky.a},
          {"b", match.sky.b},
          {"c", match.sky.c},
          {"d", match.sky.d},
          {"e", match.sky.e}};
}

}  // namespace

const SkyMatch& Classification::nearest() const {
  return *std::ranges::min_element(types, {}, &SkyMatch::rms_log_percent);
}

int Classification::nearest_of_scan(std::size_t scan) const {
  return std::ranges::min_element(types, {},
                                  [scan](const SkyMatch& m) { return m.rms_of_scan[scan]; })
      ->sky.type;
}

Classification classify(const refs::Reference& reference, const SpectralData& spectra,
                        const ClassifyOptions& options) {
  const Directions directions = directions_of(reference, spectra, options.exclude_sun);
  Classification result;
  result.scans = directions.names;
  result.directions = static_cast<int>(directions.at.size());
  for (const refs::CieSky& sky : refs::cie_skies())
    result.types.push_back(match(directions, sky, false, options.free_azimuth));
  result.free = free_match(directions, result.types, options.free_azimuth);
  return result;
}

std::string classification_text(const Classification& classification) {
  std::string text =
      fmt::format("{} of {}; RMS of log(formula / measured), percent, above {:g} a factor\n",
                  counted(classification.directions, "direction"),
                  counted(std::ssize(classification.scans), "scan"), kMostPercent);
  for (const SkyMatch& match : classification.types) {
    text += fmt::format("type {:>2} {:>7}  {}{}\n", match.sky.type,
                        log_misfit_digits(match.rms_log_percent, 3), match.sky.description,
                        &match == &classification.nearest() ? "  <- nearest" : "");
  }
  const refs::CieSky& free = classification.free.sky;
  text += fmt::format("free    {:>7}  a = {:.4g}, b = {:.4g}, c = {:.4g}, d = {:.4g}, e = {:.4g}\n",
                      log_misfit_digits(classification.free.rms_log_percent, 3), free.a, free.b,
                      free.c, free.d, free.e);
  for (std::size_t s = 0; s < classification.scans.size(); ++s) {
    const int nearest = classification.nearest_of_scan(s);
    const SkyMatch& match = classification.types[static_cast<std::size_t>(nearest - 1)];
    text +=
        fmt::format("{}: nearest type {}, {}; azimuth offset {:.3g} deg\n", classification.scans[s],
                    nearest, log_misfit_digits_with_unit(match.rms_of_scan[s], 3),
                    match.azimuth_offset[s] * kDegreesPerRadian);
  }
  return text;
}

nlohmann::json classification_json(const Classification& classification) {
  nlohmann::json json = {{"directions", classification.directions},
                         {"scans", classification.scans},
                         {"nearest_type", classification.nearest().sky.type},
                         {"free", match_json(classification.free)}};
  for (const SkyMatch& match : classification.types) json["types"].push_back(match_json(match));
  for (std::size_t s = 0; s < classification.scans.size(); ++s)
    json["nearest_type_of_scan"].push_back(classification.nearest_of_scan(s));
  return json;
}

}  // namespace skyfit::fit
