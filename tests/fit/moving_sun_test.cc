// SPDX-License-Identifier: Apache-2.0
// Wavelengths of a scan that were measured one after the other have their own sun: the model's
// values are those of that sun, many wavelengths are evaluated under their own suns only, few under
// all at once, and the derivatives hold.
#include <gtest/gtest.h>

#include <cstddef>

#include "tests/fit/scans.h"
#include "tests/fit/synthetic.h"

namespace skyfit::fit {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// Almucantars of so many wavelengths, each under a sun of its own.
refs::Reference almucantar(std::size_t wavelengths = 3) {
  refs::Reference reference;
  reference.name = "almucantar";
  reference.quantity = refs::Quantity::kSpectralRadiance;
  reference.scans.resize(1);
  reference.scans[0].sun_azimuth = 1.5;
  for (std::size_t w = 0; w < wavelengths; ++w) {
    for (const double azimuth_deg : {6.0, 30.0, 90.0, 150.0}) {
      refs::Sample sample;
      sample.sun_zenith = (60 + 0.3 * static_cast<double>(w)) * kDegree;
      sample.sun_azimuth_since = 0.4 * static_cast<double>(w) * kDegree;
      sample.view_zenith = sample.sun_zenith;
      sample.relative_azimuth = azimuth_deg * kDegree;
      sample.wavelength_nm = 440 + 40 * static_cast<double>(w);
      sample.value = 0.1;
      reference.samples.push_back(sample);
    }
  }
  return reference;
}

// Counts how often the toy is asked, and for how many values.
class CountingSky : public ToySky {
 public:
  mutable std::size_t calls = 0, values = 0;
  SkyValues radiance(const Atmosphere<double>& atmosphere,
                     std::span<const WavelengthNode> wavelengths, std::span<const SkyPoint> points,
                     std::span<const Parameter> derivatives) const override {
    ++calls;
    values += wavelengths.size() * points.size();
    return ToySky::radiance(atmosphere, wavelengths, points, derivatives);
  }
};

void expect_values_of_own_suns(const refs::Reference& reference, const CountingSky& model) {
  const Dataset data = dataset(reference, refs::standard_spectral_data(), {});
  EXPECT_EQ(data.lines_of_sight.size(), 4u);  // directions from the sun
  EXPECT_EQ(data.views.size(), reference.samples.size());
  const SkyState state = start_state(true_atmosphere(2), 1);
  const Eigen::VectorXd value = sky_values(model, data, state, {}).value;
  for (std::size_t r = 0; r < data.samples.size(); ++r) {
    const refs::Sample& sample = reference.samples[data.samples[r].index];
    const SkyPoint point = sky_point(sample);
    const std::vector<WavelengthNode> node =
        spectral_nodes(refs::standard_spectral_data(), {sample.wavelength_nm});
    const double alone = refs::standard_spectral_data().solar_irradiance.at(sample.wavelength_nm) *
                         ToySky().radiance(true_atmosphere(2), node, {&point, 1}, {}).at(0, 0);
    EXPECT_DOUBLE_EQ(value(static_cast<Eigen::Index>(r)), alone);
  }
}

TEST(MovingSun, ManyWavelengthsAreEvaluatedOnceUnderTheirOwnSun) {
  const CountingSky model;
  const refs::Reference reference = almucantar(9);
  expect_values_of_own_suns(reference, model);
  EXPECT_EQ(model.calls, 9u);
  EXPECT_EQ(model.values, reference.samples.size());
}

TEST(MovingSun, FewWavelengthsAreEvaluatedAtOnce) {
  const CountingSky model;
  const refs::Reference reference = almucantar(8);
  expect_values_of_own_suns(reference, model);
  EXPECT_EQ(model.calls, 1u);
}

// A tilt turns with the sun's own azimuth.
TEST(MovingSun, DerivativesHold) {
  const ToySky model;
  const Dataset data = dataset(almucantar(), refs::standard_spectral_data(), {});
  const SkyState state = start_state(true_atmosphere(2), 1);
  for (const Instrument id : {Instrument::kAzimuthOffset, Instrument::kTiltNorth}) {
    const Unknown unknown{{-0.1, 0.1, false, std::nullopt}, id, 0};
    const auto moved = [&](double by) {
      const Eigen::VectorXd scaled = Eigen::VectorXd::Constant(1, unknown.scaled(by));
      return sky_values(model, data, with_unknowns(state, {unknown}, scaled), {}).value;
    };
    const Eigen::VectorXd expected = (moved(1e-5) - moved(-1e-5)) / 2e-5;
    constexpr double kPointingDifference =
        5e-3;  // third derivative over 0.25 deg, 5 deg from the sun
    EXPECT_LT((sky_values(model, data, state, {unknown}).derivative.col(0) - expected).norm(),
              kPointingDifference * expected.norm());
  }
}

// A sample outside the model's spectra has no value and does not stop the others.
TEST(MovingSun, WeightlessSamplesOutsideTheSpectraAreLeftOut) {
  refs::Reference reference = almucantar();
  reference.samples.back().wavelength_nm = 290;
  reference.samples.back().weight = 0;
  const Dataset all = dataset(reference, refs::standard_spectral_data(), {true, 0, {}, 0});
  EXPECT_EQ(all.samples.size(), reference.samples.size() - 1);
}

}  // namespace
}  // namespace skyfit::fit
