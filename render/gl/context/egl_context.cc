// SPDX-License-Identifier: Apache-2.0
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>
#include <glad/gl.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "render/gl/context/context.h"

namespace skyfit {
namespace {

std::string error_name(EGLint error) {
  static constexpr std::array kNames = {
      "EGL_SUCCESS",       "EGL_NOT_INITIALIZED",     "EGL_BAD_ACCESS",
      "EGL_BAD_ALLOC",     "EGL_BAD_ATTRIBUTE",       "EGL_BAD_CONFIG",
      "EGL_BAD_CONTEXT",   "EGL_BAD_CURRENT_SURFACE", "EGL_BAD_DISPLAY",
      "EGL_BAD_MATCH",     "EGL_BAD_NATIVE_PIXMAP",   "EGL_BAD_NATIVE_WINDOW",
      "EGL_BAD_PARAMETER", "EGL_BAD_SURFACE",         "EGL_CONTEXT_LOST"};
  const auto index = static_cast<std::size_t>(error - EGL_SUCCESS);
  return index < kNames.size() ? kNames[index] : fmt::format("EGL error 0x{:04x}", error);
}

// Throws std::runtime_error "the function: the error" when the step failed.
void require(bool done, const char* function) {
  if (done) return;
  throw std::runtime_error(fmt::format("{}: {}", function, error_name(eglGetError())));
}

bool has(const char* extensions, std::string_view name) {
  const std::string padded = fmt::format(" {} ", extensions == nullptr ? "" : extensions);
  return padded.find(fmt::format(" {} ", name)) != std::string::npos;
}

template <class Function>
Function extension_function(const char* name) {
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

// A way to a display that needs no screen.
struct Way {
  std::string name;
  EGLenum platform;
  void* native;
  bool software;
};

std::vector<Way> ways() {
  constexpr EGLint kMost = 64;
  std::vector<Way> ways;
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const auto query_devices = extension_function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  const auto query_string =
      extension_function<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  if (has(extensions, "EGL_EXT_platform_device") && query_devices && query_string) {
    std::array<EGLDeviceEXT, kMost> devices{};
    EGLint count = 0;
    if (query_devices(kMost, devices.data(), &count) == EGL_FALSE) count = 0;
    for (EGLint i = 0; i < count; ++i) {
      const auto device = devices[static_cast<std::size_t>(i)];
      ways.push_back({fmt::format("EGL device {}", i), EGL_PLATFORM_DEVICE_EXT, device,
                      has(query_string(device, EGL_EXTENSIONS), "EGL_MESA_device_software")});
    }
    std::ranges::stable_partition(ways, [](const Way& way) { return !way.software; });
  }
  if (has(extensions, "EGL_MESA_platform_surfaceless")) {
    ways.push_back(
        {"EGL without surfaces", EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, true});
  }
  return ways;
}

// A display once initialised stays so until the process ends: EGL gives the same one to all who ask
// for it, and terminating it would end the contexts of others.
EGLDisplay open_display(const Way& way) {
  const auto get_display =
      extension_function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  require(get_display != nullptr, "eglGetPlatformDisplayEXT");
  const EGLDisplay display = get_display(way.platform, way.native, nullptr);
  require(display != EGL_NO_DISPLAY, "eglGetPlatformDisplayEXT");
  require(eglInitialize(display, nullptr, nullptr) == EGL_TRUE, "eglInitialize");
  return display;
}

class EglContext final : public GlContext {
 public:
  explicit EglContext(const Way& way) : parts_{open_display(way)} {
    require(eglBindAPI(EGL_OPENGL_API) == EGL_TRUE, "eglBindAPI");
    const std::array<EGLint, 5> wanted = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                          EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint found = 0;
    require(eglChooseConfig(parts_.display, wanted.data(), &config, 1, &found) == EGL_TRUE,
            "eglChooseConfig");
    if (found == 0)
      throw std::runtime_error("eglChooseConfig: nothing that draws OpenGL off screen");
    const std::array<EGLint, 7> version = {EGL_CONTEXT_MAJOR_VERSION,
                                           4,
                                           EGL_CONTEXT_MINOR_VERSION,
                                           5,
                                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                           EGL_NONE};
    parts_.context = eglCreateContext(parts_.display, config, EGL_NO_CONTEXT, version.data());
    require(parts_.context != EGL_NO_CONTEXT, "eglCreateContext");
    // No pass draws to it: with a surface, the extension for contexts without one is not needed.
    const std::array<EGLint, 5> size = {EGL_WIDTH, 4, EGL_HEIGHT, 4, EGL_NONE};
    parts_.surface = eglCreatePbufferSurface(parts_.display, config, size.data());
    require(parts_.surface != EGL_NO_SURFACE, "eglCreatePbufferSurface");
    bind();
    describe(way.name);
  }

  void make_current() override {
    try {
      bind();
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("render: {}", error.what()));
    }
  }

 private:
  void bind() {
    // Also when EGL believes it current: OSMesa may have taken its place.
    release_current_context();
    require(
        eglMakeCurrent(parts_.display, parts_.surface, parts_.surface, parts_.context) == EGL_TRUE,
        "eglMakeCurrent");
    if (gladLoadGL(eglGetProcAddress) == 0) {
      throw std::runtime_error("eglGetProcAddress: no functions of OpenGL");
    }
  }

  struct Parts {
    EGLDisplay display;
    EGLContext context = EGL_NO_CONTEXT;
    EGLSurface surface = EGL_NO_SURFACE;
    ~Parts() {
      if (context != EGL_NO_CONTEXT && eglGetCurrentContext() == context) release_current_context();
      if (surface != EGL_NO_SURFACE) eglDestroySurface(display, surface);
      if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
    }
  } parts_;
};

}  // namespace

std::unique_ptr<GlContext> make_egl_context() {
  std::string tried;
  for (const Way& way : ways()) {
    try {
      return std::make_unique<EglContext>(way);
    } catch (const std::runtime_error& error) {
      tried += fmt::format("{}{}: {}", tried.empty() ? "" : "; ", way.name, error.what());
    }
  }
  if (tried.empty()) tried = "EGL lists no device and has no platform without surfaces";
  throw std::runtime_error(fmt::format("render: --gpu: no OpenGL 4.5 core ({})", tried));
}

}  // namespace skyfit
