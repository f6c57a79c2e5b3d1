// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere/preset.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/inputs.h"
#include "data_refs/references.h"
#include "model/atmosphere/parameters.h"
#include "model/base/whole_file.h"
#include "python/bindings.h"

namespace skyfit::python {
namespace {

namespace py = pybind11;

Parameter parameter_named(const Preset& preset, const std::string& name) {
  const Parameter parameter = parameter_from_name(name);
  require_parameter(preset.atmosphere, parameter);
  return parameter;
}

// The record of a fit is of the values that were fitted, not of others.
void set(Preset& preset, const std::string& name, double value) {
  Preset changed = preset;
  set_parameter(changed.atmosphere, parameter_named(preset, name), value);
  validate(changed.atmosphere);
  changed.fit = nullptr;
  preset = std::move(changed);
}

// By name.
py::dict parameters_by_name(const Preset& preset) {
  py::dict rows;
  for (const Parameter& parameter : parameters_of(preset.atmosphere)) {
    const ParameterInfo info = parameter_info(parameter);
    py::dict row;
    row["value"] = get_parameter(preset.atmosphere, parameter);
    row["unit"] = std::string(info.unit);
    row["bounds"] = py::make_tuple(info.lower, info.upper);
    row["prior"] = info.prior ? py::object(py::make_tuple(info.prior->mean, info.prior->sigma))
                              : py::object(py::none());
    row["free_by_default"] = info.free_by_default;
    row["meaning"] = info.meaning;
    rows[py::str(info.name)] = row;
  }
  return rows;
}

}  // namespace

void bind_preset(py::module_& module) {
  module.def("preset_names", &refs::shipped_preset_names,
             "Names of the shipped presets, which Preset(name) loads.");
  py::class_<Preset>(module, "Preset",
                     "An atmosphere with everything that a model needs: planet, star, ground and "
                     "constituents (docs/preset.md).\n\nPreset(name_or_file) loads a shipped "
                     "preset or a file. Parameters are read and set by name, "
                     "preset[\"mie.scattering\"] = 4e-6, in the unit that parameters() states; "
                     "setting one drops the record of a fit, which is of other values.")
      .def(py::init([](const std::filesystem::path& name_or_file) {
             return cli::preset_named(name_or_file.string());
           }),
           py::arg("name_or_file"))
      .def_static("_parse", [](const std::string& text,
                               const std::string& source) { return parse_preset(text, source); })
      .def_readwrite("name", &Preset::name, "Its name.")
      .def_readwrite("note", &Preset::note, "A sentence for the reader; may be empty.")
      .def("__getitem__",
           [](const Preset& preset, const std::string& name) {
             return get_parameter(preset.atmosphere, parameter_named(preset, name));
           })
      .def("__setitem__", &set)
      .def("__contains__",
           [](const Preset& preset, const std::string& name) {
             return std::ranges::count(parameters_of(preset.atmosphere), name, &Parameter::name) >
                    0;
           })
      .def("__copy__", [](const Preset& preset) { return preset; })
      .def("__deepcopy__", [](const Preset& preset, const py::dict&) { return preset; })
      .def(
          "copy", [](const Preset& preset) { return preset; },
          "Another preset with the same values.")
      .def("parameters", &parameters_by_name,
           "Value, unit, bounds, prior and meaning of every parameter, by name.")
      .def("to_json", &preset_to_json, "The text of a preset file of version 2.")
      .def(
          "save",
          [](const Preset& preset, const std::filesystem::path& file) {
            write_file(file, preset_to_json(preset));
          },
          py::arg("file"), "Writes the preset; the file appears whole or not at all.")
      .def(py::pickle([](const Preset& preset) { return py::make_tuple(preset_to_json(preset)); },
                      [](const py::tuple& state) {
                        return parse_preset(state[0].cast<std::string>(), "pickled preset");
                      }))
      .def("__repr__", [](const Preset& preset) { return "<skyfit.Preset " + preset.name + ">"; });
}

}  // namespace skyfit::python
