// SPDX-License-Identifier: Apache-2.0
#include "render/image/silhouette.h"

#include <algorithm>
#include <utility>

namespace skyfit {
namespace {

// A picture or its transpose.
class Plane {
 public:
  Plane(std::span<const std::uint8_t> is_sky, int width, int height, bool transposed)
      : is_sky_(is_sky), width_(width), height_(height), transposed_(transposed) {}

  int width() const { return transposed_ ? height_ : width_; }
  int height() const { return transposed_ ? width_ : height_; }
  std::size_t sample(int x, int y) const {
    if (transposed_) std::swap(x, y);
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }
  // Between the rows y and y + 1: 1 with the sky above, -1 below, 0 none.
  int edge(int x, int y) const {
    if (x < 0 || x >= width() || y < 0 || y + 1 >= height()) return 0;
    return is_sky_[sample(x, y)] - is_sky_[sample(x, y + 1)];
  }

 private:
  std::span<const std::uint8_t> is_sky_;
  int width_, height_;
  bool transposed_;
};

// Where the line goes on beyond a run's end: 1 a row up, -1 a row down, 0 nowhere.
int step_at(const Plane& plane, int x, int y, int edge) {
  if (plane.edge(x, y - 1) == edge) return 1;
  if (plane.edge(x, y + 1) == edge) return -1;
  return 0;
}

// Columns first..last of one edge below row y. The line begins and ends half a row off where it
// steps, and is on the edge in the run's middle.
void add_run(const Plane& plane, int first, int last, int y, int edge,
             std::vector<SilhouetteSample>& found) {
  const double left = 0.5 * step_at(plane, first - 1, y, edge),
               right = 0.5 * step_at(plane, last + 1, y, edge);
  const double count = last - first + 1;
  for (int x = first; x <= last; ++x) {
    const double t = (x - first + 0.5) / count;
    const double above = t < 0.5 ? left * (1 - 2 * t) : right * (2 * t - 1);
    if (above > 0) found.push_back({plane.sample(x, y), plane.sample(x, y + 1), above});
    if (above < 0) found.push_back({plane.sample(x, y + 1), plane.sample(x, y), -above});
  }
}

// Whether there is an edge below each row, and beside each column. Most have none.
struct HasEdge {
  std::vector<std::uint8_t> below, beside;
};
HasEdge edges_of(std::span<const std::uint8_t> is_sky, int width, int height) {
  const auto columns = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
  HasEdge has{std::vector<std::uint8_t>(rows, 0), std::vector<std::uint8_t>(columns, 0)};
  for (std::size_t y = 0; y < rows; ++y) {
    const std::uint8_t* row = &is_sky[y * columns];
    has.below[y] = y + 1 < rows && !std::equal(row, row + columns, row + columns) ? 1 : 0;
    for (std::size_t x = 0; x + 1 < columns; ++x)
      has.beside[x] = static_cast<std::uint8_t>(has.beside[x] | (row[x] ^ row[x + 1]));
  }
  return has;
}

void add_runs(const Plane& plane, std::span<const std::uint8_t> has_edge,
              std::vector<SilhouetteSample>& found) {
  for (int y = 0; y + 1 < plane.height(); ++y) {
    if (has_edge[static_cast<std::size_t>(y)] == 0) continue;
    for (int x = 0; x < plane.width();) {
      const int edge = plane.edge(x, y), first = x++;
      if (edge == 0) continue;
      while (plane.edge(x, y) == edge) ++x;
      // Shorter ones are the steps of a steep line, whose runs are those of the transpose.
      if (x - first > 1) add_run(plane, first, x - 1, y, edge, found);
    }
  }
}

}  // namespace

std::vector<SilhouetteSample> silhouette(std::span<const std::uint8_t> is_sky, int width,
                                         int height) {
  std::vector<SilhouetteSample> found;
  const HasEdge has = edges_of(is_sky, width, height);
  add_runs(Plane(is_sky, width, height, false), has.below, found);
  add_runs(Plane(is_sky, width, height, true), has.beside, found);
  return found;
}

}  // namespace skyfit
