// SPDX-License-Identifier: Apache-2.0
// What is written is what is read: EXR channels, values and metadata; PNG without banding; whole
// files or none.
#include "render/image/image_files.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>
#include <stdexcept>

#include "model/base/temporary_directory.h"
#include "render/image/tone.h"

namespace skyfit {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

class ImageFiles : public ::testing::Test {
 protected:
  std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(directory_))
      names.insert(entry.path().filename().string());
    return names;
  }

  const TemporaryDirectory temporary_;
  const fs::path directory_ = temporary_.path();
};

// A smooth gradient, with a value outside the gamut and a sky pixel.
Frame gradient(int width, int height) {
  Frame frame;
  frame.width = width;
  frame.height = height;
  for (int i = 0; i < width * height; ++i) {
    const auto x = static_cast<float>(i % width) / static_cast<float>(width);
    const float luminance = 900 + 200 * x;
    frame.rgb.insert(frame.rgb.end(), {luminance, luminance, luminance});
    frame.luminance.push_back(luminance);
    frame.view_zenith_deg.push_back(90 * x);
    frame.view_azimuth_deg.push_back(-180 * x);
    frame.depth_m.push_back(1e6f * x);
  }
  frame.rgb[0] = -3.25f;
  frame.depth_m[1] = std::numeric_limits<float>::infinity();
  frame.metadata = {{"skyfit:preset", "{\"skyfit_preset\": 1}"}, {"skyfit:sun_zenith_deg", "60"}};
  return frame;
}

ToneOptions exposed(const Frame& frame) {
  ToneOptions tone;
  tone.exposure = metered_exposure(frame);
  return tone;
}

TEST_F(ImageFiles, ExrKeepsEveryChannelAndTheMetadata) {
  const Frame frame = gradient(32, 8);
  const fs::path file = directory_ / "frame.exr";
  write_exr_file(frame, file);
  EXPECT_THAT(files(), UnorderedElementsAre("frame.exr"));
  const auto input = OIIO::ImageInput::open(file.string());
  ASSERT_TRUE(input);
  const OIIO::ImageSpec& spec = input->spec();
  EXPECT_THAT(spec.channelnames, UnorderedElementsAre("R", "G", "B", "luminance.Y",
                                                      "view.zenith_deg", "view.azimuth_deg", "Z"));
  EXPECT_EQ(spec.format, OIIO::TypeDesc::FLOAT);
  EXPECT_EQ(spec.get_string_attribute("skyfit:preset"), "{\"skyfit_preset\": 1}");
  EXPECT_EQ(spec.get_string_attribute("skyfit:sun_zenith_deg"), "60");
  const auto* chromaticities = spec.find_attribute("chromaticities");
  ASSERT_NE(chromaticities, nullptr);
  EXPECT_FLOAT_EQ(static_cast<const float*>(chromaticities->data())[0], 0.64f);
  std::vector<float> pixels(static_cast<std::size_t>(spec.nchannels) * 32 * 8);
  ASSERT_TRUE(input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixels.data()));
  const auto channel = [&](std::size_t pixel, const char* name) {
    return pixels[pixel * spec.nchannels + spec.channelindex(name)];
  };
  for (std::size_t i = 0; i < frame.luminance.size(); ++i) {
    EXPECT_EQ(channel(i, "R"), frame.rgb[3 * i]);
    EXPECT_EQ(channel(i, "luminance.Y"), frame.luminance[i]);
    EXPECT_EQ(channel(i, "view.zenith_deg"), frame.view_zenith_deg[i]);
    EXPECT_EQ(channel(i, "view.azimuth_deg"), frame.view_azimuth_deg[i]);
    EXPECT_EQ(channel(i, "Z"), frame.depth_m[i]);
  }
}

TEST_F(ImageFiles, ExrSaysWhichPrimariesItsColoursHave) {
  Frame frame = gradient(4, 4);
  for (const Primaries primaries : {Primaries::kRec709, Primaries::kRec2020, Primaries::kXyz}) {
    frame.primaries = primaries;
    const fs::path file = directory_ / "frame.exr";
    write_exr_file(frame, file);
    const auto input = OIIO::ImageInput::open(file.string());
    const auto* attribute = input->spec().find_attribute("chromaticities");
    ASSERT_NE(attribute, nullptr);
    const auto* values = static_cast<const float*>(attribute->data());
    for (std::size_t i = 0; i < 8; ++i)
      EXPECT_EQ(values[i], color_space(primaries).chromaticities[i]);
  }
}

TEST_F(ImageFiles, ExrKeepsTheLayersUnderTheirNames) {
  Frame frame = gradient(16, 4);
  FrameLayers layers;
  // Every value of every layer is another one.
  float next = 1;
  for (std::vector<float>* layer : {&layers.in_scatter, &layers.reflected, &layers.direct,
                                    &layers.transmittance, &layers.normal, &layers.albedo}) {
    for (int i = 0; i < 3 * 16 * 4; ++i) layer->push_back(next += 0.5f);
  }
  frame.layers = layers;
  const fs::path file = directory_ / "layers.exr";
  write_exr_file(frame, file);
  const auto input = OIIO::ImageInput::open(file.string());
  ASSERT_TRUE(input);
  const OIIO::ImageSpec& spec = input->spec();
  EXPECT_THAT(
      spec.channelnames,
      UnorderedElementsAre("R", "G", "B", "luminance.Y", "view.zenith_deg", "view.azimuth_deg", "Z",
                           "inscatter.R", "inscatter.G", "inscatter.B", "reflected.R",
                           "reflected.G", "reflected.B", "direct.R", "direct.G", "direct.B",
                           "transmittance.R", "transmittance.G", "transmittance.B", "normal.X",
                           "normal.Y", "normal.Z", "albedo.R", "albedo.G", "albedo.B"));
  std::vector<float> pixels(static_cast<std::size_t>(spec.nchannels) * 16 * 4);
  ASSERT_TRUE(input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixels.data()));
  const auto expect_equal = [&](const std::vector<float>& values, const std::string& layer,
                                const std::string& suffixes) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const int channel = spec.channelindex(layer + suffixes[i % 3]);
      ASSERT_EQ(pixels[i / 3 * spec.nchannels + channel], values[i]) << layer << " value " << i;
    }
  };
  expect_equal(layers.in_scatter, "inscatter.", "RGB");
  expect_equal(layers.reflected, "reflected.", "RGB");
  expect_equal(layers.direct, "direct.", "RGB");
  expect_equal(layers.transmittance, "transmittance.", "RGB");
  expect_equal(layers.normal, "normal.", "XYZ");
  expect_equal(layers.albedo, "albedo.", "RGB");
}

std::vector<std::uint8_t> pixels_of(const fs::path& file, int& height) {
  const auto input = OIIO::ImageInput::open(file.string());
  height = input->spec().height;
  std::vector<std::uint8_t> bytes(3u * static_cast<std::size_t>(input->spec().width) *
                                  static_cast<std::size_t>(height));
  input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, bytes.data());
  return bytes;
}

// Each frame of a grid is the picture that it is alone, with its own exposure, and below it there
// is text, in it and not beside it.
TEST_F(ImageFiles, AGridHoldsItsFramesAndCaptionsBelowThem) {
  constexpr int kWidth = 150, kHeight = 60, kWhole = kWidth + kGridGap + kWidth;
  FrameGrid grid;
  grid.columns = 2;
  for (int i = 0; i < 4; ++i) {
    grid.frames.push_back(gradient(kWidth, kHeight));
    grid.captions.push_back({{"ground.albedo", "0.1"}, {"altitude", "2000 m"}});
    grid.tones.push_back({.exposure = 1e-4 * (i + 1)});
  }
  const fs::path file = directory_ / "grid.png";
  write_grid_file(grid, file);
  int height = 0;
  const std::vector<std::uint8_t> bytes = pixels_of(file, height);
  ASSERT_EQ(height % 2, 0);
  const int row_height = height / 2;
  ASSERT_GT(row_height, kHeight);
  for (int i = 0; i < 4; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const auto picture = tone_mapped(grid.frames[at], grid.tones[at]);
    const int left = i % 2 * (kWidth + kGridGap), top = i / 2 * row_height;
    int text_pixels = 0;
    for (int y = 0; y < row_height; ++y) {
      const auto* const row = bytes.data() + 3 * ((top + y) * kWhole + left);
      if (y < kHeight) {
        EXPECT_TRUE(std::equal(row, row + 3 * kWidth, picture.data() + 3 * y * kWidth)) << i;
      } else {
        text_pixels += static_cast<int>(
            std::count_if(row, row + 3 * kWidth, [](int value) { return value > 128; }));
      }
    }
    EXPECT_GT(text_pixels, 100) << i;
  }
  for (int y = 0; y < height; ++y)
    for (int x = kWidth; x < kWidth + kGridGap; ++x)
      EXPECT_EQ(bytes[static_cast<std::size_t>(3 * (y * kWhole + x))], 0);
}

TEST_F(ImageFiles, AGridTooNarrowForTextHasNone) {
  FrameGrid grid;
  grid.frames = {gradient(20, 60), gradient(20, 60)};
  grid.captions.assign(2, {{"ground.albedo", "0.1"}});
  grid.tones.assign(2, exposed(grid.frames[0]));
  int height = 0;
  write_grid_file(grid, directory_ / "grid.png");
  pixels_of(directory_ / "grid.png", height);
  EXPECT_EQ(height, 60 + kGridGap + 60);
}

TEST_F(ImageFiles, PngIsEightBitWithoutBands) {
  const Frame frame = gradient(256, 64);
  const fs::path file = directory_ / "frame.png";
  write_png_file(frame, file, exposed(frame));
  EXPECT_THAT(files(), UnorderedElementsAre("frame.png"));
  const auto input = OIIO::ImageInput::open(file.string());
  ASSERT_TRUE(input);
  EXPECT_EQ(input->spec().width, 256);
  EXPECT_EQ(input->spec().height, 64);
  EXPECT_EQ(input->spec().format, OIIO::TypeDesc::UINT8);
  // The mean of a column follows the gradient between the steps of 8 bits.
  const std::vector<std::uint8_t> bytes = tone_mapped(frame, exposed(frame));
  std::vector<double> mean(256, 0);
  for (std::size_t i = 0; i < 256 * 64; ++i) mean[i % 256] += bytes[3 * i + 1] / 64.0;
  EXPECT_GT(mean[255] - mean[0], 8);
  const double slope = (mean[255] - mean[0]) / 255;
  constexpr double kNoise = 0.45;  // of a mean of 64 dithered values, four sigma
  for (std::size_t x = 1; x < 255; ++x)
    EXPECT_NEAR(mean[x], mean[0] + slope * static_cast<double>(x), kNoise + 0.6);
}

TEST_F(ImageFiles, ToneCurveIsMonotoneAndExposureScales) {
  const Frame frame = gradient(64, 1);
  const double exposure = metered_exposure(frame);
  Frame brighter = frame;
  for (float& value : brighter.rgb) value *= 4;
  for (float& value : brighter.luminance) value *= 4;
  // A brighter scene is shown brighter, by a power of 0.15.
  EXPECT_NEAR(metered_exposure(brighter) / exposure, 0.25 * std::pow(4, 0.15), 1e-6);
}

TEST_F(ImageFiles, AFailureNamesTheFileAndLeavesNothing) {
  const Frame frame = gradient(8, 8);
  const fs::path file = directory_ / "missing" / "frame.exr";
  try {
    write_exr_file(frame, file);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr(file.string() + ": cannot be written: "));
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
  fs::create_directory(directory_ / "frame.png");  // a directory stands in the way
  EXPECT_THROW(write_png_file(frame, directory_ / "frame.png", exposed(frame)), std::runtime_error);
  EXPECT_THAT(files(), UnorderedElementsAre("frame.png"));
}

}  // namespace
}  // namespace skyfit
