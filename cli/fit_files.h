// SPDX-License-Identifier: Apache-2.0
// The directory that `skyfit fit` leaves, which `skyfit report` and `skyfit plot` read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/output.h"
#include "fit/result/report.h"
#include "fit/result/report_html.h"
#include "model/sky_model.h"
#include "render/plot/measured_result.h"

namespace skyfit::cli {

struct FinishedFit {
  fit::Result result;
  fit::Checks checks;
};

// The files of a result, and nothing else.
std::vector<std::string> fit_files();

void write_fit(const std::filesystem::path& directory, const FinishedFit& finished,
               const SkyModel& model, Figures& figures);

// All but the values per sample. Throws std::runtime_error or std::invalid_argument with one line
// that names the file and what was expected.
FinishedFit read_fit(const std::filesystem::path& directory);

// Whether the figures of measured skies show it: everything but a relative luminance.
bool has_absolute_values(const fit::Result& result);
// Whether some of them do: also of irradiances beside a relative luminance.
bool has_measured_figures(const fit::Result& result);

// What those figures show, with the samples of a directory that was read: of a relative luminance
// nothing but the irradiances beside it.
plot::MeasuredOutcome measured_outcome(const fit::Result& result,
                                       const std::vector<plot::Sample>& samples);
plot::MeasuredOutcome read_measured_outcome(const std::filesystem::path& directory);

// The figures of a directory that was read, drawn anew: of a stranger's only numbers are taken.
std::vector<fit::ReportFigure> report_figures(const std::filesystem::path& directory,
                                              const fit::Result& result, int threads);

}  // namespace skyfit::cli
