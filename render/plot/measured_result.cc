// SPDX-License-Identifier: Apache-2.0
#include "render/plot/measured_result.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>

#include "data_refs/samples.h"
#include "data_refs/spectra.h"

namespace skyfit::plot {
namespace {

using nlohmann::json;
constexpr double kRadian = std::numbers::pi / 180;
constexpr std::string_view kMeasuredFile = "measured.csv", kReportFile = "report.json";

double number_or_nan(const json& value) {
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

void read_report(const std::filesystem::path& file, MeasuredOutcome& outcome) {
  std::ifstream stream(file);
  if (!stream)
    throw std::runtime_error(
        fmt::format("{}: cannot be read, expected what skyfit fit left", file.string()));
  try {
    const json report = json::parse(stream);
    const json& reference = report.at("reference");
    outcome.title = reference.at("name").get<std::string>();
    outcome.spectral = reference.at("quantity").get<std::string>() != "luminance_cd_m2";
    for (const json& scan : report.at("scan_results")) {
      outcome.scans.push_back({scan.at("name"), scan.at("time_utc"),
                               number_or_nan(scan.at("luminance_error_percent")),
                               number_or_nan(scan.at("spectral_error_percent"))});
    }
    for (const json& row : report.at("unknowns")) {
      outcome.unknowns.push_back({row.at("name"), row.at("unit"),
                                  row.at("scan").is_number() ? row.at("scan").get<int>() : 0,
                                  row.at("fitted"), number_or_nan(row.at("sigma"))});
    }
    report.at("covariance_unknowns").get_to(outcome.covariance_unknowns);
    if (report.at("covariance").is_array()) report.at("covariance").get_to(outcome.covariance);
  } catch (const json::exception& error) {
    throw std::invalid_argument(fmt::format(
        "{}: {}: expected the report of a fit of measured skies", file.string(), error.what()));
  }
}

// Nanometres that each wavelength stands for.
std::map<double, double> widths_of(const std::vector<MeasuredSample>& samples) {
  std::map<double, double> widths;
  for (const MeasuredSample& sample : samples) widths[sample.wavelength_nm] = 0;
  if (widths.size() == 1) widths.begin()->second = 1;  // ratios of its directions remain
  for (auto at = widths.begin(); at != widths.end(); ++at) {
    const auto next = std::next(at);
    if (next == widths.end()) continue;
    const double half = (next->first - at->first) / 2;
    at->second += half;
    next->second += half;
  }
  return widths;
}

}  // namespace

bool is_measured_result(const std::filesystem::path& directory) {
  return std::filesystem::exists(directory / kMeasuredFile);
}

MeasuredOutcome read_measured_outcome(const std::filesystem::path& directory) {
  MeasuredOutcome outcome;
  read_report(directory / kReportFile, outcome);
  outcome.samples = read_measured_csv(directory / kMeasuredFile);
  for (const MeasuredSample& sample : outcome.samples) {
    if (static_cast<std::size_t>(sample.scan) > outcome.scans.size())
      throw std::invalid_argument(fmt::format("{}: scan = {}: expected one of the {} scans of {}",
                                              (directory / kMeasuredFile).string(), sample.scan,
                                              outcome.scans.size(), kReportFile));
  }
  return outcome;
}

DirectionKey direction_key(int scan, double sun_zenith_deg, double view_zenith_deg,
                           double relative_azimuth_deg) {
  const auto thousandths = [](double degrees) { return std::lround(1e3 * degrees); };
  return {scan, thousandths(view_zenith_deg - sun_zenith_deg), thousandths(relative_azimuth_deg)};
}

std::vector<MeasuredDirection> directions_of(const MeasuredOutcome& outcome) {
  constexpr double kLumenPerWatt = 683.002;
  const Spectrum& y_bar = refs::standard_spectral_data().y_bar;
  const std::map<double, double> widths = widths_of(outcome.samples);
  std::map<DirectionKey, MeasuredDirection> looks;
  for (const MeasuredSample& s : outcome.samples) {
    const auto [at, is_new] = looks.try_emplace(
        direction_key(s.scan, s.sun_zenith_deg, s.view_zenith_deg, s.relative_azimuth_deg));
    MeasuredDirection& look = at->second;
    if (is_new) {
      refs::Sample angles;
      angles.sun_zenith = s.sun_zenith_deg * kRadian;
      angles.view_zenith = s.view_zenith_deg * kRadian;
      angles.relative_azimuth = s.relative_azimuth_deg * kRadian;
      look = {s.scan,
              s.sun_zenith_deg,
              s.view_zenith_deg,
              s.relative_azimuth_deg,
              refs::scattering_angle(angles) / kRadian,
              0,
              0,
              false};
    }
    const double weight = s.wavelength_nm > 0 ? kLumenPerWatt * y_bar.at_or_zero(s.wavelength_nm) *
                                                    widths.at(s.wavelength_nm)
                                              : 1;
    look.measured += weight * s.measured;
    look.model += weight * s.model;
    look.counted |= s.weight > 0;
  }
  std::vector<MeasuredDirection> result;
  for (const auto& [key, look] : looks) result.push_back(look);
  return result;
}

}  // namespace skyfit::plot
