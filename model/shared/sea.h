// SPDX-License-Identifier: Apache-2.0
// model/shared/sea.glsl in C++, for what draws and tests a sea. See model/shared/shared.h.
#pragma once

#include "model/shared/shared.h"

namespace skyfit {
namespace shared_functions {

template <class T>
struct SharedSea {
  using Number = T;
#include "model/shared/sea.glsl"
};

}  // namespace shared_functions

using shared_functions::SharedSea;

}  // namespace skyfit
