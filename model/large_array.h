// SPDX-License-Identifier: Apache-2.0
// Arrays of the solver: large, and needed again by the next solution. The allocator keeps them
// instead of handing their pages back, and leaves new elements unset unless a value is given.
#pragma once

#include <tbb/scalable_allocator.h>

#include <new>
#include <utility>
#include <vector>

namespace skyfit {

template <class T>
struct LargeAllocator : tbb::scalable_allocator<T> {
  template <class U>
  struct rebind {
    using other = LargeAllocator<U>;
  };
  LargeAllocator() = default;
  template <class U>
  LargeAllocator(const LargeAllocator<U>&) noexcept {}  // NOLINT: as allocators do

  template <class U>
  void construct(U* p) noexcept {
    ::new (static_cast<void*>(p)) U;
  }
  template <class U, class... Arguments>
  void construct(U* p, Arguments&&... arguments) {
    ::new (static_cast<void*>(p)) U(std::forward<Arguments>(arguments)...);
  }
};

using LargeArray = std::vector<double, LargeAllocator<double>>;

}  // namespace skyfit
