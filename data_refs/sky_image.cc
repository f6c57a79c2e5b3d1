// SPDX-License-Identifier: Apache-2.0
#include "data_refs/sky_image.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "data_refs/csv.h"
#include "data_refs/image_directions.h"
#include "data_refs/measured_sky.h"
#include "data_refs/radiance_header.h"
#include "data_refs/sky_bins.h"
#include "model/base/input_file.h"
#include "model/base/module_file.h"
#include "model/base/text.h"
#include "model/numerics/angles.h"

namespace skyfit::refs {
namespace {

constexpr double kDefaultBin_deg = 6;
constexpr std::string_view kExrMagic = "\x76\x2f\x31\x01",
                           kHdrMagic = "#?R";  // #?RADIANCE or #?RGBE

[[noreturn]] void fail(std::string_view source, const std::string& message) {
  throw std::invalid_argument(fmt::format("{}: {}", source, message));
}

// Channels of an image and their weights in its luminance.
struct LuminanceWeights {
  std::vector<std::size_t> channels;
  std::vector<double> weights;
  std::string name;
};

std::optional<std::size_t> channel(const Image& image, std::string_view name) {
  const auto found = std::ranges::find(image.channels, name);
  if (found == image.channels.end()) return {};
  return static_cast<std::size_t>(found - image.channels.begin());
}

// What the file says of itself and nobody may contradict.
void expect_as_stated(const Image& image, const ImportOptions& facts, std::string_view source) {
  constexpr std::string_view kPanorama = "equirectangular";
  if (!image.environment.empty() &&
      (image.environment != "LatLong Environment" || facts.projection != kPanorama))
    fail(source, fmt::format("envmap {}: expected {} and projection = {}",
                             in_quotes(image.environment), "LatLong Environment", kPanorama));
  if (image.white_luminance > 0 && image.white_luminance != 1 && !facts.calibration)
    fail(source,
         fmt::format("whiteLuminance {0:.6g}: expected calibration = {0:.6g} for pixels that are 1 "
                     "where white is, or 1 for pixels in cd m-2",
                     image.white_luminance));
}

// What Y of CIE XYZ weighs red, green and blue with, where white has 1 (SMPTE RP 177).
std::vector<double> weights_of(const Chromaticities& xy, std::string_view source) {
  Eigen::Matrix3d primaries;
  for (int c = 0; c < 3; ++c) {
    const double x = static_cast<double>(xy[2 * c]), y = static_cast<double>(xy[2 * c + 1]);
    primaries.col(c) << x, y, 1 - x - y;
  }
  const double x = static_cast<double>(xy[6]), y = static_cast<double>(xy[7]);
  const Eigen::Vector3d scale = primaries.fullPivLu().solve(Eigen::Vector3d(x, y, 1 - x - y) / y);
  const Eigen::Vector3d weights = primaries.row(1).transpose().cwiseProduct(scale);
  if (!weights.allFinite() || std::abs(weights.sum() - 1) > 1e-3)
    fail(source, fmt::format("chromaticities {}: expected those of three primaries and white",
                             fmt::join(xy, " ")));
  return {weights(0), weights(1), weights(2)};
}

constexpr Chromaticities kSrgb = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
constexpr Chromaticities kRadiance = {0.64f, 0.33f, 0.29f, 0.60f, 0.15f, 0.06f, 1 / 3.f, 1 / 3.f};

bool same(const Chromaticities& a, const Chromaticities& b) {
  constexpr float kRounded = 2e-3f;  // headers have three digits
  return std::ranges::equal(a, b, [](float x, float y) { return std::abs(x - y) < kRounded; });
}

LuminanceWeights luminance_weights(const Image& image, bool is_radiance_hdr,
                                   const ImportOptions& facts, std::string_view source) {
  if (const auto y = channel(image, "Y")) return {{*y}, {1}, "channel Y"};
  const auto red = channel(image, "R"), green = channel(image, "G"), blue = channel(image, "B");
  if (!red || !green || !blue)
    fail(source, fmt::format("channels {}: expected R, G and B, or Y",
                             excerpt(fmt::format("{}", fmt::join(image.channels, ", ")))));
  const std::vector<std::size_t> channels = {*red, *green, *blue};
  const std::string stated = facts.primaries.value_or(is_radiance_hdr ? "radiance" : "srgb");
  const Chromaticities& named = stated == "radiance" ? kRadiance : kSrgb;
  if (image.chromaticities && !same(*image.chromaticities, named)) {
    if (facts.primaries)
      fail(source, fmt::format("chromaticities {}: expected primaries = {}, as options or sidecar "
                               "state",
                               fmt::join(*image.chromaticities, " "), *facts.primaries));
    return {channels, weights_of(*image.chromaticities, source), "the file's primaries"};
  }
  if (stated == "radiance") return {channels, {0.265, 0.670, 0.065}, "Radiance's primaries"};
  return {channels, {0.2126, 0.7152, 0.0722}, "sRGB primaries"};
}

// Of a pixel's luminance, as `unit` and `lumen_per_watt` say.
struct PixelUnit {
  Unit unit;
  double factor;
};

PixelUnit pixel_unit(const ImportOptions& facts, std::string_view source) {
  const double calibration = facts.calibration.value_or(1);
  if (facts.lumen_per_watt.has_value() == facts.unit.has_value()) {
    fail(source, fmt::format("unit: expected either {} or lumen_per_watt (179 or 683) of pixels in "
                             "W m-2 sr-1, got {}",
                             unit_names({Quantity::kLuminance, Quantity::kRelativeLuminance}),
                             facts.unit ? "both" : "neither"));
  }
  if (facts.lumen_per_watt) return {*find_unit("cd m-2"), calibration * *facts.lumen_per_watt};
  return {stated_unit({}, facts, source, {Quantity::kLuminance, Quantity::kRelativeLuminance}),
          calibration};
}

// Adds the pixels of an image to bins.
class PixelReader {
 public:
  PixelReader(const Image& image, const Image* mask, const LuminanceWeights& weights, double factor,
              const ImportOptions& facts, const ScanSun& sun)
      : image_(image), mask_(mask), weights_(weights), factor_(factor), facts_(facts), sun_(sun) {}

  void read(const ImageDirections& directions, SkyBins& bins) const {
    for (int y = 0; y < image_.height; ++y) {
      for (int x = 0; x < image_.width; ++x) {
        const auto view = directions.view(x + 0.5, y + 0.5);
        if (!view) continue;
        const double luminance = luminance_of(x, y);
        bins.add({view->zenith, view->azimuth}, view->solid_angle_sr, luminance,
                 flaw_of(x, y, *view, luminance));
      }
    }
  }

 private:
  double luminance_of(int x, int y) const {
    const float* const pixel = image_.pixel(x, y);
    double sum = 0;
    for (std::size_t k = 0; k < weights_.channels.size(); ++k)
      sum += weights_.weights[k] * static_cast<double>(pixel[weights_.channels[k]]);
    return factor_ * sum;
  }

  std::string_view flaw_of(int x, int y, const PixelView& view, double luminance) const {
    if (mask_ != nullptr && mask_->pixel(x, y)[0] < 0.5f) return "masked";
    if (!std::isfinite(luminance)) return "not finite";
    if (facts_.saturation && brightest_channel(x, y) >= *facts_.saturation) return "saturated";
    if (!(luminance > 0)) return "not positive";
    Sample sample;
    sample.sun_zenith = sun_.zenith;
    sample.view_zenith = view.zenith;
    sample.relative_azimuth = view.azimuth - sun_.azimuth.value_or(0);
    if (facts_.near_sun_deg && scattering_angle(sample) < *facts_.near_sun_deg * kRadiansPerDegree)
      return "near the sun";
    return {};
  }

  double brightest_channel(int x, int y) const {
    const float* const pixel = image_.pixel(x, y);
    double brightest = 0;
    for (const std::size_t c : weights_.channels)
      brightest = std::max(brightest, static_cast<double>(pixel[c]));
    return brightest;
  }

  const Image& image_;
  const Image* mask_;
  const LuminanceWeights& weights_;
  double factor_;
  const ImportOptions& facts_;
  const ScanSun& sun_;
};

// What is not used and where the brightest used bin lies, for whoever checks the orientation.
void add_notes(const SkyBins& bins, const LuminanceWeights& weights, const ScanSun& sun,
               MeasuredSky& sky) {
  for (const auto& [flaw, share] : bins.shares_not_used())
    sky.note(fmt::format("{:.2g} % of the sky is not used: {}", 100 * share, flaw));
  const SkyBin brightest = bins.brightest();
  Sample sample;
  sample.sun_zenith = sun.zenith;
  sample.view_zenith = brightest.direction.view_zenith;
  sample.relative_azimuth = brightest.direction.relative_azimuth - sun.azimuth.value_or(0);
  sky.note(fmt::format("luminance from {}; the brightest bin is {:.0f} deg from the sun",
                       weights.name, scattering_angle(sample) * kDegreesPerRadian));
}

// Its first bytes.
std::string file_head(const std::filesystem::path& file) {
  std::string head(kExrMagic.size(), '\0');
  std::ifstream(file, std::ios::binary)
      .read(head.data(), static_cast<std::streamsize>(head.size()));
  return head;
}

// Scenes of Radiance may begin as its pictures do, which name a format.
bool has_pixels(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  for (std::string line; std::getline(in, line) && !line.empty();) {
    if (line.starts_with("FORMAT=")) return true;
  }
  return false;
}

}  // namespace

bool is_sky_image(const std::filesystem::path& file) {
  const std::string head = file_head(file);
  return head.starts_with(kExrMagic) || (head.starts_with(kHdrMagic) && has_pixels(file));
}

Reference sky_image_reference(const Image& image, const Image* mask, bool is_radiance_hdr,
                              const std::string& source, const ImportOptions& facts) {
  if (mask != nullptr && (mask->width != image.width || mask->height != image.height)) {
    fail(source, fmt::format("mask of {} x {} pixels: expected {} x {}", mask->width, mask->height,
                             image.width, image.height));
  }
  const auto directions = image_directions(facts, image.width, image.height, source);
  expect_as_stated(image, facts, source);
  const PixelUnit unit = pixel_unit(facts, source);
  const LuminanceWeights weights = luminance_weights(image, is_radiance_hdr, facts, source);
  const ScanSun sun = sun_of_scan(facts, source);
  SkyBins bins(facts.bin_deg.value_or(kDefaultBin_deg));
  PixelReader(image, mask, weights, unit.factor, facts, sun).read(*directions, bins);

  ImportOptions of_bins = facts;  // pixels are judged, bins need not be; directions are from north
  of_bins.saturation.reset();
  of_bins.near_sun_deg.reset();
  of_bins.azimuth_zero.reset();
  of_bins.azimuth_turns.reset();
  MeasuredSky sky(source, unit.unit, of_bins);
  sky.begin_scan(std::filesystem::path(source).filename().string(), sun);
  for (const SkyBin& bin : bins.result()) {
    Reading reading;
    reading.number = bin.number;
    reading.view_zenith_deg = bin.direction.view_zenith * kDegreesPerRadian;
    reading.view_azimuth_deg = bin.direction.relative_azimuth * kDegreesPerRadian;
    reading.value = bin.luminance;
    reading.flaw = bin.flaw;
    sky.add(reading);
  }
  add_notes(bins, weights, sun, sky);
  return sky.finish();
}

// A view of 180 by 180 deg has its zenith in the middle and the horizon at the edges.
void expect_view_fills(const Image& image, const ImportOptions& facts, std::string_view source) {
  if (image.width != image.height)
    fail(source, fmt::format("VIEW= of 180 x 180 deg in {} x {} pixels: expected a square picture",
                             image.width, image.height));
  const double middle = 0.5 * image.width;
  for (const auto& [name, stated] : {std::pair{"centre_x_px", facts.centre_x_px},
                                     {"centre_y_px", facts.centre_y_px},
                                     {"radius_px", facts.radius_px}}) {
    constexpr double kRounded = 0.75;
    if (stated && std::abs(*stated - middle) > kRounded)
      fail(source,
           fmt::format("{} = {:.6g}: expected {:.6g}, as VIEW= says", name, *stated, middle));
  }
}

// The picture as its header means it: upright, without exposure and colour correction.
Image as_radiance_means(Image image, const RadianceHeader& header, std::string_view source) {
  if (image.channels.size() < 3) fail(source, "expected three channels");
  image = upright(image, header.order);
  image.chromaticities = header.primaries;
  if (header.is_xyz) image.channels = {"X", "Y", "Z"};
  const std::size_t channels = image.channels.size();
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const std::size_t c = i % channels;
    if (c < 3) image.pixels[i] /= static_cast<float>(header.exposure * header.colour_correction[c]);
  }
  return image;
}

// A picture by Radiance of colours XYZE is coded as one of RGBE, which alone the library reads.
std::string as_rgbe(const std::filesystem::path& file) {
  std::string bytes = read_file(file, "an image", kMostImageBytes);
  constexpr std::string_view kXyze = "FORMAT=32-bit_rle_xyze", kRgbe = "FORMAT=32-bit_rle_rgbe";
  static_assert(kXyze.size() == kRgbe.size());
  bytes.replace(bytes.find(kXyze), kRgbe.size(), kRgbe);  // header.is_xyz says that it is there
  return bytes;
}

Image read_pixels(const std::filesystem::path& file, const std::string& bytes) {
  return module_named<ImageModule>("skyfit_image_module").read(file, bytes);
}

Image pixels_of(const std::filesystem::path& file) { return read_pixels(file, {}); }

Reference load_sky_image(const std::filesystem::path& file, const ImportOptions& options) {
  ImportOptions facts = options;
  const bool is_radiance_hdr = file_head(file).starts_with(kHdrMagic);
  RadianceHeader header;
  if (is_radiance_hdr) {
    header = read_radiance_header(file);
    facts = with_view(facts, header.view, file.string());
  }
  Image image = read_pixels(file, header.is_xyz ? as_rgbe(file) : "");
  if (header.is_xyz && facts.lumen_per_watt)
    fail(file.string(), "lumen_per_watt: pixels in XYZE are luminances, expected unit = cd m-2");
  if (is_radiance_hdr) image = as_radiance_means(std::move(image), header, file.string());
  if (!header.view.empty()) expect_view_fills(image, facts, file.string());
  std::optional<Image> mask;
  if (facts.mask) {
    require_regular_file(*facts.mask, "an image", kMostImageBytes);
    mask = pixels_of(*facts.mask);
  }
  return sky_image_reference(image, mask ? &*mask : nullptr, is_radiance_hdr, file.string(), facts);
}

}  // namespace skyfit::refs
