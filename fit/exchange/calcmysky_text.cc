// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "fit/exchange/calcmysky.h"
#include "model/atmosphere/optics.h"
#include "model/atmosphere/parameter_field.h"
#include "model/numerics/angles.h"

namespace skyfit::fit::calcmysky {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kFirst_nm = 360, kLast_nm = 830, kUnit_m2 = 1e-12;  // 1 um^2
constexpr int kWavelengths = 16;
constexpr double kAbsorberDensity = 1e12;  // 1/m^3 where the profile is 1

double wavelength(int k) { return kFirst_nm + (kLast_nm - kFirst_nm) * k / (kWavelengths - 1); }

using Spectrum16 = std::array<double, kWavelengths>;

// GLSL knows 1.0 and 1e3 as numbers with a fraction, 1 not.
std::string number(double value) {
  std::string text = fmt::format("{:.9g}", value);
  return text.find_first_of(".e") == text.npos ? text + ".0" : text;
}

// For quantities with a unit, where exponents are not read.
std::string plain_number(double value) { return fmt::format("{:.9f}", value); }

std::string listed(const Spectrum16& values) {
  std::vector<std::string> texts;
  for (const double v : values) texts.push_back(fmt::format("{:.7g}", v));
  return fmt::format("{}", fmt::join(texts, ", "));
}

Code density_code(const VerticalProfile<double>& profile, double factor) {
  if (const auto tent = tent_of(profile))
    return {fmt::format("return {}*max(0.0,1.0-abs(altitude-{})/{});", number(factor),
                        number(tent->peak_m), number(tent->half_width_m))};
  switch (profile.type) {
    case ProfileType::kLayer: {
      // Its lower edge is as wide as the ground allows (model/atmosphere/profile.cc).
      constexpr double kSharp_m = 1e-3;
      const double edge = kLayerEdge * (profile.top_m - profile.base_m),
                   low = std::max(std::min(2 * profile.base_m, edge), kSharp_m);
      return {fmt::format(
          "return {}*clamp((altitude-{})/{}+0.5,0.0,1.0)*clamp(({}-altitude)/{}+0.5,0.0,1.0);",
          number(factor), number(profile.base_m), number(low), number(profile.top_m),
          number(edge))};
    }
    case ProfileType::kCorners:
    case ProfileType::kTabulated: {
      const Profile shape(profile);
      const std::vector<double>&x = shape.table().heights(), &y = shape.table().densities();
      Code code;
      for (std::size_t i = 0; i + 1 < x.size(); ++i)
        code.push_back(fmt::format("if(altitude<{}) return {}*mix({},{},(altitude-{})/{});",
                                   number(x[i + 1]), number(factor), number(y[i]), number(y[i + 1]),
                                   number(x[i]), number(x[i + 1] - x[i])));
      code.push_back("return 0.0;");
      return code;
    }
    default:
      return {fmt::format("return {}*exp(-altitude/{});", number(factor),
                          number(profile.scale_height_m))};
  }
}

std::string lobe(PhaseType type, std::string_view g) {
  return type == PhaseType::kHenyeyGreenstein
             ? fmt::format("(1.0-{0}*{0})/(4.0*PI)*pow(1.0+{0}*{0}-2.0*{0}*dotViewSun,-1.5)", g)
             : fmt::format(
                   "3.0/(8.0*PI)*(1.0-{0}*{0})/(2.0+{0}*{0})*(1.0+sqr(dotViewSun))*"
                   "pow(1.0+{0}*{0}-2.0*{0}*dotViewSun,-1.5)",
                   g);
}

}  // namespace

std::string one_lobe(PhaseType type) { return fmt::format("return vec4({});", lobe(type, "g")); }

std::string two_lobes(PhaseType type) {
  return fmt::format("return vec4(weight*{}+(1.0-weight)*{});", lobe(type, "g1"), lobe(type, "g2"));
}

namespace {

std::string constant(std::string_view name, double value) {
  return fmt::format("CONST float {}={};", name, number(value));
}

// A phase function that is no formula, at 550 nm: its logarithm linear in the angle, degrees.
TwoColumns table_at_550(const PhaseFunction<double>& phase) {
  TwoColumns table;
  if (phase.type == PhaseType::kTabulated) return phase.table->table();
  const PhaseFunction<double> there = phase_at(phase, 550);
  for (double angle = 0; angle <= 180; angle += angle < 20 ? 0.5 : 2) {
    table.x.push_back(angle);
    table.y.push_back(phase_value(there, std::cos(angle * kRadiansPerDegree)));
  }
  return table;
}

Code phase_code(const PhaseFunction<double>& phase) {
  switch (phase.type) {
    case PhaseType::kRayleigh:
      return {constant("rho", phase.depolarisation), std::string(kRayleighLine)};
    case PhaseType::kHenyeyGreenstein:
    case PhaseType::kCornetteShanks:
      return {constant("g", phase.g), one_lobe(phase.type)};
    case PhaseType::kTwoLobe:
      return {constant("g1", phase.g1), constant("g2", phase.g2), constant("weight", phase.weight),
              two_lobes(phase.lobe)};
    default: {
      const TwoColumns table = table_at_550(phase);
      Code code{std::string(kAngleLine)};
      for (std::size_t i = 0; i + 1 < table.x.size(); ++i)
        code.push_back(fmt::format("if(angle<={}) return vec4(exp(mix({},{},(angle-{})/{})));",
                                   number(table.x[i + 1]), number(std::log(table.y[i])),
                                   number(std::log(table.y[i + 1])), number(table.x[i]),
                                   number(table.x[i + 1] - table.x[i])));
      code.push_back(fmt::format("return vec4({});", number(table.y.back())));
      return code;
    }
  }
}

// The power law a (1 um / lambda)^exponent that is nearest to positive values, in logarithms and
// with weights.
struct PowerLaw {
  double at_1um, exponent;
};
PowerLaw power_law(const Spectrum16& values, const Spectrum16& weights) {
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (int k = 0; k < kWavelengths; ++k) {
    const Eigen::Vector2d row(1, std::log(1000 / wavelength(k)));
    normal += weights[k] * row * row.transpose();
    right += weights[k] * std::log(values[k]) * row;
  }
  const Eigen::Vector2d solution = normal.ldlt().solve(right);
  return {std::exp(solution[0]), solution[1]};
}

// What the eye sees of the sun's light.
Spectrum16 visual_weights(const SpectralData& spectra) {
  Spectrum16 weights{};
  for (int k = 0; k < kWavelengths; ++k) {
    const double nm = wavelength(k);
    weights[k] = (spectra.x_bar.at_or_zero(nm) + spectra.y_bar.at_or_zero(nm) +
                  spectra.z_bar.at_or_zero(nm)) *
                 spectra.solar_irradiance.at(nm);
  }
  return weights;
}

std::string block(const Code& code) {
  std::string text = "    ```\n";
  for (const std::string& line : code) text += "        " + line + "\n";
  return text + "    ```\n";
}

std::string identifier(std::string_view name) {
  std::string text(name);
  for (char& c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (!plain) c = '_';
  }
  return text;
}

std::string absorber_text(std::string_view name, const VerticalProfile<double>& profile,
                          Spectrum16 absorption) {
  for (double& a : absorption) a /= kAbsorberDensity;
  return fmt::format("Absorber \"{}\":\n{{\n    number density:\n{}    cross section: {}\n}}\n",
                     name, block(density_code(profile, kAbsorberDensity)), listed(absorption));
}

std::string constituent_text(const Atmosphere<double>& atmosphere, const Constituent<double>& c,
                             const SpectralData& spectra) {
  const VerticalProfile<double> profile = own_profile(atmosphere, c);
  const Dual<0> column(Profile(profile).vertical_column().value);
  Spectrum16 scattering{}, absorption{};
  double most = 0;
  for (int k = 0; k < kWavelengths; ++k) {
    const auto at =
        coefficients_at(with_scalar<Dual<0>>(c), column, node_at(spectra, wavelength(k)));
    scattering[k] = at.scattering.v;
    absorption[k] = std::max(at.extinction.v - at.scattering.v, 0.0);
    most = std::max(most, at.extinction.v);
  }
  // Rounding of an albedo of 1 is no absorption.
  for (double& a : absorption) a = a < 1e-12 * most ? 0 : a;
  const bool absorbs = std::ranges::max(absorption) > 0;
  std::string text;
  if (scatters(c) && std::ranges::min(scattering) > 0) {
    const PowerLaw law = power_law(scattering, visual_weights(spectra));
    text += fmt::format(
        "Scatterer \"{}\":\n{{\n    number density:\n{}    phase function:\n{}"
        "    cross section at 1 um: 1 um^2\n    angstrom exponent: {}\n"
        "    phase function type: achromatic\n}}\n",
        identifier(c.name), block(density_code(profile, law.at_1um / kUnit_m2)),
        block(phase_code(c.phase)), plain_number(law.exponent));
    if (absorbs)
      text += absorber_text(identifier(c.name) + std::string(kAbsorption), profile, absorption);
  } else if (absorbs) {
    text += absorber_text(identifier(c.name), profile, absorption);
  }
  return text;
}

// Of equal energy, 1 cd/m^2.
Spectrum16 unit_luminance(const SpectralData& spectra) {
  constexpr double kLumensPerWatt = 683;
  double sum = 0;
  for (int k = 0; k < kWavelengths; ++k)
    sum += spectra.y_bar.at_or_zero(wavelength(k)) * (kLast_nm - kFirst_nm) / (kWavelengths - 1);
  Spectrum16 values;
  values.fill(1 / (kLumensPerWatt * sum));
  return values;
}

}  // namespace

std::string atmo_text(const ExportRequest& request, std::string_view loss) {
  const Atmosphere<double>& a = request.preset.atmosphere;
  Spectrum16 irradiance{}, albedo{};
  for (int k = 0; k < kWavelengths; ++k) {
    irradiance[k] = request.spectra.solar_irradiance.at(wavelength(k));
    albedo[k] = ground_albedo_at(a, wavelength(k));
  }
  std::string text = fmt::format(
      R"(# Atmosphere of the preset {}, for CalcMySky. Loss: {}
version: 7

transmittance texture size for VZA: 256
transmittance texture size for altitude: 64
irradiance texture size for SZA: 64
irradiance texture size for altitude: 16
scattering texture size for VZA: 128
scattering texture size for dot(view,sun): 16
scattering texture size for SZA: 128
scattering texture size for altitude: 64
eclipsed scattering texture size for relative azimuth: 32
eclipsed scattering texture size for VZA: 128
eclipsed double scattering texture size for relative azimuth: 16
eclipsed double scattering texture size for VZA: 128
eclipsed double scattering texture size for SZA: 16
eclipsed double scattering number of azimuth pairs to sample: 2
eclipsed double scattering number of elevation pairs to sample: 10
light pollution texture size for VZA: 128
light pollution texture size for altitude: 64
light pollution angular integration points: 200
transmittance integration points: 500
radial integration points: 50
angular integration points: 512
angular integration points for eclipse: 512
scattering orders: 4

# The distance at which the program's sun of 696350 km has the preset's diameter.
Earth-Sun distance: {} AU
Earth-Moon distance: 384400 km
Earth radius: {} m
atmosphere height: {} m

wavelengths: min={:g}nm,max={:g}nm,count={}
solar irradiance at TOA: {}
ground albedo: {}
# Of equal energy.
light pollution relative radiance: {}

)",
      plain_line(request.preset.name), loss,
      plain_number(kSunRadius_m / a.star.angular_radius_rad() / kAu_m),
      plain_number(a.bottom_radius_m), plain_number(a.top_radius_m - a.bottom_radius_m), kFirst_nm,
      kLast_nm, kWavelengths, listed(irradiance), listed(albedo),
      listed(unit_luminance(request.spectra)));
  for (const Constituent<double>& c : a.constituents)
    text += constituent_text(a, c, request.spectra);
  return text;
}

}  // namespace skyfit::fit::calcmysky
