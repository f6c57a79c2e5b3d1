// SPDX-License-Identifier: Apache-2.0
// `reference`: the yardstick. Single scattering by quadrature in spherical geometry with the true
// phase function; multiple scattering from the diffuse field (model/solver/diffuse_field.h), solved
// in spherical shells, its source integrated along the spherical view ray at the local sun; Lambert
// ground, ozone. Light that air scattered is polarised, and refracted where that is asked for.
// docs/theory/ derives it, docs/accuracy.md states the error against Monte Carlo.
#pragma once

#include <stdexcept>

#include "model/sky_model.h"
#include "model/solver/level_grid.h"

namespace skyfit {

struct ReferenceOptions {
  int streams = 8;  // rays to the ground of the diffuse field, per hemisphere; more along the limb
  // Of the aerosol's phase function, <= 2 streams. The default, and the streams with it, is doubled
  // for a lobe so narrow that a tenth of its scattering would be cut off.
  int moments = 16;
  int levels = kDefaultLevels;  // of the diffuse field
  int threads = 1;
  double tolerance = 3e-3;  // of the azimuth modes that are left out
  // 0: all light. k > 0: only what met air or ground k times; approximate for suns below 86 deg,
  // where the coupling of neighbouring places is left out of single orders. Values only.
  int order = 0;
  // Scalar transfer leaves polarisation out: off by up to 13 % in the blue, see docs/accuracy.md.
  Transfer transfer = Transfer::kVector;
  // Refraction by air (model/atmosphere/refraction.h): view angles are those that an observer sees,
  // suns stand where they would without air. Multiple scattering leaves out that the refracted
  // beam spreads.
  bool refraction = false;
};

// The streams and moments that the model takes for an atmosphere: those given, doubled where they
// are the default and a lobe is narrow.
ReferenceOptions options_for(const Atmosphere<double>& atmosphere, ReferenceOptions options);

// An atmosphere that the solver cannot do, found while it is solved; one line with wavelength and
// sun, before which a caller puts the atmosphere's name.
class BeyondTheSolver : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class ReferenceModel final : public SkyModel {
 public:
  explicit ReferenceModel(const ReferenceOptions& options);      // throws std::invalid_argument
  static constexpr std::string_view kRefraction = "refraction";  // the variant of the registry
  std::string_view name() const override {
    return options_.refraction ? "reference:refraction" : "reference";
  }
  Transfer transfer() const override { return options_.transfer; }
  bool refracts() const override { return options_.refraction; }
  SkyValues radiance(const Atmosphere<double>& atmosphere,
                     std::span<const WavelengthNode> wavelengths, std::span<const SkyPoint> points,
                     std::span<const Parameter> derivatives) const override;
  bool gives_stokes() const override { return transfer() == Transfer::kVector; }
  StokesValues stokes(const Atmosphere<double>& atmosphere,
                      std::span<const WavelengthNode> wavelengths, std::span<const SkyPoint> points,
                      std::span<const Parameter> derivatives) const override;

 private:
  void check(const Atmosphere<double>& atmosphere, std::span<const SkyPoint> points,
             std::span<const Parameter> derivatives) const;
  ReferenceOptions options_;
};

}  // namespace skyfit
