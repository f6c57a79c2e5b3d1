// SPDX-License-Identifier: Apache-2.0
// The depth of a thing beside the ground alone.
layout(location = 0) in vec3 position;

uniform mat4 clip_from_object;

void main() { gl_Position = clip_from_object * vec4(position, 1.0); }
