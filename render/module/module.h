// SPDX-License-Identifier: Apache-2.0
// What the thin library calls in skyfit_render_module (model/base/module_file.h).
#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "model/tables/table_precision.h"
#include "render/render.h"
#include "render/sky_map/sky_map.h"

namespace skyfit {

// Renderer of render.h, without the preset's metadata.
class FrameDrawer {
 public:
  virtual ~FrameDrawer() = default;
  virtual std::string device() const = 0;
  virtual void set_ground(const Atmosphere<double>& atmosphere, const ColorRule& color) = 0;
  virtual void prepare(const FrameOptions& options) = 0;
  virtual void set_atmosphere(const AtmosphereTables& tables, TablePrecision precision) = 0;
  virtual std::vector<std::string> warnings() const = 0;
  virtual double ground_height_m(const std::optional<Site>& site) const = 0;
  virtual Frame draw(const FrameOptions& options, const std::function<void(double)>& progress) = 0;
  virtual FrameStatistics submit(const FrameOptions& options) = 0;
  virtual FrameStatistics wait() = 0;
};

struct RenderModule {
  static constexpr int kRevision = 16;
  int revision;
  std::unique_ptr<FrameDrawer> (*make_drawer)(const Scene&, GraphicsDevice,
                                              std::shared_ptr<ContentCache>);
  std::vector<float> (*glare_of)(const Frame&);
  void (*write_exr)(const Frame&, const std::filesystem::path&);
  void (*write_map)(const SkyMap&, Primaries, const std::filesystem::path&);
  void (*write_png)(const Frame&, const std::filesystem::path&, const ToneOptions&);
  void (*write_grid)(const FrameGrid&, const std::filesystem::path&);
  std::vector<std::filesystem::path> (*texture_files)(const std::filesystem::path&);
  void (*write_table)(const EncodedTable&, const std::filesystem::path&);
};

}  // namespace skyfit

// The module's only symbol.
extern "C" const void* skyfit_render_module();
