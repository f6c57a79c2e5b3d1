// SPDX-License-Identifier: Apache-2.0
#include "model/tables/scattering_tables.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/shared/shared.h"
#include "model/tables/level_path.h"
#include "model/tables/table_kernels.h"
#include "model/tables/table_lookup.h"
#include "model/tables/texel_rays.h"

namespace skyfit {
namespace {

Shared<double> shared;  // stateless

// In the place of all logarithms where nothing scatters: its exponential is 0.
constexpr float kNoScattering = -1000;

// Levels of a ray: those of the texels, which have a source, and others between them.
constexpr int kLevelsPerTexel = kSourceStep;

class ScatteringBuilder {
 public:
  ScatteringBuilder(const Shells& shells, const NodeOptics& optics, AtmosphereTables& tables,
                    const ReferenceOptions& options, const TableLight& light)
      : shells_(shells),
        optics_(optics),
        tables_(tables),
        heights_(level_heights()),
        deck_(tables.heights.deck(shells.top)),
        source_(shells, optics, source_heights(heights_), options, light),
        kinds_(tables.phases.count()) {
    set_sun_steps();
    beam_.resize(heights_.size());
    tbb::parallel_for(0, static_cast<int>(heights_.size()), [&](int i) { set_beam(i); });
  }

  void build(const std::function<void(double)>& progress) {
    const RayTexels texels = tables_.sizes.scattering();
    const std::size_t slice = static_cast<std::size_t>(texels.rows()) * texels.row();
    const int heights = tables_.sizes.scattering_r;
    for (int r = 0; r < heights; ++r) {
      scatter(texels, kLevelsPerTexel * r, tables_.rayleigh_like, tables_.single,
              slice * static_cast<std::size_t>(r), slice * static_cast<std::size_t>(heights));
      if (progress) progress((r + 1.0) / (heights + 1));
    }
    scatter(
        tables_.sizes.outside(), static_cast<int>(heights_.size()) - 1, tables_.sky_rays.air,
        tables_.sky_rays.aerosol, 0,
        static_cast<std::size_t>(tables_.sizes.outside().rows()) * tables_.sizes.outside().row());
    if (progress) progress(1);
  }

 private:
  std::vector<double> level_heights() const {
    const int count = kLevelsPerTexel * (tables_.sizes.scattering_r - 1) + 1;
    std::vector<double> heights;
    for (int i = 0; i < count; ++i)
      heights.push_back(tables_.heights.height(i / (count - 1.0), shells_.top));
    heights.back() = shells_.top;
    return heights;
  }

  static std::vector<double> source_heights(const std::vector<double>& levels) {
    std::vector<double> heights;
    for (std::size_t i = 0; i < levels.size(); i += kSourceStep) heights.push_back(levels[i]);
    return heights;
  }

  double sun_at(int step, int count) const {
    const double lowest = source_.suns().mu(source_.suns().size() - 1);
    return lowest + (1 - lowest) * step / (count - 1.0);
  }

  void set_sun_steps() {
    constexpr int kSteps = 16384;
    for (int i = 0; i < kSteps; ++i) {
      const SunStencil stencil = source_.suns().stencil(sun_at(i, kSteps));
      kernels::SunStep step{stencil.index[3] - 2, {}};  // the grid's first sun has the place 1
      for (std::size_t j = 0; j < 4; ++j) step.weight[j] = static_cast<float>(stencil.even[j]);
      sun_steps_.push_back(step);
    }
  }

  // Single scattering keeps the true phase function under the delta-M-scaled extinction (TMS, see
  // model/atmosphere/optics.h).
  void set_beam(int level) {
    constexpr int kSteps = 1024;
    const double h = heights_[level], horizon = horizon_cosine(shells_.bottom_radius, h);
    PathColumns columns;
    for (int i = 0; i < kSteps; ++i) {
      const double mu_s = sun_at(i, kSteps);
      if (i == 0 || mu_s > horizon) columns = shells_.columns_to_top(h, std::max(mu_s, horizon));
      for (const Optics<0>& optics : optics_)
        beam_[level].push_back(
            static_cast<float>(std::exp(-optics.scaled_optical_depth(columns).v)));
    }
  }

  // What kernel nodes point to.
  struct Scratch {
    std::vector<float> source, beam, single;
  };

  // Linear between the levels that are kept.
  void set_source(const LevelNode& node, Scratch& scratch) const {
    std::vector<NodeValues> factors;
    const auto slice = [&](int height, double share) {
      factors.clear();
      for (std::size_t s = 0; s < node.source.size(); ++s) {
        factors.emplace_back();
        for (std::size_t k = 0; k < 4; ++k)
          factors.back()[k] =
              share * optics_[k].scatterers[s].scaled_scattering.v * node.source[s][k];
      }
      source_.add_slice(height, node.mu, factors, scratch.source);
    };
    scratch.source.assign(source_.slice_size(), 0.0f);
    const int below = node.level / kSourceStep;
    if (node.on_level()) return slice(below, 1);
    const double low = heights_[kSourceStep * below], high = heights_[kSourceStep * (below + 1)];
    const double part = (node.height - low) / (high - low);
    slice(below, 1 - part);
    slice(below + 1, part);
  }

  kernels::TableNode kernel_node(const std::vector<LevelNode>& nodes, std::size_t index,
                                 const RayPoint& sun_point, Scratch& scratch) const {
    const LevelNode& node = nodes[index];
    kernels::TableNode out{};
    scratch.single.assign(4 * kinds_, 0.0f);
    for (std::size_t s = 0; s < node.beam.size(); ++s) {
      for (std::size_t k = 0; k < 4; ++k) {
        const Scatterer<0>& scatterer = optics_[k].scatterers[s];
        const auto kind =
            static_cast<std::size_t>(tables_.phases.of_constituent[scatterer.constituent]);
        scratch.single[4 * kind + k] +=
            static_cast<float>(scatterer.scattering.v * node.beam[s][k]);
      }
    }
    out.single = scratch.single.data();
    out.kinds = kinds_;
    if (node.has_source()) {
      set_source(node, scratch);
      out.source = scratch.source.data();
      out.blocks = static_cast<std::size_t>(source_.blocks());
    }
    const double r = shells_.bottom_radius + node.height;
    out.sun_factor = static_cast<float>((shells_.bottom_radius + sun_point.height) / r);
    out.nu_factor = static_cast<float>((node.s - sun_point.s) / r);
    out.mu = static_cast<float>(node.mu);
    // A node's share of the ray reaches half way to its neighbours.
    const LevelNode &before = nodes[index > 0 ? index - 1 : 0],
                    &after = nodes[std::min(index + 1, nodes.size() - 1)];
    const auto to_horizon = [&](double height) {
      return shared.horizon_distance(height, shells_.bottom_radius);
    };
    out.horizon = static_cast<float>(to_horizon(node.height) / r);
    out.step_nu = static_cast<float>(0.5 * (after.s - before.s) / r);
    out.step = static_cast<float>(0.5 * (to_horizon(after.height) - to_horizon(before.height)) / r);
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

  // All rays that begin at a level, into the texels from `first` on; those of each further kind
  // `apart` texels later.
  void scatter(const RayTexels& texels, int level, Table& rayleigh_like, Table& single,
               std::size_t first, std::size_t apart) const {
    tbb::parallel_for(0, texels.rows(), [&](int row) {
      const std::size_t at = 4 * (first + static_cast<std::size_t>(row) * texels.row());
      std::vector<float*> out = {&rayleigh_like.rgba[at]};
      for (std::size_t kind = 1; kind < kinds_; ++kind)
        out.push_back(&single.rgba[at + 4 * apart * (kind - 1)]);
      scatter_row(texels, row, level, out.data());
    });
  }

  void scatter_row(const RayTexels& texels, int row, int level, float* const* out) const {
    const TexelRay texel = texel_ray(shells_, texels, row, heights_[level], deck_);
    const std::vector<TexelSun> suns =
        texel_suns(texels, shells_.bottom_radius, texel.sun_point.height);
    const std::size_t cells = suns.size();
    std::vector<float> mu_s(cells), nu(cells), phase(cells), single(4 * kinds_ * cells),
        multiple(16 * cells);
    Scratch scratch;
    const auto mu = static_cast<float>(texel.sun_point.mu);
    const auto sine = std::sqrt(1 - mu * mu);
    for (std::size_t i = 0; i < cells; ++i) {
      mu_s[i] = static_cast<float>(suns[i].mu_s);
      nu[i] = mu * mu_s[i] + sine * static_cast<float>(suns[i].across);
      phase[i] = static_cast<float>(shared.rayleigh_phase(tables_.phases.depolarisation, nu[i]));
    }
    const std::vector<LevelNode> nodes = level_path(shells_, optics_, heights_, texel.ray, level);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      kernels::add_node(kernel_node(nodes, i, texel.sun_point, scratch), mu_s.data(), nu.data(),
                        cells, single.data(), multiple.data());
    }
    kernels::store_cells(single.data(), kinds_, multiple.data(), phase.data(), cells,
                         static_cast<float>(1e3 / texel.ray.length),
                         static_cast<float>(kDarkestScattering), out);
  }

  const Shells& shells_;
  const NodeOptics& optics_;
  AtmosphereTables& tables_;
  std::vector<double> heights_;
  double deck_;  // m
  DiffuseSource source_;
  std::size_t kinds_;  // classes of phase functions
  std::vector<kernels::SunStep> sun_steps_;
  std::vector<std::vector<float>> beam_;  // [level][step][wavelength]
};

}  // namespace

void make_scattering_tables(const Shells& shells, const NodeOptics& optics,
                            AtmosphereTables& tables, const ReferenceOptions& options,
                            const TableLight& light, const std::function<void(double)>& progress) {
  const auto& constituents = tables.atmosphere.constituents;
  if (std::ranges::none_of(constituents, [](const auto& c) { return scatters(c); })) {
    for (Table* table :
         {&tables.rayleigh_like, &tables.single, &tables.sky_rays.air, &tables.sky_rays.aerosol})
      std::ranges::fill(table->rgba, kNoScattering);
    if (progress) progress(1);
    return;
  }
  ScatteringBuilder(shells, optics, tables, options, light).build(progress);
}

}  // namespace skyfit
