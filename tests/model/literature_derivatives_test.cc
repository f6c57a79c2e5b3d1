// SPDX-License-Identifier: Apache-2.0
// Exact derivatives of every model of the literature equal central differences, for closed forms
// and for tables, 0 by parameters that a model does not depend on.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <ostream>

#include "data_refs/spectra.h"
#include "model/registry.h"
#include "model/sky_model.h"
#include "tests/atmospheres.h"

namespace skyfit {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

struct Case {
  std::string_view model;
  bool ground_only;        // no ray from space, no twilight, no view down
  bool single_scattering;  // without absorption
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.model; }

class LiteratureDerivatives : public ::testing::TestWithParam<Case> {
 protected:
  std::vector<SkyPoint> points() const {
    std::vector<SkyPoint> list;
    for (const double view : {5.0, 50.0, 85.0}) {
      for (const double azimuth : {20.0, 130.0})
        list.push_back({0, 55 * kDegree, view * kDegree, azimuth * kDegree});
    }
    if (!GetParam().ground_only) {
      list.push_back({0, 92 * kDegree, 70 * kDegree, 1});
      list.push_back({8e3, 50 * kDegree, 120 * kDegree, 1});
      list.push_back({8e5, 50 * kDegree, 150 * kDegree, 1});
    }
    return list;
  }
};

TEST_P(LiteratureDerivatives, EqualDifferences) {
  const auto model = make_sky_model(GetParam().model, refs::standard_spectral_data(), 2);
  Atmosphere<double> a;
  set_scattering(a.at("mie"), 550, 1.5e-4, 1.1);
  a.at("mie").phase = {model->lobes() == 2 ? PhaseType::kTwoLobe : PhaseType::kCornetteShanks,
                       0.7,
                       0.75,
                       0.2,
                       0.4,
                       PhaseType::kCornetteShanks};
  std::vector<Parameter> parameters;
  for (const Parameter& id : standard_parameters())
    if (has_parameter(a, id)) parameters.push_back(id);
  const std::vector<WavelengthNode> nodes = spectral_nodes(refs::standard_spectral_data(), {480});
  const std::vector<SkyPoint> list = points();
  const SkyValues exact = model->radiance(a, nodes, list, parameters);
  // Along directions that move every parameter at once; each parameter has its own pattern of
  // signs, the bits of its number.
  constexpr unsigned kSigns[] = {0b000000000000, 0b010101010101, 0b011001100110, 0b100001111000,
                                 0b111110000000};
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const bool absent =
        GetParam().single_scattering && (parameters[p] == Parameter::kOzoneColumn ||
                                         parameters[p] == Parameter::kMieSingleScatteringAlbedo);
    for (int i = 0; absent && i < exact.points; ++i)
      EXPECT_EQ(exact.derivative_at(static_cast<int>(p), i, 0), 0) << "point " << i;
  }
  constexpr double kStep = 1e-4, kDifference = 2e-6;  // relative; the third derivative
  for (const unsigned signs : kSigns) {
    std::vector<double> step;
    for (std::size_t p = 0; p < parameters.size(); ++p)
      step.push_back((signs >> p & 1u ? -kStep : kStep) * get_parameter(a, parameters[p]));
    const auto moved = [&](double share) {
      Atmosphere<double> b = a;
      for (std::size_t p = 0; p < parameters.size(); ++p)
        set_parameter(b, parameters[p], get_parameter(a, parameters[p]) + share * step[p]);
      return model->radiance(b, nodes, list, {});
    };
    const SkyValues above = moved(1), below = moved(-1);
    for (std::size_t i = 0; i < list.size(); ++i) {
      double expected = 0, size = 0;
      for (std::size_t p = 0; p < parameters.size(); ++p) {
        const double part =
            step[p] * exact.derivative_at(static_cast<int>(p), static_cast<int>(i), 0);
        expected += part;
        size += std::abs(part);
      }
      const double difference = 0.5 * (above.value[i] - below.value[i]);
      EXPECT_NEAR(difference / size, expected / size, kDifference)
          << "signs " << signs << " at point " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Models, LiteratureDerivatives,
    ::testing::Values(Case{"bruneton", false, false}, Case{"hillaire", false, false},
                      Case{"bodare", false, false}, Case{"schafhitzel", false, true},
                      Case{"oneil", false, true}, Case{"nielsen", true, true},
                      Case{"hoffman-preetham", true, true}, Case{"preetham", true, false},
                      Case{"hosek-wilkie", true, false}),
    [](const auto& tested) {
      std::string name(tested.param.model);
      std::erase(name, '-');
      return name;
    });

}  // namespace
}  // namespace skyfit
