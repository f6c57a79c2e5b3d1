// SPDX-License-Identifier: Apache-2.0
// The classes of the pixels as depths, which the atmosphere's pass tests against.
#include "render/shaders/pixel_class.glsl"

layout(binding = 0) uniform sampler2D depth;

void main() { gl_FragDepth = class_of(texelFetch(depth, ivec2(gl_FragCoord.xy), 0).x); }
