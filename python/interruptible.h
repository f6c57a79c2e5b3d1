// SPDX-License-Identifier: Apache-2.0
// Long work without Python's lock, in a thread of its own, so that the caller's thread hears
// Ctrl-C.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <future>

#include "model/sky_model.h"

namespace skyfit::python {

// What ends work that is not wanted any more. No std::exception, which a fit may take for a start
// that failed.
struct Interrupted {};

// Hands on to another model until `stop` is set, then throws Interrupted.
class InterruptibleModel : public SkyModel {
 public:
  InterruptibleModel(const SkyModel& model, const std::atomic<bool>& stop)
      : model_(model), stop_(stop) {}

  std::string_view name() const override { return model_.name(); }
  Transfer transfer() const override { return model_.transfer(); }
  bool refracts() const override { return model_.refracts(); }
  bool gives_stokes() const override { return model_.gives_stokes(); }
  bool can_fit(const Parameter& parameter) const override { return model_.can_fit(parameter); }
  int lobes() const override { return model_.lobes(); }
  Atmosphere<double> effective_atmosphere(const Atmosphere<double>& atmosphere) const override {
    return model_.effective_atmosphere(atmosphere);
  }
  SkyValues radiance(const Atmosphere<double>& atmosphere,
                     std::span<const WavelengthNode> wavelengths, std::span<const SkyPoint> points,
                     std::span<const Parameter> derivatives) const override {
    check();
    return model_.radiance(atmosphere, wavelengths, points, derivatives);
  }
  StokesValues stokes(const Atmosphere<double>& atmosphere,
                      std::span<const WavelengthNode> wavelengths, std::span<const SkyPoint> points,
                      std::span<const Parameter> derivatives) const override {
    check();
    return model_.stokes(atmosphere, wavelengths, points, derivatives);
  }
  ScatteredLight scattered_light(const Atmosphere<double>& atmosphere,
                                 std::span<const WavelengthNode> wavelengths,
                                 std::span<const SkyPoint> points) const override {
    check();
    return model_.scattered_light(atmosphere, wavelengths, points);
  }
  std::optional<SkyRayTables> sky_rays(
      const Atmosphere<double>& atmosphere,
      std::span<const WavelengthNode, 4> wavelengths) const override {
    check();
    return model_.sky_rays(atmosphere, wavelengths);
  }
  std::size_t prepare(const Atmosphere<double>& atmosphere,
                      std::span<const WavelengthNode> wavelengths) const override {
    check();
    return model_.prepare(atmosphere, wavelengths);
  }

 private:
  void check() const {
    if (stop_) throw Interrupted();
  }

  const SkyModel& model_;
  const std::atomic<bool>& stop_;
};

// The result of work(stop), where `stop` tells it to end soon by whatever exception. When a signal
// makes Python raise, such as KeyboardInterrupt, waits for that end and raises; the work's result
// is dropped. Called with Python's lock, which the work does not hold.
template <class Work>
auto interruptible(const Work& work) {
  constexpr auto kBetweenSignals = std::chrono::milliseconds(50);
  std::atomic<bool> stop = false;
  const pybind11::gil_scoped_release released;
  auto result = std::async(std::launch::async, [&] { return work(std::as_const(stop)); });
  while (result.wait_for(kBetweenSignals) != std::future_status::ready) {
    const pybind11::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() == 0) continue;
    const pybind11::error_already_set signal;
    stop = true;
    {
      const pybind11::gil_scoped_release waiting;
      result.wait();
    }
    throw signal;
  }
  return result.get();
}

}  // namespace skyfit::python
