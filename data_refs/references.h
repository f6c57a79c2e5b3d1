// SPDX-License-Identifier: Apache-2.0
// Every source of reference skies, by name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "data_refs/import_options.h"
#include "data_refs/samples.h"

namespace skyfit::refs {

enum class Sampling {
  kPrincipalPlane,  // every 5 deg from -85 to 85 deg view zenith in the sun's vertical plane
  kTregenza         // the 145 patches of the Tregenza hemisphere
};

struct ReferenceEntry {
  std::string name;         // "cie:12"
  std::string description;  // one line
};

// The analytic references with a name of their own: cie:1 .. cie:15 and cie:traditional-overcast.
std::vector<ReferenceEntry> shipped_references();

// The names of a list that commas part; the comma within "perez:EPSILON,DELTA" parts none.
std::vector<std::string> reference_names(std::string_view list);

// `name` is a shipped reference, "perez:EPSILON,DELTA" (data_refs/perez_sky.h),
// "perez:FILE@TIME" of an hour of a weather file (data_refs/weather_file.h), one of
// truth_references() (data_refs/truth.h) or the path of a measured sky
// (data_refs/measured_formats.h). For analytic references the suns (zenith, radians)
// and the sampling say where they are read; a measured sky and a table of truth bring their own.
// `options` say what the file of a measured sky leaves open. Throws std::invalid_argument /
// std::runtime_error with one line that names file, line, field, value, expectation.
Reference load_reference(std::string_view name, const std::vector<double>& sun_zenith,
                         Sampling sampling, const ImportOptions& options = {});

// The JSON Schema of presets of version 2.
std::string preset_schema_json();

// Shipped presets, see data_refs/README.md; JSON text.
std::vector<std::string> shipped_preset_names();
std::string shipped_preset_json(
    std::string_view name);  // throws std::invalid_argument that lists the names

}  // namespace skyfit::refs
