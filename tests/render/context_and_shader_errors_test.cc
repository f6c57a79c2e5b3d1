// SPDX-License-Identifier: Apache-2.0
// The headless context is core 4.3 or later, and a broken shader is reported with its file and
// line.
#include <gmock/gmock.h>

#include <stdexcept>

#include "tests/render/gl_fixture.h"

namespace skyfit {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string error_of(std::string_view text, std::span<const ShaderSource> more = {}) {
  std::vector<ShaderSource> sources(more.begin(), more.end());
  sources.push_back({"broken.frag", text});
  try {
    build_program(std::vector<ShaderStage>{{GL_FRAGMENT_SHADER, "broken.frag"}}, sources);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Context, IsCoreAndHasComputeShaders) {
  const auto context = make_osmesa_context();
  GLint major = 0, minor = 0, profile = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
  EXPECT_GE(10 * major + minor, 43);
  EXPECT_EQ(profile & GL_CONTEXT_CORE_PROFILE_BIT, GL_CONTEXT_CORE_PROFILE_BIT);
}

TEST(Context, TwoInOneProcessDoNotDisturbEachOther) {
  const auto first = make_osmesa_context();
  { const auto second = make_osmesa_context(); }
  first->make_current();
  EXPECT_NE(glGetString(GL_VERSION), nullptr);
}

TEST(ShaderError, NamesFileLineAndTheDriversMessage) {
  const auto context = make_osmesa_context();
  const std::string message = error_of("out vec4 color;\nvoid main() {\n  color = missing;\n}\n");
  EXPECT_THAT(message, AllOf(StartsWith("broken.frag:3: "), HasSubstr("missing")));
}

TEST(ShaderError, NamesTheIncludedFile) {
  const auto context = make_osmesa_context();
  const ShaderSource part{"part.glsl", "\n\nfloat f() { return oops; }\n"};
  const std::string text =
      "#include \"part.glsl\"\nout vec4 color;\nvoid main() { color = vec4(f()); }\n";
  EXPECT_THAT(error_of(text, std::span(&part, 1)), StartsWith("part.glsl:3: "));
}

TEST(ShaderError, CountsLinesAfterAnInclude) {
  const auto context = make_osmesa_context();
  const ShaderSource part{"part.glsl", "float f() { return 1.0; }\n\n\n\n\n"};
  const std::string text =
      "#include \"part.glsl\"\nout vec4 color;\nvoid main() { color = nowhere; }\n";
  EXPECT_THAT(error_of(text, std::span(&part, 1)), StartsWith("broken.frag:3: "));
}

TEST(ShaderError, NamesAMissingInclude) {
  const auto context = make_osmesa_context();
  EXPECT_EQ(error_of("\n#include \"nowhere.glsl\"\n"),
            "broken.frag:2: no such shader source: nowhere.glsl");
}

}  // namespace
}  // namespace skyfit
