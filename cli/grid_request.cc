// SPDX-License-Identifier: Apache-2.0
#include "cli/grid_request.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "cli/arguments.h"
#include "model/base/text.h"
#include "render/features/render_features.h"

namespace skyfit::cli {
namespace {

constexpr int kSteps = 5, kMostSteps = 64;

// An option whose values may stand along an axis.
struct AxisOption {
  std::string_view name, caption;
  std::string_view unit;         // of a number; empty for words
  bool another_session = false;  // another model, other tables or another planet
};
std::vector<AxisOption> listed_axis_options() {
  std::vector<AxisOption> rows = {
      {"view", "view", ""},
      {"latitude-deg", "latitude", "deg"},
      {"longitude-deg", "longitude", "deg"},
      {"altitude-m", "altitude", "m"},
      {"above-ground-m", "above ground", "m"},
      {"heading-deg", "heading", "deg"},
      {"azimuth-deg", "azimuth", "deg"},
      {"pitch-deg", "pitch", "deg"},
      {"view-zenith-deg", "view zenith", "deg"},
      {"field-of-view-deg", "field of view", "deg"},
      {"sun-zenith-deg", "sun zenith", "deg"},
      {"sun-azimuth-deg", "sun azimuth", "deg"},
      {"date", "date", ""},
      {"time", "time", ""},
      {"exposure", "exposure", "m^2/cd"},
      {"exposure-ev", "exposure", "EV"},
      {"tone", "tone curve", ""},
      {"view-transform", "view transform", ""},
      {"preset", "preset", "", true},
      {"model", "model", "", true},
      {"orders", "orders", "", true},
      {"table-size", "tables", "", true},
      {"table-precision", "tables", "", true},
  };
  for (const RenderFeature& feature : render_features()) {
    if (feature.caption.empty()) continue;
    const std::string_view name = feature.options.front().name;
    rows.push_back({name.substr(2), feature.caption, feature.limits ? feature.limits->unit : ""});
  }
  return rows;
}

const std::vector<AxisOption>& axis_rows() {
  static const std::vector<AxisOption> kRows = listed_axis_options();
  return kRows;
}

// A quantity of an axis, as it was typed.
struct TypedQuantity {
  std::string axis, text;                // "--rows", all that was typed after it
  const AxisOption* option = nullptr;    // or
  std::optional<Parameter> parameter{};  // of the preset
  GridQuantity quantity{};

  std::string at(std::size_t step) const { return quantity.name + "=" + quantity.values[step]; }
};
using TypedAxis = std::vector<TypedQuantity>;

constexpr std::string_view kForm =
    "expected NAME=LOW..HIGH, NAME=LOW..HIGH:N, NAME=LOW..HIGH:N:geometric or NAME=VALUE,VALUE,..";

double number_of(const TypedQuantity& typed, std::string_view text) {
  try {
    return parse_number(typed.axis, text);
  } catch (const UsageError& error) {
    throw UsageError(typed.axis, typed.text, fmt::format("\"{}\": {}", text, error.expected()));
  }
}

std::vector<std::string> numbers_of_range(const TypedQuantity& typed, const std::string& range) {
  const auto [low, rest] = parse_ends(typed.axis, range, kForm);
  const auto parts = split(rest, ':');
  double count = kSteps;
  Spacing spacing = Spacing::kEven;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    if (parts[i] == "geometric" && i + 1 == parts.size()) {
      spacing = Spacing::kGeometric;
    } else if (i == 1) {
      count = number_of(typed, parts[i]);
    } else {
      throw UsageError(typed.axis, typed.text, kForm);
    }
  }
  if (!(count >= 2 && count <= kMostSteps) || count != std::floor(count))
    throw UsageError(typed.axis, typed.text, fmt::format("expected 2 to {} frames", kMostSteps));
  const double first = number_of(typed, low), last = number_of(typed, parts[0]);
  if (spacing == Spacing::kGeometric && !(first * last > 0))
    throw UsageError(typed.axis, typed.text,
                     "expected both ends above 0, or both below, for geometric steps");
  std::vector<std::string> values;
  for (const double value : spaced(first, last, static_cast<int>(count), spacing))
    values.push_back(fmt::format("{:.9g}", value));
  return values;
}

std::vector<std::string> listed(const TypedQuantity& typed, const std::string& list, bool numbers) {
  std::vector<std::string> values;
  for (const std::string_view value : split(list, ',')) {
    if (trim(value).empty()) throw UsageError(typed.axis, typed.text, kForm);
    values.push_back(numbers ? fmt::format("{:.9g}", number_of(typed, value))
                             : std::string(trim(value)));
  }
  if (values.size() < 2 || values.size() > kMostSteps)
    throw UsageError(typed.axis, typed.text, fmt::format("expected 2 to {} values", kMostSteps));
  return values;
}

TypedQuantity parse_quantity(const std::string& axis, const std::string& text) {
  TypedQuantity typed{axis, text};
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) throw UsageError(axis, text, kForm);
  typed.quantity.name = trim(text.substr(0, equals));
  const auto option = std::ranges::find(axis_rows(), typed.quantity.name, &AxisOption::name);
  if (option != axis_rows().end()) {
    typed.option = &*option;
    typed.quantity.unit = option->unit;
    typed.quantity.caption = option->caption;
  } else if (typed.quantity.name.find('.') == std::string::npos) {
    throw UsageError(axis, text,
                     "expected the name of a parameter of the preset, or of " + axis_options());
  } else {
    typed.parameter = parse_parameters(axis, typed.quantity.name).front();
    typed.quantity.unit = parameter_info(*typed.parameter).unit;
    typed.quantity.caption = typed.quantity.name;
  }
  const std::string values = text.substr(equals + 1);
  const bool numbers = !typed.quantity.unit.empty();
  typed.quantity.values = numbers && values.find("..") != std::string::npos
                              ? numbers_of_range(typed, values)
                              : listed(typed, values, numbers);
  return typed;
}

TypedAxis parse_axis(const std::string& axis, const std::vector<std::string>& texts) {
  TypedAxis typed;
  for (const std::string& text : texts) {
    typed.push_back(parse_quantity(axis, text));
    const std::size_t steps = typed.back().quantity.values.size();
    const std::size_t expected = typed.front().quantity.values.size();
    if (steps != expected)
      throw UsageError(axis, text,
                       fmt::format("{} values: expected {}, as in {} {}", steps, expected, axis,
                                   typed.front().text));
  }
  return typed;
}

GridAxis quantities_of(const TypedAxis& typed) {
  GridAxis axis;
  for (const TypedQuantity& each : typed) axis.push_back(each.quantity);
  return axis;
}

// No quantity twice, nor beside the option that it stands for.
void check_names(const TypedAxis& typed, const CLI::App& command) {
  for (std::size_t i = 0; i < typed.size(); ++i) {
    const auto& [axis, text, option, parameter, quantity] = typed[i];
    for (std::size_t k = 0; k < i; ++k)
      if (typed[k].quantity.name == quantity.name)
        throw UsageError(axis, text, "expected each name once");
    const std::string name = "--" + quantity.name;
    if (option != nullptr && command.count(name) > 0)
      throw UsageError(name, command.get_option(name)->results().front(),
                       fmt::format("expected without {} {}", axis, text));
  }
}

// A quantity of either axis and its step.
struct Setting {
  const TypedQuantity* typed;
  std::size_t step;
};

// What was typed but the axes, and the settings of a cell.
std::vector<std::string> arguments_of(const CLI::App& command,
                                      const std::vector<Setting>& settings) {
  std::vector<std::string> arguments;
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_single_name();
    if (option->count() == 0 || name == "strip" || name == "rows" || name == "metering") continue;
    for (const std::string& value : option->results())
      arguments.push_back(fmt::format("--{}={}", name, value));
  }
  for (const auto& [typed, step] : settings)
    if (typed->option != nullptr) arguments.push_back("--" + typed->at(step));
  return arguments;
}

void set_parameters(const std::vector<Setting>& settings, Preset& preset) {
  std::vector<std::string> set;
  std::string axis;
  for (const auto& [typed, step] : settings) {
    if (!typed->parameter) continue;
    if (!has_parameter(preset.atmosphere, *typed->parameter))
      throw UsageError(typed->axis, typed->text,
                       fmt::format("expected a parameter that {} has", preset.name));
    set_parameter(preset.atmosphere, *typed->parameter,
                  number_of(*typed, typed->quantity.values[step]));
    axis = typed->axis;
    set.push_back(typed->at(step));
  }
  if (set.empty()) return;
  preset.fit = nullptr;
  try {
    validate(preset.atmosphere);
  } catch (const std::invalid_argument& error) {
    throw UsageError(axis, fmt::format("{}", fmt::join(set, ", ")), error.what());
  }
}

RenderRequest cell_request(const CLI::App& command, const std::vector<Setting>& settings) {
  CLI::App cell;
  RenderOptions cell_options;
  add_render_options(cell, cell_options);
  std::vector<std::string> arguments = arguments_of(command, settings);
  std::ranges::reverse(arguments);  // as CLI11 wants them
  try {
    cell.parse(arguments);
    RenderRequest request = frame_request(cell_options, cell);
    if (request.is_sequence)
      throw UsageError("--time", cell_options.time, "expected one time for a strip or a grid");
    set_parameters(settings, request.sequence.keyframes.front().preset);
    return request;
  } catch (const UsageError& error) {
    for (const auto& [typed, step] : settings)
      if (error.option() == "--" + typed->quantity.name)
        throw UsageError(typed->axis, typed->at(step), error.expected());
    throw;
  } catch (const CLI::ParseError& error) {
    // The rest was typed, and has been read before.
    throw UsageError(settings.front().typed->axis, settings.front().typed->text, error.what());
  }
}

std::string session_of(const std::vector<Setting>& settings) {
  std::string name;
  for (const auto& [typed, step] : settings)
    if (typed->option != nullptr && typed->option->another_session) name += typed->at(step) + ";";
  return name;
}

void check_size(const GridRequest& grid) {
  const FrameOptions& frame = grid.cells.front().frame;
  const auto side = [](std::size_t frames, int length) {
    return static_cast<long>(frames) * (length + kGridGap) - kGridGap;
  };
  const long width = side(steps_of(grid.columns), frame.width);
  const long height = side(steps_of(grid.rows), frame.height);
  if (width * height > kMaxImagePixels)
    throw UsageError(
        "--size", fmt::format("{}x{}", frame.width, frame.height),
        fmt::format("expected at most {} pixels together, {} x {} frames have {} x {}",
                    kMaxImagePixels, steps_of(grid.columns), steps_of(grid.rows), width, height));
}

}  // namespace

std::string axis_options() {
  std::vector<std::string_view> names;
  for (const AxisOption& option : axis_rows()) names.push_back(option.name);
  return fmt::format("{} or {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

GridRequest grid_request(const RenderOptions& options, const CLI::App& command) {
  for (const char* option : {"--sequence", "--panels", "--stokes"})
    if (command.count(option) > 0)
      throw UsageError(option, command.get_option(option)->results().front(),
                       "expected without --strip and --rows");
  const TypedAxis columns = parse_axis("--strip", options.strip);
  const TypedAxis rows = parse_axis("--rows", options.rows);
  TypedAxis both = columns;
  both.insert(both.end(), rows.begin(), rows.end());
  check_names(both, command);
  GridRequest grid;
  grid.columns = quantities_of(columns);
  grid.rows = quantities_of(rows);
  if (options.metering != "together" && options.metering != "each")
    throw UsageError("--metering", options.metering, "expected together or each");
  if (command.count("--metering") > 0 && command.count("--exposure") > 0)
    throw UsageError("--metering", options.metering, "expected without --exposure");
  grid.meters_together = options.metering == "together";
  for (std::size_t row = 0; row < steps_of(grid.rows); ++row) {
    for (std::size_t column = 0; column < steps_of(grid.columns); ++column) {
      std::vector<Setting> settings;
      for (const TypedQuantity& typed : columns) settings.push_back({&typed, column});
      for (const TypedQuantity& typed : rows) settings.push_back({&typed, row});
      grid.cells.push_back(cell_request(command, settings));
      grid.sessions.push_back(session_of(settings));
    }
  }
  check_size(grid);
  check_outputs(options, command, grid.cells.front());
  return grid;
}

}  // namespace skyfit::cli
