// SPDX-License-Identifier: Apache-2.0
// The parts of the module skyfit._skyfit; skyfit/__init__.py is what users see of it.
#pragma once

#include <pybind11/pybind11.h>

namespace skyfit::python {

void bind_preset(pybind11::module_& module);
void bind_reference(pybind11::module_& module);  // after the preset
void bind_sky(pybind11::module_& module);
void bind_fit(pybind11::module_& module);  // after the reference
void bind_render(pybind11::module_& module);

}  // namespace skyfit::python
