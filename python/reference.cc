// SPDX-License-Identifier: Apache-2.0
// Reference skies: shipped ones, measured ones, and those that Python makes of arrays.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <array>
#include <limits>

#include "cli/arguments.h"
#include "cli/inputs.h"
#include "data_refs/references.h"
#include "data_refs/units.h"
#include "python/bindings.h"
#include "python/interruptible.h"
#include "python/options.h"
#include "python/samples.h"

namespace skyfit::python {
namespace {

constexpr std::array kQuantities = {refs::Quantity::kLuminance, refs::Quantity::kRelativeLuminance,
                                    refs::Quantity::kSpectralRadiance};

refs::Quantity quantity_named(const std::string& name) {
  std::string known;
  for (const refs::Quantity quantity : kQuantities) {
    if (name == refs::quantity_name(quantity)) return quantity;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", refs::quantity_name(quantity));
  }
  throw std::invalid_argument(fmt::format("quantity = {}: expected one of {}", name, known));
}

// The options of reading, and where their values go.
struct ReadingOptions {
  std::string sampling = "principal", sun_zenith = "0:80:10";
  cli::ImportArguments import;

  explicit ReadingOptions(CLI::App& command) {
    cli::add_sampling_options(command, sampling, sun_zenith);
    cli::add_import_options(command, import);
  }
};

refs::Reference read(const std::string& names, const Options& options) {
  CLI::App command;
  const ReadingOptions arguments(command);
  parse(command, "read", options);
  return interruptible([&](const std::atomic<bool>&) {
    return cli::load_references(names, arguments.sun_zenith, arguments.sampling, arguments.import,
                                command);
  });
}

refs::Reference read_irradiances(const std::string& text, const Options& options) {
  CLI::App command;
  const ReadingOptions arguments(command);
  parse(command, "read_irradiances", options);
  return cli::load_irradiances(text, arguments.sun_zenith, arguments.import, command);
}

// Options of read() and the text of irradiances, in "irradiance".
struct IrradianceOptions : ReadingOptions {
  std::string irradiance;

  explicit IrradianceOptions(CLI::App& command) : ReadingOptions(command) {
    command.add_option("--irradiance", irradiance);
  }
};

refs::Reference with_irradiances(const refs::Reference& sky, const Options& options) {
  CLI::App command;
  const IrradianceOptions arguments(command);
  parse(command, "fit", options);
  return cli::load_with_irradiances(sky, arguments.irradiance, arguments.sun_zenith,
                                    arguments.import, command);
}

refs::Reference read_with_irradiances(const std::string& names, const Options& options) {
  CLI::App command;
  const IrradianceOptions arguments(command);
  parse(command, "fit", options);
  return interruptible([&](const std::atomic<bool>&) {
    return cli::load_with_irradiances(
        cli::load_references(names, arguments.sun_zenith, arguments.sampling, arguments.import,
                             command),
        arguments.irradiance, arguments.sun_zenith, arguments.import, command);
  });
}

// Arrays of one element a sample; sigma is NaN where none is stated.
refs::Reference reference_of(const std::string& name, const std::string& quantity,
                             const Input<double>& sun_zenith_deg,
                             const Input<double>& view_zenith_deg,
                             const Input<double>& relative_azimuth_deg,
                             const Input<double>& wavelength_nm, const Input<double>& value,
                             const Input<double>& sigma, const Input<double>& weight,
                             const Input<int>& scan, const Input<int>& direction) {
  refs::Reference reference;
  reference.name = name;
  reference.description = "samples from arrays";
  reference.quantity = quantity_named(quantity);
  for (py::ssize_t i = 0; i < value.size(); ++i) {
    refs::Sample sample;
    sample.sun_zenith = cli::radians(sun_zenith_deg.data()[i]);
    sample.view_zenith = cli::radians(view_zenith_deg.data()[i]);
    sample.relative_azimuth = cli::radians(relative_azimuth_deg.data()[i]);
    sample.wavelength_nm = wavelength_nm.data()[i];
    sample.value = value.data()[i];
    if (!std::isnan(sigma.data()[i])) sample.sigma = sigma.data()[i];
    sample.weight = weight.data()[i];
    if (sample.weight == 0) sample.zero_weight_reason = "weight 0 in the arrays";
    sample.scan = scan.data()[i];
    sample.direction = direction.data()[i];
    reference.samples.push_back(std::move(sample));
  }
  return reference;
}

}  // namespace

std::vector<std::string> reading_options() {
  CLI::App command;
  const ReadingOptions arguments(command);
  return keywords(command);
}

py::dict arrays_of(const refs::Reference& reference) {
  py::dict arrays;
  const auto add = [&](const char* name, const auto& of) {
    std::vector<std::decay_t<decltype(of(reference.samples.front()))>> values;
    values.reserve(reference.samples.size());
    for (const refs::Sample& sample : reference.samples) values.push_back(of(sample));
    arrays[name] = array_of(std::move(values));
  };
  using refs::Sample;
  add("sun_zenith_deg", [](const Sample& s) { return cli::whole_degrees(s.sun_zenith); });
  add("view_zenith_deg", [](const Sample& s) { return cli::whole_degrees(s.view_zenith); });
  add("relative_azimuth_deg",
      [](const Sample& s) { return cli::whole_degrees(s.relative_azimuth); });
  add("wavelength_nm", [](const Sample& s) { return s.wavelength_nm; });
  add("value", [](const Sample& s) { return s.value; });
  add("sigma",
      [](const Sample& s) { return s.sigma.value_or(std::numeric_limits<double>::quiet_NaN()); });
  add("weight", [](const Sample& s) { return s.weight; });
  add("scan", [](const Sample& s) { return s.scan; });
  if (refs::is_irradiance(reference.quantity) || reference.irradiance_quantity) {
    py::list names;
    for (const Sample& sample : reference.samples)
      names.append(sample.irradiance ? std::string(kIrradianceNames[*sample.irradiance]) : "");
    arrays["irradiance"] = py::module_::import("numpy").attr("array")(names);
  }
  return arrays;
}

void bind_reference(py::module_& module) {
  module.def(
      "reference_names",
      [] {
        std::vector<std::string> names;
        for (const refs::ReferenceEntry& entry : refs::shipped_references())
          names.push_back(entry.name);
        return names;
      },
      "Names of the standard skies, which read(name) gives.");
  module.def("read", &read);
  module.def("read_irradiances", &read_irradiances);
  module.def("with_irradiances", &with_irradiances);
  module.def("read_with_irradiances", &read_with_irradiances);
  module.def("reading_options", &reading_options);
  module.def("reference_of", &reference_of);
  py::class_<refs::Reference>(module, "Reference", "A reference sky: samples of it, in scans.")
      .def_readonly("name", &refs::Reference::name, "Its name, or the file.")
      .def_readonly("description", &refs::Reference::description, "One line, with the source.")
      .def_property_readonly(
          "quantity",
          [](const refs::Reference& reference) {
            return std::string(refs::quantity_name(reference.quantity));
          },
          "luminance (cd/m^2), relative luminance, spectral radiance (W m^-2 sr^-1 nm^-1), "
          "illuminance (lx) or irradiance (W m^-2 of all wavelengths).")
      .def_readonly("notes", &refs::Reference::notes,
                    "What the reader of a measured sky concluded or left out.")
      .def("_arrays", &arrays_of)
      .def("__len__", [](const refs::Reference& reference) { return reference.samples.size(); })
      .def("__repr__", [](const refs::Reference& reference) {
        return fmt::format("<skyfit.Reference {}: {} samples of {}>", reference.name,
                           reference.samples.size(), refs::quantity_name(reference.quantity));
      });
}

}  // namespace skyfit::python
