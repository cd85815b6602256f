#include "tissu/edit/cut/snap.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "edit/cut/crossings.h"
#include "edit/cut/incisions.h"
#include "edit/cut/movable.h"
#include "edit/cut/near.h"
#include "edit/cut/patch.h"
#include "tissu/base/index.h"
#include "tissu/mesh/triangle_tree.h"

namespace tissu {
namespace {

constexpr double kAtEnd = 1e-9;  ///< of an edge: the blade goes through the node, as the cutter takes it

Vec3 nearest_on(const SweepPart& part, const Vec3& p) {
  Vec3 nearest = p;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& t : part.triangles) {
    const std::array<double, 9> corners{t[0][0], t[0][1], t[0][2], t[1][0], t[1][1],
                                        t[1][2], t[2][0], t[2][1], t[2][2]};
    const Vec3 place = closest_on_triangle(p, corners.data());
    const double away = (place - p).norm();
    if (away >= least) continue;
    least = away;
    nearest = place;
  }
  return nearest;
}

/// Moves the nodes for one sweep.
class Snapper {
 public:
  Snapper(const Hosts& hosts, const Material& material, ConstReals x, const Sweep& sweep,
          std::vector<char> may_move)
      : material_(material), sweep_(sweep), mesh_(hosts, x), may_move_(std::move(may_move)) {}

  void snap(double t0, bool depth) {
    for (std::size_t i = 0; i < sweep_.parts.size(); ++i) snap_part(i, t0, depth);
  }
  [[nodiscard]] const Movable& mesh() const { return mesh_; }
  [[nodiscard]] std::vector<CutOptions::Met>& met() { return met_; }

 private:
  /// An edge that the blade crosses once, from its nearer end.
  struct Edge {
    double t;
    std::int32_t node;
    std::int32_t other;
  };

  void snap_part(std::size_t number, double t0, bool depth) {
    const SweepPart& part = sweep_.parts[number];
    const NearCells near(mesh_.hosts(), mesh_.x(), part);
    if (near.cells().empty()) return;
    const Patch patch(mesh_.hosts(), material_, mesh_.x(), mesh_.hosts().with_neighbours(near.cells()));
    OnCut known = known_before(patch, material_, part, true);
    on_.clear();
    edges_.clear();
    for (const CrossedEdge& edge : crossed_edges(patch, part, near, t0, known)) {
      if (edge.crossings.size() != 1) continue;
      const double t = edge.crossings.front().t;
      const std::int32_t p = patch.vertex(edge.p).number;
      const std::int32_t q = patch.vertex(edge.q).number;
      edges_.push_back(t <= 0.5 ? Edge{t, p, q} : Edge{1.0 - t, q, p});
    }
    for (std::size_t v = 0; v < patch.vertices.size(); ++v) {
      if (!known.vertices[v].on && !known.vertices[v].wall) continue;
      if (known.vertices[v].on) on_.insert(patch.vertices[v].number);
      may_move_[at(patch.vertices[v].number)] = 0;  // for later parts of the sweep too
    }
    std::ranges::sort(edges_, {}, [](const Edge& e) { return std::tuple(e.t, e.node, e.other); });
    for (const Edge& edge : edges_) {
      if (edge.t <= kAtEnd) on_.insert(edge.node);
      if (on_.contains(edge.node) || on_.contains(edge.other) || may_move_[at(edge.node)] == 0) continue;
      if (const auto move = best_move(part, edge)) put_on(number, *move);
    }
    if (depth) put_depth_on(number, near);
  }

  void put_on(std::size_t part, const NodeMove& move) {
    mesh_.move(move);
    on_.insert(move.node);
    may_move_[at(move.node)] = 0;
    const Vec3 place = block(mesh_.x(), move.node);
    met_.push_back({part, move.node, nearest_on(sweep_.parts[part], place)});
  }

  [[nodiscard]] std::optional<NodeMove> best_move(const SweepPart& part, const Edge& edge) {
    const Vec3 way = block(mesh_.hosts().rest(), edge.node) - block(mesh_.hosts().rest(), edge.other);
    std::optional<NodeMove> best;
    double least = 0.0;
    for (const Rider& to : places(part, edge.node)) {
      const NodeMove move{edge.node, to};
      const auto quality = mesh_.quality_after(move, way.norm());
      if (!quality || *quality <= least) continue;
      least = *quality;
      best = move;
    }
    return best;
  }

  /// Places on the blade to which a node may go.
  [[nodiscard]] std::vector<Rider> places(const SweepPart& part, std::int32_t node) const {
    std::vector<std::pair<std::int32_t, Rider>> crossed;
    for (const Edge& edge : edges_) {
      if (edge.node == node) crossed.emplace_back(edge.other, rider(node, edge.other, edge.t));
      if (edge.other == node) crossed.emplace_back(edge.node, rider(node, edge.node, 1.0 - edge.t));
    }
    std::vector<Rider> found;
    const auto border = mesh_.border(node);
    const Vec3 place = block(mesh_.x(), node);
    if (border.empty()) {
      if (const auto to = mesh_.locate(node, nearest_on(part, place))) found.push_back(*to);
    }
    const auto crossing = [&](std::int32_t other) {
      const auto edge = std::ranges::find(crossed, other, &std::pair<std::int32_t, Rider>::first);
      return edge == crossed.end() ? nullptr : &edge->second;
    };
    for (const auto& [a, b] : border) {
      const Rider* p = crossing(a);
      const Rider* q = crossing(b);
      if (p == nullptr || q == nullptr) continue;
      const Vec3 along = q->at(mesh_.x()) - p->at(mesh_.x());
      const double t = along.dot(place - p->at(mesh_.x())) / along.squaredNorm();
      if (t > 0.0 && t < 1.0) found.push_back(between(*p, *q, t));
    }
    for (const auto& [other, to] : crossed) found.push_back(to);
    return found;
  }

  static Rider rider(std::int32_t node, std::int32_t other, double t) {
    return {{node, other, -1, -1}, {1.0 - t, t, 0.0, 0.0}, 2};
  }

  /// Of the cells around each edge of the surface whose ends are on the cut, and that has no face on it, the
  /// inner node nearest to the plane of the blade goes there.
  void put_depth_on(std::size_t number, const NearCells& near) {
    std::set<std::array<std::int32_t, 2>> edges;
    for (const std::int32_t cell : near.cells()) {
      const auto nodes = mesh_.hosts().nodes(cell);
      for (const std::int32_t a : nodes) {
        for (const std::int32_t b : nodes) {
          if (a < b && on_.contains(a) && on_.contains(b)) edges.insert({a, b});
        }
      }
    }
    for (const auto& [a, b] : edges) {
      if (const auto move = depth_move(sweep_.parts[number], a, b)) put_on(number, *move);
    }
  }

  [[nodiscard]] std::optional<NodeMove> depth_move(const SweepPart& part, std::int32_t a, std::int32_t b) {
    const auto border = mesh_.border(a);
    const auto is_end = [b = b](const Movable::Face& face) { return face[0] == b || face[1] == b; };
    if (std::ranges::none_of(border, is_end)) return std::nullopt;
    std::set<std::int32_t> others;
    for (const std::int32_t cell : mesh_.hosts().cells_at(a)) {
      const auto nodes = mesh_.hosts().nodes(cell);
      if (std::ranges::find(nodes, b) == nodes.end()) continue;
      others.insert(nodes.begin(), nodes.end());
    }
    others.erase(a);
    others.erase(b);
    const auto is_inner = [&](std::int32_t node) { return mesh_.border(node).empty(); };
    if (std::ranges::any_of(others, [&](std::int32_t n) { return on_.contains(n) && is_inner(n); }))
      return std::nullopt;
    const double length = (block(mesh_.hosts().rest(), a) - block(mesh_.hosts().rest(), b)).norm();
    std::optional<NodeMove> best;
    double least = std::numeric_limits<double>::infinity();
    for (const std::int32_t node : others) {
      if (may_move_[at(node)] == 0 || !is_inner(node)) continue;
      const Vec3 place = block(mesh_.x(), node);
      const Vec3 to = on_plane(part, place);
      const auto rider = mesh_.locate(node, to);
      if (!rider || (to - place).norm() >= least) continue;
      const NodeMove move{node, *rider};
      if (!mesh_.quality_after(move, length)) continue;
      least = (to - place).norm();
      best = move;
    }
    return best;
  }

  /// The foot of a place on the plane of the triangle of the blade that is nearest to it.
  static Vec3 on_plane(const SweepPart& part, const Vec3& p) {
    const Vec3 nearest = nearest_on(part, p);
    double least = std::numeric_limits<double>::infinity();
    Vec3 foot = nearest;
    for (const auto& t : part.triangles) {
      const std::array<double, 9> corners{t[0][0], t[0][1], t[0][2], t[1][0], t[1][1],
                                          t[1][2], t[2][0], t[2][1], t[2][2]};
      const double away = (closest_on_triangle(p, corners.data()) - p).norm();
      if (away >= least) continue;
      least = away;
      const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
      foot = p - normal.dot(p - t[0]) * normal;
    }
    return foot;
  }

  const Material& material_;
  const Sweep& sweep_;
  Movable mesh_;
  std::vector<char> may_move_;
  std::vector<Edge> edges_;
  std::set<std::int32_t> on_;  ///< nodes on the part's cut
  std::vector<CutOptions::Met> met_;
};

/// Nodes that stay whatever the rules say.
void keep_still(const Hosts& hosts, const Material& material, std::vector<char>& may_move) {
  may_move.resize(at(hosts.node_count()), 0);
  const auto keep = [&](std::int32_t node) {
    if (node >= 0 && node < hosts.node_count()) may_move[at(node)] = 0;
  };
  for (const Incision& incision : material.incisions) std::ranges::for_each(incision.vertices, keep);
  for (const auto& [host, list] : material.cells) {
    for (const MaterialTetra& tetra : list) {
      for (std::size_t f = 0; f < tetra.corners(); ++f) {
        if ((tetra.cut >> f & 1U) == 0) continue;
        for (const std::uint8_t i : kOpposite[f]) keep(tetra.vertices[i]);
      }
    }
  }
  for (std::int32_t node = 0; node < hosts.node_count(); ++node) {
    const auto cells = hosts.cells_at(node);
    const auto is_other = [&](std::int32_t cell) {
      return hosts.type(cell) != CellType::tetra || hosts.share(cell) < 1.0;
    };
    if (cells.empty() || (may_move[at(node)] != 0 && std::ranges::any_of(cells, is_other))) keep(node);
  }
}

}  // namespace

CutPlan plan_snapped_cut(const Hosts& hosts, const Material& material, ConstReals x, const Sweep& sweep,
                         const CutOptions& asked, const SnapRules& rules) {
  CutOptions options = asked;
  options.snap = false;
  options.divide = true;
  std::vector<char> may_move = rules.may_move;
  keep_still(hosts, material, may_move);
  for (const std::int32_t node : asked.still) may_move[at(node)] = 0;
  while (material.riders.empty()) {  // else parts of cells ride, and the plan refuses them
    Snapper snapper(hosts, material, x, sweep, may_move);
    snapper.snap(options.t0, options.depth);
    const std::vector<NodeMove>& moves = snapper.mesh().moves();
    if (moves.empty()) break;
    const std::vector<std::int32_t> refused =
        rules.refused ? rules.refused(moves) : std::vector<std::int32_t>{};
    for (const std::int32_t node : refused) may_move[at(node)] = 0;
    if (!refused.empty()) continue;
    options.met = std::move(snapper.met());
    CutPlan plan = plan_cut(snapper.mesh().hosts(), material, snapper.mesh().x(), sweep, options);
    const auto goes_on = [](const SweepPart& part) { return part.incision >= 0; };
    if (plan.empty() && std::ranges::none_of(sweep.parts, goes_on)) break;
    plan.moved = moves;
    return plan;
  }
  options.met.clear();
  return plan_cut(hosts, material, x, sweep, options);
}

}  // namespace tissu
