// SPDX-License-Identifier: Apache-2.0
#include "render/image/caption.h"

#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace skyfit {
namespace {

constexpr const char* kFont = "DejaVuSans";
constexpr int kLeastText = 8;  // pixels

using Lines = std::vector<std::string>;

Lines lines_of(const Caption& caption, bool one_line) {
  if (one_line) return {caption.name + " " + caption.value};
  return {caption.name, caption.value};
}

OIIO::ROI extent(const std::string& text, int size) {
  const OIIO::ROI roi = OIIO::ImageBufAlgo::text_size(text, size, kFont);
  if (!roi.defined())
    throw std::runtime_error("captions: no font \"DejaVu Sans\" (package fonts-dejavu-core)");
  return roi;
}

bool all_fit(std::span<const Caption> captions, bool one_line, int size) {
  return std::ranges::all_of(captions, [&](const Caption& caption) {
    return std::ranges::all_of(lines_of(caption, one_line), [&](const std::string& line) {
      return extent(line, size).width() <= caption.width - size / 2;
    });
  });
}

// 0: none fits.
int largest_that_fits(std::span<const Caption> captions, bool one_line, int most, int least) {
  for (int size = most; size >= least; --size)
    if (all_fit(captions, one_line, size)) return size;
  return 0;
}

}  // namespace

CaptionBand caption_band(std::span<const Caption> captions, int width, int height) {
  if (captions.empty()) return {};
  const int wanted = std::max(12, height / 16);
  // One line may be somewhat smaller than wanted before it becomes two.
  int size = largest_that_fits(captions, true, wanted, std::max(kLeastText, 2 * wanted / 3));
  const bool one_line = size > 0;
  if (!one_line) size = largest_that_fits(captions, false, wanted, kLeastText);
  if (size == 0) return {};

  const int line_height = size * 3 / 2, margin = size / 2;
  CaptionBand band;
  band.height = (one_line ? 1 : 2) * line_height + margin;
  OIIO::ImageBuf text(OIIO::ImageSpec(width, band.height, 3, OIIO::TypeDesc::UINT8));
  OIIO::ImageBufAlgo::zero(text);
  for (const Caption& caption : captions) {
    int baseline = margin / 2 + size;
    for (const std::string& line : lines_of(caption, one_line)) {
      const int left = caption.left + (caption.width - extent(line, size).width()) / 2;
      if (!OIIO::ImageBufAlgo::render_text(text, left, baseline, line, size, kFont))
        throw std::runtime_error("captions: " + text.geterror());
      baseline += line_height;
    }
  }
  band.rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(band.height));
  if (!text.get_pixels(text.roi(), OIIO::TypeDesc::UINT8, band.rgb.data()))
    throw std::runtime_error("captions: " + text.geterror());
  return band;
}

}  // namespace skyfit
