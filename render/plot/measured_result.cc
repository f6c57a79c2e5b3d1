// SPDX-License-Identifier: Apache-2.0
#include "render/plot/measured_result.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string_view>

#include "data_refs/samples.h"
#include "data_refs/spectra.h"
#include "model/base/input_file.h"
#include "model/base/preset_reader.h"
#include "model/base/units.h"

namespace skyfit::plot {
namespace {

constexpr std::string_view kMeasuredFile = "measured.csv", kReportFile = "report.json";

// Where gnuplot reads a time, no other text may stand.
bool is_time_utc(std::string_view text) {
  constexpr std::string_view kForm = "0000-00-00T00:00:00Z";
  const auto matches = [](char c, char form) {
    return form == '0' ? c >= '0' && c <= '9' : c == form;
  };
  return text.empty() || std::ranges::equal(text, kForm, matches);
}

MeasuredScan read_scan(const PresetReader& scan) {
  const std::string time = scan.text("time_utc");
  if (!is_time_utc(time)) scan.fail_value("time_utc", "YYYY-MM-DDTHH:MM:SSZ or nothing");
  return {scan.text("name"), time, scan.number_or_nan("luminance_error_percent"),
          scan.number_or_nan("spectral_error_percent")};
}

MeasuredUnknown read_unknown(const PresetReader& row, std::size_t scans) {
  const double scan = row.number_or_nan("scan");  // null where all scans share it
  if (std::isfinite(scan) &&
      !(scan >= 1 && scan <= static_cast<double>(scans) && scan == std::floor(scan)))
    row.fail_value("scan", fmt::format("one of the {} scans, or null", scans));
  return {row.text("name"), row.text("unit"), std::isfinite(scan) ? static_cast<int>(scan) : 0,
          row.number("fitted"), row.number_or_nan("sigma")};
}

// Null where the problem was singular.
void read_covariance(const PresetReader& report, MeasuredOutcome& outcome) {
  outcome.covariance_unknowns = report.texts("covariance_unknowns");
  if (report.is_null("covariance")) return;
  outcome.covariance = report.rows("covariance");
  const std::size_t side = outcome.covariance_unknowns.size();
  const auto has_side = [&](const std::vector<double>& row) { return row.size() == side; };
  if (outcome.covariance.size() != side || !std::ranges::all_of(outcome.covariance, has_side))
    report.fail_value("covariance", fmt::format("{0} rows of {0} numbers", side));
  constexpr double kRounding = 1 + 1e-9;  // of correlations
  for (std::size_t i = 0; i < side; ++i) {
    for (std::size_t j = 0; j < side; ++j) {
      const double product = outcome.covariance[i][i] * outcome.covariance[j][j];
      const double covariance = outcome.covariance[i][j];
      if (!(product > 0 && outcome.covariance[i][i] > 0 &&
            covariance * covariance <= kRounding * product))
        report.fail_value("covariance",
                          fmt::format("variances > 0 and correlations from -1 to 1, not so in row "
                                      "{}, column {}",
                                      i, j));
    }
  }
}

void read_report(const std::filesystem::path& file, MeasuredOutcome& outcome) {
  const PresetDocument document(read_file(file, "what skyfit fit left"), file.string());
  const PresetReader report = document.root(), reference = report.object("reference");
  outcome.title = reference.text("name");
  const std::string quantity = reference.text("quantity");
  if (quantity != "luminance_cd_m2" && quantity != "relative_luminance" &&
      quantity != "spectral_radiance_w_m2_sr_nm")
    reference.fail_value("quantity",
                         "luminance_cd_m2, relative_luminance or spectral_radiance_w_m2_sr_nm");
  outcome.spectral = quantity == "spectral_radiance_w_m2_sr_nm";
  for (const PresetReader& scan : report.objects("scan_results"))
    outcome.scans.push_back(read_scan(scan));
  for (const PresetReader& row : report.objects("unknowns"))
    outcome.unknowns.push_back(read_unknown(row, outcome.scans.size()));
  read_covariance(report, outcome);
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
      angles.sun_zenith = s.sun_zenith_deg * kRadiansPerDegree;
      angles.view_zenith = s.view_zenith_deg * kRadiansPerDegree;
      angles.relative_azimuth = s.relative_azimuth_deg * kRadiansPerDegree;
      look = {s.scan,
              s.sun_zenith_deg,
              s.view_zenith_deg,
              s.relative_azimuth_deg,
              refs::scattering_angle(angles) * kDegreesPerRadian,
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
