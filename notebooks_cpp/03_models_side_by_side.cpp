// SPDX-License-Identifier: Apache-2.0
// %% [markdown]
// # The classical validation, twice
//
// Bruneton & Neyret (2008) and Bodare & Sandberg (2014, Fig. 25) validate their models in one
// figure: luminance over view zenith in the sun's vertical plane, nine suns, against the clear sky
// of the CIE. This notebook draws it for both with the values that were published, and again after
// Ceres has fitted each model to that sky. Then it asks what the agreement is worth.

// %%
#include <fmt/format.h>

#include <cmath>
#include <iostream>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <thread>

#include "data_refs/references.h"
#include "data_refs/spectra.h"
#include "data_refs/truth.h"
#include "fit/fit.h"
#include "fit/model_comparison.h"
#include "model/atmosphere/preset.h"
#include "model/registry.h"
#include "notebooks_cpp/notebook.h"
#include "render/plot/comparison.h"
#include "render/plot/evaluate.h"

using namespace skyfit;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kCone = 3 * kDegree;  // around the sun, where the CIE's formula means nothing

// Prints what was checked; a check that fails ends the notebook.
void check(bool holds, const std::string& what) {
  if (!holds) throw std::runtime_error("does not hold: " + what);
  std::cout << "holds: " << what << '\n';
}

const int kThreads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));

std::unique_ptr<SkyModel> model_named(std::string_view name) {
  return make_sky_model(name, refs::standard_spectral_data(), kThreads);
}

// %% [markdown]
// One figure: nine panels, the root mean square of the logarithmic error in each.

// %%
plot::Comparison figure_of(const std::string& title, const refs::Reference& reference,
                           const std::vector<std::pair<std::string, Atmosphere<double>>>& curves) {
  plot::Comparison figure;
  figure.title = title;
  figure.subtitle = "luminance scale free per sun position";
  figure.reference_label = reference.name;
  figure.exclude_sun_deg = kCone / kDegree;
  for (const auto& [name, atmosphere] : curves) {
    figure.curves.push_back(
        {name,
         plot::evaluated_samples(reference, atmosphere, refs::standard_spectral_data(),
                                 *model_named(name), kCone),
         {}});
  }
  return figure;
}

// %% [hidden]
void run_notebook(notebook::Page& page) {
  // %% [markdown]
  // ## With the published values
  //
  // Both papers take the aerosol coefficient $2.2\cdot10^{-5}\,\mathrm{m}^{-1}$, the single
  // scattering albedo 0.9 and $g = 0.73$; the preset `bodare-2014` holds them, with Bodare's ozone.

  // %%
  page.cell();
  std::vector<double> suns;
  for (int degrees = 0; degrees <= 80; degrees += 10) suns.push_back(degrees * kDegree);
  const refs::Reference cie = refs::load_reference("cie:12", suns, refs::Sampling::kPrincipalPlane);
  const Preset published = parse_preset(refs::shipped_preset_json("bodare-2014"), "bodare-2014");
  const plot::Comparison before =
      figure_of("The classical figure, published values", cie,
                {{"bruneton", published.atmosphere}, {"bodare", published.atmosphere}});
  plot::write_comparison(before, {page.scratch("published.png")});
  page.figure(page.scratch("published.png"));
  for (const plot::Curve& curve : before.curves)
    std::cout << fmt::format("{:<10}{:6.1f} % RMS log error over all suns\n", curve.label,
                             plot::rms_log_percent(curve.plane));

  // %% [markdown]
  // ## Fitted
  //
  // The same, one lobe: the aerosol's amount and $g$ are free. The derivatives are exact, through
  // every table and every order of scattering. Every step computes all tables anew, so both models
  // start from what the `reference`, which is a thousand times faster, finds from the defaults, and
  // take a few steps from there.

  // %%
  page.cell();
  fit::FitOptions options;
  options.lobes = 1;
  options.starts = 1;
  options.threads = 1;
  options.free = {Parameter::kMieScattering, Parameter::kMiePhaseG};
  options.start =
      fit::fit_atmosphere(cie, refs::standard_spectral_data(), *model_named("reference"), options)
          .preset;
  options.max_iterations = 4;
  std::vector<std::pair<std::string, Atmosphere<double>>> fitted;
  for (const std::string name : {"bruneton", "bodare"}) {
    const fit::Result result =
        fit::fit_atmosphere(cie, refs::standard_spectral_data(), *model_named(name), options);
    const Constituent<double>& mie = result.preset.atmosphere.at("mie");
    std::cout << fmt::format(
        "{:<10}{:6.2f} % (from {:.2f} %): optical depth {:.3f} at 550 nm, g {:.3f}, single "
        "scattering albedo {:.3f}\n",
        name, result.errors.rms_log, result.start_rms.all,
        mie.amount / mie.single_scattering_albedo * mie.profile.scale_height_m, mie.phase.g,
        mie.single_scattering_albedo);
    check(result.errors.rms_log < 15, "the fitted " + name + " is near the CIE's sky");
    fitted.emplace_back(name, result.preset.atmosphere);
  }
  plot::write_comparison(figure_of("The classical figure, fitted", cie, fitted),
                         {page.scratch("fitted.png")});
  page.figure(page.scratch("fitted.png"));

  // %% [markdown]
  // ## What that is worth
  //
  // Single scattering alone, refitted, comes as near to the CIE's sky: the shape of a luminance in
  // one plane, with a free scale per sun, does not need the second order. The tables of truth do.
  // They hold absolute radiances of atmospheres that are known in full, so that nothing is fitted.

  // %%
  page.cell();
  const auto all_free = [&](const std::string& name) {
    fit::FitOptions everything;
    everything.threads = kThreads;
    return fit::fit_atmosphere(cie, refs::standard_spectral_data(), *model_named(name), everything)
        .errors.rms_log;
  };
  const double multiple = all_free("reference"), single = all_free("oneil");
  std::cout << fmt::format(
      "all parameters free, two lobes: reference {:.2f} %, oneil (five samples, single scattering) "
      "{:.2f} %\n\n",
      multiple, single);
  check(single < multiple + 2, "single scattering comes as near to the CIE's sky");
  const std::string truth_name = "truth:earth-550nm-haze-ground";
  const refs::Reference truth = refs::truth_reference(truth_name);
  std::vector<fit::ModelComparison> rows;
  for (const std::string name : {"reference", "bruneton", "bodare", "schafhitzel"}) {
    rows.push_back(fit::compare_model(
        truth, refs::standard_spectral_data(),
        *make_sky_model(name, refs::standard_spectral_data(), kThreads, truth.transfer),
        refs::truth_preset(truth_name).atmosphere, kCone, nullptr));
  }
  std::cout << "against Monte Carlo in haze, nothing fitted\n"
               "model        RMS (%)   scale truth/model\n";
  for (const fit::ModelComparison& row : rows)
    std::cout << fmt::format("{:<12}{:8.2f}{:20.3f}\n", row.model, row.unfitted->rms_log_percent,
                             row.unfitted->scale);
  check(rows[0].unfitted->rms_log_percent < 1, "the reference is within 1 % of Monte Carlo");
  check(rows[3].unfitted->rms_log_percent > 10 * rows[1].unfitted->rms_log_percent,
        "truth tells single from multiple scattering, which the CIE does not");
}
