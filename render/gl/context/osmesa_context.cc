// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <glad/gl.h>
// After glad, which replaces the system's OpenGL header.
#include <GL/osmesa.h>

#include <array>
#include <stdexcept>

#include "render/gl/context/context.h"

namespace skyfit {
namespace {

constexpr int kMajor = 4;
constexpr int kMinor = 5;

class OsMesaContext final : public GlContext {
 public:
  OsMesaContext() {
    const std::array<int, 15> attributes = {OSMESA_FORMAT,
                                            OSMESA_RGBA,
                                            OSMESA_DEPTH_BITS,
                                            0,
                                            OSMESA_STENCIL_BITS,
                                            0,
                                            OSMESA_ACCUM_BITS,
                                            0,
                                            OSMESA_PROFILE,
                                            OSMESA_CORE_PROFILE,
                                            OSMESA_CONTEXT_MAJOR_VERSION,
                                            kMajor,
                                            OSMESA_CONTEXT_MINOR_VERSION,
                                            kMinor,
                                            0};
    context_ = OSMesaCreateContextAttribs(attributes.data(), nullptr);
    if (context_ == nullptr) {
      throw std::runtime_error(
          fmt::format("render: OSMesa gives no OpenGL {}.{} core context", kMajor, kMinor));
    }
    try {
      make_current();
    } catch (...) {
      OSMesaDestroyContext(context_);
      throw;
    }
    describe("OSMesa");
  }

  ~OsMesaContext() override { OSMesaDestroyContext(context_); }

  void make_current() override {
    release_current_context();
    if (OSMesaMakeCurrent(context_, surface_.data(), GL_UNSIGNED_BYTE, kSide, kSide) == GL_FALSE) {
      throw std::runtime_error("render: OSMesa cannot make its context current");
    }
    if (gladLoadGL(reinterpret_cast<GLADloadfunc>(OSMesaGetProcAddress)) == 0) {
      throw std::runtime_error("render: the OpenGL functions cannot be loaded from OSMesa");
    }
  }

 private:
  static constexpr int kSide = 4;  // OSMesa wants a surface; no pass draws to it
  OSMesaContext context_ = nullptr;
  std::array<unsigned char, 4 * kSide * kSide> surface_{};
};

}  // namespace

std::unique_ptr<GlContext> make_osmesa_context() { return std::make_unique<OsMesaContext>(); }

}  // namespace skyfit
