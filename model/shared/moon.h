// SPDX-License-Identifier: Apache-2.0
// model/shared/moon.glsl in C++, for tests of frames. See model/shared/shared.h.
#pragma once

#include "model/shared/shared.h"

namespace skyfit {
namespace shared_functions {

template <class T>
struct SharedMoon {
  using Number = T;
#include "model/shared/moon.glsl"
};

}  // namespace shared_functions

using shared_functions::SharedMoon;

}  // namespace skyfit
