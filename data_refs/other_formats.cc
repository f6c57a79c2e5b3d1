// SPDX-License-Identifier: Apache-2.0
#include "data_refs/other_formats.h"

#include <algorithm>
#include <array>
#include <regex>

#include "data_refs/scan_header.h"
#include "model/base/text.h"

namespace skyfit::refs {
namespace {

constexpr std::string_view kBlanks = " \t\r\n\v\f";

struct OtherFormat {
  std::string_view pattern;  // in the head of the text, without case
  std::string_view what;     // "is .., skyfit .."
};

// The first that matches; a line of columns of AERONET tells the product.
constexpr std::array<OtherFormat, 13> kFormats = {{
    {R"(krochmann)",
     "is a scan of a PRC Krochmann sky scanner, whose layout is not public; skyfit reads its 145 "
     "luminances alone, or columns of directions and luminances that a sidecar names"},
    {R"(:\s*iy im id ihh)",
     "is a file .DT3 to .DT5 of SKYRAD.pack; skyfit reads the file .dat of the sky radiometer that "
     "it was made of"},
    {R"(^\s*\d\d:\d\d:\d\d[ ,][hv][ ,]\d)",
     "is a file of a sky radiometer POM-01L, which does not say its directions; skyfit reads files "
     ".dat of a POM-01 or POM-02"},
    {R"(single_scattering_albedo\[|refractive_index|inversion|retrievals, version|ssa\d+-t)",
     "is an inversion of AERONET; skyfit reads the sky radiances that it came from, and takes it "
     "as "
     "a prior by fit --aeronet-inversion"},
    {R"(aod_\d+nm|aot_\d+|[,_]aod_)",
     "is aerosol optical depths of AERONET; skyfit reads AERONET's sky radiances, and takes these "
     "as "
     "a prior by fit --aeronet-aod"},
    {R"(^location,[^\n]*\n\s*design conditions)",
     "is an EnergyPlus weather file (EPW), which holds irradiances; skyfit reads skies with "
     "directions, and an hour of such a file as perez:FILE@YYYY-MM-DDTHH:MM or by "
     "fit --irradiance FILE@YYYY-MM-DDTHH:MM"},
    {R"(^\s*(#\?radiance[^\n]*\n)?(#[^\n]*\n|\s*\n)*\s*(void\s+(light|glow|brightfunc|plastic)\s|!\s*gen))",
     "is a scene of Radiance, such as gendaylit and gensky write; skyfit reads the sky of one with "
     "perezlum.cal or skybright.cal where it takes a reference (fit, references, compare, "
     "classify)"},
    {R"(^\s*#?\s*gen(daylit|sky|daymtx)\b)",
     "is what gendaylit, gensky or gendaymtx wrote, without a sky of perezlum.cal or "
     "skybright.cal, "
     "which skyfit reads"},
    {R"(^\s*<\?xml|^\s*<!doctype|^\s*<html)",
     "is XML or HTML; skyfit reads skies as text tables and images"},
    {R"(^\s*[{\[])",
     "is JSON; skyfit reads presets as --preset and skies as text tables and images"},
    {R"(^\s*(#[^\n]*\n)*[^#\n]*(irradiance|(direct|diffuse|global)_(normal|horizontal)_(lx|w_m2)))",
     "is a table of irradiances, which have no directions; skyfit reads radiances and luminances "
     "of directions, and irradiances by fit --irradiance"},
    {R"(^netcdf\s|^CDF)", "is netCDF; skyfit reads skies as text tables and images, not yet these"},
    {R"(^%!ps|^%pdf)", "is a document; skyfit reads skies as text tables and images"},
}};

// With one blank or line end in the place of many, which the patterns would try in all ways.
std::string squeezed(std::string_view text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t blank = text.find_first_of(kBlanks, at);
    result += text.substr(at, blank - at);
    if (blank == text.npos) break;
    at = std::min(text.size(), text.find_first_not_of(kBlanks, blank));
    const std::string_view run = text.substr(blank, at - blank);
    result += run.find('\n') == run.npos ? ' ' : '\n';
  }
  return result;
}

}  // namespace

std::optional<std::string> other_format(std::string_view text) {
  constexpr std::size_t kHead = 6000;  // a dozen lines of many columns
  const std::string head = squeezed(lower_case(text.substr(0, kHead)));
  for (const OtherFormat& format : kFormats) {
    const std::regex pattern(format.pattern.begin(), format.pattern.end());
    if (std::regex_search(head, pattern)) return std::string(format.what);
  }
  return {};
}

}  // namespace skyfit::refs
