// SPDX-License-Identifier: Apache-2.0
// A model that throws or is dark ends the fit with its own message; one that fails on the way is
// stepped around.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fit/fit.h"
#include "tests/fit/synthetic.h"

namespace skyfit::fit {
namespace {

using testing::HasSubstr;
using testing::Not;

class DarkSky : public ToySky {
 public:
  SkyValues radiance(const Atmosphere<double>& atmosphere,
                     std::span<const WavelengthNode> wavelengths, std::span<const SkyPoint> points,
                     std::span<const Parameter> derivatives) const override {
    SkyValues sky = ToySky::radiance(atmosphere, wavelengths, points, derivatives);
    for (std::size_t k = 0; k < wavelengths.size(); ++k) sky.value[k] = 0;
    return sky;
  }
};

// Fails for every aerosol amount above `limit`.
class LimitedSky : public ToySky {
 public:
  explicit LimitedSky(double limit) : limit_(limit) {}
  mutable std::atomic<int> refusals = 0;
  SkyValues radiance(const Atmosphere<double>& atmosphere,
                     std::span<const WavelengthNode> wavelengths, std::span<const SkyPoint> points,
                     std::span<const Parameter> derivatives) const override {
    if (atmosphere.at("mie").amount > limit_) {
      ++refusals;
      throw std::domain_error("too thick");
    }
    return ToySky::radiance(atmosphere, wavelengths, points, derivatives);
  }

 private:
  double limit_;
};

class RefusingSky : public ToySky {
 public:
  SkyValues radiance(const Atmosphere<double>&, std::span<const WavelengthNode>,
                     std::span<const SkyPoint>, std::span<const Parameter>) const override {
    throw std::invalid_argument("model: refused");
  }
};

FitOptions one_lobe() {
  FitOptions options;
  options.lobes = 1;
  options.starts = 2;
  return options;
}

template <class Error>
std::string message(const SkyModel& model) {
  try {
    fit_atmosphere(synthetic_reference(true_atmosphere(1), 0.02), refs::standard_spectral_data(),
                   model, one_lobe());
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(FailingModelTest, DarkSkyIsNamedWithItsDirection) {
  const std::string text = message<std::domain_error>(DarkSky());
  EXPECT_THAT(text, HasSubstr("sun zenith 0 deg, view zenith 80 deg, azimuth 180 deg is 0 cd/m^2"));
  EXPECT_THAT(text, Not(HasSubstr("\n")));
}

TEST(FailingModelTest, ErrorsOfTheModelPassThrough) {
  EXPECT_EQ(message<std::invalid_argument>(RefusingSky()), "model: refused");
}

TEST(FailingModelTest, FailureOnTheWayIsSteppedAround) {
  const double limit =
      1.4e-4;  // the truth has 1.2e-4; the first steps from little aerosol overshoot
  FitOptions options = one_lobe();
  options.starts = 1;
  options.start = Preset{"thin", true_atmosphere(1), {}};
  options.start->atmosphere.at("mie").amount = 5e-6;
  const LimitedSky model(limit);
  const Result result = fit_atmosphere(synthetic_reference(true_atmosphere(1), 0.02),
                                       refs::standard_spectral_data(), model, options);
  EXPECT_GT(model.refusals, 0);
  EXPECT_TRUE(result.converged);
  EXPECT_LT(result.errors.rms_log, 2.3);
  EXPECT_LE(result.preset.atmosphere.at("mie").amount, limit);
}

}  // namespace
}  // namespace skyfit::fit
