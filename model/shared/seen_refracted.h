// SPDX-License-Identifier: Apache-2.0
// model/shared/seen_refracted.glsl in C++. See model/shared/shared.h.
#pragma once

#include "model/shared/shared.h"

namespace skyfit {
namespace shared_functions {

template <class T>
struct SharedSeenRefracted {
  using Number = T;
#include "model/shared/geometry.glsl"
#include "model/shared/seen_refracted.glsl"
};

}  // namespace shared_functions

using shared_functions::SharedSeenRefracted;

}  // namespace skyfit
