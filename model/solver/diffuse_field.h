// SPDX-License-Identifier: Apache-2.0
// The diffuse field of the atmosphere for a list of local sun angles, in spherical shells: rays are
// straight lines through them, the horizon dips with height, the sun's beam is that of each level.
// Azimuth is a Fourier series, zenith a set of streams (model/solver/streams.h), each mode is
// solved directly (model/solver/fourier_modes.h). At first the sun turns with the local zenith, as
// if the sky were the same everywhere on the planet; horizontal coupling then adds the light of
// columns under another sun, which couples modes and suns, in steps of an iteration, for the
// suns for which it matters (docs/theory, chapter 7). The field's Legendre moments are the source
// of multiple scattering; the caller integrates it along view rays at the local sun.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "model/solver/level_grid.h"
#include "model/solver/rayleigh_stokes.h"
#include "model/solver/stream_light.h"
#include "model/solver/streams.h"
#include "model/solver/sun_grid.h"

namespace skyfit {

// Layout of a field: for each mode m, [level][l - m][sun][slice], slice fastest; slice 0 is the
// value, slice 1 + p the derivative by parameter p. The modes 0 to 2 of a polarised field have one
// more row after the moments of I: the second moment P of Q and U, docs/theory (13.6). Last, where
// the particles' matrices are taken, come the rows b_l and then c_l, l >= 2 (model/solver/
// spin_basis.h).
struct FieldShape {
  int levels = 0, moments = 0, suns = 0, slices = 0;
  bool polarised = false, matrices = false;
  bool polarised_mode(int m) const { return polarised && m < kPolarisedModes; }
  int spin_rows(int m) const { return matrices ? moments - std::max(m, 2) : 0; }  // of b and of c
  std::size_t rows(int m) const {
    return static_cast<std::size_t>(moments - m + (polarised_mode(m) ? 1 : 0) + 2 * spin_rows(m));
  }
  std::size_t row() const { return static_cast<std::size_t>(slices) * suns; }
  std::size_t level(int m) const { return row() * rows(m); }
};

struct DiffuseField {
  FieldShape shape;
  // moments[m] holds 2 pi integral Lambda_lm I_m dmu, I = sum_m (2 - delta_m0) I_m cos m phi, mu
  // and phi those of the direction in which one looks; one entry per mode that matters.
  std::vector<LargeArray> moments;
  LargeArray ground_irradiance;  // diffuse, on the ground, [sun][slice]
};

// What fields are solved for: how fine they are and how far suns are coupled.
enum class FieldsOf {
  kDay,
  kLowSuns,       // more than 80 deg from the eye's zenith, in an extended atmosphere
  kDeepTwilight,  // more than 94 deg from a zenith along the ray
};

struct DiffuseOptions {
  int moments = 16;  // of the phase functions, as many as the optics keep
  // A mode is left out when a bound on what it adds to the field is below this share of mode 0.
  double tolerance = 3e-3;
  // 0: the whole field. k > 0: only the light that met air or ground k times (values only).
  int order = 0;
  // Couples the suns in as many steps as a deep twilight takes, whose light all comes from far
  // places; in two where that does not converge.
  bool deep_twilight = false;
  int shifted_modes = 6;        // those of the coupling, if any shifts
  bool polarised = true;        // with P of the light that air polarises
  int levels = kDefaultLevels;  // LevelGrid::asked()
};

// How finely a field is solved, where that of a thin atmosphere's day has so many levels and the
// fewest rays along the limb. In deep twilight light of one layer comes from places under suns that
// stand degrees apart; of an extended atmosphere, that of Mars or Titan, at every hour.
struct FieldGrid {
  int levels;
  LimbRays limb_rays;
};
FieldGrid field_grid(const Shells& shells, int levels_by_day, bool deep_twilight);

// Whether its top is above 0.02 of the planet's radius, as on Mars and Titan.
bool is_extended(const Shells& shells);

// The first sun of the grid that has light from neighbouring places under their own sun. On a
// planet whose atmosphere is thin against its radius, as the Earth's, that matters for low suns
// only (below 0.15 % of the radiance to 80 deg, 0.7 % to 85 deg).
int first_coupled_sun(const SunGrid& grid, const Shells& shells);

// The coupling of the suns of `grid` that are solved (solved[i] >= 0 is the place of grid node i
// among them), from the node `first` on; it and those after it, and the two before it, must be
// solved.
HorizontalCoupling sun_coupling(const SunGrid& grid, const Shells& shells,
                                const std::vector<int>& solved, const Streams& streams, int first,
                                int shifted_modes);

// The fields of several wavelengths, in parallel over wavelengths and modes on the calling arena's
// threads; results do not depend on their number.
template <int N>
std::vector<DiffuseField> solve_diffuse_fields(
    const Shells& shells, std::span<const Optics<N>> optics, int slices,
    const std::vector<double>& heights, const std::vector<double>& sun_mu, const Streams& streams,
    const HorizontalCoupling& coupling, const DiffuseOptions& options);

// Lambda_lm = sqrt((2 l + 1) / (4 pi) (l - m)! / (l + m)!) P_lm for l = m .. count - 1, written to
// out[0 .. count - m), so that a phase function with moments chi_l is
//   P(v . w) = sum_m (2 - delta_m0) cos m(phi_v - phi_w) sum_l chi_l Lambda_lm(mu_v)
//   Lambda_lm(mu_w).
void normalised_legendre(int m, int count, double mu, double* out);

}  // namespace skyfit
