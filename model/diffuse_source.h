// SPDX-License-Identifier: Apache-2.0
// The source of multiple scattering as a table: light that has been scattered or reflected before
// and is scattered here toward the eye, per unit of scattering coefficient (1/sr), of the air and
// of the aerosol, at the four nodes of a colour rule. From the diffuse field of
// model/diffuse_field.h.
#pragma once

#include <array>
#include <vector>

#include "model/diffuse_field.h"

namespace skyfit {

using NodeOptics = std::array<Optics<0>, 4>;

// How many Legendre moments the phase functions keep; optics_at() wants to know.
inline constexpr int kSourceMoments = 32;

class DiffuseSource {
 public:
  DiffuseSource(const Shells& shells, const NodeOptics& optics);

  // The source at one place and view direction for all suns and azimuths, with a factor per node
  // for air and aerosol.
  class Slice {
   public:
    // Adds the source times the factors for a local sun and azimuth between sun and view (cosine)
    // to sum[0..3].
    void add(double mu_s, double cos_azimuth, float* sum) const;

   private:
    friend class DiffuseSource;
    const DiffuseSource* source_ = nullptr;
    std::vector<float> value_;  // [sun][azimuth][node]
  };

  // mu is that of the view ray. Factors: scattering coefficients times what the path does to the
  // light.
  void slice(double height, double mu, const std::array<double, 4>& air,
             const std::array<double, 4>& aerosol, Slice& out) const;

 private:
  struct Stencil {
    int first;
    std::array<float, 4> weight;
  };
  void tabulate(const Optics<0>& optics, const DiffuseField& field, std::size_t node);
  std::size_t index(int level, int mu) const;

  Shells shells_;
  std::vector<double> sun_mu_;        // descending cosines of the suns that the field is solved for
  std::vector<Stencil> stencils_;     // of sun_mu_, at even steps of mu_s from the lowest to 1
  std::vector<float> air_, aerosol_;  // [level][mu][sun][azimuth][node]
};

}  // namespace skyfit
