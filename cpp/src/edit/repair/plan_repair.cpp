#include "tissu/edit/repair/plan_repair.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include "edit/cut/patch.h"
#include "edit/repair/collapse.h"
#include "edit/repair/flips.h"
#include "edit/repair/judge.h"
#include "edit/repair/repair_mesh.h"
#include "edit/repair/shape.h"
#include "edit/repair/shift.h"
#include "tissu/base/index.h"

namespace tissu {
namespace {

constexpr double kAnyEdge = 2.0;  ///< of the longest

/// Nodes on faces that cuts have opened.
std::vector<char> opened_nodes(const Hosts& hosts, const Material& material) {
  std::vector<char> opened(at(hosts.node_count()), 0);
  for (const auto& [host, list] : material.cells) {
    for (const MaterialTetra& tetra : list) {
      for (std::size_t f = 0; f < tetra.corners(); ++f) {
        if ((tetra.cut >> f & 1U) == 0) continue;
        for (const std::uint8_t i : kOpposite[f]) {
          const std::int32_t vertex = tetra.vertices[i];
          if (vertex >= 0 && vertex != kNoVertex) opened[at(vertex)] = 1;
        }
      }
    }
  }
  return opened;
}

double volume_of(const Hosts& hosts, const RepairMesh& mesh) {
  double sum = 0.0;
  for (const std::int32_t cell : hosts.numbers()) {
    if (hosts.type(cell) == CellType::tetra) sum += tetra_volume(rest_corners(mesh, mesh.cell(cell)));
  }
  return sum;
}

class Repairer {
 public:
  Repairer(const Hosts& hosts, const Material& material, ConstReals x, const RepairRules& rules,
           const RepairOptions& options)
      : hosts_(hosts),
        rules_(rules),
        options_(options),
        opened_(opened_nodes(hosts, material)),
        may_move_(rules.may_move),
        kept_(at(hosts.node_count()), 0),
        mesh_(hosts, material, x),
        judge_(mesh_, rules_, volume_of(hosts, mesh_), options.below) {
    may_move_.resize(kept_.size(), 0);
    for (const std::int32_t node : options.still) may_move_[at(node)] = 0;
    for (const Incision& incision : material.incisions) {
      if (std::ranges::find(options.goes_on, incision.number) == options.goes_on.end()) continue;
      for (const std::int32_t vertex : incision.vertices) {
        if (vertex >= 0) keep(vertex);
      }
    }
    for (std::int32_t node = 0; node < hosts.node_count(); ++node) {
      if (!mesh_.is_solid(node)) keep(node);
    }
  }

  RepairPlan repair() {
    RepairPlan plan;
    std::vector<std::int32_t> cells = tetrahedra();
    plan.counts.least_before = judge_.least(cells);
    for (const std::int32_t cell : cells) push(cell);
    plan.counts.bad_before = static_cast<std::int32_t>(queue_.size());
    std::int32_t made = 0;
    while (!queue_.empty() && made < options_.most) {
      const std::int32_t cell = queue_.begin()->second;
      queue_.erase(queue_.begin());
      const auto operation = best(cell);
      if (!operation) continue;
      ++made;
      count(operation->kind, plan.counts);
      for (const std::int32_t gone : operation->patch) drop(gone);
      for (const std::int32_t changed : mesh_.apply(*operation)) push_around(changed);
    }
    cells = tetrahedra();
    plan.counts.least_after = judge_.least(cells);
    plan.counts.bad_after =
        static_cast<std::int32_t>(std::ranges::count_if(cells, [&](std::int32_t c) { return is_bad(c); }));
    plan.plan = mesh_.plan();
    return plan;
  }

 private:
  using Ranked = std::pair<double, std::int32_t>;

  void keep(std::int32_t node) {
    kept_[at(node)] = 1;
    may_move_[at(node)] = 0;
  }

  /// Of the body as it is, ascending.
  [[nodiscard]] std::vector<std::int32_t> tetrahedra() const {
    std::vector<std::int32_t> cells;
    for (const std::int32_t cell : mesh_.numbers()) {
      if (mesh_.is_tetra(cell)) cells.push_back(cell);
    }
    return cells;
  }

  [[nodiscard]] bool is_of_cut(std::int32_t number) const {
    if (number >= hosts_.next_cell() || hosts_.origin(number) != number) return true;
    const RepairCell cell = mesh_.cell(number);
    return std::ranges::any_of(cell.nodes, [&](std::int32_t node) { return opened_[at(node)] != 0; });
  }
  [[nodiscard]] double worst(std::int32_t cell) const {
    return worst_measure(rest_corners(mesh_, mesh_.cell(cell)), options_.below);
  }
  [[nodiscard]] bool is_bad(std::int32_t cell) const { return is_of_cut(cell) && worst(cell) < 1.0; }

  void push(std::int32_t cell) {
    if (is_bad(cell)) queue_.emplace(worst(cell), cell);
  }
  void drop(std::int32_t cell) { queue_.erase({worst(cell), cell}); }
  /// A cell that changed, and those at its nodes, for which something may be possible now.
  void push_around(std::int32_t cell) {
    for (const std::int32_t node : mesh_.cell(cell).nodes) {
      for (const std::int32_t other : mesh_.cells_at(node)) {
        if (mesh_.is_tetra(other)) push(other);
      }
    }
  }

  static void count(Repair kind, RepairCounts& counts) {
    ++(kind == Repair::collapse ? counts.collapses : kind == Repair::flip ? counts.flips : counts.moves);
  }

  [[nodiscard]] std::optional<Operation> best(std::int32_t cell) const {
    if (auto operation = best_of(collapses(cell, 2.0 * options_.below))) return operation;
    std::vector<Operation> others = flips_of(mesh_, cell, kept_);
    std::ranges::move(shifts_of(mesh_, cell, may_move_), std::back_inserter(others));
    if (auto operation = best_of(std::move(others))) return operation;
    return best_of(collapses(cell, kAnyEdge));
  }

  /// Of the edges that are shorter than a share of the longest.
  [[nodiscard]] std::vector<Operation> collapses(std::int32_t number, double share) const {
    std::vector<Operation> found;
    const RepairCell cell = mesh_.cell(number);
    const CellCorners corners = rest_corners(mesh_, cell);
    double longest = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = 0; k < i; ++k) longest = std::max(longest, (corners[i] - corners[k]).norm());
    }
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = 0; k < 4; ++k) {
        if (i == k || !((corners[i] - corners[k]).norm() < share * longest)) continue;
        if (!may_go(cell.nodes[i], cell.nodes[k])) continue;
        if (auto operation = collapse(mesh_, cell.nodes[i], cell.nodes[k]))
          found.push_back(*std::move(operation));
      }
    }
    return found;
  }

  [[nodiscard]] bool may_go(std::int32_t u, std::int32_t v) const {
    if (may_move_[at(u)] == 0 || kept_[at(v)] != 0) return false;
    if (!rules_.is_held.empty() && (rules_.is_held[at(u)] != 0 || rules_.is_held[at(v)] != 0)) return false;
    return !rules_.surface_stays || mesh_.border(u).empty();
  }

  [[nodiscard]] std::optional<Operation> best_of(std::vector<Operation> operations) const {
    std::vector<Ranked> better;  // by falling quality, then in their order
    for (std::size_t i = 0; i < operations.size(); ++i) {
      if (judge_.improves(operations[i]))
        better.emplace_back(-operations[i].least, static_cast<std::int32_t>(i));
    }
    std::ranges::sort(better);
    for (const auto& [quality, i] : better) {
      if (judge_.allows(operations[at(i)])) return std::move(operations[at(i)]);
    }
    return std::nullopt;
  }

  const Hosts& hosts_;
  const RepairRules& rules_;
  const RepairOptions& options_;
  std::vector<char> opened_;
  std::vector<char> may_move_;
  KeptNodes kept_;  ///< nodes, of which no face or edge goes that has no other
  RepairMesh mesh_;
  Judge judge_;
  std::set<Ranked> queue_;  ///< bad cells that nothing is known against
};

}  // namespace

RepairPlan plan_repair(const Hosts& hosts, const Material& material, ConstReals x, const RepairRules& rules,
                       const RepairOptions& options) {
  return Repairer(hosts, material, x, rules, options).repair();
}

}  // namespace tissu
