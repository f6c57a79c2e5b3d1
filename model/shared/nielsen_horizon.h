// SPDX-License-Identifier: Apache-2.0
// model/shared/nielsen_horizon.glsl in C++. See model/shared/shared.h.
#pragma once

#include "model/shared/shared.h"

namespace skyfit {
namespace shared_functions {

template <class T>
struct SharedNielsenHorizon {
  using Number = T;
#include "model/shared/nielsen_horizon.glsl"
};

}  // namespace shared_functions

using shared_functions::SharedNielsenHorizon;

}  // namespace skyfit
