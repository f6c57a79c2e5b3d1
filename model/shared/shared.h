// SPDX-License-Identifier: Apache-2.0
// The formulas that C++ and the shaders share. Shared<T>{}.rayleigh_phase(nu) is the C++ side for
// any scalar T: double, Dual<N>, ceres::Jet. A shader reads the same files after `#define Number
// float` and `#define OUT(T) out T`.
#pragma once

#include <cmath>

namespace skyfit {
namespace shared_functions {

using std::acos;
using std::atan;
using std::cos;
using std::exp;
using std::log;
using std::pow;
using std::sin;
using std::sqrt;
using std::tan;

template <class T>
T max(const T& a, const T& b) {
  return a < b ? b : a;
}
template <class T>
T min(const T& a, const T& b) {
  return b < a ? b : a;
}
template <class T>
T clamp(const T& x, const T& low, const T& high) {
  return min(max(x, low), high);
}

template <class T>
struct Shared {
  using Number = T;
#define OUT(type) type&
#include "model/shared/closed_forms.glsl"
#include "model/shared/geometry.glsl"
#include "model/shared/mapping.glsl"
// after the geometry and the mapping that they stand on
#include "model/shared/bodare_mapping.glsl"
#include "model/shared/bruneton_mapping.glsl"
#include "model/shared/hillaire_mapping.glsl"
#include "model/shared/hosek_wilkie.glsl"
#include "model/shared/media.glsl"
#include "model/shared/phase.glsl"
#undef OUT
};

}  // namespace shared_functions

using shared_functions::Shared;

}  // namespace skyfit
