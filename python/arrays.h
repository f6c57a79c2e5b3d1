// SPDX-License-Identifier: Apache-2.0
// NumPy arrays from the vectors of the rooms, without a copy.
#pragma once

#include <pybind11/numpy.h>

#include <utility>
#include <vector>

namespace skyfit::python {

namespace py = pybind11;

using Shape = std::vector<py::ssize_t>;

// Owns the vector's memory. The shape has as many elements as the vector.
template <class T>
py::array_t<T> array_of(std::vector<T>&& values, const Shape& shape) {
  auto* const owned = new std::vector<T>(std::move(values));
  const py::capsule owner(owned, [](void* memory) { delete static_cast<std::vector<T>*>(memory); });
  return py::array_t<T>(shape, owned->data(), owner);
}
template <class T>
py::array_t<T> array_of(std::vector<T>&& values) {
  const auto size = static_cast<py::ssize_t>(values.size());
  return array_of(std::move(values), {size});
}

// Contiguous and of one type: what is not is converted.
template <class T>
using Input = py::array_t<T, py::array::c_style | py::array::forcecast>;

}  // namespace skyfit::python
