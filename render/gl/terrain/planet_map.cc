// SPDX-License-Identifier: Apache-2.0
#include "render/gl/terrain/planet_map.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <type_traits>
#include <typeinfo>
#include <vector>

#include "model/photometry/srgb_transfer.h"
#include "render/gl/terrain/color_reflectance.h"
#include "render/gl/terrain/cubic_spline.h"
#include "render/gl/terrain/map_file.h"
#include "render/gl/terrain/map_layout.h"

namespace skyfit {
namespace {

// Between what is stored and what it means: integers of colours are sRGB coded, 1 = their largest.
template <class T, int kChannels>
class Code {
 public:
  Code() {
    if constexpr (kCoded) {
      meaning_.resize(static_cast<std::size_t>(kLargest) + 1);
      for (std::size_t i = 0; i < meaning_.size(); ++i)
        meaning_[i] = static_cast<float>(srgb_decoded(static_cast<double>(i) / kLargest));
    }
  }
  double meaning(T stored) const {
    if constexpr (kCoded) {
      return meaning_[stored];
    } else {
      return stored;
    }
  }
  T stored(double meaning) const {
    if constexpr (std::is_floating_point_v<T>) return static_cast<T>(meaning);
    if constexpr (!kCoded) return static_cast<T>(std::lround(meaning));
    // The nearest meaning; a search in the table is faster than the formula.
    const auto above =
        std::lower_bound(meaning_.begin() + 1, meaning_.end() - 1, static_cast<float>(meaning));
    return static_cast<T>(above - meaning_.begin() - (meaning - above[-1] < *above - meaning));
  }

 private:
  static constexpr bool kCoded = std::is_integral_v<T> && kChannels == 3;
  static constexpr double kLargest = std::numeric_limits<T>::max();
  std::vector<float> meaning_;
};

template <class T>
struct Level {
  int rows = 0;
  std::vector<T> texels;  // [row][face][column][channel]
};

// Which texels of a row of `from` cover one of `to`, and by how much; their sum is 1.
struct Cover {
  Cover(int index, int from, int to) {
    constexpr double kNothing = 1e-9;  // left by rounding
    const double size = static_cast<double>(from) / to;
    const double begin = index * size, end = begin + size;
    first = static_cast<int>(begin + kNothing);
    for (int k = 0; k < 4; ++k) {
      const double inside = std::min(end, first + k + 1.0) - std::max(begin, first + k + 0.0);
      if (inside > kNothing) part[static_cast<std::size_t>(count++)] = inside / size;
    }
  }
  int first, count = 0;
  std::array<double, 4> part{};
};

template <class Layout, class T, int kChannels>
Level<T> half_as_fine(const Level<T>& fine, const Code<T, kChannels>& code) {
  Level<T> coarse;
  coarse.rows = fine.rows / 2;
  const int from = fine.rows * Layout::kColumnsPerRow, to = coarse.rows * Layout::kColumnsPerRow;
  coarse.texels.resize(static_cast<std::size_t>(coarse.rows) * to * Layout::kFaces * kChannels);
  tbb::parallel_for(0, coarse.rows, [&](int row) {
    const Cover down(row, fine.rows, coarse.rows);
    for (int column = 0; column < to; ++column) {
      const Cover along(column, from, to);
      for (int face = 0; face < Layout::kFaces; ++face) {
        std::array<double, kChannels> sum{};
        for (int y = 0; y < down.count; ++y) {
          const auto start =
              (static_cast<std::size_t>(down.first + y) * Layout::kFaces + face) * from;
          for (int x = 0; x < along.count; ++x) {
            const T* texel = &fine.texels[(start + along.first + x) * kChannels];
            for (std::size_t c = 0; c < kChannels; ++c)
              sum[c] += down.part[y] * along.part[x] * code.meaning(texel[c]);
          }
        }
        const auto at = (static_cast<std::size_t>(row) * Layout::kFaces + face) * to + column;
        for (std::size_t c = 0; c < kChannels; ++c)
          coarse.texels[at * kChannels + c] = code.stored(sum[c]);
      }
    }
  });
  return coarse;
}

// The mean of `width` texels around each one of a ring.
void smooth_ring(double width, std::vector<double>& ring) {
  const auto count = static_cast<std::ptrdiff_t>(ring.size());
  const auto reach = static_cast<std::ptrdiff_t>(0.5 * (width - 1));
  const double edge = 0.5 * (width - 1) - static_cast<double>(reach);
  const auto at = [&](std::ptrdiff_t i) {
    return ring[static_cast<std::size_t>((i + 2 * count) % count)];
  };
  std::vector<double> smooth(ring.size());
  double sum = 0;
  for (std::ptrdiff_t i = -reach; i <= reach; ++i) sum += at(i);
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    smooth[static_cast<std::size_t>(i)] =
        (sum + edge * (at(i - reach - 1) + at(i + reach + 1))) / width;
    sum += at(i + reach + 1) - at(i - reach);
  }
  ring = smooth;
}

// An equirectangular picture says more along a parallel near a pole than it does elsewhere, and at
// the pole contradicts itself. Beyond 60 degrees, details along a parallel become no finer than
// half a texel of the equator; the two rows that meet at a pole become one colour.
template <class T, int kChannels>
void smooth_poles(const Code<T, kChannels>& code, Level<T>& level) {
  const int columns = 2 * level.rows;
  tbb::parallel_for(0, level.rows, [&](int row) {
    const double width = 0.5 / std::sin(std::numbers::pi * (row + 0.5) / level.rows);
    const bool at_pole = row < 2 || row >= level.rows - 2;
    if (width <= 1 && !at_pole) return;
    T* texels = &level.texels[static_cast<std::size_t>(row) * columns * kChannels];
    std::vector<double> ring(static_cast<std::size_t>(columns));
    for (int c = 0; c < kChannels; ++c) {
      for (int i = 0; i < columns; ++i)
        ring[static_cast<std::size_t>(i)] = code.meaning(texels[i * kChannels + c]);
      if (at_pole) {
        const double mean = std::accumulate(ring.begin(), ring.end(), 0.0) / columns;
        std::ranges::fill(ring, mean);
      } else {
        smooth_ring(width, ring);
      }
      for (int i = 0; i < columns; ++i)
        texels[i * kChannels + c] = code.stored(ring[static_cast<std::size_t>(i)]);
    }
  });
}

template <class Layout, class T, int kChannels>
class SplineMap final : public PlanetMap {
 public:
  explicit SplineMap(const MapFile& file) {
    Level<T> finest{file.rows, {}};
    read_map(file, kChannels, finest.texels);
    if constexpr (kChannels == 1) {
      const auto [low, high] = std::ranges::minmax_element(finest.texels);
      darkest_ = static_cast<double>(*low);
      // A map of one value lies at the lowest height.
      if (*low < *high) range_ = static_cast<double>(*high) - darkest_;
    }
    add(std::move(finest));
    constexpr int kFewestRows = 4;
    while (levels_.back().rows / 2 >= kFewestRows) add(half_as_fine<Layout>(levels_.back(), code_));
  }

  double texel_angle() const override { return Layout::kAngle / levels_.front().rows; }

  void add_inputs(CacheKey& key) const override {
    const std::vector<T>& texels = levels_.front().texels;
    key.text(typeid(*this).name()).value(levels_.front().rows);
    key.text({reinterpret_cast<const char*>(texels.data()), texels.size() * sizeof(T)});
  }

  Sample at(const glm::dvec3& direction, double angle) const override {
    // The shortest wave between texels is two of them long.
    const double texel = 0.5 * angle;
    std::size_t fine = 0;
    while (fine + 1 < levels_.size() && texel_of(fine + 1) <= texel) ++fine;
    Sums sums = sums_of(levels_[fine], direction);
    const auto slope_of = [&](const Sums& of, std::size_t level) {
      return spline_slope(of.value[0], of.square) * texel_angle() / texel_of(level);
    };
    double slope = slope_of(sums, fine);
    if (fine + 1 < levels_.size() && texel > texel_of(fine)) {
      const Sums coarse = sums_of(levels_[fine + 1], direction);
      const double part =
          std::log(texel / texel_of(fine)) / std::log(texel_of(fine + 1) / texel_of(fine));
      slope = std::lerp(slope, slope_of(coarse, fine + 1), part);
      for (std::size_t c = 0; c < kChannels; ++c)
        sums.value[c] += part * (coarse.value[c] - sums.value[c]);
    }
    if constexpr (kChannels == 1) {
      return {{(sums.value[0] - darkest_) / range_, 0, 0}, slope / range_};
    } else {
      return {{sums.value[0], sums.value[1], sums.value[2]}, 0};
    }
  }

 private:
  struct Sums {
    std::array<double, kChannels> value{};
    double square = 0;  // of the first channel
  };

  double texel_of(std::size_t level) const { return Layout::kAngle / levels_[level].rows; }

  void add(Level<T> level) {
    if constexpr (std::is_same_v<Layout, EquirectangularLayout>) smooth_poles(code_, level);
    levels_.push_back(std::move(level));
  }

  Sums sums_of(const Level<T>& level, const glm::dvec3& direction) const {
    const int columns = level.rows * Layout::kColumnsPerRow;
    Sums sums;
    const auto add = [&](int face, int column, int row, double weight) {
      const auto at = (static_cast<std::size_t>(row) * Layout::kFaces + face) * columns + column;
      const T* texel = &level.texels[at * kChannels];
      const double first = code_.meaning(texel[0]);
      sums.square += weight * first * first;
      for (std::size_t c = 0; c < kChannels; ++c) sums.value[c] += weight * code_.meaning(texel[c]);
    };
    const MapPlaces places = Layout::places(direction, level.rows);
    for (int i = 0; i < places.count; ++i) {
      const MapPlace& place = places.place[static_cast<std::size_t>(i)];
      const CubicSpline along(place.u), down(place.v);
      for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 4; ++x) {
          const double weight = place.weight * along.weight[static_cast<std::size_t>(x)] *
                                down.weight[static_cast<std::size_t>(y)];
          Layout::texels(place.face, along.first + x, down.first + y, level.rows,
                         [&](int face, int column, int row, double part) {
                           add(face, column, row, weight * part);
                         });
        }
      }
    }
    return sums;
  }

  Code<T, kChannels> code_;
  std::vector<Level<T>> levels_;
  double darkest_ = 0, range_ = 1;
};

template <class T, int kChannels>
std::unique_ptr<PlanetMap> spline_map(const MapFile& file) {
  if (file.layout == MapLayout::kCube)
    return std::make_unique<SplineMap<CubeLayout, T, kChannels>>(file);
  return std::make_unique<SplineMap<EquirectangularLayout, T, kChannels>>(file);
}

}  // namespace

std::unique_ptr<PlanetMap> read_planet_map(const std::filesystem::path& file,
                                           PlanetMap::Values values) {
  const int channels = values == PlanetMap::Values::kHeights ? 1 : 3;
  const MapFile map = inspect_map(file, channels);
  if (channels == 1) {
    // A byte would not hold the means of the coarser copies.
    return map.type == TexelType::kFloat ? spline_map<float, 1>(map)
                                         : spline_map<std::uint16_t, 1>(map);
  }
  switch (map.type) {
    case TexelType::kByte:
      return spline_map<std::uint8_t, 3>(map);
    case TexelType::kShort:
      return spline_map<std::uint16_t, 3>(map);
    case TexelType::kFloat:
      break;
  }
  return spline_map<float, 3>(map);
}

}  // namespace skyfit
