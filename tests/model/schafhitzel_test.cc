// SPDX-License-Identifier: Apache-2.0
// The table of `schafhitzel` holds what direct integration gives, on Earth and on Mars; the texels
// that a list of views needs are those of the whole table.
#include "model/literature/schafhitzel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "data_refs/references.h"
#include "data_refs/spectra.h"
#include "model/atmosphere/preset.h"
#include "model/registry.h"
#include "model/solver/reference_model.h"
#include "tests/model/truth.h"

namespace skyfit::truth {
namespace {

constexpr WavelengthNode kGreen{550, 0};

Atmosphere<double> preset(std::string_view name) {
  return parse_preset(refs::shipped_preset_json(name), std::string(name)).atmosphere;
}

// In the sun's plane and on its side, where the table's one plane is the truth: single scattering
// without absorption over a black ground.
TEST(Schafhitzel, IsTheIntegralInTheSunsPlane) {
  for (const std::string_view name : {"earth-clear", "schafhitzel-2007-mars"}) {
    Atmosphere<double> a = preset(name);
    if (name == "earth-clear") {
      a.at("mie").single_scattering_albedo = 1;
      a.at("ozone").amount = 0;
    }
    a.ground_albedo = 0;
    std::vector<SkyPoint> points;
    for (const double sun : {10.0, 40.0, 70.0}) {
      for (const double view : {0.0, 30.0, 60.0, 75.0})
        points.push_back({0, sun * kDegree, view * kDegree, 0});
    }
    ReferenceOptions single;
    single.order = 1;
    const SkyValues exact = ReferenceModel(single).radiance(a, {&kGreen, 1}, points, {});
    const SkyValues table = make_sky_model("schafhitzel", refs::standard_spectral_data(), 2)
                                ->radiance(a, {&kGreen, 1}, points, {});
    constexpr double kTable = 0.01;  // angles 1.4 deg apart
    for (std::size_t i = 0; i < points.size(); ++i)
      EXPECT_NEAR(table.value[i] / exact.value[i], 1, kTable) << name << ", point " << i;
  }
}

TEST(Schafhitzel, NeededTexelsAreThoseOfTheWholeTable) {
  const auto some = make_sky_model("schafhitzel", refs::standard_spectral_data(), 2),
             all = make_sky_model("schafhitzel", refs::standard_spectral_data(), 2);
  const Atmosphere<double> a = preset("earth-clear");
  const std::size_t bytes = all->prepare(a, {&kGreen, 1});
  EXPECT_GE(bytes, std::size_t{2} * 128 * 128 * 128 * sizeof(double));
  std::vector<SkyPoint> points;
  for (const double altitude : {0.0, 3e3, 4e5}) {
    for (const double view : {20.0, 95.0, 160.0})
      points.push_back({altitude, 0.8, view * kDegree, 2});
  }
  EXPECT_EQ(some->radiance(a, {&kGreen, 1}, points, {}).value,
            all->radiance(a, {&kGreen, 1}, points, {}).value);
}

}  // namespace
}  // namespace skyfit::truth
