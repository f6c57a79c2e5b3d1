// SPDX-License-Identifier: Apache-2.0
// The calibration of a sky radiometer, as SKYRAD.pack keeps it in its file ins.para. Each item
// begins a line; what follows its last number is a comment:
//   a title
//   "PS1202006"        number of the instrument
//   30                 type, here not used
//   NW                 number of wavelengths, then NW wavelengths in cm
//   SVA                NW solid angles of view, sr
//   NDAY               number of calibrations, each a line of year, month, day, hour UTC and
//   F0                 NW currents that the sun would give at 1 au above the air, A; 0: not known
// Layout: the reader RDINSP and the examples of skyrad.pack 5.0, which its authors publish.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data_refs/civil_time.h"

namespace skyfit::refs {

struct PomCalibration {
  Instant time;
  std::vector<double> current_a;  // by wavelength
};

struct PomInstrument {
  std::string number;
  std::vector<double> wavelength_nm, solid_angle_sr;
  std::vector<PomCalibration> calibrations;  // at least one, by ascending time

  // Of the wavelength at the time: between two calibrations linear, before the first and after the
  // last theirs (SKYRAD.pack extrapolates). Nothing where it is not known.
  std::optional<double> current_a(std::size_t wavelength, Instant time) const;
};

// Throws std::invalid_argument `source:line: field: expected ...`.
PomInstrument parse_pom_instrument(std::string_view text, std::string_view source);

// Throws std::runtime_error too, when the file cannot be read.
PomInstrument load_pom_instrument(const std::filesystem::path& file);

}  // namespace skyfit::refs
