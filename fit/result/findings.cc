// SPDX-License-Identifier: Apache-2.0
#include "fit/result/findings.h"

#include "model/atmosphere/derived.h"

namespace skyfit::fit {

std::vector<Finding> findings(const Atmosphere<double>& atmosphere) {
  const double aerosol = aerosol_optical_depth(atmosphere);
  const double air = rayleigh_optical_depth(atmosphere);
  std::vector<Finding> found = {
      {"aerosol optical depth at 550 nm", "aerosol_optical_depth_550nm", aerosol, 0.03, 0.6,
       "Hess et al. 1998: continental clean 0.06, average 0.15, urban 0.6"},
      {"Rayleigh optical depth at 550 nm", "rayleigh_optical_depth_550nm", air, 0.06, 0.105,
       "Bodhaine et al. 1999: 0.097 at sea level, 0.06 at 4 km"},
      {"turbidity", "turbidity", (air + aerosol) / air, 1.3, 8,
       "Preetham et al. 1999: 2 very clear, 3 clear, 6 warm and moist"},
      {"ground albedo at 550 nm", "ground_albedo_550nm", atmosphere.ground_albedo, 0.03, 0.4,
       "grass 0.05 to 0.12, soil and sand to 0.4; snow, far above, to 0.99"},
  };
  if (const Constituent<double>* const main = main_aerosol(atmosphere)) {
    // Between the optical depths and the turbidity, and before the ground.
    found.insert(found.begin() + 2, {"Angstrom exponent of the scattering", "angstrom_exponent",
                                     angstrom_exponent(*main), 0, 2.3,
                                     "Dubovik et al. 2002: dust 0.1, urban and smoke to 2.3"});
    found.insert(
        found.end() - 1,
        {{"single scattering albedo at 550 nm", "single_scattering_albedo",
          single_scattering_albedo(*main), 0.82, 1, "Dubovik et al. 2002: 0.83 smoke to 0.98"},
         {"mean cosine of the phase function", "aerosol_mean_cosine", mean_cosine(main->phase),
          0.55, 0.8, "Andrews et al. 2006: 0.55 to 0.72; dust and sea salt to 0.8"}});
  }
  if (const Constituent<double>* const cloud = main_cloud(atmosphere)) {
    found.insert(found.end() - 1,
                 {{"cloud optical depth at 550 nm", "cloud_optical_depth_550nm",
                   cloud_optical_depth(atmosphere), 0.1, 100,
                   "Rossow & Schiffer 1999: thin cirrus below 3.6, deep convection above 23"},
                  {"mean cosine of the cloud's phase function", "cloud_mean_cosine",
                   mean_cosine(cloud->phase), 0.75, 0.88,
                   "Hu & Stamnes 1993: water droplets 0.85 to 0.87; ice crystals from 0.75"}});
  }
  return found;
}

}  // namespace skyfit::fit
