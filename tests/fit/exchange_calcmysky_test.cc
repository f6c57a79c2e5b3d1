// SPDX-License-Identifier: Apache-2.0
// Descriptions of CalcMySky: what is written is read back, and foreign ones are refused by key.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "model/atmosphere/derived.h"
#include "model/atmosphere/optics.h"
#include "model/atmosphere/parameter_field.h"
#include "tests/fit/exchange.h"

namespace skyfit::fit {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// A sky that costs nothing, where only the text of an export matters.
class EvenSky : public SkyModel {
 public:
  std::string_view name() const override { return "even"; }
  SkyValues radiance(const Atmosphere<double>&, std::span<const WavelengthNode> wavelengths,
                     std::span<const SkyPoint> points, std::span<const Parameter>) const override {
    SkyValues sky{static_cast<int>(points.size()), static_cast<int>(wavelengths.size()), 0, {}, {}};
    sky.value.assign(points.size() * wavelengths.size(), 1.0);
    return sky;
  }
};

double depth_at(const Atmosphere<double>& a, const std::string& name, double nm) {
  return vertical_optical_depth(a, a.at(name), node_at(spectra(), nm));
}

// At wavelengths of its list; what lies between is interpolated.
constexpr std::array kListed_nm = {360 + 2 * 470 / 15.0, 360 + 6 * 470 / 15.0,
                                   360 + 10 * 470 / 15.0};

TEST(CalcMySky, ReadsWhatItWrites) {
  for (const char* name : {"thin-cloud", "titan"}) {
    const Preset preset{name, shipped(name), nullptr};
    const EvenSky even;
    const Exported written = program_named("calcmysky")
                                 .write({.preset = preset,
                                         .spectra = spectra(),
                                         .models = {even, even},
                                         .file = "sky.atmo",
                                         .write_sky_map = {}});
    const std::string& text = written.files.at(0).text;
    EXPECT_EQ(program_of(text)->name, "calcmysky");
    std::vector<std::string> notes;
    const Atmosphere<double> back = *read_calcmysky(text, "file", notes);
    EXPECT_NO_THROW(validate(back)) << name;
    EXPECT_EQ(notes.size(), 1U);
    EXPECT_NEAR(back.bottom_radius_m, preset.atmosphere.bottom_radius_m, 1e-6);
    EXPECT_NEAR(back.top_radius_m, preset.atmosphere.top_radius_m, 1e-6);
    EXPECT_NEAR(back.star.angular_diameter_deg, preset.atmosphere.star.angular_diameter_deg, 1e-6);
    EXPECT_EQ(back.constituents.size(), preset.atmosphere.constituents.size()) << name;
    for (const Constituent<double>& c : preset.atmosphere.constituents) {
      EXPECT_EQ(back.at(c.name).profile.type, c.profile.type) << name << " " << c.name;
      const double depth = depth_at(preset.atmosphere, c.name, kListed_nm[1]);
      // Tables of spectra become power laws.
      EXPECT_NEAR(depth_at(back, c.name, kListed_nm[1]), depth, 0.03 * depth)
          << name << " " << c.name;
    }
  }
}

TEST(CalcMySky, LosesNothingOfPowerLawsAndLobes) {
  const Preset preset{"earth-clear", shipped("earth-clear"), nullptr};
  std::vector<std::string> notes;
  const Atmosphere<double>& a = preset.atmosphere;
  const Atmosphere<double> back =
      *read_calcmysky(exported(preset, "calcmysky", 0.5, 1).files.at(0).text, "file", notes);
  for (const Constituent<double>& c : a.constituents) {
    for (const double nm : kListed_nm)
      EXPECT_NEAR(depth_at(back, c.name, nm), depth_at(a, c.name, nm),
                  2e-5 * depth_at(a, c.name, nm))
          << c.name << " " << nm;
    if (!scatters(c)) continue;
    for (const double nu : {-1.0, 0.2, 0.9, 1.0})
      EXPECT_NEAR(phase_value(back.at(c.name).phase, nu), phase_value(c.phase, nu), 1e-6) << c.name;
  }
  EXPECT_NEAR(single_scattering_albedo_at(with_scalar<Dual<0>>(back.at("mie")), kListed_nm[1]).v,
              a.at("mie").single_scattering_albedo, 1e-6);
  EXPECT_NEAR(back.ground_albedo, a.ground_albedo, 1e-6);
}

TEST(CalcMySky, ForeignCodeIsRefusedByKey) {
  const Preset preset{"earth-clear", shipped("earth-clear"), nullptr};
  const std::string text = exported(preset, "calcmysky", 0.5, 1).files.at(0).text;
  std::vector<std::string> notes;
  const auto with = [&](const std::string& old, const std::string& other) {
    std::string changed = text;
    const std::size_t at = changed.find(old);
    EXPECT_NE(at, changed.npos) << old;
    changed.replace(at, old.size(), other);
    return [&notes, changed] { read_calcmysky(changed, "a.atmo", notes); };
  };
  EXPECT_THAT(
      with("exp(-altitude/1200.0)", "exp(-altitude/1200.0)*2.0"),
      ThrowsMessage<std::invalid_argument>(HasSubstr("a.atmo: Scatterer \"mie\": number density")));
  EXPECT_THAT(with("CONST float g1=", "CONST float h="),
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("a.atmo: Scatterer \"mie\": phase function = g1")));
  EXPECT_THAT(with("Earth radius: 6360000.000000000 m", "Earth radius: 6360 miles"),
              ThrowsMessage<std::invalid_argument>(HasSubstr("Earth radius = 6360 miles")));
  EXPECT_THAT(with("count=16", "count=20"),
              ThrowsMessage<std::invalid_argument>(HasSubstr("16 values, expected 20")));
}

}  // namespace
}  // namespace skyfit::fit
