// SPDX-License-Identifier: Apache-2.0
// What the loader of Wavefront OBJ files takes silently for zero or leaves out, found beforehand
// with its line: numbers that are none, indices of nothing.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace skyfit {

// Materials that the faces ask for, and the line of the first that does.
using MaterialUses = std::map<std::string, int>;

// Throws std::runtime_error `file:line: what was found and what was expected`: a vertex or normal
// that is not three finite numbers, a face of less than three corners or of an index that is not in
// the file; `file: ...`: unreadable, no faces, more than 50 million triangles.
MaterialUses check_obj(const std::filesystem::path& file);

}  // namespace skyfit
