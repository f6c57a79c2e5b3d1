// SPDX-License-Identifier: Apache-2.0
// The classes of the pixels as depths, which the atmosphere's pass tests against; in the place of the G-buffer's depth, which
// each fragment alone reads and writes. As a texture it would cost a renderer in software four times as much.
#extension GL_ARM_shader_framebuffer_fetch_depth_stencil : enable
#include "render/shaders/pixel_class.glsl"

#ifdef GL_ARM_shader_framebuffer_fetch_depth_stencil
float depth_here() { return gl_LastFragDepthARM; }
#else
layout(binding = 0) uniform sampler2D depth;
float depth_here() { return texelFetch(depth, ivec2(gl_FragCoord.xy), 0).x; }
#endif

noperspective in vec2 slope;
flat in float grainless;

void main() { gl_FragDepth = class_of(depth_here(), grainless, vec3(slope, 1.0)); }
