// SPDX-License-Identifier: Apache-2.0
// The words of a Radiance scene and the primitives that they make (Radiance, The RADIANCE Synthetic
// Imaging System, file formats): what a sky means is radiance_sky.h's.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace skyfit::refs::radiance {

struct Word {
  std::string text;
  int line;
};

// `modifier type identifier`, then numbers of strings, of integers and of reals with these.
struct Primitive {
  std::string modifier, type, name;
  std::vector<std::string> strings;
  std::vector<double> reals;
  int line = 0;
};

// Words outside comments; the comments one by one.
struct Scene {
  std::vector<Word> words;
  std::vector<Word> comments;
};

Scene scene_of(std::string_view text);

// Without aliases, which are further names of modifiers. Throws std::invalid_argument
// `source:line: ..: expected ..`.
std::vector<Primitive> primitives_of(const Scene& scene, std::string_view source);

}  // namespace skyfit::refs::radiance
