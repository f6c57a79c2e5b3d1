// SPDX-License-Identifier: Apache-2.0
#include "render/shaders/gbuffer.glsl"

layout(location = 0) out uvec4 gbuffer;

void write_gbuffer(vec3 normal, float rock, vec4 reflectance) {
  gbuffer = pack_ground(GroundSample(normal, rock, reflectance, gl_FragCoord.z));
}
