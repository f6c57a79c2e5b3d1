// SPDX-License-Identifier: Apache-2.0
// The bins of an image hold the mean luminance of the sky in it, in cd/m^2, toward the directions
// they name; what cannot be used is left out and said.
#include "data_refs/sky_image.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <string>

#include "complaint.h"
#include "data_refs/fisheye.h"
#include "data_refs/sky_bins.h"

namespace skyfit::refs {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::StartsWith;

constexpr double kPi = std::numbers::pi, kDegree = kPi / 180;
constexpr int kSide = 240;

ImportOptions facts() {
  ImportOptions result;
  result.projection = "equidistant";
  result.unit = "cd/m^2";
  result.sun_zenith_deg = 40;
  result.sun_azimuth_deg = 120;
  result.bin_deg = 12;
  return result;
}

// Grey pixels of a luminance that depends on the direction; 0 outside the sky.
Image image_of(const std::function<double(double zenith, double azimuth)>& luminance) {
  const Fisheye lens(facts(), kSide, kSide, "sky.exr");
  Image image{kSide, kSide, {"R", "G", "B"}, {}};
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const auto view = lens.view(x + 0.5, y + 0.5);
      const double value = view ? luminance(view->zenith, view->azimuth) : 0;
      image.pixels.insert(image.pixels.end(), 3, static_cast<float>(value));
    }
  }
  return image;
}

const Image kUniform = image_of([](double, double) { return 5000.0; });

Reference read(const Image& image, const ImportOptions& options, const Image* mask = nullptr) {
  return sky_image_reference(image, mask, false, "sky.exr", options);
}

TEST(SkyImage, OfAUniformSkyIsUniform) {
  constexpr double kFloat = 1e-6;
  for (const double bin_deg : {12.0, 6.0, 3.0}) {
    ImportOptions options = facts();
    options.bin_deg = bin_deg;
    const Reference sky = read(kUniform, options);
    EXPECT_EQ(sky.quantity, Quantity::kLuminance);
    for (const Sample& sample : sky.samples) EXPECT_NEAR(sample.value / 5000, 1, kFloat);
    EXPECT_GE(sky.samples.size(), 145u);
  }
}

// The mean over a bin of cos(zenith), and of a gradient in azimuth, is its value in the mean
// direction.
TEST(SkyImage, BinsLookWhereTheirLuminanceIsFrom) {
  constexpr double kCurvature = 0.01;
  const Image image = image_of([](double zenith, double azimuth) {
    return 1000 * (2 + std::cos(zenith) + std::sin(zenith) * std::sin(azimuth));
  });
  const Reference sky = read(image, facts());
  for (const Sample& sample : sky.samples) {
    const double azimuth = sample.relative_azimuth + 120 * kDegree;
    EXPECT_NEAR(sample.value / (1000 * (2 + std::cos(sample.view_zenith) +
                                        std::sin(sample.view_zenith) * std::sin(azimuth))),
                1, kCurvature);
  }
  // The centres are near those of the patches: rows from the horizon up, from north clockwise.
  EXPECT_NEAR(sky.samples[0].view_zenith / kDegree, 84, 1);
  EXPECT_NEAR(std::remainder(sky.samples[1].relative_azimuth / kDegree + 120 - 12, 360), 0, 1);
  EXPECT_NEAR(sky.samples[144].view_zenith / kDegree, 0, 1);
  ASSERT_EQ(sky.samples.size(), 145u);
  EXPECT_EQ(sky.samples[144].direction, 145);
}

// The same sky as a panorama, whole or of its upper half, north in its middle or elsewhere, seen
// from within or from without.
TEST(SkyImage, APanoramaShowsTheSameSky) {
  constexpr double kCurvature = 0.01;
  for (const bool whole : {true, false}) {
    for (const char* east : {"right", "left"}) {
      ImportOptions options = facts();
      options.projection = "equirectangular";
      options.north_deg = 70;
      if (east == std::string("left")) options.east = east;
      constexpr int kWidth = 360;
      Image image{kWidth, whole ? kWidth / 2 : kWidth / 4, {"R", "G", "B"}, {}};
      for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < kWidth; ++x) {
          const double zenith = (y + 0.5) * kDegree;
          const double right = (x + 0.5 - kWidth / 2 - 70) * kDegree;
          const double azimuth = east == std::string("left") ? -right : right;
          const double value =
              zenith < 90 * kDegree
                  ? 1000 * (2 + std::cos(zenith) + std::sin(zenith) * std::sin(azimuth))
                  : 1e5;
          image.pixels.insert(image.pixels.end(), 3, static_cast<float>(value));
        }
      }
      const Reference sky = read(image, options);
      ASSERT_EQ(sky.samples.size(), 145u);
      for (const Sample& sample : sky.samples) {
        const double azimuth = sample.relative_azimuth + 120 * kDegree;
        EXPECT_NEAR(sample.value / (1000 * (2 + std::cos(sample.view_zenith) +
                                            std::sin(sample.view_zenith) * std::sin(azimuth))),
                    1, kCurvature);
      }
    }
  }
}

TEST(SkyImage, APanoramaOfAnotherShapeWantsItsHorizon) {
  ImportOptions options = facts();
  options.projection = "equirectangular";
  EXPECT_THAT(complaint_of([&] { read(kUniform, options); }), HasSubstr("centre_y_px"));
  options.centre_y_px = 60;
  EXPECT_EQ(read(kUniform, options).samples.size(), 145u);
  options.radius_px = 100;
  EXPECT_THAT(complaint_of([&] { read(kUniform, options); }), HasSubstr("radius_px"));
}

TEST(SkyImage, LuminanceIsThatOfThePixelsUnit) {
  Image red = kUniform;
  for (std::size_t i = 0; i < red.pixels.size(); i += 3) red.pixels[i + 1] = red.pixels[i + 2] = 0;
  constexpr double kFloat = 1e-6;
  ImportOptions options = facts();
  const auto first = [&](const Image& image) { return read(image, options).samples[0].value; };
  EXPECT_NEAR(first(red) / (5000 * 0.2126), 1, kFloat);
  options.primaries = "radiance";
  EXPECT_NEAR(first(red) / (5000 * 0.265), 1, kFloat);
  options.calibration = 1.1;
  EXPECT_NEAR(first(kUniform) / (5000 * 1.1), 1, kFloat);
  options.unit = "kcd/m2";
  EXPECT_NEAR(first(kUniform) / (5e6 * 1.1), 1, kFloat);
  options.unit.reset();
  options.lumen_per_watt = 179;
  EXPECT_NEAR(first(kUniform) / (5000 * 1.1 * 179), 1, kFloat);
  Image luminance = kUniform;
  luminance.channels = {"A", "Y", "Z"};
  EXPECT_NEAR(first(luminance) / (5000 * 1.1 * 179), 1, kFloat);
}

TEST(SkyImage, SaturatedMaskedAndSunnyPixelsAreLeftOutAndSaid) {
  ImportOptions options = facts();
  options.saturation = 8000;
  options.near_sun_deg = 5;
  const Image image = image_of([](double zenith, double azimuth) {
    return zenith > 60 * kDegree && azimuth > 0 && azimuth < 40 * kDegree ? 9000.0 : 5000.0;
  });
  Image mask = image_of([](double zenith, double) { return zenith > 80 * kDegree ? 0.0 : 1.0; });
  const Reference sky = read(image, options, &mask);
  std::map<std::string, int> reasons;
  for (const Sample& sample : sky.samples) {
    EXPECT_EQ(sample.weight == 0, !sample.zero_weight_reason.empty());
    ++reasons[sample.zero_weight_reason];
    const double expected = sample.weight > 0 ? 5000 : sample.value;  // never a bright pixel
    EXPECT_NEAR(sample.value, expected, 0.01);
  }
  EXPECT_EQ(reasons["masked"], 30);  // of the lowest row 10 of 12 deg
  EXPECT_GE(reasons["saturated"], 3);
  EXPECT_THAT(sky.notes, Contains(StartsWith("17 % of the sky is not used: masked")));
  EXPECT_THAT(sky.notes, Contains(HasSubstr("% of the sky is not used: saturated")));
  EXPECT_THAT(sky.notes, Contains(HasSubstr("% of the sky is not used: near the sun")));
}

TEST(SkyImage, FaultsAreNamed) {
  const auto complaint = [](const ImportOptions& options, const Image& image = kUniform,
                            const Image* mask = nullptr) {
    return complaint_of([&] { read(image, options, mask); });
  };
  ImportOptions options = facts();
  options.unit.reset();
  EXPECT_EQ(complaint(options),
            "sky.exr: unit: expected either cd m-2, kcd m-2, relative or lumen_per_watt (179 or "
            "683) of pixels in W m-2 sr-1, got neither");
  options.unit = "cd/m2";
  options.lumen_per_watt = 179;
  EXPECT_THAT(complaint(options), HasSubstr("got both"));
  options = facts();
  options.unit = "W m-2 sr-1 nm-1";
  EXPECT_EQ(complaint(options),
            "sky.exr: unit = \"W m-2 sr-1 nm-1\": expected one of cd m-2, kcd m-2, relative");
  options = facts();
  options.sun_zenith_deg.reset();
  EXPECT_THAT(complaint(options), StartsWith("sky.exr: the sun is not known"));
  Image depth = kUniform;
  depth.channels = {"X", "Y2", "Z"};
  EXPECT_EQ(complaint(facts(), depth), "sky.exr: channels X, Y2, Z: expected R, G and B, or Y");
  const Image small{2, 2, {"Y"}, std::vector<float>(4, 1.0f)};
  EXPECT_EQ(complaint(facts(), kUniform, &small),
            "sky.exr: mask of 2 x 2 pixels: expected 240 x 240");
  EXPECT_EQ(complaint(facts(), image_of([](double, double) { return -1.0; })),
            "sky.exr: none of 145 samples can be used, expected at least 1: not positive");
}

// A file written by hand: 8 x 8 pixels of (0.5, 0.5, 0.5), times an exposure of 2 as it says.
TEST(SkyImage, RadianceFileIsReadAndItsExposureUndone) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "skyfit_sky.hdr";
  std::ofstream out(file, std::ios::binary);
  out << "#?RADIANCE\nEXPOSURE= 4\nEXPOSURE=0.5\nFORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 8\n";
  for (int i = 0; i < 64; ++i) out << std::string("\x80\x80\x80\x80", 4);  // 128/256 * 2^0
  out.close();
  ASSERT_TRUE(is_sky_image(file));
  ImportOptions options = facts();
  options.bin_deg = 30;
  options.unit.reset();
  options.lumen_per_watt = 179;
  const Reference sky = load_sky_image(file, options);
  constexpr double kSharedExponent = 0.005;  // half a step of 128
  EXPECT_NEAR(sky.samples[0].value / (179 * 0.5 / 2), 1, kSharedExponent);
  EXPECT_THAT(sky.notes.back(), StartsWith("luminance from Radiance's primaries"));
  std::ofstream(file, std::ios::binary) << "#?RADIANCE\nEXPOSURE=none\n\n-Y 8 +X 8\n";
  EXPECT_EQ(complaint_of([&] { load_sky_image(file, options); }),
            file.string() + ": \"EXPOSURE=none\": expected a number > 0");
  std::ofstream(file, std::ios::binary) << "#?RADIANCE\n\n-Y 8 +X 8\n";
  EXPECT_THAT(complaint_of([&] { load_sky_image(file, options); }),
              StartsWith(file.string() + ": cannot be read: "));
  std::filesystem::remove(file);
}

// The same picture in the file's other coding: X, Y, Z of 0.5, which are luminances.
TEST(SkyImage, RadianceFileOfXyzIsReadByItsY) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "skyfit_xyz.hdr";
  std::ofstream out(file, std::ios::binary);
  out << "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 8 +X 8\n";
  for (int i = 0; i < 64; ++i) out << std::string("\x20\x80\x40\x80", 4);
  out.close();
  ImportOptions options = facts();
  options.bin_deg = 30;
  EXPECT_NEAR(load_sky_image(file, options).samples[0].value, 0.5, 0.005);
  options.unit.reset();
  options.lumen_per_watt = 179;
  EXPECT_THAT(complaint_of([&] { load_sky_image(file, options); }),
              HasSubstr("lumen_per_watt: pixels in XYZE are luminances"));
  std::ofstream(file, std::ios::binary) << "#?RADIANCE\nFORMAT=float\n\n-Y 8 +X 8\n";
  EXPECT_THAT(complaint_of([&] { load_sky_image(file, options); }),
              HasSubstr("\"FORMAT=float\": expected 32-bit_rle_rgbe or 32-bit_rle_xyze"));
  std::filesystem::remove(file);
}

TEST(SkyImage, AViewOfRadianceFillsItsPicture) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "skyfit_view.hdr";
  std::ofstream out(file, std::ios::binary);
  out << "#?RADIANCE\nVIEW= -vta -vd 0 0 1 -vu 0 1 0 -vh 180 -vv 180\nFORMAT=32-bit_rle_rgbe\n\n"
         "-Y 8 +X 8\n";
  for (int i = 0; i < 64; ++i) out << std::string("\x80\x80\x80\x80", 4);
  out.close();
  ImportOptions options = facts();
  options.radius_px = 3;
  EXPECT_EQ(complaint_of([&] { load_sky_image(file, options); }),
            file.string() + ": radius_px = 3: expected 4, as VIEW= says");
  options.radius_px = 4;
  options.bin_deg = 30;
  EXPECT_EQ(complaint_of([&] { load_sky_image(file, options); }), "accepted");
  std::filesystem::remove(file);
}

// Of a file whose window of data is smaller than its picture the rest is not known.
TEST(SkyImage, OpenExrIsReadWithinItsDisplayWindow) {
  ImportOptions options = facts();
  options.accept_sun = true;
  const std::string data = SKYFIT_TEST_DATA;
  const Reference whole = load_sky_image(data + "/exr_whole.exr", options),
                  window = load_sky_image(data + "/exr_window.exr", options);
  int same = 0;
  for (const Sample& s : window.samples) {
    for (const Sample& w : whole.samples) {
      if (std::abs(w.view_zenith - s.view_zenith) > 1e-9 ||
          std::abs(w.relative_azimuth - s.relative_azimuth) > 1e-9 || !(s.weight > 0))
        continue;
      EXPECT_NEAR(s.value / w.value, 1, 0.05);  // of a bin at the edge only a part is known
      ++same;
    }
  }
  EXPECT_GT(same, 20);
  EXPECT_THAT(window.notes, Contains(HasSubstr("of the sky is not used: not finite")));
}

TEST(SkyImage, WhatAnOpenExrSaysOfItselfIsObeyedOrRefused) {
  const auto complaint_about = [](const std::string& name, const ImportOptions& options) {
    const std::string file = SKYFIT_TEST_DATA "/" + name;
    return complaint_of([&] { load_sky_image(file, options); });
  };
  EXPECT_THAT(complaint_about("exr_aspect.exr", facts()),
              HasSubstr("PixelAspectRatio 1.5: expected square pixels, 1"));
  EXPECT_THAT(complaint_about("exr_latlong.exr", facts()),
              HasSubstr("expected LatLong Environment and projection = equirectangular"));
  EXPECT_THAT(complaint_about("exr_white.exr", facts()),
              HasSubstr("whiteLuminance 100: expected calibration = 100"));
}

TEST(SkyBins, CoverTheSkyOnce) {
  for (const double bin_deg : {12.0, 30.0, 1.0}) {
    SkyBins bins(bin_deg);
    // A pixel in the middle of every bin is that bin's alone.
    const std::vector<SkyBin> empty = bins.result();
    for (const SkyBin& bin : empty) {
      EXPECT_EQ(bin.flaw, "no pixels");
      bins.add(bin.direction, 1, bin.number, {});
    }
    for (const SkyBin& bin : bins.result()) {
      EXPECT_EQ(bin.luminance, bin.number);
      EXPECT_EQ(bin.flaw, "");
    }
    EXPECT_EQ(bins.brightest().number, static_cast<int>(empty.size()));
  }
}

}  // namespace
}  // namespace skyfit::refs
