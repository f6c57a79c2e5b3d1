// SPDX-License-Identifier: Apache-2.0
// Rooms depend on each other one way only: no source includes and no library links what the table
// of rooms forbids, and the checker finds each kind of violation when there is one.
#include "room_rules.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "model/base/temporary_directory.h"

namespace skyfit::house {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(RoomRules, TheSourcesKeepThem) {
  EXPECT_THAT(include_violations(SKYFIT_SOURCE_DIR, room_rules()), IsEmpty());
}

TEST(RoomRules, TheLibrariesKeepThem) {
  EXPECT_THAT(link_violations(SKYFIT_ROOM_LINKS, room_rules()), IsEmpty());
}

TEST(RoomRules, EveryRoomHasSourcesToCheck) {
  for (const RoomRule& rule : room_rules())
    EXPECT_FALSE(room_sources(SKYFIT_SOURCE_DIR, rule, room_rules()).empty()) << rule.room;
}

// A small house in a directory of its own.
class BadHouse : public ::testing::Test {
 protected:
  fs::path write(const std::string& path, const std::string& text) const {
    fs::create_directories((top_ / path).parent_path());
    std::ofstream(top_ / path) << text;
    return top_ / path;
  }
  const TemporaryDirectory temporary_;
  const fs::path top_ = temporary_.path();
};

TEST_F(BadHouse, IncludesAreFound) {
  write("model/sky.cc",
        "#include <vector>\n#include <ceres/jet.h>\n#include \"fit/fit.h\"\n#include "
        "\"model/sky.h\"\n");
  write("model/shared/phase.glsl",
        "#include \"model/atmosphere/atmosphere.h\"\n#include \"model/shared/geometry.glsl\"\n");
  write("data_refs/cie.cc", "#  include \"fit/fit.h\"\n");
  write("fit/fit.cc", "#include <ceres/ceres.h>\n#include \"render/render.h\"\n");
  write("render/pass.cc",
        "#include <glm/glm.hpp>\n#include \"fit/fit.h\"\n#include \"../data_refs/cie.cc\"\n");
  write("render/plot/figure.cc", "#include <glad/gl.h>\n#include \"data_refs/samples.h\"\n");
  EXPECT_THAT(
      include_violations(top_, room_rules()),
      ElementsAre("model/shared/phase.glsl:1: includes model/atmosphere/atmosphere.h, which "
                  "model/shared may not use",
                  "model/sky.cc:2: includes ceres/jet.h, which model may not use",
                  "model/sky.cc:3: includes fit/fit.h, which model may not use",
                  "data_refs/cie.cc:1: includes fit/fit.h, which data_refs may not use",
                  "fit/fit.cc:2: includes render/render.h, which fit may not use",
                  "render/pass.cc:2: includes fit/fit.h, which render may not use",
                  "render/pass.cc:3: includes ../data_refs/cie.cc, which render may not use",
                  "render/plot/figure.cc:1: includes glad/gl.h, which render/plot may not use"));
}

TEST_F(BadHouse, LinksAreFound) {
  const fs::path links = write("links.txt",
                               "model skyfit_model fmt::fmt\n"
                               "model skyfit_model Ceres::ceres\n"
                               "model skyfit_model $<BUILD_INTERFACE:skyfit_warnings>\n"
                               "render skyfit_render $<BUILD_INTERFACE:skyfit::fit>\n"
                               "render/plot skyfit_plot skyfit::render\n");
  EXPECT_THAT(link_violations(links, room_rules()),
              ElementsAre("model: skyfit_model links Ceres::ceres, which it may not",
                          "render: skyfit_render links skyfit::fit, which it may not",
                          "render/plot: skyfit_plot links skyfit::render, which it may not"));
}

}  // namespace
}  // namespace skyfit::house
