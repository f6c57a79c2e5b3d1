// SPDX-License-Identifier: Apache-2.0
// What a constituent of spherical particles is made of: one lognormal mode of radii and a
// refractive index. Everything that it does to light at a wavelength follows, see particles.h.
#pragma once

#include <memory>

#include "model/atmosphere/particles.h"
#include "model/atmosphere/refractive_index.h"
#include "model/numerics/dual.h"

namespace skyfit {

template <class T>
struct SizeDistribution {
  T radius_um{0.15};                                      // median of the volume
  T width{0.45};                                          // standard deviation of ln(radius)
  T index_real{1.45}, index_imaginary{0.005};             // where there is no
  std::shared_ptr<const RefractiveIndex> index_spectrum;  // by wavelength
  bool absorbs = true;                                    // false: in models without absorption
  std::shared_ptr<const ParticleTables> tables;           // what is kept of it; not null

  // Of what was computed nothing.
  bool operator==(const SizeDistribution& o) const {
    return radius_um == o.radius_um && width == o.width && index_real == o.index_real &&
           index_imaginary == o.index_imaginary && same_spectrum(*this, o) && absorbs == o.absorbs;
  }
};

// Whether both have the same index by wavelength, or none.
template <class T>
bool same_spectrum(const SizeDistribution<T>& a, const SizeDistribution<T>& b) {
  return a.index_spectrum == b.index_spectrum ||
         (a.index_spectrum && b.index_spectrum && *a.index_spectrum == *b.index_spectrum);
}

template <class T>
SizeDistribution<T> with_scalar(const SizeDistribution<double>& d) {
  return {T(d.radius_um),   T(d.width), T(d.index_real), T(d.index_imaginary),
          d.index_spectrum, d.absorbs,  d.tables};
}

inline bool has_slope(double) { return false; }
template <int N>
bool has_slope(const Dual<N>& x) {
  for (std::size_t i = 0; i < N; ++i) {
    if (x.d[i] != 0) return true;
  }
  return false;
}

template <class T>
std::shared_ptr<const ParticleOptics> optics_at(const SizeDistribution<T>& d,
                                                double wavelength_nm) {
  const std::complex<double> index =
      d.index_spectrum ? d.index_spectrum->at(wavelength_nm)
                       : std::complex<double>(value_of(d.index_real), value_of(d.index_imaginary));
  return d.tables->optics({wavelength_nm, value_of(d.radius_um), value_of(d.width), index},
                          has_slope(d.index_real) || has_slope(d.index_imaginary));
}

inline double with_slopes(const ParticleValue& value, const SizeDistribution<double>&) {
  return value[0];
}
template <int N>
Dual<N> with_slopes(const ParticleValue& value, const SizeDistribution<Dual<N>>& of) {
  Dual<N> result(value[0]);
  for (std::size_t i = 0; i < N; ++i) {
    result.d[i] = value[1] * of.radius_um.d[i] + value[2] * of.width.d[i] +
                  value[3] * of.index_real.d[i] + value[4] * of.index_imaginary.d[i];
  }
  return result;
}

}  // namespace skyfit
