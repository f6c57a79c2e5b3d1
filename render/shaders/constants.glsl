// SPDX-License-Identifier: Apache-2.0
// What is the same for all pixels of a frame: a block of constants by its binding, name and members. These are a macro that
// hands the type and the name of each to the macro EACH, which declares it here and copies it in pixel_ray.glsl.
// A renderer in software looks up a uniform for each pixel anew, ten components in the time of a 2D fetch; an input that is
// the same at a triangle's three corners is free. With FLAT_CONSTANTS a fragment shader's constants come that way.
// GLSL ES 3.00 has neither bindings nor such blocks of its programs: there constants are uniforms by their names.
// TABLE is a texture by its unit. HLSL has its own, render/glsl/shader_text.cc.
#ifndef HLSL
#define LIST(TYPE, SIZE, VALUES) TYPE[SIZE](VALUES)
#endif
#ifdef GL_ES
#define TABLE(UNIT, TYPE, NAME) uniform TYPE NAME;
#define UNIFORM_CONSTANT(TYPE, NAME) uniform TYPE NAME;
#define CONSTANTS(UNIT, NAME, MEMBERS) MEMBERS(UNIFORM_CONSTANT)
#elif !defined(HLSL)
#define TABLE(UNIT, TYPE, NAME) layout(binding = UNIT) uniform TYPE NAME;
#define FLAT_CONSTANT(TYPE, NAME) flat TYPE NAME;
#define BLOCK_CONSTANT(TYPE, NAME) TYPE NAME;
#ifdef FLAT_CONSTANTS
#define CONSTANTS(UNIT, NAME, MEMBERS) in NAME { MEMBERS(FLAT_CONSTANT) };
#else
#define CONSTANTS(UNIT, NAME, MEMBERS) layout(std140, binding = UNIT) uniform NAME { MEMBERS(BLOCK_CONSTANT) };
#endif
#endif
