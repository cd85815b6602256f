#include "parted_loads.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

#include "tissu/element/reference_cell.h"

namespace tissu {
namespace {

using Masses = std::unordered_map<std::int32_t, double>;

/// [m3]; of a sheet the area [m2], of a line the length [m].
double rest_measure(const ReferenceCell& reference, const std::int32_t* nodes, ConstReals X) {
  double measure = 0.0;
  for (const ReferenceCell::Point& point : reference.points) {
    Mat3 J = Mat3::Zero();
    for (int a = 0; a < reference.nodes; ++a) {
      J += block(X, nodes[a]) *
           Eigen::Map<const Eigen::RowVector3d>(point.gradients[static_cast<std::size_t>(a)].data());
    }
    const double volume = reference.dimension == 3   ? J.determinant()
                          : reference.dimension == 2 ? J.col(0).cross(J.col(1)).norm()
                                                     : J.col(0).norm();
    measure += point.weight * volume;
  }
  return measure;
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
          const double section = reference.dimension == 3 ? 1.0 : of_cell(cells.cross_section, e);
          mass = of_cell(cells.density, e) * of_cell(cells.share, e) * section *
                 rest_measure(reference, nodes, body.positions) / reference.nodes;
        }
        found->second += mass;
      }
    }
  }
}

/// The nodes of a body by the node of the first day that they come from.
struct Family {
  const BodyDescription& body;
  std::int32_t first_day = static_cast<std::int32_t>(body.positions.size() / 3 - body.copies_of.size());

  [[nodiscard]] std::int32_t root(std::int32_t node) const {
    return node < first_day ? node : body.copies_of[static_cast<std::size_t>(node - first_day)];
  }
  /// Those with material of each node that has copies, ascending.
  [[nodiscard]] std::unordered_map<std::int32_t, std::vector<std::int32_t>> sharers() const {
    const auto is_bare = [&](std::int32_t node) { return std::ranges::binary_search(body.bare, node); };
    std::unordered_map<std::int32_t, std::vector<std::int32_t>> result;
    for (std::size_t k = 0; k < body.copies_of.size(); ++k) {
      const std::int32_t root = body.copies_of[k];
      if (root < 0) continue;  // on an edge, where no load of the first day acts
      const auto [found, is_new] = result.try_emplace(root);
      if (is_new && !is_bare(root)) found->second.push_back(root);
      const auto copy = first_day + static_cast<std::int32_t>(k);
      if (!is_bare(copy)) found->second.push_back(copy);
    }
    return result;
  }
};

using Sharers = std::unordered_map<std::int32_t, std::vector<std::int32_t>>;

/// Collects the load of each first-day node from its copies, and shares it among the copies that have
/// material now. Shares of earlier edits leave no trace.
LoadDescription shared(const LoadDescription& load, const Family& family, const Sharers& sharers,
                       const Masses& masses) {
  LoadDescription parted = load;
  parted.nodes.clear();
  parted.forces.clear();
  const auto add = [&](std::int32_t node, const Vec3& force) {
    parted.nodes.push_back(node);
    parted.forces.insert(parted.forces.end(), force.data(), force.data() + 3);
  };
  std::unordered_map<std::int32_t, Vec3> whole;  // of each node of the first day that has copies
  for (std::size_t i = 0; i < load.nodes.size(); ++i) {
    const std::int32_t root = family.root(load.nodes[i]);
    if (!sharers.contains(root)) continue;
    whole.try_emplace(root, Vec3::Zero()).first->second +=
        block(ConstReals(load.forces), static_cast<std::int32_t>(i));
  }
  std::unordered_set<std::int32_t> done;
  for (std::size_t i = 0; i < load.nodes.size(); ++i) {
    const std::int32_t root = family.root(load.nodes[i]);
    const auto found = sharers.find(root);
    double mass = 0.0;
    if (found != sharers.end()) {
      for (const std::int32_t one : found->second) mass += masses.at(one);
    }
    if (found == sharers.end()) {
      add(load.nodes[i], block(ConstReals(load.forces), static_cast<std::int32_t>(i)));
      continue;
    }
    if (!done.insert(root).second) continue;
    if (!(mass > 0.0)) {  // no material is left there
      add(root, whole.at(root));
      continue;
    }
    for (const std::int32_t one : found->second) {
      const double share = masses.at(one) / mass;
      if (share > 0.0) add(one, share * whole.at(root));
    }
  }
  return parted;
}

}  // namespace

void part_loads(WorldDescription& description, const BodyDescription& body) {
  if (body.copies_of.empty()) return;
  const Family family{body};
  const auto sharers = family.sharers();
  Masses masses;
  for (const LoadDescription& load : description.loads) {
    if (load.body != body.name) continue;
    for (const std::int32_t node : load.nodes) {
      const auto found = sharers.find(family.root(node));
      if (found == sharers.end()) continue;
      for (const std::int32_t one : found->second) masses[one] = 0.0;
    }
  }
  if (masses.empty()) return;
  add_masses(body, masses);
  for (LoadDescription& load : description.loads) {
    if (load.body == body.name) load = shared(load, family, sharers, masses);
  }
}

}  // namespace tissu
