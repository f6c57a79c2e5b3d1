// SPDX-License-Identifier: Apache-2.0
#include "fit/problem/scan_model.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <set>
#include <utility>

namespace skyfit::fit {
namespace {

constexpr double kPointingStep = 0.25 * std::numbers::pi / 180;

// Rays that see one atmosphere and are measured at the same wavelengths.
struct Group {
  int scan = 0;  // the first of them
  std::vector<int> rays;
  std::vector<Eigen::Index> rows;
  std::vector<int> index_of_node;  // of all nodes, within `nodes`
  std::vector<WavelengthNode> nodes;
};

// What is measured under one sun of a scan; a sample that is missing does not part its direction
// from the others.
using Sun = std::pair<int, double>;
Sun sun_of(const Ray& ray) { return {ray.scan, ray.stated.sun_zenith}; }

std::map<Sun, std::set<int>> channels_of_suns(const ScanData& data) {
  std::map<Sun, std::set<int>> channels;
  for (const ScanRow& row : data.rows)
    channels[sun_of(data.rays[static_cast<std::size_t>(row.ray)])].insert(row.channel);
  return channels;
}

void add_nodes(const ScanData& data, const std::set<int>& channels, Group& group) {
  group.index_of_node.assign(data.nodes.size(), -1);
  for (const int channel : channels) {
    for (const int node : data.channels[static_cast<std::size_t>(channel)].node) {
      group.index_of_node[static_cast<std::size_t>(node)] = static_cast<int>(group.nodes.size());
      group.nodes.push_back(data.nodes[static_cast<std::size_t>(node)]);
    }
  }
}

// Rays without a row are in none.
std::vector<Group> groups_of(const ScanData& data, const SkyState& state) {
  const std::map<Sun, std::set<int>> channels = channels_of_suns(data);
  std::map<std::pair<int, std::set<int>>, Group> groups;
  for (std::size_t r = 0; r < data.rows.size(); ++r) {
    const int ray = data.rows[r].ray;
    const Ray& of_row = data.rays[static_cast<std::size_t>(ray)];
    const std::set<int>& measured = channels.at(sun_of(of_row));
    const auto [at, is_new] =
        groups.try_emplace({state.one_atmosphere ? 0 : of_row.scan, measured});
    Group& group = at->second;
    if (is_new) {
      group.scan = of_row.scan;
      add_nodes(data, measured, group);
    }
    if (group.rays.empty() || group.rays.back() != ray) group.rays.push_back(ray);
    group.rows.push_back(static_cast<Eigen::Index>(r));
  }
  std::vector<Group> result;
  for (auto& [key, group] : groups) result.push_back(std::move(group));
  return result;
}

class Evaluation {
 public:
  Evaluation(const SkyModel& model, const ScanData& data, const SkyState& state,
             const std::vector<Unknown>& unknowns)
      : model_(model), data_(data), state_(state), unknowns_(unknowns) {
    const auto rows = static_cast<Eigen::Index>(data.rows.size());
    result_.value = Eigen::VectorXd::Zero(rows);
    result_.derivative = Eigen::MatrixXd::Zero(rows, static_cast<Eigen::Index>(unknowns.size()));
  }

  RowValues run() {
    for (const Group& group : groups_of(data_, state_)) {
      add_atmosphere(group);
      add_pointing(group);
    }
    add_scale();
    return std::move(result_);
  }

 private:
  const Atmosphere<double>& atmosphere(const Group& group) const {
    return state_.atmosphere[static_cast<std::size_t>(group.scan)];
  }

  SkyPoint point(int ray, Instrument moved, double by) const {
    const Ray& r = data_.rays[static_cast<std::size_t>(ray)];
    auto instrument = state_.instrument[static_cast<std::size_t>(r.scan)];
    instrument[static_cast<std::size_t>(moved)] += by;
    return pointed(r.stated, r.sun_azimuth, instrument);
  }

  int scan_of(const ScanRow& row) const {
    return data_.rays[static_cast<std::size_t>(row.ray)].scan;
  }

  // Calls use(row index, row, ray within the group, factor from the weighted radiance).
  template <class Use>
  void for_rows(const Group& group, const Use& use) const {
    int ray = 0;
    for (const Eigen::Index r : group.rows) {
      const ScanRow& row = data_.rows[static_cast<std::size_t>(r)];
      if (group.rays[static_cast<std::size_t>(ray)] != row.ray) ++ray;  // both ascend
      const int scan = scan_of(row);
      const double factor = data_.scans[static_cast<std::size_t>(scan)].inverse_distance2 *
                            state_.instrument[static_cast<std::size_t>(scan)]
                                             [static_cast<std::size_t>(Instrument::kScale)];
      use(r, row, ray, factor);
    }
  }

  template <class At>
  double weighted(const Group& group, const ScanRow& row, const At& at) const {
    const Channel& channel = data_.channels[static_cast<std::size_t>(row.channel)];
    double sum = 0;
    for (std::size_t k = 0; k < channel.node.size(); ++k)
      sum += channel.weight[k] * at(group.index_of_node[static_cast<std::size_t>(channel.node[k])]);
    return sum;
  }

  void add_atmosphere(const Group& group) {
    std::vector<Parameter> wanted;
    std::vector<int> slice(unknowns_.size(), -1);
    for (std::size_t u = 0; u < unknowns_.size(); ++u) {
      const Parameter* parameter = std::get_if<Parameter>(&unknowns_[u].what);
      if (parameter == nullptr) continue;
      if (!state_.one_atmosphere && !unknowns_[u].applies_to(group.scan)) continue;
      slice[u] = static_cast<int>(wanted.size());
      wanted.push_back(*parameter);
    }
    std::vector<SkyPoint> points;
    for (const int ray : group.rays) points.push_back(point(ray, Instrument::kAzimuthOffset, 0));
    const SkyValues sky = model_.radiance(atmosphere(group), group.nodes, points, wanted);
    for_rows(group, [&](Eigen::Index r, const ScanRow& row, int ray, double factor) {
      result_.value(r) = factor * weighted(group, row, [&](int node) { return sky.at(ray, node); });
      for (std::size_t u = 0; u < unknowns_.size(); ++u) {
        if (slice[u] < 0 || !unknowns_[u].applies_to(scan_of(row))) continue;
        result_.derivative(r, static_cast<Eigen::Index>(u)) =
            factor *
            weighted(group, row, [&](int node) { return sky.derivative_at(slice[u], ray, node); });
      }
    });
  }

  // The pointing angles that some unknown varies.
  std::vector<Instrument> moved_angles() const {
    std::vector<Instrument> angles;
    for (const Unknown& unknown : unknowns_) {
      const Instrument* id = std::get_if<Instrument>(&unknown.what);
      if (id != nullptr && *id != Instrument::kScale && std::ranges::count(angles, *id) == 0)
        angles.push_back(*id);
    }
    return angles;
  }

  void add_pointing(const Group& group) {
    const std::vector<Instrument> angles = moved_angles();
    if (angles.empty()) return;
    const int rays = static_cast<int>(group.rays.size());
    std::vector<SkyPoint> points;
    for (const Instrument angle : angles) {
      for (const double step : {-kPointingStep, kPointingStep}) {
        for (const int ray : group.rays) points.push_back(point(ray, angle, step));
      }
    }
    const SkyValues sky = model_.radiance(atmosphere(group), group.nodes, points, {});
    for_rows(group, [&](Eigen::Index r, const ScanRow& row, int ray, double factor) {
      const int scan = scan_of(row);
      for (std::size_t u = 0; u < unknowns_.size(); ++u) {
        const Instrument* id = std::get_if<Instrument>(&unknowns_[u].what);
        const auto angle = id == nullptr ? angles.end() : std::ranges::find(angles, *id);
        if (angle == angles.end() || !unknowns_[u].applies_to(scan)) continue;
        const int below = static_cast<int>(angle - angles.begin()) * 2 * rays + ray;
        result_.derivative(r, static_cast<Eigen::Index>(u)) =
            factor / (2 * kPointingStep) * weighted(group, row, [&](int node) {
              return sky.at(below + rays, node) - sky.at(below, node);
            });
      }
    });
  }

  void add_scale() {
    for (std::size_t u = 0; u < unknowns_.size(); ++u) {
      const Instrument* id = std::get_if<Instrument>(&unknowns_[u].what);
      if (id == nullptr || *id != Instrument::kScale) continue;
      for (std::size_t r = 0; r < data_.rows.size(); ++r) {
        const int scan = scan_of(data_.rows[r]);
        if (!unknowns_[u].applies_to(scan)) continue;
        const auto row = static_cast<Eigen::Index>(r);
        result_.derivative(row, static_cast<Eigen::Index>(u)) =
            result_.value(row) / state_.instrument[static_cast<std::size_t>(scan)]
                                                  [static_cast<std::size_t>(Instrument::kScale)];
      }
    }
  }

  const SkyModel& model_;
  const ScanData& data_;
  const SkyState& state_;
  const std::vector<Unknown>& unknowns_;
  RowValues result_;
};

}  // namespace

RowValues row_values(const SkyModel& model, const ScanData& data, const SkyState& state,
                     const std::vector<Unknown>& unknowns) {
  return Evaluation(model, data, state, unknowns).run();
}

}  // namespace skyfit::fit
