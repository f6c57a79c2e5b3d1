// SPDX-License-Identifier: Apache-2.0
// G-buffer of Sperlhofer 2011, 4.4: colour at the four wavelengths, scaled to a largest component of 1; normal in the
// camera frame with that largest reflectance / pi.
layout(location = 0) out vec4 color;
layout(location = 1) out vec4 normal_reflectance;

void write_gbuffer(vec3 normal, vec4 reflectance) {
  float largest = max(max(reflectance.x, reflectance.y), max(reflectance.z, max(reflectance.w, 1e-6)));
  color = reflectance / largest;
  normal_reflectance = vec4(normal, largest * 0.318309886183790672);  // 1 / pi
}
