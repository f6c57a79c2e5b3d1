// SPDX-License-Identifier: Apache-2.0
#include "fit/exchange/engine_form.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "model/atmosphere/derived.h"
#include "model/atmosphere/optics.h"
#include "model/atmosphere/parameter_field.h"
#include "model/atmosphere/profile.h"

namespace skyfit::fit {
namespace {

using Constituents = std::vector<const Constituent<double>*>;

double depth(const Atmosphere<double>& atmosphere, const Constituent<double>& c,
             const SpectralData& spectra, double nm) {
  return vertical_optical_depth(atmosphere, c, node_at(spectra, nm));
}

double albedo(const Constituent<double>& c, double nm) {
  if (!scatters(c)) return 0;
  return single_scattering_albedo_at(with_scalar<Dual<0>>(c), nm).v;
}

// Optical depths of scattering and of extinction at red, green and blue.
struct Depths {
  Rgb scattering{}, extinction{};
};

Depths depths_of(const Atmosphere<double>& atmosphere, const Constituents& list,
                 const SpectralData& spectra) {
  Depths sum;
  for (const Constituent<double>* c : list) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double nm = kEngineWavelengths_nm[k], tau = depth(atmosphere, *c, spectra, nm);
      sum.extinction[k] += tau;
      sum.scattering[k] += tau * albedo(*c, nm);
    }
  }
  return sum;
}

// Of the constituent with the largest optical depth whose profile is such a one; nothing: none is.
std::optional<VerticalProfile<double>> largest(
    const Atmosphere<double>& atmosphere, const Constituents& list, const SpectralData& spectra,
    bool (*is_such)(const VerticalProfile<double>& profile)) {
  std::optional<VerticalProfile<double>> found;
  double most = 0;
  for (const Constituent<double>* c : list) {
    const double tau = depth(atmosphere, *c, spectra, 550);
    const VerticalProfile<double> profile = own_profile(atmosphere, *c);
    if (!is_such(profile) || tau < most) continue;
    found = profile;
    most = tau;
  }
  return found;
}

Rgb over(const Rgb& depths, double column_m) {
  return {depths[0] / column_m, depths[1] / column_m, depths[2] / column_m};
}

// Cornette & Shanks' g of a mean cosine: 3 g (4 + g^2) / (5 (2 + g^2)) by Newton's method.
double cornette_shanks_g(double cosine) {
  double g = cosine;
  for (int i = 0; i < 30; ++i) {
    const double n = 3 * g * (4 + g * g), d = 5 * (2 + g * g);
    const double slope = (3 * (4 + 3 * g * g) * d - n * 10 * g) / (d * d);
    g = std::clamp(g - (n / d - cosine) / slope, -0.98, 0.98);
  }
  return g;
}

double lobe_of(const Atmosphere<double>& atmosphere, const Constituents& aerosols,
               const SpectralData& spectra, PhaseType lobe, double if_none) {
  double sum = 0, weight = 0;
  for (const Constituent<double>* c : aerosols) {
    const double tau = depth(atmosphere, *c, spectra, 550) * albedo(*c, 550);
    sum += tau * mean_cosine(c->phase);
    weight += tau;
  }
  if (weight == 0) return if_none;
  return lobe == PhaseType::kCornetteShanks ? cornette_shanks_g(sum / weight) : sum / weight;
}

std::shared_ptr<const SpectrumTable> table_of(const Rgb& values, const TableFormat& format) {
  return std::make_shared<const SpectrumTable>(
      TwoColumns{{kEngineWavelengths_nm[2], kEngineWavelengths_nm[1], kEngineWavelengths_nm[0]},
                 {values[2], values[1], values[0]}},
      format);
}

void set_coefficients(const Rgb& values, Constituent<double>& c) {
  constexpr double kSame = 0.02;
  c.wavelength_nm = 550;
  c.amount = values[1];
  c.angstrom_exponent = 0;
  if (values[0] == values[2] && values[0] == values[1]) return;
  if (values[0] > 0 && values[2] > 0) {
    c.angstrom_exponent = std::log(values[2] / values[0]) /
                          std::log(kEngineWavelengths_nm[0] / kEngineWavelengths_nm[2]);
    const double green = values[0] * std::pow(550 / kEngineWavelengths_nm[0], -c.angstrom_exponent);
    if (std::abs(green / values[1] - 1) < kSame) return;
  }
  c.angstrom_exponent = 0;
  c.spectrum = table_of(values, kShapeFormat);
}

Rgb coefficients(const Constituent<double>& c) {
  Rgb values;
  for (std::size_t k = 0; k < 3; ++k) {
    const double nm = kEngineWavelengths_nm[k];
    values[k] = c.amount * relative_coefficient_at(with_scalar<Dual<0>>(c), nm).v;
  }
  return values;
}

}  // namespace

Atmosphere<double> engine_form(const Atmosphere<double>& atmosphere, const SpectralData& spectra,
                               PhaseType lobe) {
  Constituents air, aerosols, absorbers;
  for (const Constituent<double>& c : atmosphere.constituents) {
    (!scatters(c)                           ? absorbers
     : c.phase.type == PhaseType::kRayleigh ? air
                                            : aerosols)
        .push_back(&c);
  }
  EngineAtmosphere engine;
  engine.bottom_radius_m = atmosphere.bottom_radius_m;
  engine.top_radius_m = atmosphere.top_radius_m;
  engine.lobe = lobe;
  const auto is_exponential = [](const VerticalProfile<double>& p) {
    return p.type == ProfileType::kExponential;
  };
  if (const auto p = largest(atmosphere, air, spectra, is_exponential))
    engine.rayleigh_scale_height_m = p->scale_height_m;
  if (const auto p = largest(atmosphere, aerosols, spectra, is_exponential))
    engine.mie_scale_height_m = p->scale_height_m;
  if (const auto p = largest(atmosphere, absorbers, spectra,
                             [](const auto& profile) { return tent_of(profile).has_value(); })) {
    engine.tent_peak_m = tent_of(*p)->peak_m;
    engine.tent_half_width_m = tent_of(*p)->half_width_m;
  }
  const Depths of_air = depths_of(atmosphere, air, spectra),
               of_aerosols = depths_of(atmosphere, aerosols, spectra),
               of_absorbers = depths_of(atmosphere, absorbers, spectra);
  engine.rayleigh_scattering = over(of_air.scattering, engine.rayleigh_scale_height_m);
  engine.mie_scattering = over(of_aerosols.scattering, engine.mie_scale_height_m);
  VerticalProfile<double> tent;
  set_tent(engine.tent_peak_m, engine.tent_half_width_m, tent);
  engine.absorption = over(of_absorbers.extinction, Profile(tent).vertical_column().value);
  engine.g = lobe_of(atmosphere, aerosols, spectra, lobe, engine.g);
  for (std::size_t k = 0; k < 3; ++k) {
    engine.mie_absorption[k] =
        of_aerosols.extinction[k] / engine.mie_scale_height_m - engine.mie_scattering[k];
    engine.ground_albedo[k] = ground_albedo_at(atmosphere, kEngineWavelengths_nm[k]);
  }
  Atmosphere<double> form = atmosphere_of(engine);
  form.star = atmosphere.star;
  form.sea = atmosphere.sea;
  return form;
}

EngineAtmosphere engine_atmosphere(const Atmosphere<double>& atmosphere) {
  const Constituent<double>& air = atmosphere.at("rayleigh");
  EngineAtmosphere engine;
  engine.bottom_radius_m = atmosphere.bottom_radius_m;
  engine.top_radius_m = atmosphere.top_radius_m;
  engine.rayleigh_scattering = coefficients(air);
  engine.rayleigh_scale_height_m = air.profile.scale_height_m;
  if (const Constituent<double>* mie = atmosphere.find("mie")) {
    engine.mie_scattering = coefficients(*mie);
    engine.mie_scale_height_m = mie->profile.scale_height_m;
    engine.g = mie->phase.g;
    engine.lobe = mie->phase.type;
    for (std::size_t k = 0; k < 3; ++k) {
      engine.mie_absorption[k] =
          engine.mie_scattering[k] * (1 / albedo(*mie, kEngineWavelengths_nm[k]) - 1);
    }
  }
  for (std::size_t k = 0; k < 3; ++k)
    engine.ground_albedo[k] = ground_albedo_at(atmosphere, kEngineWavelengths_nm[k]);
  if (const Constituent<double>* absorber = atmosphere.find("absorber")) {
    engine.absorption = coefficients(*absorber);
    const Tent tent = tent_of(absorber->profile).value();
    engine.tent_peak_m = tent.peak_m;
    engine.tent_half_width_m = tent.half_width_m;
  }
  return engine;
}

Atmosphere<double> atmosphere_of(const EngineAtmosphere& engine) {
  Atmosphere<double> a;
  a.bottom_radius_m = engine.bottom_radius_m;
  a.top_radius_m = engine.top_radius_m;
  Constituent<double>&air = a.at("rayleigh"), &mie = a.at("mie");
  set_coefficients(engine.rayleigh_scattering, air);
  air.profile.scale_height_m = engine.rayleigh_scale_height_m;
  set_coefficients(engine.mie_scattering, mie);
  mie.profile.scale_height_m = engine.mie_scale_height_m;
  mie.phase.type = engine.lobe;
  mie.phase.g = engine.g;
  Rgb albedos;
  for (std::size_t k = 0; k < 3; ++k) {
    const double extinction = engine.mie_scattering[k] + engine.mie_absorption[k];
    albedos[k] = extinction > 0 ? engine.mie_scattering[k] / extinction : 1;
  }
  mie.single_scattering_albedo = albedos[1];
  if (std::ranges::max(albedos) - std::ranges::min(albedos) > 1e-9)
    mie.albedo_spectrum = table_of(albedos, kAlbedoFormat);
  const bool has_aerosol = std::ranges::max(engine.mie_scattering) > 0;
  std::erase_if(a.constituents, [&](const auto& c) {
    return c.name == "ozone" || (c.name == "mie" && !has_aerosol);
  });
  if (std::ranges::max(engine.absorption) > 0) {
    Constituent<double> absorber;
    absorber.name = "absorber";
    absorber.amount_type = AmountType::kExtinction;
    absorber.single_scattering_albedo = 0;
    set_tent(engine.tent_peak_m, engine.tent_half_width_m, absorber.profile);
    set_coefficients(engine.absorption, absorber);
    a.constituents.push_back(absorber);
  }
  a.ground_albedo = engine.ground_albedo[1];
  if (engine.ground_albedo[1] > 0 &&
      std::ranges::max(engine.ground_albedo) > std::ranges::min(engine.ground_albedo)) {
    a.ground_spectrum = std::make_shared<const GroundSpectrum>(
        TwoColumns{{440, 550, 680},
                   {engine.ground_albedo[2], engine.ground_albedo[1], engine.ground_albedo[0]}});
  }
  return a;
}

}  // namespace skyfit::fit
