// SPDX-License-Identifier: Apache-2.0
#include "model/tables/table_kernels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "model/numerics/clones.h"

namespace skyfit::kernels {
namespace {

typedef float Vector4 __attribute__((vector_size(16)));
typedef float Vector16 __attribute__((vector_size(64)));

constexpr std::size_t kChunk = 64;  // cells whose places are worked out together

}  // namespace

SKYFIT_CLONES
void mix(const float* __restrict low, const float* __restrict high, float part, std::size_t count,
         float* __restrict out) {
  for (std::size_t i = 0; i < count; ++i) out[i] = low[i] + part * (high[i] - low[i]);
}

SKYFIT_CLONES
void add_source(const float* __restrict low, const float* __restrict high, float part,
                const float* __restrict factor, std::size_t suns, std::size_t own,
                std::size_t blocks, float* __restrict out) {
  float near[16], far[16];
  for (std::size_t i = 0; i < 16; ++i) {
    near[i] = (1 - part) * factor[i / 4];
    far[i] = part * factor[i / 4];
  }
  for (std::size_t j = 0; j < suns; ++j, out += 16 * blocks) {
    for (std::size_t b = 0; b < own; ++b, low += 16, high += 16) {
      for (std::size_t i = 0; i < 16; ++i) out[16 * b + i] += near[i] * low[i] + far[i] * high[i];
    }
  }
}

SKYFIT_CLONES
void add_node(const TableNode& node, const float* __restrict mu_s, const float* __restrict nu,
              std::size_t cells, float* __restrict single, float* __restrict multiple) {
  const std::size_t kinds = node.kinds;
  const float sun_steps = static_cast<float>(node.sun_step_count - 1) / (1 - node.lowest);
  const float beam_steps = static_cast<float>(node.beam_count - 1) / (1 - node.lowest);
  const auto last_beam = static_cast<int>(node.beam_count) - 2;
  const float view_sine2 = std::max(1 - node.mu * node.mu, 1e-12f);
  int sun_step[kChunk], beam_step[kChunk];
  float beam_part[kChunk], cosine[kChunk], lit[kChunk];
  for (std::size_t begin = 0; begin < cells; begin += kChunk) {
    const std::size_t count = std::min(kChunk, cells - begin);
    for (std::size_t i = 0; i < count; ++i) {
      const float angle = nu[begin + i];
      float sun = node.sun_factor * mu_s[begin + i] + node.nu_factor * angle;
      sun = sun < 1 ? sun : 1;
      const float sines2 = view_sine2 * (1 - sun * sun);
      float c = (angle - node.mu * sun) / std::sqrt(sines2 > 1e-14f ? sines2 : 1e-14f);
      c = c < 1 ? c : 1;
      cosine[i] = c > -1 ? c : -1;
      const float change = std::abs(node.step_nu * angle + node.step);
      const float share = 0.5f + (sun + node.horizon) / (change > 1e-6f ? change : 1e-6f);
      lit[i] = share > 0 ? (share < 1 ? share : 1) : 0;
      const float above = sun > node.lowest ? sun - node.lowest : 0;
      sun_step[i] = static_cast<int>(above * sun_steps + 0.5f);
      const float place = above * beam_steps;
      const int low = static_cast<int>(place);
      beam_step[i] = low < last_beam ? low : last_beam;
      beam_part[i] = place - static_cast<float>(beam_step[i]);
    }
    for (std::size_t i = 0; i < count; ++i) {
      Vector4 low, high, sum;
      std::memcpy(&low, node.beam + 4 * beam_step[i], sizeof low);
      std::memcpy(&high, node.beam + 4 * beam_step[i] + 4, sizeof high);
      low = lit[i] * (low + beam_part[i] * (high - low));
      float* to = single + 4 * kinds * (begin + i);
      for (std::size_t kind = 0; kind < kinds; ++kind, to += 4) {
        Vector4 weight;
        std::memcpy(&weight, node.single + 4 * kind, sizeof weight);
        std::memcpy(&sum, to, sizeof sum);
        sum += weight * low;
        std::memcpy(to, &sum, sizeof sum);
      }
    }
    if (node.source == nullptr) continue;
    for (std::size_t i = 0; i < count; ++i) {
      const SunStep& step = node.sun_steps[sun_step[i]];
      const float* from = node.source + static_cast<std::size_t>(step.first) * node.blocks * 16;
      const float c = cosine[i], c2 = c * c, c3 = c2 * c;
      const float wave = 8 * c2 * (c2 - 1) + 1;  // cos 4 phi
      Vector16 sum{}, later{};
      for (std::size_t b = node.blocks; b-- > 0;) {  // Clenshaw's recurrence over the blocks
        Vector16 term = (b > 0 ? 2 : 1) * wave * sum - later;
        for (std::size_t k = 0; k < 4; ++k) {
          Vector16 value;
          std::memcpy(&value, from + (k * node.blocks + b) * 16, sizeof value);
          term += step.weight[k] * value;
        }
        later = sum;
        sum = term;
      }
      const Vector16 powers = {1, c, c2, c3, 1, c, c2, c3, 1, c, c2, c3, 1, c, c2, c3};
      Vector16 before;
      float* to = multiple + 16 * (begin + i);
      std::memcpy(&before, to, sizeof before);
      before += sum * powers;
      std::memcpy(to, &before, sizeof before);
    }
  }
}

SKYFIT_CLONES
void store_cells(const float* __restrict single, std::size_t kinds,
                 const float* __restrict multiple, const float* __restrict phase, std::size_t cells,
                 float scale, float darkest, float* const* out) {
  for (std::size_t kind = 0; kind < kinds; ++kind) {
    float* const values = out[kind];
    for (std::size_t i = 0; i < cells; ++i) {
      for (std::size_t k = 0; k < 4; ++k)
        values[4 * i + k] = scale * single[4 * (kinds * i + kind) + k];
    }
  }
  for (std::size_t i = 0; i < cells; ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      const float* m = multiple + 16 * i + 4 * k;
      const float sum = m[0] + m[1] + m[2] + m[3];
      // The series of the diffuse field may swing below 0 where the field is dark.
      out[0][4 * i + k] += scale * std::max(sum, 0.0f) / phase[i];
    }
  }
  // log(m 2^e) = e log 2 + 2 atanh((m - 1) / (m + 1)), m about 1: to the last digits of a float.
  for (std::size_t kind = 0; kind < kinds; ++kind) {
    float* const values = out[kind];
    for (std::size_t i = 0; i < 4 * cells; ++i) {
      const float x = values[i] > darkest ? values[i] : darkest;
      const auto bits = std::bit_cast<std::int32_t>(x);
      const std::int32_t exponent = (bits - 0x3f3504f3) >> 23;  // of x / sqrt(1 / 2)
      const float m = std::bit_cast<float>(bits - exponent * (1 << 23));
      const float z = (m - 1) / (m + 1), z2 = z * z;
      const float series = 2 + z2 * (2.0f / 3 + z2 * (2.0f / 5 + z2 * (2.0f / 7 + z2 * 2.0f / 9)));
      values[i] = static_cast<float>(exponent) * 0.693147181f + z * series;
    }
  }
}

}  // namespace skyfit::kernels
