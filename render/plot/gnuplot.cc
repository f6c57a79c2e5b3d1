// SPDX-License-Identifier: Apache-2.0
#include "render/plot/gnuplot.h"

#include <fmt/format.h>

#include <cstdlib>
#include <stdexcept>

#include "model/base/process.h"
#include "model/base/text.h"

namespace skyfit::plot {
namespace {

// gnuplot prints the offending line, a caret and then the reason: the last line that says something
// is the reason.
std::string last_message(std::string_view output) {
  std::string_view message = "no message";
  for (const std::string_view line : split(output, '\n'))
    if (!trim(line).empty()) message = trim(line);
  return excerpt(message);
}

}  // namespace

std::string gnuplot_quoted(std::string_view text) {
  constexpr std::string_view kPlain =
      " ,.:+-0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
  std::string result = "\"";
  for (const char c : printable(text)) {
    const auto code = static_cast<unsigned char>(c);
    if (code >= 0x80 || kPlain.find(c) != kPlain.npos) {
      result += c;
    } else {
      result += fmt::format("\\{:03o}", code);
    }
  }
  return result + '"';
}

void run_gnuplot(const std::string& script, const std::filesystem::path& folder) {
  const char* const chosen = std::getenv("SKYFIT_GNUPLOT");
  const std::string name = chosen != nullptr ? chosen : "gnuplot";
  const auto program = program_in_path(name);
  if (!program)
    throw std::runtime_error(
        fmt::format("{}: no such program; figures need gnuplot 5.4 (package gnuplot-nox)", name));
  const Outcome outcome = run({*program, {"-d"}, script, folder});
  if (!outcome.succeeded())
    throw std::runtime_error(
        fmt::format("{}: {}: {}", name, outcome.ending(), last_message(outcome.output)));
}

}  // namespace skyfit::plot
