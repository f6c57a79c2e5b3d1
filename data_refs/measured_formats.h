// SPDX-License-Identifier: Apache-2.0
// The formats of measured skies, recognised by what a file holds, not by its name. One table names
// them; reading, help texts and docs/measured-skies.md follow it.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "data_refs/import_options.h"
#include "data_refs/samples.h"

namespace skyfit::refs {

// A file or a folder that may hold a measured sky.
class SkyFile {
 public:
  // Throws std::runtime_error in one line when it is neither a folder nor a regular file of a
  // sensible size.
  explicit SkyFile(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }
  std::string name() const { return path_.string(); }  // for messages
  bool is_folder() const { return is_folder_; }
  // Of a file. Throws std::invalid_argument when it is no text.
  const std::string& text() const;
  std::string_view line() const;  // the first that is no comment
  void set_text(std::string text) { text_ = std::move(text); }

 private:
  std::filesystem::path path_;
  bool is_folder_;
  mutable std::optional<std::string> text_;  // read when it is first asked for
};

struct MeasuredFormat {
  SkyFormats format;
  std::string_view name;     // "EKO MS-321LR"
  std::string_view meaning;  // what is read of it
  std::string_view layout;   // where the layout is described
  std::string_view example;  // in data_refs/examples/
  bool (*matches)(const SkyFile& file);
  Reference (*read)(const SkyFile& file, const ImportOptions& facts);
};

// In the order in which they are tried; the last matches every file.
std::span<const MeasuredFormat> measured_formats();

// What the sidecar beside the file says is used too, after `options`. Throws std::invalid_argument
// with one line that names file, line, field, value and expectation, std::runtime_error when the
// file cannot be read.
Reference load_measured_sky(const std::filesystem::path& file, const ImportOptions& options);

}  // namespace skyfit::refs
