// SPDX-License-Identifier: Apache-2.0
#include "model/scattering_tables.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/level_path.h"
#include "model/shared/shared.h"
#include "model/table_kernels.h"
#include "model/table_lookup.h"
#include "model/texel_rays.h"

namespace skyfit {
namespace {

Shared<double> shared;  // stateless

// Levels of a ray: those of the texels, which have a source, and others between them.
constexpr int kLevelsPerTexel = kSourceStep;

class ScatteringBuilder {
 public:
  ScatteringBuilder(const Shells& shells, const NodeOptics& optics, AtmosphereTables& tables)
      : shells_(shells),
        optics_(optics),
        tables_(tables),
        heights_(level_heights()),
        source_(shells, optics, heights_, kSourceStep) {
    set_cells();
    set_sun_steps();
    beam_.resize(heights_.size());
    tbb::parallel_for(0, static_cast<int>(heights_.size()), [&](int i) { set_beam(i); });
  }

  void build(const std::function<void(double)>& progress) {
    const TableSizes& s = tables_.sizes;
    const int rows = s.scattering_ground + s.scattering_sky;
    for (int r = 0; r < s.scattering_r; ++r) {
      tbb::parallel_for(0, rows, [&](int mu) { scatter(mu, r); });
      if (progress) progress((r + 1.0) / s.scattering_r);
    }
  }

 private:
  std::vector<double> level_heights() const {
    const int count = kLevelsPerTexel * (tables_.sizes.scattering_r - 1) + 1;
    std::vector<double> heights;
    for (int i = 0; i < count; ++i)
      heights.push_back(shared.height_from_unit(i / (count - 1.0), shells_.top));
    heights.back() = shells_.top;
    return heights;
  }

  void set_cells() {
    for (const TexelSun& sun : texel_suns(tables_.sizes)) {
      mu_s_.push_back(static_cast<float>(sun.mu_s));
      across_.push_back(static_cast<float>(sun.across));
    }
  }

  double sun_at(int step, int count) const {
    const double lowest = source_.suns().mu(source_.suns().size() - 1);
    return lowest + (1 - lowest) * step / (count - 1.0);
  }

  void set_sun_steps() {
    constexpr int kSteps = 16384;
    for (int i = 0; i < kSteps; ++i) {
      const int first =
          std::clamp(source_.suns().below(sun_at(i, kSteps)) - 2, 0, source_.suns().size() - 4);
      double zenith[4], weight[4];
      for (int j = 0; j < 4; ++j) zenith[j] = source_.suns().zenith(first + j);
      lagrange_weights(zenith, 4, std::acos(sun_at(i, kSteps)), weight);
      kernels::SunStep step{first, {}};
      for (std::size_t j = 0; j < 4; ++j) step.weight[j] = static_cast<float>(weight[j]);
      sun_steps_.push_back(step);
    }
  }

  // Single scattering keeps the true phase function under the cut extinction (TMS, see
  // model/optics.h).
  void set_beam(int level) {
    constexpr int kSteps = 1024;
    const double h = heights_[level], horizon = horizon_cosine(shells_.bottom_radius, h);
    for (int i = 0; i < kSteps; ++i) {
      const double mu_s = sun_at(i, kSteps), visible = visible_sun(shells_.bottom_radius, h, mu_s);
      PathColumns columns;
      if (visible > 0) columns = shells_.columns_to_top(h, std::max(mu_s, horizon));
      for (const Optics<0>& optics : optics_) {
        const double beam = visible > 0 ? visible * std::exp(-optics.optical_depth(columns).v) : 0;
        beam_[level].push_back(static_cast<float>(beam));
      }
    }
  }

  // What kernel nodes point to.
  struct Scratch {
    std::vector<float> source, beam;
  };

  kernels::TableNode kernel_node(const LevelNode& node, const RayPoint& sun_point,
                                 Scratch& scratch) const {
    kernels::TableNode out{};
    for (std::size_t k = 0; k < 4; ++k) {
      out.single[k] = static_cast<float>(optics_[k].air.v * node.beam.air[k]);
      out.single[4 + k] =
          static_cast<float>(optics_[k].aerosol_scattering.v * node.beam.aerosol[k]);
    }
    if (node.has_source()) {
      NodeValues air, aerosol;
      for (std::size_t k = 0; k < 4; ++k) {
        air[k] = optics_[k].air.v * node.source.air[k];
        aerosol[k] = optics_[k].aerosol_scattering_cut.v * node.source.aerosol[k];
      }
      source_.slice(node.level, node.mu, air, aerosol, scratch.source);
      out.source = scratch.source.data();
      out.blocks = DiffuseSource::kBlocks;
    }
    const double r = shells_.bottom_radius + node.height;
    out.sun_factor = static_cast<float>((shells_.bottom_radius + sun_point.height) / r);
    out.nu_factor = static_cast<float>((node.s - sun_point.s) / r);
    out.mu = static_cast<float>(node.mu);
    out.lowest = static_cast<float>(sun_at(0, 2));
    out.sun_steps = sun_steps_.data();
    out.sun_step_count = sun_steps_.size();
    out.beam = beam_[node.level].data();
    out.beam_count = beam_[node.level].size() / 4;
    if (!node.on_level()) {
      scratch.beam.resize(beam_[node.level].size());
      kernels::mix(beam_[node.level].data(), beam_[node.level + 1].data(),
                   static_cast<float>(node.part), scratch.beam.size(), scratch.beam.data());
      out.beam = scratch.beam.data();
    }
    return out;
  }

  void scatter(int mu_index, int r_index) {
    const TexelRay texel =
        texel_ray(shells_, tables_.sizes, mu_index, heights_[kLevelsPerTexel * r_index]);
    const std::size_t cells = mu_s_.size();
    std::vector<float> nu(cells), phase(cells), single(8 * cells), multiple(16 * cells);
    Scratch scratch;
    const auto mu = static_cast<float>(texel.sun_point.mu);
    const auto sine = std::sqrt(1 - mu * mu);
    for (std::size_t i = 0; i < cells; ++i) {
      nu[i] = mu * mu_s_[i] + sine * across_[i];
      phase[i] = static_cast<float>(
          shared.rayleigh_phase(tables_.atmosphere.rayleigh.depolarisation, nu[i]));
    }
    for (const LevelNode& node :
         level_path(shells_, optics_, heights_, texel.ray, kLevelsPerTexel * r_index)) {
      kernels::add_node(kernel_node(node, texel.sun_point, scratch), mu_s_.data(), nu.data(), cells,
                        single.data(), multiple.data());
    }
    const std::size_t row = static_cast<std::size_t>(r_index) * tables_.rayleigh_like.height +
                            static_cast<std::size_t>(mu_index);
    kernels::store_cells(
        single.data(), multiple.data(), phase.data(), cells,
        static_cast<float>(1e3 / texel.ray.length), static_cast<float>(kDarkestScattering),
        &tables_.rayleigh_like.rgba[4 * cells * row], &tables_.single_mie.rgba[4 * cells * row]);
  }

  const Shells& shells_;
  const NodeOptics& optics_;
  AtmosphereTables& tables_;
  std::vector<double> heights_;
  DiffuseSource source_;
  std::vector<float> mu_s_, across_;  // of the cells: [azimuth][sun]; sin(sun zenith) cos(azimuth)
  std::vector<kernels::SunStep> sun_steps_;
  std::vector<std::vector<float>> beam_;  // [level][step][wavelength]
};

}  // namespace

void make_scattering_tables(const Shells& shells, const NodeOptics& optics,
                            AtmosphereTables& tables, const std::function<void(double)>& progress) {
  ScatteringBuilder(shells, optics, tables).build(progress);
}

}  // namespace skyfit
