// SPDX-License-Identifier: Apache-2.0
// The tables of an atmosphere on the device, and what its shaders have to know of them.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "model/tables/tables.h"
#include "render/gl/context/objects.h"
#include "render/gl/context/uniform_block.h"
#include "render/gl/passes/passes.h"

namespace skyfit {

// Makes the textures of the tables, named as in kAtmosphereReads (atmosphere_pass.h).
void add_tables(const AtmosphereTables& tables, FrameGraph& graph);

// What render/shaders/atmosphere.glsl needs to know of the tables: what no blend of two atmospheres
// changes, as text to #define, and the rest.
std::vector<std::string> atmosphere_defines(const AtmosphereTables& tables);
void bind_atmosphere(const AtmosphereTables& tables, GLuint program, UniformBuffers& buffers);

// Of the sky's view: columns of a sun, rows to the ground, rows to the sky.
glm::ivec3 sky_view_size(const AtmosphereTables& tables);

// What the classes of phase functions scatter, a row each, and in the last row the extinction,
// 1/km, over the heights of the tables.
GlTexture scattering_texture(const AtmosphereTables& tables);

// SkyRayTables::gathered, of SkyRayMapping::kBodare.
GlTexture gathered_texture(const AtmosphereTables& tables);

}  // namespace skyfit
