// SPDX-License-Identifier: Apache-2.0
// OSMesa and EGL draw the same picture, also in turn in one process, and where EGL has nothing one
// line says what was tried.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <stdexcept>

#include "tests/render/gl_fixture.h"

namespace skyfit {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr int kWidth = 64, kHeight = 32;

// A full-screen pass with a triangle's edges and interpolation, a discontinuity and functions of
// the library.
std::vector<float> small_picture() {
  static constexpr std::string_view kVertex =
      "out vec2 place;\nvoid main() {\n"
      "  place = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);\n"
      "  gl_Position = vec4(place, 0.5, 1.0);\n}\n";
  static constexpr std::string_view kFragment =
      "in vec2 place;\nout vec4 color;\nvoid main() {\n"
      "  float r = length(place);\n"
      "  color = vec4(exp(-r), step(r, 0.7), 0.5 + 0.5 * sin(9.0 * place.x), sqrt(r));\n}\n";
  const std::vector<ShaderSource> sources = {{"test.vert", kVertex}, {"test.frag", kFragment}};
  const GlProgram program = build_program(
      std::vector<ShaderStage>{{GL_VERTEX_SHADER, "test.vert"}, {GL_FRAGMENT_SHADER, "test.frag"}},
      sources);
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  const GlVertexArray corners(name);
  FrameGraph graph;
  graph.add_target("picture", GL_RGBA32F, kWidth, kHeight);
  graph.run(std::vector<Pass>{{"test", {}, {"picture"}, [&] {
                                 glUseProgram(program.id());
                                 glBindVertexArray(corners.id());
                                 glDrawArrays(GL_TRIANGLES, 0, 3);
                               }}});
  return graph.read_rows("picture", GL_RGBA, 4, 0, kHeight);
}

void expect_same(const std::vector<float>& a, const std::vector<float>& b) {
  ASSERT_EQ(a.size(), b.size());
  double difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) difference += std::abs(a[i] - b[i]);
  const double mean = std::accumulate(a.begin(), a.end(), 0.0);
  EXPECT_GT(mean, 0.3 * static_cast<double>(a.size()));
  EXPECT_LT(difference, 0.01 * mean);  // another device rounds and rasterises edges its own way
}

TEST(TwoContexts, DrawTheSamePicture) {
  const auto software = make_context(GraphicsDevice::kSoftware);
  const std::vector<float> expected = small_picture();
  const auto gpu = make_context(GraphicsDevice::kGpu);
  expect_same(expected, small_picture());
}

TEST(TwoContexts, TakeTurns) {
  const auto gpu = make_context(GraphicsDevice::kGpu);
  const std::vector<float> expected = small_picture();
  const auto software = make_context(GraphicsDevice::kSoftware);
  // An object of one context does not exist in the other.
  GLuint names[2] = {};
  glCreateBuffers(2, names);
  const GlBuffer first(names[0]), second(names[1]);
  for (int turn = 0; turn < 2; ++turn) {
    gpu->make_current();
    EXPECT_EQ(glIsBuffer(second.id()), GL_FALSE);
    expect_same(expected, small_picture());
    software->make_current();
    EXPECT_EQ(glIsBuffer(second.id()), GL_TRUE);
    expect_same(expected, small_picture());
  }
}

TEST(TwoContexts, OneEndsWithoutTheOther) {
  const auto gpu = make_context(GraphicsDevice::kGpu);
  const std::vector<float> expected = small_picture();
  { const auto another = make_context(GraphicsDevice::kGpu); }
  { const auto software = make_context(GraphicsDevice::kSoftware); }
  gpu->make_current();
  expect_same(expected, small_picture());
}

TEST(TwoContexts, AreCoreAndSayWhatTheyAre) {
  for (const GraphicsDevice device : {GraphicsDevice::kSoftware, GraphicsDevice::kGpu}) {
    const auto context = make_context(device);
    GLint major = 0, minor = 0, profile = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_MINOR_VERSION, &minor);
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    EXPECT_GE(10 * major + minor, 45);
    EXPECT_EQ(profile & GL_CONTEXT_CORE_PROFILE_BIT, GL_CONTEXT_CORE_PROFILE_BIT);
    EXPECT_THAT(context->description(),
                AllOf(HasSubstr(", OpenGL 4."),
                      HasSubstr(device == GraphicsDevice::kGpu ? ", by EGL " : ", by OSMesa")));
  }
}

// In a process of its own, which has not asked EGL for anything yet.
TEST(NoGpuDeathTest, IsOneLine) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto without_drivers = [] {
    setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "none.json", 1);
    try {
      make_context(GraphicsDevice::kGpu);
    } catch (const std::runtime_error& error) {
      std::fputs(error.what(), stderr);
      std::exit(std::string_view(error.what()).find('\n') == std::string_view::npos ? 3 : 4);
    }
    std::exit(0);
  };
  EXPECT_EXIT(without_drivers(), ::testing::ExitedWithCode(3),
              "^render: --gpu: no OpenGL 4.5 core \\(.+\\)$");
}

}  // namespace
}  // namespace skyfit
