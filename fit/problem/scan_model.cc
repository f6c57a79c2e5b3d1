// SPDX-License-Identifier: Apache-2.0
#include "fit/problem/scan_model.h"

#include <algorithm>
#include <numbers>

namespace skyfit::fit {
namespace {

constexpr double kPointingStep = 0.25 * std::numbers::pi / 180;

// Looks first .. last - 1 see one atmosphere.
struct Group {
  int scan;  // the first of them
  int first, last;
};

std::vector<Group> groups_of(const ScanData& data, const SkyState& state) {
  const int looks = static_cast<int>(data.looks.size());
  if (state.one_atmosphere) return {{0, 0, looks}};
  std::vector<Group> groups;
  for (int look = 0; look < looks; ++look) {
    const int scan = data.looks[static_cast<std::size_t>(look)].scan;
    if (groups.empty() || groups.back().scan != scan) groups.push_back({scan, look, look});
    groups.back().last = look + 1;
  }
  return groups;
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

  SkyPoint point(int look, Instrument moved, double by) const {
    const Look& l = data_.looks[static_cast<std::size_t>(look)];
    const auto scan = static_cast<std::size_t>(l.scan);
    auto instrument = state_.instrument[scan];
    instrument[static_cast<std::size_t>(moved)] += by;
    return pointed(l.stated, data_.scans[scan], instrument);
  }

  int scan_of(const ScanRow& row) const {
    return data_.looks[static_cast<std::size_t>(row.look)].scan;
  }

  // Calls use(row index, row, look within the group, factor from the weighted radiance).
  template <class Use>
  void for_rows(const Group& group, const Use& use) const {
    for (std::size_t r = 0; r < data_.rows.size(); ++r) {
      const ScanRow& row = data_.rows[r];
      if (row.look < group.first || row.look >= group.last) continue;
      const int scan = scan_of(row);
      const double factor = data_.scans[static_cast<std::size_t>(scan)].inverse_distance2 *
                            state_.instrument[static_cast<std::size_t>(scan)]
                                             [static_cast<std::size_t>(Instrument::kScale)];
      use(static_cast<Eigen::Index>(r), row, row.look - group.first, factor);
    }
  }

  template <class At>
  double weighted(const ScanRow& row, const At& at) const {
    const Channel& channel = data_.channels[static_cast<std::size_t>(row.channel)];
    double sum = 0;
    for (std::size_t k = 0; k < channel.node.size(); ++k)
      sum += channel.weight[k] * at(channel.node[k]);
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
    for (int look = group.first; look < group.last; ++look)
      points.push_back(point(look, Instrument::kAzimuthOffset, 0));
    const SkyValues sky = model_.radiance(atmosphere(group), data_.nodes, points, wanted);
    for_rows(group, [&](Eigen::Index r, const ScanRow& row, int look, double factor) {
      result_.value(r) = factor * weighted(row, [&](int node) { return sky.at(look, node); });
      for (std::size_t u = 0; u < unknowns_.size(); ++u) {
        if (slice[u] < 0 || !unknowns_[u].applies_to(scan_of(row))) continue;
        result_.derivative(r, static_cast<Eigen::Index>(u)) =
            factor *
            weighted(row, [&](int node) { return sky.derivative_at(slice[u], look, node); });
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
    const int looks = group.last - group.first;
    std::vector<SkyPoint> points;
    for (const Instrument angle : angles) {
      for (const double step : {-kPointingStep, kPointingStep}) {
        for (int look = group.first; look < group.last; ++look)
          points.push_back(point(look, angle, step));
      }
    }
    const SkyValues sky = model_.radiance(atmosphere(group), data_.nodes, points, {});
    for_rows(group, [&](Eigen::Index r, const ScanRow& row, int look, double factor) {
      const int scan = scan_of(row);
      for (std::size_t u = 0; u < unknowns_.size(); ++u) {
        const Instrument* id = std::get_if<Instrument>(&unknowns_[u].what);
        const auto angle = id == nullptr ? angles.end() : std::ranges::find(angles, *id);
        if (angle == angles.end() || !unknowns_[u].applies_to(scan)) continue;
        const int below = static_cast<int>(angle - angles.begin()) * 2 * looks + look;
        result_.derivative(r, static_cast<Eigen::Index>(u)) =
            factor / (2 * kPointingStep) * weighted(row, [&](int node) {
              return sky.at(below + looks, node) - sky.at(below, node);
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
