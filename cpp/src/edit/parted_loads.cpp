#include "parted_loads.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "tissu/element/reference_cell.h"

namespace tissu {
namespace {

using Masses = std::unordered_map<std::int32_t, double>;

double rest_volume(const ReferenceCell& reference, const std::int32_t* nodes, ConstReals X) {
  double volume = 0.0;
  for (const ReferenceCell::Point& point : reference.points) {
    Mat3 J = Mat3::Zero();
    for (int a = 0; a < reference.nodes; ++a) {
      J += block(X, nodes[a]) *
           Eigen::Map<const Eigen::RowVector3d>(point.gradients[static_cast<std::size_t>(a)].data());
    }
    volume += point.weight * J.determinant();
  }
  return volume;
}

/// The mass of the material around each of the nodes that are keys, shared evenly by the nodes of a cell.
void add_masses(const BodyDescription& body, Masses& masses) {
  for (const ElasticBlock& cells : body.elastic) {
    const ReferenceCell reference = reference_cell(cells.element, cells.quadrature);
    const auto count = static_cast<std::int32_t>(cells.cells.size()) / reference.nodes;
    for (std::int32_t e = 0; e < count; ++e) {
      const std::int32_t* nodes = &cells.cells[static_cast<std::size_t>(e * reference.nodes)];
      double mass = -1.0;
      for (int a = 0; a < reference.nodes; ++a) {
        const auto found = masses.find(nodes[a]);
        if (found == masses.end()) continue;
        if (mass < 0.0) {
          mass = of_cell(cells.density, e) * of_cell(cells.share, e) *
                 rest_volume(reference, nodes, body.positions) / reference.nodes;
        }
        found->second += mass;
      }
    }
  }
}

/// The nodes among which the load of each parted node is shared, itself among them where it keeps some.
std::unordered_map<std::int32_t, std::vector<std::int32_t>> copies_with_material(
    const BodyDescription& body, const std::vector<std::int32_t>& copied) {
  const auto first = static_cast<std::int32_t>(body.positions.size() / 3 - copied.size());
  const auto is_bare = [&](std::int32_t node) { return std::ranges::binary_search(body.bare, node); };
  std::unordered_map<std::int32_t, std::vector<std::int32_t>> result;
  for (std::size_t k = 0; k < copied.size(); ++k) {
    std::vector<std::int32_t>& sharers = result[copied[k]];
    const auto copy = first + static_cast<std::int32_t>(k);
    if (sharers.empty() && !is_bare(copied[k])) sharers.push_back(copied[k]);
    if (!is_bare(copy)) sharers.push_back(copy);
  }
  return result;
}

}  // namespace

void part_loads(WorldDescription& description, const BodyDescription& body,
                const std::vector<std::int32_t>& copied) {
  if (copied.empty()) return;
  const auto sharers = copies_with_material(body, copied);
  Masses masses;
  for (const LoadDescription& load : description.loads) {
    if (load.body != body.name) continue;
    for (const std::int32_t node : load.nodes) {
      const auto found = sharers.find(node);
      if (found == sharers.end()) continue;
      for (const std::int32_t one : found->second) masses[one] = 0.0;
    }
  }
  add_masses(body, masses);
  for (LoadDescription& load : description.loads) {
    if (load.body != body.name) continue;
    LoadDescription parted = load;
    parted.nodes.clear();
    parted.forces.clear();
    const auto add = [&](std::int32_t node, const Vec3& force) {
      parted.nodes.push_back(node);
      parted.forces.insert(parted.forces.end(), force.data(), force.data() + 3);
    };
    for (std::size_t i = 0; i < load.nodes.size(); ++i) {
      const Vec3 force = block(ConstReals(load.forces), static_cast<std::int32_t>(i));
      const auto found = sharers.find(load.nodes[i]);
      double whole = 0.0;
      if (found != sharers.end()) {
        for (const std::int32_t one : found->second) whole += masses[one];
      }
      if (!(whole > 0.0)) {
        add(load.nodes[i], force);
        continue;
      }
      for (const std::int32_t one : found->second) {
        if (masses[one] > 0.0) add(one, masses[one] / whole * force);
      }
    }
    load = std::move(parted);
  }
}

}  // namespace tissu
