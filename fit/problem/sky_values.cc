// SPDX-License-Identifier: Apache-2.0
#include "fit/problem/sky_values.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "model/numerics/angles.h"
#include "model/numerics/batch.h"

namespace skyfit::fit {
namespace {

constexpr double kPointingStep = 0.25 * kRadiansPerDegree;

// Views that see one atmosphere and are measured at the same wavelengths, or at few.
struct Group {
  int scan = 0;  // the first of them
  std::vector<int> views;
  std::vector<Eigen::Index> samples;
  std::vector<int> index_of_node;  // of all nodes, within `nodes`
  std::vector<WavelengthNode> nodes;
  bool polarised = false;  // some sample is a reading of polarisation
};

// Of a sample, or its derivative; Q and U are 0 where no sample needs them.
struct Light {
  double i = 0, q = 0, u = 0;
};

// `factor` from the weighted radiance to the instrument's.
double value_of(const Sample& sample, const Light& light, double factor) {
  if (!sample.polarisation) return factor * light.i;
  switch (*sample.polarisation) {
    case refs::Polarisation::kQ:
      return light.q / light.i;
    case refs::Polarisation::kU:
      return light.u / light.i;
    case refs::Polarisation::kDegree:
      break;
  }
  return std::hypot(light.q, light.u) / light.i;
}

// docs/theory (11.7). Where nothing is polarised the degree has no derivative, and 0 stands for it.
double derivative_of(const Sample& sample, const Light& light, const Light& by, double factor) {
  if (!sample.polarisation) return factor * by.i;
  const double q = light.q / light.i, u = light.u / light.i, q_by = (by.q - q * by.i) / light.i,
               u_by = (by.u - u * by.i) / light.i;
  switch (*sample.polarisation) {
    case refs::Polarisation::kQ:
      return q_by;
    case refs::Polarisation::kU:
      return u_by;
    case refs::Polarisation::kDegree:
      break;
  }
  const double degree = std::hypot(q, u);
  return degree > 0 ? (q * q_by + u * u_by) / degree : 0;
}

// What is measured under one sun of a scan; a sample that is missing does not part its direction
// from the others.
using Sun = std::pair<int, double>;
Sun sun_of(const View& view) { return {view.scan, view.stated.sun_zenith}; }

std::map<Sun, std::set<int>> channels_of_suns(const Dataset& data) {
  std::map<Sun, std::set<int>> channels;
  for (const Sample& sample : data.samples) {
    if (!sample.irradiance)
      channels[sun_of(data.views[static_cast<std::size_t>(sample.view)])].insert(sample.channel);
  }
  return channels;
}

// A photometer measures each wavelength under a sun of its own. As many wavelengths as the model
// reference solves at once are cheaper asked for under all suns together than each by itself.
void join_few(const Dataset& data, std::map<Sun, std::set<int>>& channels) {
  std::set<int> all;
  for (const auto& [sun, of_sun] : channels) all.insert(of_sun.begin(), of_sun.end());
  std::size_t nodes = 0;
  for (const int channel : all)
    nodes += data.channels[static_cast<std::size_t>(channel)].node.size();
  if (nodes > batch::kBatchWidth) return;
  for (auto& [sun, of_sun] : channels) of_sun = all;
}

void add_nodes(const Dataset& data, const std::set<int>& channels, Group& group) {
  group.index_of_node.assign(data.nodes.size(), -1);
  for (const int channel : channels) {
    for (const int node : data.channels[static_cast<std::size_t>(channel)].node) {
      int& index = group.index_of_node[static_cast<std::size_t>(node)];
      if (index >= 0) continue;
      index = static_cast<int>(group.nodes.size());
      group.nodes.push_back(data.nodes[static_cast<std::size_t>(node)]);
    }
  }
}

// Views without a sample are in none, nor are those of irradiances.
std::vector<Group> groups_of(const Dataset& data, const SkyState& state) {
  std::map<Sun, std::set<int>> channels = channels_of_suns(data);
  join_few(data, channels);
  std::map<std::pair<int, std::set<int>>, Group> groups;
  for (std::size_t r = 0; r < data.samples.size(); ++r) {
    if (data.samples[r].irradiance) continue;
    const int index = data.samples[r].view;
    const View& view = data.views[static_cast<std::size_t>(index)];
    const std::set<int>& measured = channels.at(sun_of(view));
    const auto [at, is_new] = groups.try_emplace({state.one_atmosphere ? 0 : view.scan, measured});
    Group& group = at->second;
    if (is_new) {
      group.scan = view.scan;
      add_nodes(data, measured, group);
    }
    if (group.views.empty() || group.views.back() != index) group.views.push_back(index);
    group.samples.push_back(static_cast<Eigen::Index>(r));
    group.polarised = group.polarised || data.samples[r].polarisation.has_value();
  }
  std::vector<Group> result;
  for (auto& [key, group] : groups) result.push_back(std::move(group));
  return result;
}

class Evaluation {
 public:
  Evaluation(const SkyModel& model, const Dataset& data, const SkyState& state,
             const std::vector<Unknown>& unknowns)
      : model_(model), data_(data), state_(state), unknowns_(unknowns) {
    const auto samples = static_cast<Eigen::Index>(data.samples.size());
    result_.value = Eigen::VectorXd::Zero(samples);
    result_.derivative = Eigen::MatrixXd::Zero(samples, static_cast<Eigen::Index>(unknowns.size()));
  }

  SampleValues run() {
    for (const Group& group : groups_of(data_, state_)) {
      add_atmosphere(group);
      add_pointing(group);
    }
    add_irradiances();
    add_scale();
    return std::move(result_);
  }

 private:
  const Atmosphere<double>& atmosphere(const Group& group) const {
    return state_.atmosphere[static_cast<std::size_t>(group.scan)];
  }

  SkyPoint point(int view, Instrument moved, double by) const {
    const View& stated = data_.views[static_cast<std::size_t>(view)];
    auto instrument = state_.instrument[static_cast<std::size_t>(stated.scan)];
    instrument[static_cast<std::size_t>(moved)] += by;
    return pointed(stated.stated, stated.sun_azimuth, instrument);
  }

  // Calls use(sample index, sample, view within the group, factor from the weighted radiance).
  template <class Use>
  void for_samples(const Group& group, const Use& use) const {
    int view = 0;
    for (const Eigen::Index r : group.samples) {
      const Sample& sample = data_.samples[static_cast<std::size_t>(r)];
      if (group.views[static_cast<std::size_t>(view)] != sample.view) ++view;  // both ascend
      use(r, sample, view, factor_of(data_.scan_of(sample)));
    }
  }

  // From the weighted radiance or irradiance to the instrument's.
  double factor_of(int scan) const {
    return data_.scans[static_cast<std::size_t>(scan)].inverse_distance2 *
           state_.instrument[static_cast<std::size_t>(scan)]
                            [static_cast<std::size_t>(Instrument::kScale)];
  }

  // The parameters of the atmosphere of a scan that are unknowns, and where each unknown stands
  // among them; -1: it is none of them.
  struct Differentiated {
    std::vector<Parameter> wanted;
    std::vector<int> slice;
  };
  Differentiated differentiated(int scan) const {
    Differentiated result{{}, std::vector<int>(unknowns_.size(), -1)};
    for (std::size_t u = 0; u < unknowns_.size(); ++u) {
      const Parameter* parameter = std::get_if<Parameter>(&unknowns_[u].what);
      if (parameter == nullptr) continue;
      if (!state_.one_atmosphere && !unknowns_[u].applies_to(scan)) continue;
      result.slice[u] = static_cast<int>(result.wanted.size());
      result.wanted.push_back(*parameter);
    }
    return result;
  }

  // Those under one sun come from one hemisphere.
  void add_irradiances() {
    std::map<Sun, Group> suns;
    std::map<Sun, std::set<int>> channels;
    for (std::size_t r = 0; r < data_.samples.size(); ++r) {
      const Sample& sample = data_.samples[r];
      if (!sample.irradiance) continue;
      const Sun sun = sun_of(data_.views[static_cast<std::size_t>(sample.view)]);
      suns[sun].samples.push_back(static_cast<Eigen::Index>(r));
      channels[sun].insert(sample.channel);
    }
    for (auto& [sun, group] : suns) {
      const auto [scan, sun_zenith] = sun;
      group.scan = scan;
      add_nodes(data_, channels.at(sun), group);
      const auto [wanted, slice] = differentiated(scan);
      const SkyValues light =
          model_.irradiance(atmosphere(group), group.nodes, 0, sun_zenith, wanted);
      for (const Eigen::Index r : group.samples) add_irradiance(r, group, light, slice);
    }
  }

  void add_irradiance(Eigen::Index r, const Group& group, const SkyValues& light,
                      const std::vector<int>& slice) {
    const Sample& sample = data_.samples[static_cast<std::size_t>(r)];
    const Channel& channel = data_.channels[static_cast<std::size_t>(sample.channel)];
    const int scan = data_.scan_of(sample);
    // The scale of a sky is not that of what stands beside it.
    const double factor = sample.beside_sky
                              ? data_.scans[static_cast<std::size_t>(scan)].inverse_distance2
                              : factor_of(scan);
    for (std::size_t k = 0; k < channel.node.size(); ++k) {
      const double weight = factor * channel.weight[k];
      const int node = group.index_of_node[static_cast<std::size_t>(channel.node[k])];
      result_.value(r) += weight * light.at(*sample.irradiance, node);
      for (std::size_t u = 0; u < unknowns_.size(); ++u) {
        if (slice[u] < 0 || !unknowns_[u].applies_to(scan)) continue;
        result_.derivative(r, static_cast<Eigen::Index>(u)) +=
            weight * light.derivative_at(slice[u], *sample.irradiance, node);
      }
    }
  }

  // at(values, node) of I, Q and U.
  template <class At>
  Light weighted(const Group& group, const Sample& sample, const StokesValues& sky,
                 const At& at) const {
    const Channel& channel = data_.channels[static_cast<std::size_t>(sample.channel)];
    Light sum;
    for (std::size_t k = 0; k < channel.node.size(); ++k) {
      const int node = group.index_of_node[static_cast<std::size_t>(channel.node[k])];
      sum.i += channel.weight[k] * at(sky.i, node);
      if (!sample.polarisation) continue;
      sum.q += channel.weight[k] * at(sky.q, node);
      sum.u += channel.weight[k] * at(sky.u, node);
    }
    return sum;
  }

  Light light_at(const Group& group, const Sample& sample, const StokesValues& sky,
                 int point) const {
    return weighted(group, sample, sky,
                    [&](const SkyValues& values, int node) { return values.at(point, node); });
  }

  StokesValues light(const Group& group, const std::vector<SkyPoint>& points,
                     const std::vector<Parameter>& wanted) const {
    if (group.polarised) return model_.stokes(atmosphere(group), group.nodes, points, wanted);
    return {model_.radiance(atmosphere(group), group.nodes, points, wanted), {}, {}};
  }

  void add_atmosphere(const Group& group) {
    const Differentiated of = differentiated(group.scan);
    const std::vector<int>& slice = of.slice;
    std::vector<SkyPoint> points;
    for (const int view : group.views) points.push_back(point(view, Instrument::kAzimuthOffset, 0));
    const StokesValues sky = light(group, points, of.wanted);
    for_samples(group, [&](Eigen::Index r, const Sample& sample, int view, double factor) {
      const Light seen = light_at(group, sample, sky, view);
      result_.value(r) = value_of(sample, seen, factor);
      for (std::size_t u = 0; u < unknowns_.size(); ++u) {
        if (slice[u] < 0 || !unknowns_[u].applies_to(data_.scan_of(sample))) continue;
        const Light by = weighted(group, sample, sky, [&](const SkyValues& values, int node) {
          return values.derivative_at(slice[u], view, node);
        });
        result_.derivative(r, static_cast<Eigen::Index>(u)) =
            derivative_of(sample, seen, by, factor);
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
    const int views = static_cast<int>(group.views.size());
    std::vector<SkyPoint> points;
    for (const Instrument angle : angles) {
      for (const double step : {-kPointingStep, kPointingStep}) {
        for (const int view : group.views) points.push_back(point(view, angle, step));
      }
    }
    const StokesValues sky = light(group, points, {});
    for_samples(group, [&](Eigen::Index r, const Sample& sample, int view, double factor) {
      const int scan = data_.scan_of(sample);
      for (std::size_t u = 0; u < unknowns_.size(); ++u) {
        const Instrument* id = std::get_if<Instrument>(&unknowns_[u].what);
        const auto angle = id == nullptr ? angles.end() : std::ranges::find(angles, *id);
        if (angle == angles.end() || !unknowns_[u].applies_to(scan)) continue;
        const int below = static_cast<int>(angle - angles.begin()) * 2 * views + view;
        result_.derivative(r, static_cast<Eigen::Index>(u)) =
            (value_of(sample, light_at(group, sample, sky, below + views), factor) -
             value_of(sample, light_at(group, sample, sky, below), factor)) /
            (2 * kPointingStep);
      }
    });
  }

  void add_scale() {
    for (std::size_t u = 0; u < unknowns_.size(); ++u) {
      const Instrument* id = std::get_if<Instrument>(&unknowns_[u].what);
      if (id == nullptr || *id != Instrument::kScale) continue;
      for (std::size_t r = 0; r < data_.samples.size(); ++r) {
        const int scan = data_.scan_of(data_.samples[r]);
        if (!unknowns_[u].applies_to(scan) || data_.samples[r].polarisation ||
            data_.samples[r].beside_sky)
          continue;
        const auto sample = static_cast<Eigen::Index>(r);
        result_.derivative(sample, static_cast<Eigen::Index>(u)) =
            result_.value(sample) / state_.instrument[static_cast<std::size_t>(scan)]
                                                     [static_cast<std::size_t>(Instrument::kScale)];
      }
    }
  }

  const SkyModel& model_;
  const Dataset& data_;
  const SkyState& state_;
  const std::vector<Unknown>& unknowns_;
  SampleValues result_;
};

}  // namespace

SampleValues sky_values(const SkyModel& model, const Dataset& data, const SkyState& state,
                        const std::vector<Unknown>& unknowns) {
  return Evaluation(model, data, state, unknowns).run();
}

}  // namespace skyfit::fit
