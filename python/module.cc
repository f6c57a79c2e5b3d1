// SPDX-License-Identifier: Apache-2.0
// The module skyfit._skyfit. std::invalid_argument becomes ValueError, an error of the file system
// OSError, any other std::runtime_error RuntimeError; each with the one line that the program
// shows.
#include <pybind11/pybind11.h>

#include <filesystem>

#include "model/version.h"
#include "python/bindings.h"

PYBIND11_MODULE(_skyfit, module) {
  namespace python = skyfit::python;
  pybind11::register_exception_translator([](std::exception_ptr error) {
    try {
      if (error) std::rethrow_exception(error);
    } catch (const std::filesystem::filesystem_error& failure) {
      PyErr_SetString(PyExc_OSError,
                      (failure.path1().string() + ": " + failure.code().message()).c_str());
    }
  });
  module.attr("__version__") = std::string(skyfit::kVersion);
  python::bind_preset(module);
  python::bind_reference(module);
  python::bind_sky(module);
  python::bind_fit(module);
  python::bind_render(module);
}
