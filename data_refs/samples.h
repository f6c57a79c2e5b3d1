// SPDX-License-Identifier: Apache-2.0
// A sample is a sample: a CIE curve point, a Tregenza patch, a line of a CSV become the same
// struct.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "data_refs/solar_position.h"
#include "model/irradiance.h"
#include "model/transfer.h"

namespace skyfit::refs {

enum class Quantity {
  kLuminance,          // cd/m^2
  kRelativeLuminance,  // up to a factor per sun position
  kSpectralRadiance,   // W m^-2 sr^-1 nm^-1, at Sample::wavelength_nm
  kIlluminance,        // lx
  kIrradiance          // W m^-2 of all wavelengths
};

// Whether the samples are the light of a whole hemisphere or of the sun's beam: they have an
// Irradiance and no line of sight.
constexpr bool is_irradiance(Quantity quantity) {
  return quantity == Quantity::kIlluminance || quantity == Quantity::kIrradiance;
}

// What a polarimeter reads beside the radiance, a pure number: Q / I and U / I in the meridian
// plane of the view as StokesValues has them (model/sky_model.h), or the degree of linear
// polarisation.
enum class Polarisation { kQ, kU, kDegree };
struct PolarisationReading {
  Polarisation what;
  double value;                 // -1 .. 1, a degree 0 .. 1
  std::optional<double> sigma;  // one standard deviation
};

// Angles in radians; azimuth 0 looks toward the sun's azimuth. Of an irradiance the view is the
// normal of the surface that the light falls on.
struct Sample {
  double sun_zenith = 0;
  double view_zenith = 0;
  double relative_azimuth = 0;
  double wavelength_nm = 0;        // > 0 for a spectral radiance, 0 for the others
  double value = 0;                // in the unit of the reference's quantity; > 0 where it weighs
  std::optional<double> sigma;     // one standard deviation, same unit as value
  double weight = 1;               // >= 0
  std::string zero_weight_reason;  // why weight == 0; empty otherwise
  int scan = 0;                    // samples of one scan share one sun position's luminance scale
  // How far the sun has gone since the scan's begin, radians clockwise, where a scan takes minutes.
  double sun_azimuth_since = 0;
  std::vector<PolarisationReading> polarisation = {};  // of the same light; at most one of each
  int direction = 0;  // its number in a measured scan; many wavelengths share one
  std::optional<Irradiance> irradiance = {};  // which, where the quantity is one
};

// What is known of one scan beside its samples. Instants in UTC.
struct Scan {
  std::string name;                   // the file, or "sun zenith 30 deg"
  std::string time_utc;               // "2013-05-27T13:30:00Z"; empty: not known
  std::optional<double> sun_azimuth;  // radians clockwise from north, of the begin
  double sun_distance_au = 1;         // of the time; 1 where the time is not known
  std::optional<double> elevation_m;  // of the site above the sea
  std::optional<Site> site = {};      // that the sun was computed for
  // The vertical column of water vapour, > 0: an irradiance of all wavelengths depends on it.
  std::optional<double> precipitable_water_mm = {};
};

struct Reference {
  std::string name;         // "cie:12", or the file
  std::string description;  // one line, with the source
  Quantity quantity = Quantity::kRelativeLuminance;
  std::vector<Sample> samples;
  std::vector<Scan> scans;  // indexed by Sample::scan; empty when nothing is known of them
  // What the values were computed with: a model is compared under the same. Nature's is the vector.
  Transfer transfer = Transfer::kVector;
  std::vector<std::string> notes;  // what the reader of a measured sky concluded or left out
  // Of the samples with an Irradiance that stand beside those of a sky (joint_reference.h).
  std::optional<Quantity> irradiance_quantity = {};
};

// Whether it is an irradiance among the samples of a sky.
bool is_beside_sky(const Reference& reference, const Sample& sample);

Quantity quantity_of(const Reference& reference, const Sample& sample);

// Whether the values are luminances, or radiances of so many wavelengths that these sum up to
// luminances of the same sky: from 450 to 660 nm no step is longer than 41 nm.
bool gives_luminance(const Reference& reference);

// How many samples have weight 0, by the reason.
std::map<std::string, int> samples_left_out(const Reference& reference);

// Angle between the view ray and the direction to the sun, radians.
double scattering_angle(const Sample& sample);

// What samples of one direction of a scan share while the sun moves: the scan, view zenith minus
// sun zenith and relative azimuth, in 1e-9 radians; and which irradiance it is, -1 where it is
// none.
using DirectionFromSun = std::tuple<int, long long, long long, int>;
DirectionFromSun direction_from_sun(const Sample& sample);

}  // namespace skyfit::refs
