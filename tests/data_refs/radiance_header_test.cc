// SPDX-License-Identifier: Apache-2.0
// The header of a Radiance picture is obeyed or refused: the eight orders of pixels give one
// picture, factors and primaries are read, a view is a fisheye of the zenith.
#include "data_refs/radiance_header.h"

#include <gmock/gmock.h>

#include <fstream>
#include <string>
#include <vector>

#include "complaint.h"

namespace skyfit::refs {
namespace {

using testing::HasSubstr;

RadianceHeader header_of(const std::string& variables, const std::string& size = "-Y 2 +X 3") {
  const std::string file = testing::TempDir() + "header.hdr";
  std::ofstream(file, std::ios::binary) << "#?RADIANCE\n"
                                        << variables << "FORMAT=32-bit_rle_rgbe\n\n"
                                        << size << "\n";
  return read_radiance_header(file);
}

Image one_channel(int width, int height, std::vector<float> pixels) {
  return {width, height, {"Y"}, std::move(pixels), {}};
}

// Of the picture  0 1 2
//                 3 4 5
TEST(RadianceHeader, EveryOrderOfPixelsGivesOnePicture) {
  const std::vector<float> expected = {0, 1, 2, 3, 4, 5};
  const auto pixels = [](const std::string& order, int width, int height, std::vector<float> p) {
    const Image image = upright(one_channel(width, height, std::move(p)), order);
    EXPECT_EQ(image.width, 3) << order;
    return image.pixels;
  };
  EXPECT_EQ(pixels("-Y +X", 3, 2, {0, 1, 2, 3, 4, 5}), expected);
  EXPECT_EQ(pixels("-Y -X", 3, 2, {2, 1, 0, 5, 4, 3}), expected);
  EXPECT_EQ(pixels("+Y +X", 3, 2, {3, 4, 5, 0, 1, 2}), expected);
  EXPECT_EQ(pixels("+Y -X", 3, 2, {5, 4, 3, 2, 1, 0}), expected);
  EXPECT_EQ(pixels("+X -Y", 2, 3, {0, 3, 1, 4, 2, 5}), expected);
  EXPECT_EQ(pixels("+X +Y", 2, 3, {3, 0, 4, 1, 5, 2}), expected);
  EXPECT_EQ(pixels("-X -Y", 2, 3, {2, 5, 1, 4, 0, 3}), expected);
  EXPECT_EQ(pixels("-X +Y", 2, 3, {5, 2, 4, 1, 3, 0}), expected);
}

TEST(RadianceHeader, FactorsAndPrimariesAreRead) {
  const RadianceHeader header = header_of(
      "EXPOSURE= 2\nEXPOSURE=3\nCOLORCORR= 1 2 4\nVIEW= -vta -vd 0 0 1\n\tVIEW= -vtv\n"
      "PRIMARIES= .64 .33 .3 .6 .15 .06 .3127 .329\n",
      "+X 3 -Y 2");
  EXPECT_EQ(header.exposure, 6);
  EXPECT_EQ(header.colour_correction[2], 4);
  EXPECT_EQ((*header.primaries)[0], 0.64f);
  EXPECT_EQ(header.order, "+X -Y");
  EXPECT_EQ(header.view, " -vta -vd 0 0 1");
  EXPECT_THAT(complaint_of([] { header_of("EXPOSURE=0\n"); }), HasSubstr("expected a number > 0"));
  EXPECT_THAT(complaint_of([] { header_of("PIXASPECT=2\n"); }), HasSubstr("square pixels"));
  EXPECT_THAT(complaint_of([] { header_of("", "2 3"); }), HasSubstr("expected the size"));
}

TEST(RadianceHeader, AViewIsObeyedOrRefused) {
  const ImportOptions facts = with_view({}, " -vta -vd 0 0 1 -vu 1 0 0 -vh 180 -vv 180", "a.hdr");
  EXPECT_EQ(facts.projection, "equidistant");
  EXPECT_NEAR(*facts.north_deg, 90, 1e-9);  // east is up and lies left of north: north is right
  const auto refusal = [](const std::string& view, const ImportOptions& stated = {}) {
    return complaint_of([&] { with_view(stated, view, "a.hdr"); });
  };
  EXPECT_THAT(refusal(" -vtv -vd 0 0 1"), HasSubstr("expected a fisheye"));
  EXPECT_THAT(refusal(" -vta -vd 0 1 0"), HasSubstr("expected a view of the zenith"));
  EXPECT_THAT(refusal(" -vta -vd 0.01 0 1 -vh 180 -vv 180"), HasSubstr("view of the zenith"));
  EXPECT_THAT(refusal(" -vta -vd 0 0 1 -vh 120"), HasSubstr("expected the whole sky"));
  EXPECT_THAT(refusal(" -vta -vd 0 0 1"), HasSubstr("expected the whole sky"));  // 45 deg of it
  ImportOptions stated;
  stated.projection = "equisolid";
  EXPECT_THAT(refusal(" -vta -vd 0 0 1 -vh 180 -vv 180", stated),
              HasSubstr("expected projection = equisolid"));
}

}  // namespace
}  // namespace skyfit::refs
