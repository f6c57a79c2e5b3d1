// SPDX-License-Identifier: Apache-2.0
// The one interface of every sky model: an atmosphere, suns and view directions go in; radiance per
// unit solar irradiance comes out, with exact derivatives when asked.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "model/atmosphere/atmosphere.h"
#include "model/atmosphere/parameters.h"
#include "model/geometry/sky_point.h"
#include "model/irradiance.h"
#include "model/photometry/photometry.h"
#include "model/tables/sky_rays.h"
#include "model/transfer.h"

namespace skyfit {

// Values [point][wavelength] and derivatives [parameter][point][wavelength], row major.
struct SkyValues {
  int points = 0, wavelengths = 0, parameters = 0;
  std::vector<double> value;
  std::vector<double> derivative;
  double at(int point, int wavelength) const { return value[point * wavelengths + wavelength]; }
  double derivative_at(int parameter, int point, int wavelength) const {
    return derivative[(static_cast<std::size_t>(parameter) * points + point) * wavelengths +
                      wavelength];
  }
};

// Stokes parameters, each as the radiance of SkyModel::radiance(), per unit unpolarised solar
// irradiance (1/sr). The reference plane is the meridian plane of the view, which holds the line of
// sight and the local vertical. Q > 0: polarised along it; U > 0: along the direction half-way
// between up and right as the observer sees them, clockwise from up (the IAU counts U the other
// way). Relative azimuths count counter-clockwise from above, view less sun. Air and lobes make no
// circular polarisation, V = 0.
struct StokesValues {
  SkyValues i, q, u;
};

// Radiances [point][wavelength] of light that air, or the aerosol, scattered last, 1/sr.
struct ScatteredLight {
  std::vector<double> air, aerosol;
};

class SkyModel {
 public:
  virtual ~SkyModel() = default;
  virtual std::string_view name() const = 0;
  // The models of the literature know no polarisation.
  virtual Transfer transfer() const { return Transfer::kScalar; }
  // Whether rays are curved: view angles are then the apparent ones, suns the true ones.
  virtual bool refracts() const { return false; }

  // Diffuse radiance per unit solar irradiance (1/sr): scattered light and light reflected by the
  // ground, the sun's disc not. `derivatives` lists the parameters to differentiate by; their order
  // is that of SkyValues::derivative. Throws std::invalid_argument for an atmosphere that
  // validate() refuses or a point the model cannot do.
  virtual SkyValues radiance(const Atmosphere<double>& atmosphere,
                             std::span<const WavelengthNode> wavelengths,
                             std::span<const SkyPoint> points,
                             std::span<const Parameter> derivatives) const = 0;

  // Whether stokes() gives them.
  virtual bool gives_stokes() const { return false; }

  // radiance() with its polarisation, docs/theory (13.14). Throws std::invalid_argument unless
  // gives_stokes(), else as radiance() does.
  virtual StokesValues stokes(const Atmosphere<double>& atmosphere,
                              std::span<const WavelengthNode> wavelengths,
                              std::span<const SkyPoint> points,
                              std::span<const Parameter> derivatives) const;

  // The values of Irradiance, in its order, as the points of SkyValues, per unit solar irradiance
  // at the top of the atmosphere (pure numbers): the integral of radiance()
  // over the sky, and the sun's beam behind the whole of the atmosphere's optical depth, which no
  // model approximates. Throws as radiance() does.
  SkyValues irradiance(const Atmosphere<double>& atmosphere,
                       std::span<const WavelengthNode> wavelengths, double altitude_m,
                       double sun_zenith, std::span<const Parameter> derivatives) const;

  // The light of whole view rays without that which comes straight from the ground: what a renderer
  // tabulates; of models with tables after prepare() with the same. Throws as radiance() does, and
  // std::invalid_argument by a model that does not part the two or does not know every height and
  // sun.
  virtual ScatteredLight scattered_light(const Atmosphere<double>& atmosphere,
                                         std::span<const WavelengthNode> wavelengths,
                                         std::span<const SkyPoint> points) const;

  // The model's own tables of rays to the sky, at the four nodes of a colour rule, after prepare()
  // with the same; empty by a model that has none. Throws as radiance() does.
  virtual std::optional<SkyRayTables> sky_rays(const Atmosphere<double>&,
                                               std::span<const WavelengthNode, 4>) const {
    return {};
  }

  // The effective atmosphere: without what the model leaves out.
  virtual Atmosphere<double> effective_atmosphere(const Atmosphere<double>& atmosphere) const {
    return atmosphere;
  }

  // Whether a sky can tell the parameter by this model: radiance() depends on it, and not only
  // together with others. A fit leaves the rest as it is.
  virtual bool can_fit(const Parameter&) const { return true; }

  // How many lobes of a phase function a fit can tell apart: 1 or 2.
  virtual int lobes() const { return 2; }

  // Computes the model's tables for an atmosphere and keeps those that were asked for last, so that
  // radiance() with the same only looks them up. Returns their size in bytes; 0 for a model without
  // tables, which has nothing to prepare. Throws as radiance() does.
  virtual std::size_t prepare(const Atmosphere<double>& atmosphere,
                              std::span<const WavelengthNode> wavelengths) const;
};

// For the models: throws std::invalid_argument "MODEL model: NAME = VALUE: must be EXPECTED" unless
// `good`; the same for a point that no model can do.
void check_model_value(std::string_view model, bool good, std::string_view name, double value,
                       std::string_view expected);
void check_point(std::string_view model, const SkyPoint& point);

// For the models: throws std::invalid_argument unless the atmosphere has the parameter.
void check_derivative(std::string_view model, const Atmosphere<double>& atmosphere,
                      const Parameter& parameter);

// Appends the derivatives of the same values by further parameters.
inline void append_derivatives(SkyValues& to, const SkyValues& more) {
  to.derivative.insert(to.derivative.end(), more.derivative.begin(), more.derivative.end());
  to.parameters += more.parameters;
}
inline void append_derivatives(std::vector<SkyValues>& to, const std::vector<SkyValues>& more) {
  for (std::size_t i = 0; i < to.size(); ++i) append_derivatives(to[i], more[i]);
}

// Calls of_batch(parameters) -> SkyValues, or a list of them, for at most `kBatch` of the
// derivatives at a time and puts the results together; at least one call.
template <std::size_t kBatch, class OfBatch>
auto in_batches(std::span<const Parameter> derivatives, const OfBatch& of_batch) {
  auto all = of_batch(derivatives.first(std::min(kBatch, derivatives.size())));
  for (std::size_t first = kBatch; first < derivatives.size(); first += kBatch) {
    append_derivatives(
        all, of_batch(derivatives.subspan(first, std::min(kBatch, derivatives.size() - first))));
  }
  return all;
}

}  // namespace skyfit
