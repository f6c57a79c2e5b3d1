// SPDX-License-Identifier: Apache-2.0
#include "render/image/caption.h"

#include <OpenImageIO/imagebufalgo.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace skyfit {
namespace {

constexpr const char* kFont = "DejaVuSans";
constexpr int kLeastText = 8;  // pixels

using Lines = std::vector<std::string>;

enum class Layout { kOneLine, kLineEach, kNameAboveValue };

Lines lines_of(std::span<const Caption> captions, Layout layout) {
  Lines lines;
  for (const auto& [name, value] : captions) {
    if (layout == Layout::kNameAboveValue) {
      lines.insert(lines.end(), {name, value});
    } else {
      lines.push_back(name + " " + value);
    }
  }
  if (layout == Layout::kOneLine) return {fmt::format("{}", fmt::join(lines, ", "))};
  return lines;
}

OIIO::ROI extent(const std::string& text, int size) {
  const OIIO::ROI roi = OIIO::ImageBufAlgo::text_size(text, size, kFont);
  if (!roi.defined())
    throw std::runtime_error("captions: no font \"DejaVu Sans\" (package fonts-dejavu-core)");
  return roi;
}

bool all_fit(std::span<const Lines> texts, int size, int width) {
  return std::ranges::all_of(texts, [&](const Lines& lines) {
    return std::ranges::all_of(lines, [&](const std::string& line) {
      return extent(line, size).width() <= width - size / 2;
    });
  });
}

// Of each frame; the size is 0 where none fits.
struct Text {
  std::vector<Lines> lines;
  int size;
};

Text largest_that_fits(std::span<const std::vector<Caption>> captions, Layout layout, int most,
                       int least, int width) {
  Text text{{}, most};
  for (const std::vector<Caption>& caption : captions)
    text.lines.push_back(lines_of(caption, layout));
  while (text.size >= least && !all_fit(text.lines, text.size, width)) --text.size;
  if (text.size < least) text.size = 0;
  return text;
}

Text layout_of(std::span<const std::vector<Caption>> captions, int width, int height) {
  const int wanted = std::max(12, height / 16);
  // Text may be somewhat smaller than wanted before it takes more lines.
  for (const Layout layout : {Layout::kOneLine, Layout::kLineEach}) {
    const int least = std::max(kLeastText, 2 * wanted / 3);
    Text text = largest_that_fits(captions, layout, wanted, least, width);
    if (text.size > 0) return text;
  }
  return largest_that_fits(captions, Layout::kNameAboveValue, wanted, kLeastText, width);
}

std::vector<std::uint8_t> drawn(const Lines& lines, int size, int width, int height) {
  OIIO::ImageBuf band(OIIO::ImageSpec(width, height, 3, OIIO::TypeDesc::UINT8));
  OIIO::ImageBufAlgo::zero(band);
  int baseline = size / 4 + size;
  for (const std::string& line : lines) {
    const int left = (width - extent(line, size).width()) / 2;
    if (!OIIO::ImageBufAlgo::render_text(band, left, baseline, line, size, kFont))
      throw std::runtime_error("captions: " + band.geterror());
    baseline += size * 3 / 2;
  }
  std::vector<std::uint8_t> rgb(3 * static_cast<std::size_t>(width) *
                                static_cast<std::size_t>(height));
  if (!band.get_pixels(band.roi(), OIIO::TypeDesc::UINT8, rgb.data()))
    throw std::runtime_error("captions: " + band.geterror());
  return rgb;
}

}  // namespace

CaptionBands caption_bands(std::span<const std::vector<Caption>> captions, int frame_width,
                           int frame_height) {
  const Text text = layout_of(captions, frame_width, frame_height);
  CaptionBands bands;
  bands.rgb.resize(captions.size());
  if (text.size == 0) return bands;
  std::size_t lines = 0;
  for (const Lines& of_frame : text.lines) lines = std::max(lines, of_frame.size());
  bands.height = static_cast<int>(lines) * (text.size * 3 / 2) + text.size / 2;
  for (std::size_t i = 0; i < captions.size(); ++i)
    bands.rgb[i] = drawn(text.lines[i], text.size, frame_width, bands.height);
  return bands;
}

}  // namespace skyfit
