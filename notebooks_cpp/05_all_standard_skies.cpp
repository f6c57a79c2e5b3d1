// SPDX-License-Identifier: Apache-2.0
// %% [markdown]
// # Which standard skies can an atmosphere be?
//
// The CIE (S 011/E:2003) describes fifteen skies by a formula: from overcast over partly cloudy to
// clear. Each is a luminance as a function of the direction and of the sun, nothing more. This
// notebook asks of each whether there is an atmosphere, the same in all horizontal directions and
// made of particles that exist, whose sky it is, for a sun at any height.
//
// Every cell below is compiled and executed C++; what it printed stands under it.

// %%
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>
#include <numbers>
#include <stdexcept>
#include <thread>

#include "cli/fit_standard_skies.h"
#include "data_refs/cie_sky.h"
#include "data_refs/references.h"
#include "data_refs/spectra.h"
#include "fit/fit.h"
#include "fit/standard_sky.h"
#include "fit/standard_sky_table.h"
#include "model/registry.h"
#include "model/sky_model.h"
#include "notebooks_cpp/notebook.h"
#include "render/plot/figure_file.h"

using namespace skyfit;

constexpr double kDegree = std::numbers::pi / 180;

// Prints what was checked; a check that fails ends the notebook.
void check(bool holds, const std::string& what) {
  if (!holds) throw std::runtime_error("does not hold: " + what);
  std::cout << "holds: " << what << '\n';
}

// %% [hidden]
void run_notebook(notebook::Page& page) {
  // %% [markdown]
  // ## What may be in the air
  //
  // Air alone is blue and bright at the horizon. Aerosol gives a clear sky its aureole. An overcast
  // sky is bright at the zenith and dark at the horizon, and does not know where the sun is: no
  // aerosol does that, unless it scatters backward, which none does. A cloud does it: a layer of
  // droplets that absorb nothing and scatter forward (mean cosine 0.86), so thick that light
  // forgets where it came from. So three kinds of atmosphere are fitted, each within bounds of what
  // exists.

  // %%
  page.cell();
  for (const fit::StandardSkyKind& kind : fit::standard_sky_kinds()) {
    std::cout << fmt::format("{}: {}; types {}\n", kind.name, kind.meaning,
                             fmt::join(kind.types, ", "));
    for (const auto& [parameter, bounds] : kind.free)
      std::cout << fmt::format("    {} {} to {} {}\n", parameter.name(), bounds.lower, bounds.upper,
                               parameter_info(parameter).unit == "1"
                                   ? std::string_view()
                                   : parameter_info(parameter).unit);
  }

  // %% [markdown]
  // ## Fifteen fits
  //
  // One fit for each type, of nine suns together, in the vertical plane of the sun, with a free
  // luminance scale per sun. The light is taken without polarisation here, which
  // under a cloud changes nothing and saves a quarter of the time.

  // %%
  page.cell();
  const int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const SpectralData& spectra = refs::standard_spectral_data();
  const std::unique_ptr<SkyModel> model =
      make_sky_model("reference", spectra, threads, Transfer::kScalar);
  std::vector<double> suns;
  for (int degrees = 0; degrees <= 80; degrees += 10) suns.push_back(degrees * kDegree);
  std::vector<fit::StandardSkyFit> fits;
  for (const refs::CieSky& sky : refs::cie_skies()) {
    const fit::StandardSkyKind& kind = fit::standard_sky_kind(sky.type, *model);
    const refs::Reference reference = refs::load_reference(fmt::format("cie:{}", sky.type), suns,
                                                           refs::Sampling::kPrincipalPlane);
    fit::FitOptions options;
    options.threads = threads;
    fits.push_back({sky.type, kind.name,
                    fit::fit_atmosphere(reference, spectra, *model,
                                        fit::with_standard_sky(options, kind, *model))});
  }
  plot::write_figure(cli::standard_skies_figure(fits), {page.scratch("skies.png")});
  page.figure(page.scratch("skies.png"));

  // %% [markdown]
  // ## The answer
  //
  // The table, what was found, and sentences, all made from these fits.

  // %%
  page.cell();
  std::cout << fit::standard_skies_text(fits);

  // %% [markdown]
  // The dark rows of the figure are the skies that an atmosphere can be: the overcast and uniform
  // ones are thick clouds, the clear ones are air with aerosol. Between them lie skies that are
  // neither. They brighten toward the sun as clear air does, and are as flat or as dark at the
  // horizon as under a cloud. Where the sun is high a thin cloud or a thick haze can do both. Under
  // a low sun it cannot, because the light then passes ten times the vertical optical depth: the
  // brightening toward the sun is lost, while the formula, which knows only angles, keeps it. Real
  // skies of these types are broken clouds, which no uniform layer is.

  // %%
  page.cell();
  const auto percent = [&](int type) {
    return fits[static_cast<std::size_t>(type - 1)].result.errors.rms_log;
  };
  for (const int type : {1, 3, 5, 9, 10, 11, 12, 13, 14})
    check(percent(type) < fit::kSameSkyPercent, fmt::format("type {} is a sky of ours", type));
  for (const int type : {2, 4, 6, 7, 8, 15}) {
    const auto& scans = fits[static_cast<std::size_t>(type - 1)].result.scans;
    check(percent(type) > fit::kSameSkyPercent && scans.back().errors.rms_log > 1.2 * percent(type),
          fmt::format("type {} is not, and the sun at 80 deg is worse than all together", type));
  }

  // %% [markdown]
  // ## Limits
  //
  // The CIE skies are formulas: agreement says that an atmosphere can take their shape. On the
  // command line all of this is `skyfit fit --reference cie:all --out DIR`.

  // %% [hidden]
}
