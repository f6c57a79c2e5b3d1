// SPDX-License-Identifier: Apache-2.0
// The documents name every row of the registries: models, formats of measured skies, figures,
// shipped presets, and every option that a measured sky may want.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "data_refs/import_options.h"
#include "data_refs/measured_formats.h"
#include "data_refs/references.h"
#include "fit/exchange/programs.h"
#include "model/geometry/map_projection.h"
#include "model/registry.h"
#include "model/tables/table_precision.h"
#include "render/engine/table_files.h"
#include "render/features/render_features.h"
#include "render/panels.h"
#include "render/plot/measured_figures.h"

namespace skyfit {
namespace {

std::string document(const std::string& name) {
  std::ifstream file(std::string(SKYFIT_SOURCE_DIR) + "/" + name);
  EXPECT_TRUE(file) << name;
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void expect_in(const std::string& text, const std::string& what) {
  EXPECT_NE(text.find(what), std::string::npos) << what;
}

TEST(Documents, NameEveryModel) {
  const std::string text = document("docs/models.md");
  for (const SkyModelEntry& model : sky_models())
    expect_in(text, fmt::format("| `{}` |", model.name));
}

TEST(Documents, NameEveryFormatOfMeasuredSkies) {
  const std::string text = document("docs/measured-skies.md");
  for (const refs::MeasuredFormat& format : refs::measured_formats())
    expect_in(text, fmt::format("| {} | {} | {} | {} |", format.name, format.meaning, format.layout,
                                format.example));
}

TEST(Documents, NameEveryFigure) {
  const std::string text = document("docs/fits.md");
  for (const plot::MeasuredFigure& figure : plot::measured_figures())
    expect_in(text, fmt::format("| {} | {} |", figure.name, figure.meaning));
}

TEST(Documents, NameEveryProjectionOfSkyMaps) {
  const std::string text = document("docs/rendering.md");
  for (const MapProjectionEntry& projection : map_projections())
    expect_in(text, fmt::format("| {} | {} |", projection.name, projection.meaning));
}

TEST(Documents, NameEveryPanelOfFrames) {
  const std::string text = document("docs/rendering.md");
  for (const PanelEntry& panel : frame_panels())
    expect_in(text, fmt::format("| `frame.{}.png` | {} |", panel.name, panel.meaning));
}

TEST(Documents, NameEveryFeatureOfFrames) {
  const std::string text = document("docs/rendering.md") + document("docs/lights.md");
  for (const RenderFeature& feature : render_features()) {
    for (const FeatureOption& option : feature.options) {
      std::string typed = option.type.empty() ? option.name : option.name + " " + option.type;
      for (std::size_t at = 0; (at = typed.find('|', at)) != std::string::npos; at += 2)
        typed.insert(at, "\\");  // within a cell of a table
      expect_in(text, fmt::format("| `{}` | {} |", typed, option.meaning));
    }
  }
}

TEST(Documents, NameEveryVariantOfModels) {
  const std::string text = document("docs/models.md");
  for (const SkyModelEntry& model : sky_models())
    for (const SkyModelVariant& variant : model.variants)
      expect_in(text, fmt::format("| `{}:{}` |", model.name, variant.name));
}

TEST(Documents, NameEveryProgramOfExports) {
  const std::string text = document("docs/exchange.md");
  for (const fit::Program& program : fit::programs())
    expect_in(text, fmt::format("| {} | {} |", program.name, program.meaning));
}

TEST(Documents, NameEverySizePrecisionAndFormatOfTables) {
  const std::string rendering = document("docs/rendering.md"), tables = document("docs/tables.md");
  for (const TableSizesEntry& sizes : table_sizes())
    expect_in(rendering, fmt::format("| {} | {} |", sizes.name, sizes.meaning));
  for (const TablePrecisionEntry& precision : table_precisions())
    expect_in(rendering, fmt::format("| {} | {} |", precision.name, precision.meaning));
  for (const TableFormatEntry& format : table_formats())
    expect_in(tables, fmt::format("| {} | {} |", format.name, format.meaning));
}

TEST(Documents, NameEveryShippedPreset) {
  const std::string text = document("docs/preset.md");
  for (const std::string& name : refs::shipped_preset_names()) expect_in(text, "`" + name + "`");
}

TEST(Documents, NameWhatAMeasuredSkyMayLeaveOpen) {
  const std::string text = document("docs/measured-skies.md");
  for (const refs::ImportOptionRow& row : refs::import_option_table())
    expect_in(text, fmt::format("| `{}` | {} | {} |", row.name, row.meaning, row.expectation));
}

}  // namespace
}  // namespace skyfit
