// SPDX-License-Identifier: Apache-2.0
// The corners of one triangle over the whole picture, which runs from -1 to 1.
vec2 corner_beyond_picture() { return vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0); }
