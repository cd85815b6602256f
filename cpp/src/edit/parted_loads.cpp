#include "parted_loads.h"

#include <Eigen/LU>
#include <algorithm>
#include <memory>
#include <unordered_map>

#include "debris.h"
#include "parted_face_loads.h"
#include "renewed_load.h"
#include "tissu/edit/cut_state.h"
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

/// What a cell gives to the mass of one of its nodes.
struct NodeMass {
  std::int32_t cell;
  std::int32_t node;
  double mass;
};

/// The mass of the material around each of the nodes that are keys, shared evenly by the nodes of a cell. It
/// is summed by ascending cells, in whatever order the blocks have them.
void add_masses(const BodyDescription& body, Masses& masses) {
  std::vector<char> wanted(body.positions.size() / 3, 0);
  for (const auto& [node, mass] : masses) wanted[static_cast<std::size_t>(node)] = 1;
  std::vector<NodeMass> parts;
  for (const ElasticBlock& cells : body.elastic) {
    const ReferenceCell reference = reference_cell(cells.element, cells.quadrature);
    const auto count = static_cast<std::int32_t>(cells.cells.size()) / reference.nodes;
    for (std::int32_t e = 0; e < count; ++e) {
      const std::int32_t* nodes = &cells.cells[static_cast<std::size_t>(e * reference.nodes)];
      double mass = -1.0;
      for (int a = 0; a < reference.nodes; ++a) {
        const auto node = static_cast<std::size_t>(nodes[a]);  // those of other bodies follow the own ones
        if (node >= wanted.size() || wanted[node] == 0) continue;
        if (mass < 0.0) {
          const double section = reference.dimension == 3 ? 1.0 : of_cell(cells.cross_section, e);
          mass = of_cell(cells.density, e) * of_cell(cells.share, e) * section *
                 rest_measure(reference, nodes, body.positions) / reference.nodes;
        }
        parts.push_back({cells.cell_numbers[static_cast<std::size_t>(e)], nodes[a], mass});
      }
    }
  }
  std::ranges::sort(parts, {}, &NodeMass::cell);
  for (const NodeMass& part : parts) masses.at(part.node) += part.mass;
}

using Sharers = std::unordered_map<std::int32_t, std::vector<std::int32_t>>;

/// Of each node of the first day that has copies, it and these, as far as they may bear a load; ascending.
template <class MayBear>
Sharers sharers_of(const BodyDescription& body, MayBear&& may_bear) {
  const auto first_day = static_cast<std::int32_t>(body.positions.size() / 3 - body.copies_of.size());
  Sharers result;
  for (std::size_t k = 0; k < body.copies_of.size(); ++k) {
    const std::int32_t root = body.copies_of[k];
    if (root < 0) continue;  // on an edge, where no load of the first day acts
    const auto [found, is_new] = result.try_emplace(root);
    if (is_new && may_bear(root)) found->second.push_back(root);
    const auto copy = first_day + static_cast<std::int32_t>(k);
    if (may_bear(copy)) found->second.push_back(copy);
  }
  return result;
}

/// Shares the load of each node of the first day among its copies that have material now. Shares of earlier
/// edits leave no trace. `has_material`: of a node of the first day, with its copies.
template <class HasMaterial>
void share(LoadDescription& load, const Sharers& sharers, const Masses& masses, HasMaterial&& has_material) {
  RenewedLoad renewed(load);
  for (std::size_t i = 0; i < load.first_day.size(); ++i) {
    const std::int32_t root = load.first_day[i];
    const Vec3 whole = block(ConstReals(load.first_forces), static_cast<std::int32_t>(i));
    if (!has_material(root)) {
      renewed.add_left(root, Vec3::Zero());
      continue;
    }
    const auto found = sharers.find(root);
    double mass = 0.0;
    if (found != sharers.end()) {
      for (const std::int32_t one : found->second) mass += masses.at(one);
    }
    if (found == sharers.end() || !(mass > 0.0)) {  // it has no copies, or nothing has a mass
      renewed.add(root, whole);
      continue;
    }
    for (const std::int32_t one : found->second) {
      const double part = masses.at(one) / mass;
      if (part > 0.0) renewed.add(one, part * whole);
    }
  }
}

}  // namespace

void part_loads(std::vector<LoadDescription>& loads, const BodyDescription& body) {
  const auto acts = [&](const LoadDescription& load) { return load.body == body.name; };
  if (std::ranges::none_of(loads, acts)) return;
  const std::vector<char> used = used_nodes(body);
  const auto is_used = [&](std::int32_t node) { return used[static_cast<std::size_t>(node)] != 0; };
  const Sharers sharers =
      sharers_of(body, [&](std::int32_t node) { return !std::ranges::binary_search(body.bare, node); });
  const auto has_material = [&](std::int32_t root) {
    const auto found = sharers.find(root);
    if (found != sharers.end()) return std::ranges::any_of(found->second, is_used);
    return is_used(root) && !std::ranges::binary_search(body.bare, root);
  };
  Masses masses;
  for (LoadDescription& load : loads) {
    if (!acts(load)) continue;
    if (load.first_day.empty()) {
      load.first_day = load.nodes;
      load.first_forces = load.forces;
    }
    if (!load.faces.empty()) continue;
    for (const std::int32_t node : load.first_day) {
      const auto found = sharers.find(node);
      if (found == sharers.end()) continue;
      for (const std::int32_t one : found->second) masses[one] = 0.0;
    }
  }
  if (!masses.empty()) add_masses(body, masses);
  const bool on_faces = std::ranges::any_of(
      loads, [&](const LoadDescription& load) { return acts(load) && !load.faces.empty(); });
  const std::shared_ptr<const CutState> cut = on_faces ? cut_state_now(body) : nullptr;
  for (LoadDescription& load : loads) {
    if (!acts(load)) continue;
    if (load.faces.empty()) {
      share(load, sharers, masses, has_material);
    } else {
      part_face_load(load, *cut);
    }
  }
}

}  // namespace tissu
