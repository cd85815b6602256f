#include "parted_loads.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <span>
#include <unordered_map>

#include "debris.h"
#include "left_faces.h"
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

using Left = std::unordered_map<std::int32_t, Vec3>;

/// What one face gives to each of its nodes for each unit of the load.
std::vector<Vec3> given_by(const FaceCells& some, std::span<const std::int32_t> nodes, bool along_normals,
                           ConstReals X) {
  FaceCells face{some.element, {}, some.thickness};
  std::vector<double> places;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    face.nodes.push_back(static_cast<std::int32_t>(i));
    const Vec3 place = block(X, nodes[i]);
    places.insert(places.end(), place.data(), place.data() + 3);
  }
  std::vector<double> sums(along_normals ? places.size() : nodes.size(), 0.0);
  if (along_normals) {
    add_normals(face, places, sums);
  } else {
    add_areas(face, places, sums);
  }
  std::vector<Vec3> given;
  given.reserve(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    given.push_back(along_normals ? Vec3(block(ConstReals(sums), static_cast<std::int32_t>(i)))
                                  : Vec3(Vec3::Constant(sums[i])));
  }
  return given;
}

/// Calls f(faces of one type, nodes of a face, share of it that is left) for each face of a load.
template <class Function>
void for_faces(const LoadDescription& load, const std::vector<double>& shares, Function&& f) {
  auto share = shares.begin();
  for (const FaceCells& some : load.faces) {
    const auto count = static_cast<std::size_t>(find_element(some.element)->nodes);
    for (std::size_t i = 0; i + count <= some.nodes.size(); i += count)
      f(some, std::span(some.nodes).subspan(i, count), *share++);
  }
}

/// The same of a face of which a share is left: the nodes with material take over what others have none for.
template <class HasMaterial>
std::vector<Vec3> left_by(const FaceCells& some, std::span<const std::int32_t> nodes, double share,
                          const LoadDescription& load, ConstReals X, HasMaterial&& has_material) {
  std::vector<Vec3> given = given_by(some, nodes, load.along_normals, X);
  for (Vec3& one : given) one *= share;
  const auto bearing = std::ranges::count_if(nodes, has_material);
  if (share == 1.0 || bearing == 0 || bearing == std::ssize(nodes)) return given;
  const Vec3 each =
      std::accumulate(given.begin(), given.end(), Vec3(Vec3::Zero())) / static_cast<double>(bearing);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    given[i] = has_material(nodes[i]) ? each : Vec3(Vec3::Zero());
  return given;
}

/// Of each node of the first day on a face that is not whole any more, what the faces that are left give it.
template <class HasMaterial>
Left left_of(const LoadDescription& load, const CutState& cut, HasMaterial&& has_material) {
  Left left;
  const std::vector<double> shares = shares_left(cut, load.faces);
  for_faces(load, shares, [&](const FaceCells& /*some*/, std::span<const std::int32_t> nodes, double share) {
    if (share == 1.0) return;
    for (const std::int32_t node : nodes) left.emplace(node, Vec3::Zero());
  });
  if (left.empty()) return left;
  for_faces(load, shares, [&](const FaceCells& some, std::span<const std::int32_t> nodes, double share) {
    const auto is_in = [&](std::int32_t node) { return left.contains(node); };
    if (share == 0.0 || std::ranges::none_of(nodes, is_in)) return;
    const std::vector<Vec3> given = left_by(some, nodes, share, load, cut.hosts.rest(), has_material);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto found = left.find(nodes[i]);
      if (found != left.end()) found->second += given[i];
    }
  });
  return left;
}

/// Shares the load of each node of the first day among its copies that have material now. Shares of earlier
/// edits leave no trace. `has_material`: of a node of the first day, with its copies. `with_cells`: those
/// that have cells, which bear what is left of a face between nodes without material.
template <class HasMaterial>
LoadDescription shared(const LoadDescription& load, const Left& left, const Sharers& sharers,
                       const Masses& masses, const Sharers& with_cells, HasMaterial&& has_material) {
  LoadDescription parted = load;
  parted.nodes.clear();
  parted.forces.clear();
  parted.left.clear();
  const auto add = [&](std::int32_t node, double share, const Vec3& whole, const Vec3* per_unit) {
    if (per_unit != nullptr) parted.left.push_back({parted.nodes.size(), share * *per_unit});
    const Vec3 force = share * whole;
    parted.nodes.push_back(node);
    parted.forces.insert(parted.forces.end(), force.data(), force.data() + 3);
  };
  const Vec3 nothing = Vec3::Zero();
  for (std::size_t i = 0; i < load.first_day.size(); ++i) {
    const std::int32_t root = load.first_day[i];
    Vec3 whole = block(ConstReals(load.first_forces), static_cast<std::int32_t>(i));
    const Vec3* per_unit = nullptr;
    if (const auto found = left.find(root); found != left.end()) {
      per_unit = &found->second;
      whole = per_unit->cwiseProduct(load.unit);
    }
    if (!has_material(root)) {
      const auto bearing = with_cells.find(root);
      const bool bears = per_unit != nullptr && !per_unit->isZero(0.0) && bearing != with_cells.end();
      if (!bears || bearing->second.empty()) {
        add(root, 1.0, nothing, &nothing);
        continue;
      }
      const double share = 1.0 / static_cast<double>(bearing->second.size());
      for (const std::int32_t one : bearing->second) add(one, share, whole, per_unit);
      continue;
    }
    const auto found = sharers.find(root);
    double mass = 0.0;
    if (found != sharers.end()) {
      for (const std::int32_t one : found->second) mass += masses.at(one);
    }
    if (found == sharers.end() || !(mass > 0.0)) {  // it has no copies, or nothing has a mass
      add(root, 1.0, whole, per_unit);
      continue;
    }
    for (const std::int32_t one : found->second) {
      const double share = masses.at(one) / mass;
      if (share > 0.0) add(one, share, whole, per_unit);
    }
  }
  return parted;
}

}  // namespace

void part_loads(std::vector<LoadDescription>& loads, const BodyDescription& body) {
  const auto acts = [&](const LoadDescription& load) { return load.body == body.name; };
  if (std::ranges::none_of(loads, acts)) return;
  const std::vector<char> used = used_nodes(body);
  const auto is_used = [&](std::int32_t node) { return used[static_cast<std::size_t>(node)] != 0; };
  const Sharers with_cells = sharers_of(body, is_used);
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
    const Left left = load.faces.empty() ? Left() : left_of(load, *cut, has_material);
    load = shared(load, left, sharers, masses, with_cells, has_material);
  }
}

}  // namespace tissu
