// SPDX-License-Identifier: Apache-2.0
// Modules: shared libraries that hold what few commands need and that take long to load. They are
// built with the program and opened on first use; NAME.so has one symbol, `extern "C" const void*
// NAME()`, which returns a struct of functions that begins with its revision.
#pragma once

#include <stdexcept>
#include <string>

namespace skyfit {

// What NAME() returns. A program of the build directory opens the modules of the build and no
// others; any other opens those in the library directory beside its own (a moved installation) or
// where CMake installs them, all by absolute path. A library that holds this code, such as the
// Python package, counts as the program and may have the modules beside it. Throws
// std::runtime_error with one line.
const void* open_module(const std::string& name);

// The struct of that module; kRevision is the one this program knows.
template <class Module>
const Module& module_named(const std::string& name) {
  const auto* module = static_cast<const Module*>(open_module(name));
  if (module->revision != Module::kRevision)
    throw std::runtime_error(name + ".so: belongs to another version of skyfit");
  return *module;
}

}  // namespace skyfit
