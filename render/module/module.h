// SPDX-License-Identifier: Apache-2.0
// What the thin library calls in skyfit_render_module (model/module_file.h).
#pragma once

#include <filesystem>
#include <functional>

#include "render/render.h"

namespace skyfit {

struct RenderModule {
  static constexpr int kRevision = 1;
  int revision;
  Frame (*render_frame)(const AtmosphereTables&, const FrameOptions&,
                        const std::function<void(double)>&);
  void (*write_exr)(const Frame&, const std::filesystem::path&);
  void (*write_png)(const Frame&, const std::filesystem::path&, const ToneOptions&);
};

}  // namespace skyfit

// The module's only symbol.
extern "C" const void* skyfit_render_module();
