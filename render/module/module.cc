// SPDX-License-Identifier: Apache-2.0
#include "render/module/module.h"

#include "render/gl/passes/renderer.h"
#include "render/gl/terrain/materials.h"
#include "render/image/glare.h"
#include "render/image/image_files.h"

extern "C" __attribute__((visibility("default"))) const void* skyfit_render_module() {
  static constexpr skyfit::RenderModule kModule = {
      skyfit::RenderModule::kRevision, skyfit::make_drawer,        skyfit::glare_of,
      skyfit::write_exr_file,          skyfit::write_map_file,     skyfit::write_png_file,
      skyfit::write_grid_file,         skyfit::made_texture_files, skyfit::write_table_file};
  return &kModule;
}
