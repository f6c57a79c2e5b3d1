// SPDX-License-Identifier: Apache-2.0
// The report of a fit as one page for a browser: HTML 5, dark where the reader's system is, for
// paper too, without anything from a network.
#pragma once

#include <span>
#include <string>

#include "fit/result/result.h"
#include "fit/uncertainty/checks.h"

namespace skyfit::fit {

struct ReportFigure {
  std::string title;
  std::string svg;  // a document
};

// UTF-8. `live_sky`: the file beside the report that shows the fitted sky (render/page/), which the
// report links; may be empty. Throws std::runtime_error with one line for a figure that is no SVG.
std::string html_report(const Result& result, const Checks& checks,
                        std::span<const ReportFigure> figures, const std::string& live_sky = {});

}  // namespace skyfit::fit
