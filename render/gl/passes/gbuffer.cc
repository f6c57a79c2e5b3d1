// SPDX-License-Identifier: Apache-2.0
#include "render/gl/passes/gbuffer.h"

namespace skyfit {

void add_gbuffer(int width, int height, FrameGraph& graph) {
  graph.add_target("gbuffer", GL_RGBA32UI, width, height);
  graph.add_target("depth", GL_DEPTH_COMPONENT32F, width, height);
}

void clear_gbuffer() {
  const float far_depth = 0;
  glClearBufferfv(GL_DEPTH, 0, &far_depth);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
}

}  // namespace skyfit
