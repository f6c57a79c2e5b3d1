// SPDX-License-Identifier: Apache-2.0
// The rules of model/photometry/photometry.h keep to the 5 nm sum for clear and hazy atmospheres,
// ozone 0 to 500 DU, suns 0 to 92 deg, views 0 to 90 deg, from the ground and from 10 km. The
// atmospheres are not those that the nodes were found with.
#include "tests/atmospheres.h"
#include "tests/model/rule_accuracy.h"

namespace skyfit {
namespace {

struct Air {
  double scattering, exponent, scale_height, albedo, ozone, ground;
  PhaseType phase;
};

TEST(RuleAccuracy, Everywhere) {
  std::vector<RuleCase> cases;
  for (const Air& air : {Air{0, 1, 1200, 0.9, 500, 0.3, PhaseType::kCornetteShanks},
                         Air{8e-6, 1.3, 1200, 0.9, 350, 0.1, PhaseType::kTwoLobe},
                         Air{1e-4, 0.3, 2000, 0.8, 500, 0.8, PhaseType::kTwoLobe},
                         Air{2.5e-4, 1.8, 900, 0.98, 500, 0.05, PhaseType::kHenyeyGreenstein},
                         Air{6e-4, 1.2, 1200, 0.9, 420, 0.2, PhaseType::kTwoLobe},
                         Air{2e-4, 1.0, 1200, 0.9, 0, 0.2, PhaseType::kCornetteShanks}}) {
    Atmosphere<double> a;
    set_scattering(a.at("mie"), 550, air.scattering, air.exponent);
    a.at("mie").profile.scale_height_m = air.scale_height;
    a.at("mie").single_scattering_albedo = air.albedo;
    a.at("mie").phase.type = air.phase;
    a.at("ozone").amount = air.ozone;
    a.ground_albedo = air.ground;
    cases.push_back({a,
                     {0, 10e3},
                     {0, 30, 55, 70, 78, 83, 87, 89, 91, 92},
                     {0, 20, 45, 65, 78, 84, 87, 89, 90}});
  }
  expect_rules_hold(cases);
}

}  // namespace
}  // namespace skyfit
