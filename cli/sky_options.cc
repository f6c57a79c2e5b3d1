// SPDX-License-Identifier: Apache-2.0
#include "cli/sky_options.h"

#include <fmt/format.h>

namespace skyfit::cli {

void add_sky_options(CLI::App& command, SkyOptions& options) {
  command.add_option("--preset", options.preset, "Shipped preset or preset file")
      ->required()
      ->type_name("FILE|NAME");
  add_site_pressure_option(command, options.site_pressure);
  command.add_option("--model", options.model, "Sky model")
      ->type_name("NAME")
      ->capture_default_str();
  command.add_option("--sun-zenith-deg", options.sun_zenith, "Sun zenith angles, 0 to 180")
      ->required()
      ->type_name("LIST");
  command
      .add_option("--view-zenith-deg", options.view_zenith,
                  "View zenith angles, 0 to 180; over 90 looks down")
      ->type_name("LIST");
  command
      .add_option("--azimuth-deg", options.azimuth,
                  "View azimuths relative to the sun's, -360 to 360; 0 = toward it")
      ->type_name("LIST")
      ->capture_default_str();
  command.add_option("--altitude-m", options.altitude, "Heights of the observer above the ground")
      ->type_name("LIST")
      ->capture_default_str();
  command
      .add_option("--wavelength-nm", options.wavelength,
                  "Print radiance per unit solar irradiance (1/sr) at these wavelengths")
      ->type_name("LIST");
  auto* const luminance =
      command.add_flag("--luminance", options.luminance, "Print luminance in cd/m^2 (the default)");
  auto* const color =
      command
          .add_flag("--color", options.color,
                    "Print CIE 1931 XYZ (Y is luminance) and linear sRGB (primaries of\n"
                    "IEC 61966-2-1; white D65 of luminance L is R = G = B = L; negative\n"
                    "outside its gamut), all in cd/m^2")
          ->excludes(luminance);
  auto* const irradiance =
      command
          .add_flag("--irradiance", options.irradiance,
                    "Print direct, diffuse and global irradiance (no view directions): lx,\n"
                    "or W m^-2 nm^-1 with --wavelength-nm")
          ->excludes(luminance)
          ->excludes(color);
  auto* const sigma =
      command.add_flag("--sigma", options.sigma,
                       "Print one standard deviation after each value, from the covariance of a\n"
                       "fitted preset");
  auto* const stokes =
      command
          .add_flag("--stokes", options.stokes,
                    "Print radiance, Q, U, degree and angle of linear polarisation at\n"
                    "--wavelength-nm")
          ->excludes(luminance)
          ->excludes(color)
          ->excludes(irradiance)
          ->excludes(sigma);
  add_iau_option(command, options.iau, stokes);
  auto* const refraction = add_refraction_option(command, options.refraction);
  command
      .add_flag("--apparent-sun", options.apparent_sun,
                "The sun zenith angles are those at which the sun is seen")
      ->needs(refraction);
  add_scalar_option(command, options.scalar);
  command
      .add_option(
          "--orders", options.orders,
          fmt::format("Print the orders of scattering 1 to N, N <= {}, after each value, and\n"
                      "what is left",
                      kMaxOrders))
      ->type_name("N")
      ->check(CLI::Range(1, kMaxOrders).description(""))
      ->excludes(color)
      ->excludes(irradiance)
      ->excludes(sigma)
      ->excludes(stokes);
  add_netcdf_option(command, options.netcdf, "Write, in place of the CSV, the table");
  command
      .add_option(
          "--npz", options.npz,
          "Write, in place of the CSV, the table for numpy.load(): each list and each column "
          "by its name")
      ->type_name("FILE.npz");
  add_threads_option(command, options.threads);
  command.footer(
      "Prints every combination of the lists. A LIST is a,b,c or "
      "start:stop:step, stop included.\n"
      "Values are those of diffuse light, with what the ground reflects and without the sun's "
      "disc,\n"
      "under the preset's star.\n"
      "\n"
      "--sigma is sqrt(J C J'), J the exact derivatives by the fitted parameters and C the\n"
      "covariance in the preset. Parameters that were fixed or at a bound contribute nothing, nor\n"
      "does the luminance scale, which a fit to relative luminances leaves free.\n"
      "\n"
      "--orders N splits the value, in its unit: order_k is light that met air or ground exactly "
      "k\n"
      "times (order 1 is single scattering, and the ground under the sun's beam), order_higher "
      "the\n"
      "value less those. Light in the forward peak of an aerosol that 16 moments cannot resolve\n"
      "counts as light that was not scattered. For zenith angles of the sun above 86 deg single\n"
      "orders leave out the horizontal coupling (docs/theory), so that order_higher holds the\n"
      "difference and may be negative.\n"
      "\n"
      "--stokes prints Q and U in the unit of the radiance I, in the meridian plane of the view, "
      "which\n"
      "holds the line of sight and the zenith: Q > 0 is light polarised along that plane, U > 0 "
      "along\n"
      "the direction half-way between up and right as the observer sees them. The angle of linear\n"
      "polarisation counts clockwise from up; --iau changes the sign of U and of the angle. "
      "Azimuths\n"
      "count counter-clockwise from above, view less sun. Coulson's and Natraj's tables hold -Q "
      "and\n"
      "-U. Air polarises, and particles of a size distribution; what any other aerosol scattered\n"
      "last counts as unpolarised, and V is 0.\n"
      "\n"
      "Examples:\n"
      "  skyfit sky --preset earth-clear --sun-zenith-deg 30 --view-zenith-deg 0:85:5 "
      "--azimuth-deg 0,180\n"
      "  skyfit sky --preset fitted/preset.json --sun-zenith-deg 0:80:10 --irradiance --sigma\n"
      "  skyfit sky --preset earth-clear --sun-zenith-deg 88 --view-zenith-deg 85 --color\n"
      "  skyfit sky --preset earth-clear --sun-zenith-deg 80 --view-zenith-deg 0 --wavelength-nm "
      "450 --stokes\n"
      "  skyfit sky --preset earth-clear --sun-zenith-deg 60 --view-zenith-deg 0:85:5 --orders 4");
}

}  // namespace skyfit::cli
