// SPDX-License-Identifier: Apache-2.0
// Fits and comparisons, as `skyfit fit` and `skyfit compare` do them.
#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <variant>

#include "cli/compare_options.h"
#include "cli/fit_request.h"
#include "cli/light_check.h"
#include "cli/output.h"
#include "fit/result/report.h"
#include "python/bindings.h"
#include "python/interruptible.h"
#include "python/options.h"
#include "python/samples.h"

namespace skyfit::python {
namespace {

// With what to do instead, for a reference that was read before.
std::map<std::string, std::string> refused_options() {
  std::map<std::string, std::string> refused;
  for (const std::string& name : reading_options())
    refused.emplace(name, "expected as an option of read(), which made the reference");
  return refused;
}

cli::FinishedFit fit(const refs::Reference& reference, const std::optional<Preset>& preset,
                     const Options& options) {
  CLI::App command;
  cli::FitArguments arguments;
  cli::add_fit_options(command, arguments);
  cli::add_fit_model_options(command, arguments);
  parse(command, "fit", options, refused_options());
  arguments.start = preset;
  const cli::FitRequest request = cli::fit_request(arguments, reference, command);
  return interruptible([&](const std::atomic<bool>& stop) {
    return cli::finished_fit(request, InterruptibleModel(*request.model, stop));
  });
}

// [unknown] of the covariance.
std::vector<std::string> covariance_names(const fit::Result& result) {
  std::vector<std::string> names;
  for (const int u : result.covariance_unknowns)
    names.push_back(result.unknowns[static_cast<std::size_t>(u)].unknown.name());
  return names;
}

template <class Value>
py::dict by_unknown(const fit::Result& result, const Value& value) {
  py::dict values;
  for (const fit::UnknownRow& row : result.unknowns)
    values[py::str(row.unknown.name())] = value(row);
  return values;
}

py::dict fitted_samples(const fit::Result& result) {
  py::dict arrays = arrays_of(result.reference);
  arrays["model"] = array_of(std::vector<double>(result.model));
  arrays["start_model"] = array_of(std::vector<double>(result.start_model));
  arrays["sigma"] = array_of(std::vector<double>(result.sigma));
  return arrays;
}

struct Comparison {
  cli::CompareRequest request;
  std::vector<fit::ModelComparison> rows;
};

Comparison compare(const std::variant<std::string, refs::Reference>& reference,
                   const std::optional<Preset>& preset, const Options& options) {
  CLI::App command;
  cli::CompareOptions arguments;
  cli::add_compare_options(command, arguments);
  const auto* const name = std::get_if<std::string>(&reference);
  auto refused = name != nullptr ? std::map<std::string, std::string>{} : refused_options();
  refused["reference"] = "expected as the first argument alone";
  command.get_option("--reference")->required(false);
  parse(command, "compare", options, refused);
  if (name != nullptr) arguments.reference = *name;
  arguments.atmosphere = preset;
  return interruptible([&](const std::atomic<bool>& stop) {
    Comparison result;
    result.request = name != nullptr
                         ? cli::compare_request(arguments)
                         : cli::compare_request(arguments, std::get<refs::Reference>(reference));
    for (const std::string& model_name : result.request.models) {
      const auto model = cli::model_of(arguments, result.request, model_name);
      result.rows.push_back(
          cli::compare_with(arguments, result.request, InterruptibleModel(*model, stop), {}));
    }
    cli::check_light(result.rows);
    return result;
  });
}

// Per sample, with the scale of its scan.
py::array_t<double> model_values(const Comparison& comparison, const std::string& model,
                                 bool fitted) {
  for (const fit::ModelComparison& row : comparison.rows) {
    if (row.model != model) continue;
    const std::optional<fit::ModelErrors>& errors = fitted ? row.fitted : row.unfitted;
    if (errors) return array_of(std::vector<double>(errors->model));
    throw std::invalid_argument(fmt::format("{}: has no {} values{}{}", model,
                                            fitted ? "fitted" : "unfitted",
                                            row.problem.empty() ? "" : ": ", row.problem));
  }
  throw std::invalid_argument(fmt::format("{}: expected a model that was compared", model));
}

void bind_fit_result(py::module_& module) {
  using cli::FinishedFit;
  const auto matrix = [](Eigen::MatrixXd fit::Result::*member) {
    return [member](const FinishedFit& finished) { return finished.result.*member; };
  };
  py::class_<FinishedFit>(module, "Fit", "What a fit found.")
      .def_property_readonly(
          "parameters",
          [](const FinishedFit& finished) {
            return by_unknown(finished.result,
                              [](const fit::UnknownRow& row) { return row.fitted; });
          },
          "Value of every unknown by name, in the unit of `units`.")
      .def_property_readonly(
          "sigma",
          [](const FinishedFit& finished) {
            return by_unknown(finished.result,
                              [](const fit::UnknownRow& row) { return row.sigma; });
          },
          "One standard deviation of every unknown, priors included; NaN at a bound and where "
          "nothing holds the unknown.")
      .def_property_readonly(
          "units",
          [](const FinishedFit& finished) {
            return by_unknown(finished.result, [](const fit::UnknownRow& row) {
              return std::string(row.unknown.unit());
            });
          },
          "Unit of every unknown.")
      .def_property_readonly(
          "covariance_names",
          [](const FinishedFit& finished) { return covariance_names(finished.result); },
          "Unknowns of the rows and columns of `covariance` and `correlation`: those that are not "
          "at a bound.")
      .def_property_readonly("covariance", matrix(&fit::Result::covariance),
                             "Covariance in the units of `units`; empty when it is singular.")
      .def_property_readonly("correlation", matrix(&fit::Result::correlation),
                             "Correlation of the unknowns; empty when it is singular.")
      .def_property_readonly(
          "converged", [](const FinishedFit& finished) { return finished.result.converged; },
          "Whether the solver came to its end by itself.")
      .def_property_readonly(
          "termination", [](const FinishedFit& finished) { return finished.result.termination; },
          "The solver's word for why it ended.")
      .def_property_readonly(
          "wall_seconds", [](const FinishedFit& finished) { return finished.result.wall_seconds; },
          "How long the fit took.")
      .def_property_readonly(
          "preset", [](const FinishedFit& finished) { return finished.result.preset; },
          "The fitted atmosphere, with the record of its fit.")
      .def_property_readonly(
          "report",
          [](const FinishedFit& finished) {
            return fit::full_report(finished.result, finished.checks);
          },
          "The text of report.txt.")
      .def("_report_json",
           [](const FinishedFit& finished) {
             return cli::json_text(fit::report_json(finished.result, finished.checks));
           })
      .def("_samples", [](const FinishedFit& finished) { return fitted_samples(finished.result); })
      .def("__repr__", [](const FinishedFit& finished) {
        return "<skyfit.Fit " + fit::brief_report(finished.result) + ">";
      });
}

}  // namespace

void bind_fit(py::module_& module) {
  bind_fit_result(module);
  module.def("fit", &fit);
  py::class_<Comparison>(module, "Comparison", "Sky models against one reference.")
      .def_property_readonly(
          "models", [](const Comparison& comparison) { return comparison.request.models; },
          "The models that were compared.")
      .def_property_readonly(
          "preset", [](const Comparison& comparison) { return comparison.request.preset; },
          "The unfitted atmosphere.")
      .def_property_readonly(
          "reference", [](const Comparison& comparison) { return comparison.request.reference; },
          "What of the reference can be compared.")
      .def_property_readonly(
          "report",
          [](const Comparison& comparison) {
            return fit::comparison_text(comparison.request.reference, comparison.rows);
          },
          "The text of comparison.txt.")
      .def("_json",
           [](const Comparison& comparison) {
             return cli::json_text(
                 fit::comparison_json(comparison.request.reference, comparison.rows));
           })
      .def("values", &model_values, py::arg("model"), py::arg("fitted") = false,
           "Values of a model at the samples of `reference`, with the scale of their scan; NaN "
           "where a sample is not compared.")
      .def("__str__", [](const Comparison& comparison) {
        return fit::comparison_text(comparison.request.reference, comparison.rows);
      });
  module.def("compare", &compare);
}

}  // namespace skyfit::python
