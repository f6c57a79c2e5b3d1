// SPDX-License-Identifier: Apache-2.0
// Skies for the tests of the figures.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "model/base/temporary_directory.h"
#include "render/plot/comparison.h"
#include "render/plot/measured_result.h"

namespace skyfit::plot {

// A directory that goes away with the test.
class PlotTest : public ::testing::Test {
 protected:
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
      names.push_back(entry.path().filename());
    return names;
  }

  const TemporaryDirectory temporary_;
  const std::filesystem::path folder_ = temporary_.path();
};

inline std::string bytes_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

inline Sample sample_at(double sun_deg, double view_deg, double azimuth_deg, double residual) {
  Sample sample;
  sample.sun_zenith_deg = sun_deg;
  sample.view_zenith_deg = view_deg;
  sample.relative_azimuth_deg = azimuth_deg;
  sample.reference = 1 + view_deg / 90;
  sample.model = sample.reference * std::exp(residual);
  return sample;
}

// Principal plane by 5 degrees and Tregenza's rows, with a residual that is +-`residual` in turn.
inline Curve curve_at(const std::vector<double>& suns_deg, double residual) {
  constexpr int kRows[] = {30, 30, 24, 24, 18, 12, 6, 1};
  Curve curve{"fitted", {}, {}};
  for (const double sun : suns_deg) {
    for (int view = -85; view <= 85; view += 5)
      curve.plane.push_back(
          sample_at(sun, std::abs(view), view < 0 ? 180 : 0, view % 2 == 0 ? residual : -residual));
    for (int row = 0; row < 8; ++row)
      for (int patch = 0; patch < kRows[row]; ++patch)
        curve.hemisphere.push_back(sample_at(sun, 84 - 12 * row, 360.0 * patch / kRows[row],
                                             patch % 2 == 0 ? residual : -residual));
  }
  return curve;
}

inline Comparison comparison_at(const std::vector<double>& suns_deg, double residual = 0.04) {
  Comparison comparison;
  comparison.title = "A sky's \"title\" with 'quotes', {braces}, $dollars and a \\ backslash";
  comparison.reference_label = "reference";
  comparison.curves = {curve_at(suns_deg, residual)};
  return comparison;
}

// Two scans of a day with all that the figures of measured skies show.
inline MeasuredOutcome outcome(bool spectral) {
  MeasuredOutcome result;
  result.title = "folder/scans.csv";
  result.spectral = spectral;
  for (const int scan : {1, 2}) {
    for (int k = 0; k < 24; ++k) {
      for (const double nm : spectral ? std::vector{450.0, 550.0, 650.0} : std::vector{0.0}) {
        const double value = 0.1 + 0.01 * k / scan;
        result.samples.push_back({scan, 30.0 * scan, 20.0 + 30 * (k / 8), 45.0 * (k % 8) + 7, nm,
                                  value, 0.05 * value, value * (1 + 0.05 * std::sin(k)),
                                  k == 3 ? 0.0 : 1.0});
      }
    }
    result.scans.push_back({"folder/scan" + std::to_string(scan) + ".csv",
                            scan == 1 ? "2020-06-01T09:00:00Z" : "2020-06-01T10:00:00Z", 5, 6});
    result.unknowns.push_back(
        {"instrument.azimuth_offset[" + std::to_string(scan) + "]", "deg", scan, 5.0 + scan, 0.5});
  }
  result.unknowns.push_back({"ground.albedo", "1", 0, 0.2, 0.02});
  result.covariance_unknowns = {"instrument.azimuth_offset[1]", "ground.albedo"};
  result.covariance = {{0.25, 0.005}, {0.005, 0.0004}};
  return result;
}

}  // namespace skyfit::plot
