// SPDX-License-Identifier: Apache-2.0
// What the fragments of a pass over the picture get from the corners: the ray through a pixel, and what is the same for all.
#include "render/shaders/view_ray.glsl"
#include "render/shaders/materials.glsl"

noperspective out vec3 site_ray;    // camera frame
noperspective out vec3 planet_ray;  // planet's axes

out View { VIEW_CONSTANTS(FLAT_CONSTANT) } view;
out Atmosphere { ATMOSPHERE_CONSTANTS(FLAT_CONSTANT) } atmosphere;
out Materials { MATERIAL_CONSTANTS(FLAT_CONSTANT) } material;
#define PASS_VIEW(TYPE, NAME) view.NAME = NAME;
#define PASS_ATMOSPHERE(TYPE, NAME) atmosphere.NAME = NAME;
#define PASS_MATERIAL(TYPE, NAME) material.NAME = NAME;

void pass_ray(vec2 screen) {
  site_ray = ray_through(screen);
  planet_ray = planet_from_site * site_ray;
}

void pass_constants() {
  VIEW_CONSTANTS(PASS_VIEW)
  ATMOSPHERE_CONSTANTS(PASS_ATMOSPHERE)
  MATERIAL_CONSTANTS(PASS_MATERIAL)
}
