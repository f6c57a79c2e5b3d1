// SPDX-License-Identifier: Apache-2.0
// G-buffer of Sperlhofer 2011, 4.4: colour at the four wavelengths, scaled to a largest component of 1; normal with
// that largest reflectance / pi.
in vec3 ground_normal;
in vec4 ground_reflectance;

layout(location = 0) out vec4 color;
layout(location = 1) out vec4 normal_reflectance;

const float kPi = 3.14159265358979;

void main() {
  float largest = max(max(ground_reflectance.x, ground_reflectance.y),
                      max(ground_reflectance.z, max(ground_reflectance.w, 1e-6)));
  color = ground_reflectance / largest;
  normal_reflectance = vec4(normalize(ground_normal), largest / kPi);
}
