#include "cut_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <sstream>

#include "tissu/base/index.h"
#include "tissu/mesh/box.h"
#include "tissu/mesh/cell_shape.h"

namespace tissu::test {
namespace {

constexpr double kRoundOff = 1e-12;  ///< relative; sums over some thousand tetrahedra
constexpr std::array<std::array<std::uint8_t, 3>, 4> kFaces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

double area(const Vec3& a, const Vec3& b, const Vec3& c) { return 0.5 * (b - a).cross(c - a).norm(); }

double volume_of(const MaterialTetra& tetra, const tissu::Material& material, ConstReals x) {
  std::array<Vec3, 4> p;
  for (std::size_t i = 0; i < 4; ++i) p[i] = material.at(tetra.vertices[i], x);
  return (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]) / 6.0;
}

/// Area of the surface at rest, of opened faces or of the others.
double area_of(const MaterialSurface& surface, const Hosts& hosts, bool cut) {
  double sum = 0.0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if ((surface.cut[t] != 0) != cut) continue;
    const auto& [a, b, c] = surface.triangles[t];
    sum += area(surface.vertices[at(a)].at(hosts.rest()), surface.vertices[at(b)].at(hosts.rest()),
                surface.vertices[at(c)].at(hosts.rest()));
  }
  return sum;
}

}  // namespace

CutBody::CutBody(const Mesh& mesh) : hosts(mesh), x(mesh.positions) {
  for (const std::int32_t cell : hosts.numbers()) {
    double sum = 0.0;
    for (const MaterialTetra& tetra : list(cell)) sum += volume_of(tetra, material, hosts.rest());
    first_volumes_.push_back(sum);
  }
  outer_area_ = area_of(material_surface(hosts, material), hosts, false);
}

void CutBody::move(const std::function<Vec3(const Vec3&)>& map) {
  for (std::int32_t n = 0; n < hosts.node_count(); ++n) block(Reals(x), n) = map(block(ConstReals(x), n));
}

void CutBody::apply(const CutPlan& plan) {
  hosts.apply(plan);
  material.apply(plan);
  for (const NodeMove& move : plan.moved) {
    const Vec3 place = move.to.at(x);
    block(Reals(x), move.node) = place;
  }
  for (const BornNode& node : plan.nodes) {
    const bool is_copy = node.between.count == 0;
    const Vec3 place = is_copy ? Vec3(block(ConstReals(x), node.copied)) : node.between.at(x);
    x.insert(x.end(), place.data(), place.data() + 3);
  }
}

CutPlan CutBody::cut(const Sweep& sweep, const CutOptions& options) {
  CutPlan plan = plan_cut(hosts, material, x, sweep, options);
  apply(plan);
  return plan;
}

CutPlan CutBody::snap(const Sweep& sweep, CutOptions options, SnapRules rules) {
  if (rules.may_move.empty()) rules.may_move.assign(at(hosts.node_count()), 1);
  CutPlan plan = plan_snapped_cut(hosts, material, x, sweep, options, rules);
  apply(plan);
  return plan;
}

RepairPlan CutBody::repair(const RepairOptions& options, RepairRules rules) {
  if (rules.may_move.empty()) rules.may_move.assign(at(hosts.node_count()), 1);
  RepairPlan plan = plan_repair(hosts, material, x, rules, options);
  apply(plan.plan);
  repaired_ = true;
  return plan;
}

CutPlan CutBody::ablate(const std::vector<std::int32_t>& cells) {
  CutPlan plan = plan_ablation(hosts, material, cells);
  ablated_ = true;
  for (const std::int32_t cell : cells) {
    first_volumes_[at(hosts.origin(cell))] *= 1.0 - hosts.share(cell);  // right for whole cells
  }
  apply(plan);
  return plan;
}

Sweep CutBody::plane(const Vec3& point, const Vec3& normal) const {
  Eigen::AlignedBox3d box;
  for (std::int32_t n = 0; n < hosts.node_count(); ++n) box.extend(block(ConstReals(x), n).eval());
  return plane_sweep(point, normal, box.min(), box.max());
}

std::vector<MaterialTetra> CutBody::list(std::int32_t cell) const {
  const auto stored = material.cells.find(cell);
  return stored == material.cells.end() ? whole_material(hosts, cell) : stored->second;
}

double CutBody::volume() const {
  double sum = 0.0;
  for (const std::int32_t cell : hosts.numbers()) {
    for (const MaterialTetra& tetra : list(cell)) sum += volume_of(tetra, material, hosts.rest());
  }
  return sum;
}

double CutBody::cut_area() const { return area_of(material_surface(hosts, material), hosts, true); }

std::string CutBody::fault() const {
  for (const std::string& found : {tetrahedra_fault(), share_fault(), surface_fault(), pieces_fault()}) {
    if (!found.empty()) return found;
  }
  return {};
}

/// Volumes above zero; weights that sum to one, of nodes that are corners of the host.
std::string CutBody::tetrahedra_fault() const {
  std::ostringstream fault;
  for (const auto& [cell, tetrahedra] : material.cells) {
    if (!hosts.has(cell)) return "material of a cell that is gone";
    const auto corners = hosts.corners(cell);
    for (const MaterialTetra& tetra : tetrahedra) {
      if (!(volume_of(tetra, material, hosts.rest()) > 0.0)) fault << "no volume in cell " << cell;
      for (const std::int32_t v : tetra.vertices) {
        Rider rider{{v, -1, -1, -1}, {1, 0, 0, 0}, 1};
        if (v < 0) rider = material.riders[at(-1 - v)];
        double sum = 0.0;
        for (std::size_t i = 0; i < at(rider.count); ++i) {
          sum += rider.weight[i];
          if (rider.weight[i] < 0.0) fault << "weight below 0 in cell " << cell;
          if (std::ranges::find(corners, rider.node[i]) == corners.end()) {
            fault << "vertex " << v << " of cell " << cell << " rides on node " << rider.node[i];
          }
        }
        if (std::abs(sum - 1.0) > 1e-14) fault << "weights sum to " << sum;
      }
      if (!fault.str().empty()) return fault.str();
    }
  }
  return {};
}

/// Shares are the volumes of hosts over those of their cells; a first-day cell keeps its volume.
std::string CutBody::share_fault() const {
  std::vector<double> volumes(first_volumes_.size(), 0.0);
  for (const std::int32_t cell : hosts.numbers()) {
    double own = 0.0;
    for (const MaterialTetra& tetra : list(cell)) own += volume_of(tetra, material, hosts.rest());
    const std::size_t origin = at(hosts.origin(cell));
    volumes[origin] += own;
    double whole = 0.0;
    for (const MaterialTetra& tetra : whole_material(hosts, cell))
      whole += volume_of(tetra, material, hosts.rest());
    if (!ablated_ && std::abs(hosts.share(cell) * whole - own) > kRoundOff * whole) {
      return "share of cell " + std::to_string(cell) + " is not its volume's";
    }
  }
  if (hosts.moved() || repaired_) {  // cells take volume from each other, and the body keeps its own
    const double before = std::accumulate(first_volumes_.begin(), first_volumes_.end(), 0.0);
    const double now = std::accumulate(volumes.begin(), volumes.end(), 0.0);
    return std::abs(now - before) > kRoundOff * before ? "the volume of the body changed" : "";
  }
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    if (std::abs(volumes[i] - first_volumes_[i]) > kRoundOff * std::abs(first_volumes_[i])) {
      return "volume of first-day cell " + std::to_string(i) + " changed";
    }
  }
  return {};
}

/// Every edge runs to and fro equally often; what no cut opened is the surface of the first day, so that no
/// face lacks its neighbour.
std::string CutBody::surface_fault() const {
  const MaterialSurface surface = material_surface(hosts, material);
  std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
  Vec3 flux = Vec3::Zero();
  double enclosed = 0.0;
  for (const auto& t : surface.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t a = t[i];
      const std::int32_t b = t[(i + 1) % 3];
      edges[std::minmax(a, b)] += a < b ? 1 : -1;
    }
    std::array<Vec3, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = surface.vertices[at(t[i])].at(hosts.rest());
    flux += 0.5 * (p[1] - p[0]).cross(p[2] - p[0]);
    enclosed += p[0].dot(p[1].cross(p[2])) / 6.0;
  }
  for (const auto& [edge, count] : edges) {
    if (count != 0) return "the surface is open at an edge";
  }
  if (flux.norm() > kRoundOff * outer_area_) return "the surface is open";
  if (std::abs(enclosed - volume()) > kRoundOff * volume()) return "the surface holds another volume";
  if (!ablated_ && std::abs(area_of(surface, hosts, false) - outer_area_) > kRoundOff * outer_area_) {
    return "a face lacks its neighbour";
  }
  return {};
}

/// Cells of different pieces share no node, and every piece has a volume.
std::string CutBody::pieces_fault() const {
  std::vector<std::int32_t> piece_of(at(hosts.node_count()), -1);
  double sum = 0.0;
  const std::vector<Piece> all = pieces(hosts, material);
  for (std::size_t p = 0; p < all.size(); ++p) {
    sum += all[p].volume;
    for (const std::int32_t cell : all[p].cells) {
      for (const std::int32_t node : hosts.nodes(cell)) {
        std::int32_t& own = piece_of[at(node)];
        if (own >= 0 && own != static_cast<std::int32_t>(p)) {
          return "node " + std::to_string(node) + " holds two pieces together";
        }
        own = static_cast<std::int32_t>(p);
      }
    }
  }
  if (std::abs(sum - volume()) > kRoundOff * volume()) return "the pieces have another volume";
  return {};
}

namespace {

/// Counts the sets of tetrahedra around each vertex or edge that faces not open join.
std::size_t fan_count(const std::vector<std::array<std::int32_t, 4>>& tetrahedra,
                      const std::map<std::array<std::int32_t, 3>, std::vector<std::int32_t>>& faces,
                      std::size_t size) {
  std::map<std::vector<std::int32_t>, std::map<std::int32_t, std::int32_t>> parents;
  for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
    for (unsigned mask = 1; mask < 16; ++mask) {
      std::vector<std::int32_t> key;
      for (std::size_t i = 0; i < 4; ++i) {
        if ((mask >> i & 1U) != 0) key.push_back(tetrahedra[t][i]);
      }
      std::ranges::sort(key);
      if (key.size() == size) parents[key][static_cast<std::int32_t>(t)] = static_cast<std::int32_t>(t);
    }
  }
  const auto find = [](std::map<std::int32_t, std::int32_t>& parent, std::int32_t t) {
    while (parent.at(t) != t) t = parent.at(t);
    return t;
  };
  for (const auto& [key, pair] : faces) {
    if (pair.size() != 2) continue;
    for (unsigned mask = 1; mask < 8; ++mask) {
      std::vector<std::int32_t> part;
      for (std::size_t i = 0; i < 3; ++i) {
        if ((mask >> i & 1U) != 0) part.push_back(key[i]);
      }
      if (part.size() != size) continue;
      auto& parent = parents.at(part);
      parent.at(find(parent, pair[0])) = find(parent, pair[1]);
    }
  }
  std::size_t count = 0;
  for (const auto& [key, parent] : parents) {
    for (const auto& [t, above] : parent) count += t == above ? 1 : 0;
  }
  return count;
}

}  // namespace

int CutBody::characteristic() const {
  std::vector<std::array<std::int32_t, 4>> tetrahedra;
  std::map<std::array<std::int32_t, 3>, std::vector<std::int32_t>> faces;
  std::size_t open = 0;
  for (const std::int32_t cell : hosts.numbers()) {
    for (const MaterialTetra& tetra : list(cell)) {
      for (std::size_t f = 0; f < 4; ++f) {
        std::array<std::int32_t, 3> key{tetra.vertices[kFaces[f][0]], tetra.vertices[kFaces[f][1]],
                                        tetra.vertices[kFaces[f][2]]};
        std::ranges::sort(key);
        if ((tetra.cut >> f & 1U) != 0) {
          ++open;
        } else {
          faces[key].push_back(static_cast<std::int32_t>(tetrahedra.size()));
        }
      }
      tetrahedra.push_back(tetra.vertices);
    }
  }
  const std::size_t plus = fan_count(tetrahedra, faces, 1) + faces.size() + open;
  const std::size_t minus = fan_count(tetrahedra, faces, 2) + tetrahedra.size();
  return static_cast<int>(plus) - static_cast<int>(minus);
}

}  // namespace tissu::test
