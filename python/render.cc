// SPDX-License-Identifier: Apache-2.0
// Frames, as `skyfit render` draws them. A frame's arrays are its own memory.
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <utility>

#include "cli/arguments.h"
#include "cli/light_check.h"
#include "cli/render_arguments.h"
#include "cli/render_options.h"
#include "cli/render_session.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/interruptible.h"
#include "python/options.h"

namespace skyfit::python {
namespace {

struct DrawnFrame {
  Frame frame;
  ToneOptions tone;  // of a PNG
  bool panels;       // beside a PNG
};

const std::map<std::string, std::string>& refused_options() {
  static const std::map<std::string, std::string> refused = [] {
    std::map<std::string, std::string> names;
    for (const char* name : {"sequence", "step_min", "frames", "frames_per_second", "out_dir",
                             "format", "adaptation_s", "strip"})
      names[name] = "expected in `skyfit render` alone: render() draws one frame";
    names["out"] = "expected in the save() of the frame";
    names["stats"] = "expected in `skyfit render` alone";
    names["preset"] = "expected as the first argument alone";
    return names;
  }();
  return refused;
}

DrawnFrame render(const Preset& preset, const Options& options) {
  CLI::App command;
  cli::RenderOptions arguments;
  cli::add_render_options(command, arguments);
  parse(command, "render", options, refused_options());
  arguments.start = preset;
  const cli::RenderRequest request = cli::frame_request(arguments, command);
  if (request.is_sequence)
    throw cli::UsageError("--time", arguments.time, "expected one time, HH:MM, for one frame");
  // The renderer belongs to the thread that works.
  return interruptible([&](const std::atomic<bool>&) {
    cli::TimeAccount time;
    cli::RenderSession session(request, cli::timeline_of(request.sequence), 0, time,
                               [](double, std::string_view) {});
    DrawnFrame drawn{session.draw(shot_at(request.sequence, 0, cli::sun_over), 0, {}), request.tone,
                     request.panels};
    cli::check_light(drawn.frame);
    return drawn;
  });
}

// The frame's own memory as [row][column] or [row][column][channel].
py::array_t<float> plane(const py::object& owner, const Frame& frame,
                         const std::vector<float>& values, int channels) {
  Shape shape = {frame.height, frame.width};
  if (channels > 1) shape.push_back(channels);
  return py::array_t<float>(shape, values.data(), owner);
}

template <std::vector<float> Frame::*kMember, int kChannels>
py::array_t<float> plane_of(const py::object& self) {
  const Frame& frame = self.cast<const DrawnFrame&>().frame;
  return plane(self, frame, frame.*kMember, kChannels);
}

py::dict layers_of(const py::object& self) {
  const Frame& frame = self.cast<const DrawnFrame&>().frame;
  py::dict arrays;
  if (const auto& light = frame.polarisation) {
    arrays["stokes_q"] = plane(self, frame, light->q, 1);
    arrays["stokes_u"] = plane(self, frame, light->u, 1);
    arrays["dolp"] = plane(self, frame, light->degree, 1);
    arrays["aolp"] = plane(self, frame, light->angle_deg, 1);
  }
  if (!frame.layers) return arrays;
  const FrameLayers& layers = *frame.layers;
  for (const auto& [name, values] :
       {std::pair<const char*, const std::vector<float>&>{"in_scatter", layers.in_scatter},
        {"reflected", layers.reflected},
        {"transmittance", layers.transmittance},
        {"normal", layers.normal},
        {"albedo", layers.albedo}})
    arrays[name] = plane(self, frame, values, 3);
  return arrays;
}

}  // namespace

void bind_render(py::module_& module) {
  module.def(
      "views",
      [] {
        std::map<std::string, std::string> rows;
        for (const NamedView& view : named_views()) rows.emplace(view.name, view.meaning);
        return rows;
      },
      "Name and meaning of every named view of render().");
  module.def("render", &render);
  py::class_<DrawnFrame>(module, "Frame",
                         "A frame: float32 arrays [row][column], row 0 at the top, without copies.")
      .def_property_readonly("rgb", &plane_of<&Frame::rgb, 3>,
                             "[row][column][3] linear light in the primaries, cd/m^2.")
      .def_property_readonly("luminance", &plane_of<&Frame::luminance, 1>, "cd/m^2.")
      .def_property_readonly("depth_m", &plane_of<&Frame::depth_m, 1>,
                             "Distance along the ray, m; infinite for sky.")
      .def_property_readonly("view_zenith_deg", &plane_of<&Frame::view_zenith_deg, 1>,
                             "Of the pixel's centre.")
      .def_property_readonly("view_azimuth_deg", &plane_of<&Frame::view_azimuth_deg, 1>,
                             "Relative to the sun, -180 to 180.")
      .def_property_readonly("layers", &layers_of,
                             "With layers=True: in_scatter and reflected (cd/m^2), transmittance, "
                             "normal, albedo; each [row][column][3]. With stokes=True: stokes_q "
                             "and stokes_u (cd/m^2), dolp and aolp (deg), each [row][column].")
      .def_property_readonly(
          "metadata", [](const DrawnFrame& drawn) { return drawn.frame.metadata; },
          "What an image file states: preset, sun, camera, version.")
      .def(
          "save",
          [](const DrawnFrame& drawn, const std::filesystem::path& file) {
            if (file.extension() != ".exr" && file.extension() != ".png")
              throw std::invalid_argument(
                  fmt::format("{}: expected a name that ends in .png or .exr", file.string()));
            const py::gil_scoped_release released;
            cli::write_frame_files(drawn.frame, {file}, drawn.tone, drawn.panels);
          },
          py::arg("file"),
          "Writes OpenEXR (.exr: linear cd/m^2, directions, depth) or PNG (.png: tone-mapped).")
      .def(
          "__array__",
          [](const py::object& self, const py::object& dtype) {
            const py::object array = plane_of<&Frame::rgb, 3>(self);
            return dtype.is_none() ? array : py::object(array.attr("astype")(dtype));
          },
          py::arg("dtype") = py::none())
      .def("__repr__", [](const DrawnFrame& drawn) {
        return fmt::format("<skyfit.Frame of {} x {} pixels>", drawn.frame.width,
                           drawn.frame.height);
      });
}

}  // namespace skyfit::python
