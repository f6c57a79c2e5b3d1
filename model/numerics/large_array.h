// SPDX-License-Identifier: Apache-2.0
// Arrays of the solver: large, and needed again by the next solution. They come from a pool that
// keeps their memory instead of handing its pages back, and new elements stay unset unless a value
// is given.
#pragma once

#include <memory_resource>
#include <new>
#include <utility>
#include <vector>

namespace skyfit {

inline std::pmr::memory_resource& large_array_pool() {
  static std::pmr::synchronized_pool_resource pool(
      std::pmr::pool_options{.max_blocks_per_chunk = 1, .largest_required_pool_block = 4 << 20});
  return pool;
}

template <class T>
struct LargeAllocator {
  using value_type = T;
  LargeAllocator() = default;
  template <class U>
  LargeAllocator(const LargeAllocator<U>&) noexcept {}  // NOLINT: as allocators do

  T* allocate(std::size_t count) {
    return static_cast<T*>(large_array_pool().allocate(count * sizeof(T), kAlignment));
  }
  void deallocate(T* p, std::size_t count) noexcept {
    large_array_pool().deallocate(p, count * sizeof(T), kAlignment);
  }
  template <class U>
  void construct(U* p) noexcept {
    ::new (static_cast<void*>(p)) U;
  }
  template <class U, class... Arguments>
  void construct(U* p, Arguments&&... arguments) {
    ::new (static_cast<void*>(p)) U(std::forward<Arguments>(arguments)...);
  }
  friend bool operator==(const LargeAllocator&, const LargeAllocator&) { return true; }

 private:
  static constexpr std::size_t kAlignment = 64;  // a cache line, and the widest vector
};

using LargeArray = std::vector<double, LargeAllocator<double>>;

}  // namespace skyfit
