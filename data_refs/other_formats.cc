// SPDX-License-Identifier: Apache-2.0
#include "data_refs/other_formats.h"

#include <algorithm>
#include <array>
#include <regex>

#include "data_refs/scan_header.h"
#include "model/base/pattern.h"
#include "model/base/text.h"

namespace skyfit::refs {
namespace {

constexpr std::string_view kBlanks = " \t\r\n\v\f";

struct OtherFormat {
  std::string_view pattern;  // in the head of the text, without case
  std::string_view what;     // "is .., skyfit .."
};

// The first that matches; a line of columns of AERONET tells the product.
constexpr std::array<OtherFormat, 30> kFormats = {{
    {R"(^\x89png|^\xff\xd8\xff|^(ii\*|mm\x00\*)|^gif8)",
     "is an image of colours for a screen (PNG, JPEG, TIFF or GIF), whose light is not known; "
     "skyfit "
     "reads skies in OpenEXR and Radiance HDR"},
    {R"(^pk[\x01-\x08]|^\x1f\x8b|^bzh|^7z\xbc|^\xfd\x37zxz)",
     "is an archive; skyfit reads what is in it, once it is unpacked"},
    {R"(^\x89hdf)", "is HDF5; skyfit reads skies as text tables and images, not yet these"},
    {R"(^(\xff\xfe|\xfe\xff))", "is text in UTF-16; skyfit reads UTF-8"},
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
    {R"((fine|coarse)_mode_aod|\bmonth,aod_)",
     "is fine and coarse modes or monthly means of AERONET; skyfit reads its sky radiances, and as "
     "a prior, by fit --aeronet-aod, its optical depths by wavelength and time"},
    {R"(aod_\d+nm|aot_\d+|[,_]aod_)",
     "is aerosol optical depths of AERONET; skyfit reads AERONET's sky radiances, and takes these "
     "as "
     "a prior by fit --aeronet-aod"},
    {R"(no data (was |were )?found)",
     "is an answer without data, as AERONET's web service gives it for a site or a time that it "
     "does not have; skyfit reads its sky radiances"},
    {R"(^(<[^\n>]*>|\s)*aeronet (version|data))",
     "is of AERONET, without the columns of its sky radiances; skyfit reads those with Date(..), "
     "Time(..), a wavelength, Solar_Zenith_Angle(..) and a radiance for each angle"},
    {R"(^"?location"?,[^\n]*\n\s*"?design conditions|^place [^\n]*\s+latitude |date \(mm/dd/yyyy\),|^source,location id,|^\s*\d{5} [a-z][^\n]* -?\d+ [ns] \d+ \d+ [ew] \d+ \d+ )",
     "is a weather file (EPW, WEA, TMY2, TMY3 or NSRDB), which holds irradiances; skyfit reads "
     "skies with "
     "directions, and an hour of such a file as perez:FILE@YYYY-MM-DDTHH:MM or by "
     "fit --irradiance FILE@YYYY-MM-DDTHH:MM"},
    {R"(^\d{4}-\d\d-\d\d___|wavelength ?[,;] ?irradiance)",
     "is a spectrum of irradiance, as Kider et al. 2014 publish them; skyfit reads their radiances "
     "of directions, not yet these"},
    {R"(^((mtllib |o |g |s |usemtl )[^\n]*\n)*v -?[\d.]+ -?[\d.]+ -?[\d.])",
     "is a mesh (OBJ); skyfit render reads it by --mesh"},
    {R"(^newmtl )",
     "is materials of a mesh (MTL); skyfit render reads them beside the OBJ of --mesh"},
    {R"(^ply\s|^solid )",
     "is a mesh (PLY or STL); skyfit render reads OBJ by --mesh, not yet these"},
    {R"(^data from [^\n]* node)",
     "is a spectrum of OceanView, which does not say its direction; skyfit reads a folder of "
     "spectra "
     "whose names do, or a CSV of directions and wavelengths"},
    {R"(^latitude \(decimal degrees\))",
     "is a table of PVGIS, which holds irradiances; skyfit reads skies with directions, and an "
     "hour "
     "of the typical year of PVGIS as perez:FILE@YYYY-MM-DDTHH:MM or by "
     "fit --irradiance FILE@YYYY-MM-DDTHH:MM"},
    {R"(^/\* ?data description)",
     "is a table of PANGAEA; skyfit reads directions and luminances whose columns a sidecar names, "
     "and irradiances by fit --irradiance"},
    {R"(^ncols \d)", "is a map of heights (ESRI grid); skyfit render takes maps by --dem"},
    {R"(^\s*(void\s+(light|glow|brightfunc|plastic)\s|!\s*gen))",
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
    {R"(^\s*[^#\n]*(irradiance|(direct|diffuse|global)_(normal|horizontal)_(lx|w_m2)))",
     "is a table of irradiances, which have no directions; skyfit reads radiances and luminances "
     "of directions, and irradiances by fit --irradiance"},
    {R"(^[^#\n]*\b(ghi|dni|dhi)\b)",
     "is a table of irradiances (GHI, DNI, DHI), which have no directions; fit --irradiance reads "
     "it with the columns time, global_horizontal_w_m2, direct_normal_w_m2 and "
     "diffuse_horizontal_w_m2"},
    {R"(^netcdf\s|^CDF)", "is netCDF; skyfit reads skies as text tables and images, not yet these"},
    {R"(^%!ps|^%pdf)", "is a document; skyfit reads skies as text tables and images"},
    {R"(^[^#,\n;]*;[^,\n;]*;[^,\n]*\n)",
     "has columns between semicolons; skyfit reads them where the sidecar FILE.sidecar.json says "
     "which they are: \"columns\", \"delimiter\": \";\" and, of numbers such as 3,14, "
     "\"decimal_comma\": true"},
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

// Without the blank lines and the lines with # at the beginning.
std::string_view without_comments(std::string_view text) {
  for (;;) {
    text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
    if (!text.starts_with('#')) return text;
    text.remove_prefix(std::min(text.find('\n'), text.size()));
  }
}

}  // namespace

std::optional<std::string> other_format(std::string_view text) {
  // A dozen lines of many columns, with the comments before them and without.
  const auto head = [](std::string_view part) {
    return squeezed(lower_case(part.substr(0, kMostMatched)));
  };
  const std::string whole = head(text), body = head(without_comments(text));
  for (const OtherFormat& format : kFormats) {
    const std::regex pattern(format.pattern.begin(), format.pattern.end());
    if (first_match(whole, pattern) || first_match(body, pattern)) return std::string(format.what);
  }
  return {};
}

}  // namespace skyfit::refs
