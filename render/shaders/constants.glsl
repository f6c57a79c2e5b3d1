// SPDX-License-Identifier: Apache-2.0
// What is the same for all pixels of a frame: a block of constants by its binding, name and members, a macro of the members'
// qualifier (`highp` stands for none). A renderer in software looks up a uniform for each pixel anew, ten components in the
// time of a 2D fetch; an input that is the same at a triangle's three corners is free. With FLAT_CONSTANTS a fragment
// shader's constants come that way, see pixel_ray.glsl.
#ifdef FLAT_CONSTANTS
#define CONSTANTS(BINDING, NAME, MEMBERS) in NAME { MEMBERS(flat) };
#else
#define CONSTANTS(BINDING, NAME, MEMBERS) layout(std140, binding = BINDING) uniform NAME { MEMBERS(highp) };
#endif
