// SPDX-License-Identifier: Apache-2.0
// What the loader of Wavefront OBJ files takes silently for zero or leaves out, found beforehand
// with its line: numbers that are none, indices of nothing.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace skyfit {

// Materials that the faces ask for, and the line of the first that does.
using MaterialUses = std::map<std::string, int>;

// The text with each line that ends in a backslash joined to the next, and with joined names. Empty
// lines after the joined one keep the numbers of those that follow.
std::string with_joined_lines(std::string_view obj);

// The text with names of materials and of their file whole for the loader, which ends them at a
// blank. Files of mtllib are several where .mtl stands several times.
std::string with_joined_names(std::string_view text);

// The name as the file has it.
std::string with_blanks(std::string name);

// `text` is the file's with joined lines. Throws std::runtime_error `file:line: what was found and
// what was expected`: a vertex or normal that is not three finite numbers, a face of less than
// three corners or of an index that is not in the file; `file: ...`: no faces, more than 50 million
// triangles.
MaterialUses check_obj(const std::filesystem::path& file, std::string_view text);

// Of a file of materials: throws `file:line: ..` unless every diffuse colour, Kd, is three finite
// numbers.
void check_mtl(const std::filesystem::path& file, std::string_view text);

}  // namespace skyfit
