// SPDX-License-Identifier: Apache-2.0
// model/shared/preetham.glsl in C++, for the model and what draws it. See model/shared/shared.h;
// dual numbers need a cosine and a tangent of their own.
#pragma once

#include "model/shared/shared.h"

namespace skyfit {
namespace shared_functions {

template <class T>
struct SharedPreetham {
  using Number = T;
#include "model/shared/preetham.glsl"
};

}  // namespace shared_functions

using shared_functions::SharedPreetham;

}  // namespace skyfit
