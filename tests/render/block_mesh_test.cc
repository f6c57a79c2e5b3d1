// SPDX-License-Identifier: Apache-2.0
// Blocks meet without seams: with neighbours of their level, over the edges of the cube too, and,
// once they have taken on the coarser shape, with neighbours of the coarser level.
#include "render/gl/terrain/block_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <set>

#include "render/gl/terrain/patches.h"
#include "tests/render/terrain_fixture.h"

namespace skyfit {
namespace {

constexpr double kFloat = 1.2e-7;  // of a position relative to the block's centre: two roundings
constexpr double kPacked = 2e-4;   // of a normal: 16 bit, three components
constexpr int kReflectance = 4;    // of 65535: it follows the slope

double tolerance_m(int level) { return 1e-3 + kFloat * block_arc_m(level, kEarth); }

glm::dvec3 normal_of(const std::array<std::int16_t, 4>& packed) {
  return glm::dvec3(packed[0], packed[1], packed[2]) / 32767.0;
}

// Column and row of the vertex i of the side: 0 bottom, 1 right, 2 top, 3 left, counterclockwise.
std::pair<int, int> on_side(int side, int i) {
  constexpr int n = kBlockQuads;
  switch (side) {
    case 0:
      return {i, 0};
    case 1:
      return {n, i};
    case 2:
      return {n - i, n};
    default:
      return {0, n - i};
  }
}

// The block of the same level across a side.
CubeBlock across(const CubeBlock& block, int side) {
  constexpr double kLittle = 1e-3;
  const std::array<std::pair<double, double>, 4> beyond = {
      {{0.5, -kLittle}, {1 + kLittle, 0.5}, {0.5, 1 + kLittle}, {-kLittle, 0.5}}};
  return block_at(block_direction(block, beyond[side].first, beyond[side].second), block.level);
}

// Calls f(own vertex, its neighbour's) for the vertices that lie in one direction from the centre
// of the planet. `stride` of the block's own vertices.
template <class F>
int for_shared_border(const CubeBlock& block, const CubeBlock& neighbour, int side, F&& f) {
  const MadeBlock& own = stored_block(block);
  const MadeBlock& other = stored_block(neighbour);
  int met = 0;
  for (int i = 0; i <= kBlockQuads; ++i) {
    const auto [column, row] = on_side(side, i);
    const glm::dvec3 direction = block_direction(block, static_cast<double>(column) / kBlockQuads,
                                                 static_cast<double>(row) / kBlockQuads);
    for (int s = 0; s < 4; ++s) {
      for (int j = 0; j < kBlockQuads; ++j) {
        const auto [c, r] = on_side(s, j);
        const glm::dvec3 there = block_direction(neighbour, static_cast<double>(c) / kBlockQuads,
                                                 static_cast<double>(r) / kBlockQuads);
        if (glm::distance(direction, there) * kEarth > 1e-5 * block_arc_m(block.level, kEarth))
          continue;
        f(own, own.at(column, row), other, other.at(c, r), i);
        ++met;
      }
    }
  }
  return met;
}

// Between vertices, where pixels find it, too: about straight within a quad.
TEST(Coast, IsWhereTheGroundHasIt) {
  // Water on one side of a plane through the centre, which runs aslant over the blocks.
  struct Shore final : Ground {
    glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, -0.8, 0.05));
    Elevation elevation(const glm::dvec3& direction, double) const override {
      return {0, 1e-3 * kEarth * glm::dot(normal, direction)};
    }
    NodeValues reflectance(const glm::dvec3&, double, double, double) const override { return {}; }
    std::optional<NodeValues> water_reflectance() const override { return std::nullopt; }
    double rock(const glm::dvec3&, double, double, double) const override { return 0; }
    double highest_m() const override { return 0; }
    void add_inputs(CacheKey&) const override {}
  };
  const Shore shore;
  const glm::dvec3 on_it = glm::normalize(glm::cross(shore.normal, glm::dvec3(0.2, 0.1, 0.9)));
  for (const int level : {2, 6, 11, 17}) {
    MadeBlock made;
    const CubeBlock block = block_at(on_it, level);
    made.vertices.resize(kBlockVertices);
    make_block(block, shore, kEarth, made.vertices);
    made.centre = block_centre(block, kEarth);
    const double quad = block_arc_m(level, kEarth) / kBlockQuads;
    int crossings = 0;
    double worst = 0;
    for (int row = 0; row <= kBlockQuads; ++row) {
      for (int column = 0; column < kBlockQuads; ++column) {
        for (const std::size_t shape : {0u, 1u}) {
          const BlockVertex &a = made.at(column, row), &b = made.at(column + 1, row);
          const double left = a.above_water[shape], right = b.above_water[shape];
          if ((left <= 0) == (right <= 0)) continue;
          const glm::dvec3 at =
              glm::mix(shape == 0 ? made.fine(a) : made.coarse(a),
                       shape == 0 ? made.fine(b) : made.coarse(b), left / (left - right));
          worst = std::max(worst, std::abs(glm::dot(shore.normal, at)) / quad);
          ++crossings;
        }
      }
    }
    std::printf("[  coast ] level %d: %d crossings, worst %.5f of a quad\n", level, crossings,
                worst);
    EXPECT_GT(crossings, kBlockQuads / 2);
    EXPECT_LT(worst, 0.01);
  }
}

TEST(Border, MeetsTheNeighbourOfTheSameLevel) {
  double worst_position = 0, worst_normal = 0;
  std::set<std::pair<int, int>> edges;  // of the cube that were crossed
  for (const int level : {1, 3, 6, 10, 14}) {
    for (int face = 0; face < 6; ++face) {
      const std::int64_t last = (std::int64_t{1} << level) - 1;
      // A block on each side of the face, and one within.
      const std::array<CubeBlock, 5> blocks = {{{face, level, last / 3, 0},
                                                {face, level, last, last / 3},
                                                {face, level, last / 3, last},
                                                {face, level, 0, last / 3},
                                                {face, level, last / 3, last / 3}}};
      for (int side = 0; side < 5; ++side) {
        const int toward = side % 4;
        const CubeBlock& block = blocks[static_cast<std::size_t>(side)];
        const CubeBlock neighbour = across(block, toward);
        const bool edge = neighbour.face != block.face;
        if (edge) edges.insert(std::minmax(block.face, neighbour.face));
        const int met = for_shared_border(
            block, neighbour, toward,
            [&](const MadeBlock& own, const BlockVertex& a, const MadeBlock& other,
                const BlockVertex& b, int i) {
              const double gap = std::max(glm::distance(own.fine(a), other.fine(b)),
                                          glm::distance(own.coarse(a), other.coarse(b)));
              EXPECT_LT(gap, tolerance_m(level)) << "level " << level << ", vertex " << i;
              worst_position = std::max(worst_position, gap / tolerance_m(level));
              const double turn =
                  std::max(glm::distance(normal_of(a.fine_normal), normal_of(b.fine_normal)),
                           glm::distance(normal_of(a.coarse_normal), normal_of(b.coarse_normal)));
              EXPECT_LT(turn, kPacked) << "level " << level << ", face " << block.face << ", side "
                                       << toward << ", vertex " << i;
              worst_normal = std::max(worst_normal, turn);
              for (std::size_t k = 0; k < 4; ++k)
                EXPECT_NEAR(a.fine_reflectance[k], b.fine_reflectance[k], kReflectance);
            });
        EXPECT_EQ(met, kBlockQuads + 1);
      }
    }
  }
  EXPECT_EQ(edges.size(), 12u);
  std::printf("[  worst ] gap %.2f of the tolerance, normals %.2g apart\n", worst_position,
              worst_normal);
}

TEST(Border, OfTheCoarseShapeIsThatOfTheCoarserNeighbour) {
  for (const int level : {2, 5, 9, 13}) {
    for (int face = 0; face < 6; ++face) {
      const std::int64_t last = (std::int64_t{1} << level) - 1;
      for (int side = 0; side < 4; ++side) {
        // Its parent's border is its own on this side.
        std::int64_t column = last / 3 & ~std::int64_t{1}, row = column;
        if (side == 0) row = 0;
        if (side == 1) column = last;
        if (side == 2) row = last;
        if (side == 3) column = 0;
        const CubeBlock block{face, level, column, row};
        const CubeBlock same = across(block, side);
        const CubeBlock coarser{same.face, same.level - 1, same.column / 2, same.row / 2};
        const MadeBlock& own = stored_block(block);
        const int met = for_shared_border(
            block, coarser, side,
            [&](const MadeBlock& mine, const BlockVertex& a, const MadeBlock& other,
                const BlockVertex& b, int i) {
              EXPECT_LT(glm::distance(mine.coarse(a), other.fine(b)), tolerance_m(level - 1))
                  << "level " << level << ", face " << face << ", side " << side << ", vertex "
                  << i;
            });
        EXPECT_EQ(met, kBlockQuads / 2 + 1);
        // The vertices between lie on the coarser neighbour's edges.
        for (int i = 1; i < kBlockQuads; i += 2) {
          const auto vertex = [&](int k) {
            const auto [c, r] = on_side(side, k);
            return own.coarse(own.at(c, r));
          };
          EXPECT_LT(glm::distance(vertex(i), 0.5 * (vertex(i - 1) + vertex(i + 1))),
                    tolerance_m(level));
        }
      }
    }
  }
}

TEST(CoarseShape, IsThatOfTheParent) {
  for (const int level : {1, 4, 8, 13}) {
    const CubeBlock block = block_at(glm::normalize(glm::dvec3(0.3, -0.5, 0.4)), level);
    const CubeBlock parent{block.face, level - 1, block.column / 2, block.row / 2};
    const MadeBlock& own = stored_block(block);
    const MadeBlock& parents = stored_block(parent);
    const int first_column = block.column % 2 == 0 ? 0 : kBlockQuads / 2,
              first_row = block.row % 2 == 0 ? 0 : kBlockQuads / 2;
    const auto at_parent = [&](int column, int row) {
      return parents.fine(parents.at(first_column + column, first_row + row));
    };
    for (int row = 0; row <= kBlockQuads; ++row) {
      for (int column = 0; column <= kBlockQuads; ++column) {
        const int c = column / 2, r = row / 2;
        // Odd vertices lie on the middles of the parent's edges; those of quads on the diagonal
        // from (1, 0) to (0, 1), along which its triangles meet.
        const bool odd_column = column % 2 != 0, odd_row = row % 2 != 0;
        glm::dvec3 expected = at_parent(c, r);
        if (odd_column && odd_row) {
          expected = 0.5 * (at_parent(c + 1, r) + at_parent(c, r + 1));
        } else if (odd_column) {
          expected = 0.5 * (at_parent(c, r) + at_parent(c + 1, r));
        } else if (odd_row) {
          expected = 0.5 * (at_parent(c, r) + at_parent(c, r + 1));
        }
        ASSERT_LT(glm::distance(own.coarse(own.at(column, row)), expected), tolerance_m(level - 1))
            << "level " << level << ", column " << column << ", row " << row;
      }
    }
  }
}

TEST(Vertices, StandOnTheRelief) {
  for (const int level : {0, 5, 12}) {
    const CubeBlock block = block_at(relief().coast().z, level);
    const MadeBlock& made = stored_block(block);
    const double resolution = 2 * block_arc_m(level, kEarth) / kBlockQuads;
    for (int row = 0; row <= kBlockQuads; row += 3) {
      for (int column = 0; column <= kBlockQuads; column += 3) {
        const glm::dvec3 p = made.fine(made.at(column, row));
        const glm::dvec3 up = glm::normalize(p);
        EXPECT_NEAR(glm::length(p) - kEarth, relief().height_m(up, resolution),
                    // The direction of a rounded position is another one.
                    tolerance_m(level) + 0.02 * tolerance_m(level));
        const glm::dvec3 normal = normal_of(made.at(column, row).fine_normal);
        EXPECT_NEAR(glm::length(normal), 1, kPacked);
        EXPECT_GT(glm::dot(normal, up), 0.05);
      }
    }
  }
}

TEST(Skirt, HangsBelowTheBorder) {
  for (const int level : {0, 5, 12}) {
    const MadeBlock& made = stored_block(block_at(relief().coast().z, level));
    for (int side = 0; side < 4; ++side) {
      for (int i = 0; i < kBlockQuads; ++i) {
        const auto [column, row] = on_side(side, i);
        const BlockVertex& border = made.at(column, row);
        const BlockVertex& below = made.vertices[static_cast<std::size_t>(kBlockSide * kBlockSide +
                                                                          side * kBlockQuads + i)];
        EXPECT_LT(glm::length(made.fine(below)), glm::length(made.fine(border)));
        EXPECT_LT(glm::length(made.coarse(below)), glm::length(made.coarse(border)));
        EXPECT_GE(glm::length(made.fine(below)), kEarth + made.heights.low - tolerance_m(level));
        EXPECT_EQ(below.fine_normal, border.fine_normal);
      }
    }
  }
}

// The triangles of a block, three vertices each, whose patches of the set are coarse.
std::vector<std::uint16_t> triangles_of(const PatchSet& coarse) {
  const auto& [indices, shapes] = block_indices();
  std::vector<std::uint16_t> all;
  for (std::size_t patch = 0; patch < kPatches; ++patch) {
    const auto& places = shapes[shape_of(patch, coarse)];
    all.insert(all.end(), indices.begin() + places[patch], indices.begin() + places[patch + 1]);
  }
  return all;
}

// No patch, one, all, and some of the patches.
const std::vector<PatchSet>& coarse_sets() {
  static const std::vector<PatchSet> made = [] {
    std::vector<PatchSet> sets(2);
    sets[1].set(27);
    std::mt19937 random(1);
    for (const double share : {0.1, 0.5, 0.9, 1.0}) {
      for (int i = 0; i < 4; ++i) {
        PatchSet& set = sets.emplace_back();
        for (std::size_t patch = 0; patch < kPatches; ++patch)
          set[patch] = std::bernoulli_distribution(share)(random);
      }
    }
    return sets;
  }();
  return made;
}

TEST(Triangles, FaceOutwardAndTheSkirtClosesTheBorder) {
  const MadeBlock& made = stored_block({2, 0, 0, 0});
  for (const PatchSet& coarse : coarse_sets()) {
    const std::vector<std::uint16_t> indices = triangles_of(coarse);
    ASSERT_EQ(indices.size() % 3, 0u);
    std::map<std::pair<int, int>, int> edges;
    for (std::size_t i = 0; i < indices.size(); i += 3) {
      const int a = indices[i], b = indices[i + 1], c = indices[i + 2];
      for (const auto& edge : {std::pair(a, b), {b, c}, {c, a}}) ++edges[edge];
      if (std::max({a, b, c}) >= kBlockSide * kBlockSide) continue;  // of the skirt
      const auto at = [&](int k) { return made.fine(made.vertices[static_cast<std::size_t>(k)]); };
      EXPECT_GT(glm::dot(glm::cross(at(b) - at(a), at(c) - at(a)), at(a)), 0);
    }
    // Every directed edge occurs once; those without an opposite are the skirt's lower border.
    int open = 0;
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1);
      if (edges.contains({edge.second, edge.first})) continue;
      ++open;
      EXPECT_GE(std::min(edge.first, edge.second), kBlockSide * kBlockSide);
    }
    int border = 0;
    constexpr std::size_t kLast = kPatchesPerSide - 1;
    for (std::size_t i = 0; i <= kLast; ++i) {
      for (const std::size_t patch :
           {i, kLast * kPatchesPerSide + i, i * kPatchesPerSide, i * kPatchesPerSide + kLast})
        border += coarse[patch] ? 2 : 4;
    }
    EXPECT_EQ(open, border);
  }
}

// Of the coarser shape, whose triangles a patch keeps that drops every second vertex.
TEST(Triangles, OfCoarsePatchesAreThoseOfTheCoarserShape) {
  const CubeBlock block{4, 7, 40, 90};
  const MadeBlock& made = stored_block(block);
  const auto at = [&](int column, int row) { return made.coarse(made.at(column, row)); };
  for (int row = 0; row <= kBlockQuads; ++row) {
    for (int column = 0; column <= kBlockQuads; ++column) {
      const int c = column % 2, r = row % 2;
      EXPECT_LT(
          glm::distance(at(column, row), 0.5 * (at(column + c, row - r) + at(column - c, row + r))),
          tolerance_m(block.level))
          << column << ", " << row;
    }
  }
  const std::size_t all = triangles_of({}).size();
  EXPECT_EQ(all, 6u * (kBlockQuads * kBlockQuads + 4 * kBlockQuads));
  PatchSet coarse;
  coarse.set();
  EXPECT_EQ(triangles_of(coarse).size(), 6u * (kBlockQuads * kBlockQuads / 4 + 2 * kBlockQuads));
  // A patch within others keeps what it shares with them: 16 of its 32 triangles.
  EXPECT_EQ(all - triangles_of(coarse_sets()[1]).size(), 3u * 16);
}

}  // namespace
}  // namespace skyfit
