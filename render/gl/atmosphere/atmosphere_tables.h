// SPDX-License-Identifier: Apache-2.0
// The tables of an atmosphere on the device, and what its shaders have to know of them.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "model/tables/table_precision.h"
#include "model/tables/tables.h"
#include "render/gl/context/objects.h"
#include "render/gl/context/uniform_block.h"
#include "render/gl/passes/passes.h"

namespace skyfit {

// How the tables of scattered light are kept on the device, what their texels stand for.
struct TableCodes {
  TablePrecision precision = TablePrecision::kFloat;
  TexelCode rayleigh_like = {}, single = {}, sky_ray_air = {}, sky_ray_aerosol = {};
};

// Makes the textures of the tables, named as in kAtmosphereReads (atmosphere_pass.h).
TableCodes add_tables(const AtmosphereTables& tables, FrameGraph& graph,
                      TablePrecision precision = TablePrecision::kFloat);

// What render/shaders/atmosphere.glsl needs to know of the tables: what no blend of two atmospheres
// changes, as text to #define, and the rest.
std::vector<std::string> atmosphere_defines(const AtmosphereTables& tables,
                                            const TableCodes& codes = {});
void bind_atmosphere(const AtmosphereTables& tables, GLuint program, UniformBuffers& buffers,
                     const TableCodes& codes = {});

// Of the sky's view: columns of a sun, rows to the ground, rows to the sky.
glm::ivec3 sky_view_size(const AtmosphereTables& tables);

// What the classes of phase functions scatter, a row each, and in the last row the extinction,
// 1/km, over the heights of the tables.
GlTexture scattering_texture(const AtmosphereTables& tables);

// SkyRayTables::gathered, of SkyRayMapping::kBodare.
GlTexture gathered_texture(const AtmosphereTables& tables);

}  // namespace skyfit
