// SPDX-License-Identifier: Apache-2.0
#include "data_refs/joint_reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "data_refs/units.h"

namespace skyfit::refs {
namespace {

int scan_count(const Reference& reference) {
  int count = static_cast<int>(reference.scans.size());
  for (const Sample& sample : reference.samples) count = std::max(count, sample.scan + 1);
  return count;
}

}  // namespace

Reference joint_reference(const std::vector<Reference>& references) {
  if (references.empty()) throw std::invalid_argument("no reference given, expected at least one");
  if (references.size() == 1) return references.front();
  Reference joint;
  joint.name = fmt::format("{} and {} more", references.front().name, references.size() - 1);
  joint.description = fmt::format("{} references together", references.size());
  joint.quantity = references.front().quantity;
  joint.transfer = references.front().transfer;
  for (const Reference& reference : references) {
    if (reference.quantity != joint.quantity) {
      throw std::invalid_argument(fmt::format(
          "{}: {}: expected {} as in {}", reference.name, quantity_name(reference.quantity),
          quantity_name(joint.quantity), references.front().name));
    }
    if (reference.transfer != joint.transfer) {
      throw std::invalid_argument(fmt::format("{}: {} transfer: expected {} as in {}",
                                              reference.name, transfer_name(reference.transfer),
                                              transfer_name(joint.transfer),
                                              references.front().name));
    }
    joint.notes.insert(joint.notes.end(), reference.notes.begin(), reference.notes.end());
    const int first = static_cast<int>(joint.scans.size());
    for (Sample sample : reference.samples) {
      sample.scan += first;
      joint.samples.push_back(sample);
    }
    joint.scans.insert(joint.scans.end(), reference.scans.begin(), reference.scans.end());
    joint.scans.resize(static_cast<std::size_t>(first + scan_count(reference)));
  }
  return joint;
}

}  // namespace skyfit::refs
