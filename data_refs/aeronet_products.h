// SPDX-License-Identifier: Apache-2.0
// What AERONET found out of the aerosol: optical depths by the direct sun, and inversions of sky
// radiances, of version 2 or 3, as a download or the web service gives them. Columns are known by
// their names:
//   version 3: AOD_440nm, AOD_Extinction-Total[440nm], Single_Scattering_Albedo[440nm],
//              Asymmetry_Factor-Total[440nm]
//   version 2: AOT_440, AOTExt440-T, SSA440-T, ASYM440-T
// -999 and N/A are missing values.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "data_refs/civil_time.h"
#include "data_refs/solar_position.h"
#include "model/atmosphere/parameters.h"

namespace skyfit::refs {

// By wavelength in nm.
struct AerosolRecord {
  Instant time;
  std::map<double, double> optical_depth, single_scattering_albedo, asymmetry;
  std::optional<Site> site = {};  // where the file states it
};

// By time, without those whose values are all missing. Throws std::invalid_argument with one line
// that names file, line and expectation when the file holds neither product, no value, or an
// optical depth outside -0.1 to 10, an albedo outside 0 to 1 or an asymmetry factor outside -1 to
// 1; std::runtime_error when it cannot be read.
std::vector<AerosolRecord> load_aerosol_records(const std::filesystem::path& file);

// Those within 100 km of the site, or of no known place. Throws std::invalid_argument that names
// both places when there is none.
std::vector<AerosolRecord> records_near(const std::vector<AerosolRecord>& records, const Site& site,
                                        const std::string& source);

// What a fit takes from it: values at 550 nm with one standard deviation.
struct AerosolKnowledge {
  std::optional<Prior> optical_depth, angstrom_exponent, single_scattering_albedo;
  // Where each comes from, what the records do not tell, and the asymmetry factor to compare.
  std::vector<std::string> notes;
};

// The records around the times of the scans, between which is interpolated; several times are
// averaged. A record counts for half an hour where it holds optical depths alone, for two hours
// where it is an inversion.
//
// Optical depth and exponent are those of the power law through the optical depths of 400 to 1100
// nm, of at least two wavelengths: weighted least squares of ln tau = ln tau_550 - alpha ln(lambda
// / 550 nm). sigma of an optical depth is 0.01 (Giles et al. 2019, Atmos. Meas. Tech. 12, 169),
// that of tau_550 too, because the errors of the wavelengths go together; that of alpha is what
// independent errors make. The single scattering albedo is interpolated to 550 nm, its sigma 0.03
// where the optical depth at 440 nm is 0.4 or more, else 0.07 (Dubovik et al. 2000, J. Geophys.
// Res. 105, 9791).
//
// Throws std::invalid_argument that names the time without a record and the nearest record, or says
// that the records tell nothing of these.
AerosolKnowledge aerosol_at(const std::vector<AerosolRecord>& records,
                            const std::vector<Instant>& times, const std::string& source);

// Of two files, the first overruling.
AerosolKnowledge joined(const AerosolKnowledge& first, const AerosolKnowledge& second);

}  // namespace skyfit::refs
