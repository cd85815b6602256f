#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>

#include "edit/cut/bisect.h"
#include "edit/cut/bridges.h"
#include "edit/cut/crossings.h"
#include "edit/cut/divide.h"
#include "edit/cut/fans.h"
#include "edit/cut/fragments.h"
#include "edit/cut/incisions.h"
#include "edit/cut/near.h"
#include "edit/cut/open.h"
#include "edit/cut/patch.h"
#include "edit/cut/pierced.h"
#include "edit/cut/remedies.h"
#include "edit/cut/write_plan.h"
#include "tissu/base/error.h"
#include "tissu/base/number_text.h"
#include "tissu/base/sort_unique.h"
#include "tissu/edit/cut/cut_plan.h"

namespace tissu {
namespace {

using Numbers = std::vector<std::int32_t>;

constexpr int kRefinements = 3;
constexpr int kAttempts = 6;
/// Of a first-day cell; smaller parts send their crossings to the nodes.
constexpr double kLeastShare = 1e-9;
constexpr double kFirstRaise = 0.02;
constexpr double kLargestT0 = 0.45;
constexpr double kMostSettled = 0.02;  ///< share of an edge
/// Where cells are divided: nearer to an end their parts would be too flat.
constexpr double kLeastT0OfDivided = 0.2;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

void check(const Hosts& hosts, ConstReals x, const CutOptions& options) {
  if (!(options.t0 >= 0.0 && options.t0 <= kLargestT0)) {
    throw ParameterError("a cut has t0 = " + number_text(options.t0) + "; 0 to 0.45 are accepted.");
  }
  if (x.size() != 3 * at(hosts.node_count())) {
    throw ParameterError("a cut of " + std::to_string(hosts.node_count()) + " nodes got " +
                         std::to_string(x.size()) + " numbers for places; 3 per node are accepted.");
  }
  if (!Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size())).allFinite()) {
    throw ParameterError("a cut got places that are not finite; finite ones are accepted.");
  }
}

/// Shares of edges that single cells ask for, where the plan's own would leave too small a part.
using RaisedT0 = std::map<std::int32_t, double>;

/// One attempt to cut: the patch after all parts of the sweep.
class Attempt {
 public:
  Attempt(const Hosts& hosts, const Material& material, ConstReals x, const Sweep& sweep,
          const std::vector<NearCells>& near, const CutOptions& options, const RaisedT0& raised,
          Remedies& remedies)
      : hosts_(hosts),
        material_(material),
        x_(x),
        sweep_(sweep),
        near_(near),
        options_(options),
        raised_(raised),
        remedies_(remedies),
        settled_(std::min(options.t0, kMostSettled)),
        patch_(hosts, material, x, loaded()) {}

  /// Divides and opens. False when the blade crossed no edge and lies in no inner face.
  bool cut(CutPlan& plan) {
    bool met = false;
    for (std::size_t i = 0; i < sweep_.parts.size(); ++i) met = cut_part(i, plan) || met;
    return met;
  }

  /// The plan's cells, nodes and material. False when a part is too small; then `raised` says of which hosts.
  bool finish(CutPlan& plan, RaisedT0& raised, bool last) {
    Numbers touched;
    for (const Patch::Cell& cell : patch_.cells) {
      plan.cells_cut += cell.divided || cell.opened ? 1 : 0;
      if (cell.opened) touched.push_back(cell.number);
    }
    part_divided_edges(touched);
    sort_unique(touched);
    part_corners(touched);
    sort_unique(parted_);
    patch_.extend(hosts_, material_, x_, hosts_.with_neighbours(touched));
    const Fragments fragments(hosts_, patch_, touched, {});
    const Replicas replicas = find_replicas(hosts_, patch_, fragments);
    if (!last && !large_enough(replicas, raised)) return false;
    const Fans fans(patch_, fragments, parted_);
    write_plan(hosts_, material_, patch_, fragments, replicas, fans, plan);
    write_incisions(patch_, material_, on_incision_, fans, plan);
    return true;
  }

  /// The plan of divided cells. False when one of them would be too flat; then it has another remedy.
  bool divided(CutPlan& plan) {
    if (remedies_.advance(hosts_, patch_)) return false;
    for (const Patch::Cell& cell : patch_.cells) plan.cells_cut += cell.divided || cell.opened ? 1 : 0;
    write_division(hosts_, material_, x_, patch_, on_incision_, plan);
    return true;
  }

  /// Vertices that a blade met which opened nothing: along faces one opens when its last vertex is met.
  void remember(CutPlan& plan) const { remember_incisions(patch_, material_, on_incision_, plan); }

 private:
  [[nodiscard]] Numbers loaded() const {
    Numbers cells;
    for (const NearCells& near : near_) cells.insert(cells.end(), near.cells().begin(), near.cells().end());
    sort_unique(cells);
    return hosts_.with_neighbours(cells);
  }

  [[nodiscard]] double t0(std::int32_t cell) const {
    const std::int32_t number = patch_.cell(cell).number;
    const auto own = raised_.find(number);
    if (own != raised_.end()) return own->second;
    if (info(hosts_.type(number)).dimension == 1) return 0.0;  // no part of a line is narrow
    return remedies_.t0(number, options_.t0);
  }

  bool cut_part(std::size_t number, CutPlan& plan) {
    const SweepPart& part = sweep_.parts[number];
    const NearCells& near = near_[number];
    OnCut known = known_before(patch_, material_, part.incision);
    std::vector<CrossedEdge> edges = crossed_edges(patch_, part, near, settled_, known);
    for (int round = 0; options_.refine && round < kRefinements; ++round) {
      if (!refine(part, near, known, edges)) break;
      known = known_before(patch_, material_, part.incision);
      edges = crossed_edges(patch_, part, near, settled_, known);
    }
    for (const std::int32_t cell : remedies_.apply(patch_, options_.t0, edges))
      plan.unresolved.emplace_back(cell, Unresolved::flat);
    const BladeSheets sheets(part);
    const CrowdedCells crowded(patch_, part, near, sheets);
    const Blade blade{part, sheets, crowded};
    const bool crossed = !edges.empty();
    std::function<bool(std::int32_t)> turned;
    if (remedies_.any())
      turned = [&](std::int32_t cell) { return remedies_.turned(patch_.cell(cell).number); };
    const auto share = [&](std::int32_t cell) { return t0(cell); };
    const std::vector<Patch::Cell> before = begin_part();
    const LeftEdges left = divide_crossed(patch_, std::move(edges), share, known, turned);
    const LeftEdges folded = divide_at_other_sheets(patch_, blade, settled_, options_.t0, share, known);
    const OpenedFaces opened = open_faces(patch_, blade, near, known, !options_.divide);
    plan.faces_opened += opened.count;
    plan.area += opened.area;
    plan.rest_area += opened.rest_area;
    parted_.insert(parted_.end(), opened.vertices.begin(), opened.vertices.end());
    for (const std::int32_t cell : bridged_cells(patch_, blade, settled_, known, opened.uncovered))
      plan.unresolved.emplace_back(patch_.cell(cell).number, Unresolved::bridge);
    report(folded, {}, plan);
    for (const std::int32_t cell : cells_pierced_between(patch_, blade, known))
      plan.unresolved.emplace_back(patch_.cell(cell).number, Unresolved::bridge);
    report(left, pierced_tetrahedra(patch_, part, near, known), plan);
    end_part(before);
    if (part.incision >= 0) on_incision_.emplace_back(part.incision, std::move(known));
    return crossed || opened.count > 0;
  }

  /// Cells as they were before this part of the blade; from now on only those are divided or opened that it
  /// divides or opens.
  std::vector<Patch::Cell> begin_part() {
    const std::vector<Patch::Cell> before = patch_.cells;
    for (Patch::Cell& cell : patch_.cells) cell.divided = cell.opened = false;
    return before;
  }

  void end_part(const std::vector<Patch::Cell>& before) {
    for (std::size_t c = 0; c < before.size(); ++c) {
      patch_.cells[c].divided = patch_.cells[c].divided || before[c].divided;
      patch_.cells[c].opened = patch_.cells[c].opened || before[c].opened;
    }
  }

  /// Divides the longest edges of the tetrahedra that the blade pierces. False when it pierces none.
  bool refine(const SweepPart& part, const NearCells& near, OnCut known,
              const std::vector<CrossedEdge>& edges) {
    for (const CrossedEdge& edge : edges) {
      for (const std::int32_t t : patch_.around(edge.p, edge.q)) {
        for (const std::int32_t v : patch_.tetra(t).vertices) {
          if (v >= 0) known.vertices[at(v)].on = true;
        }
      }
    }
    bool any = false;
    const std::vector<Patch::Tetra> before = patch_.tetrahedra;
    for (const std::int32_t t : pierced_tetrahedra(patch_, part, near, known)) {
      const Patch::Tetra& tetra = patch_.tetra(t);
      if (remedies_.any() && stays_whole(tetra)) continue;
      if (!patch_.cell(tetra.cell).sound || tetra.vertices != before[at(t)].vertices) continue;
      divide_longest(patch_, t);
      any = true;
    }
    return any;
  }

  /// Whether a cell at one of the vertices of a tetrahedron stays whole.
  [[nodiscard]] bool stays_whole(const Patch::Tetra& tetra) const {
    return std::ranges::any_of(tetra.vertices, [&](std::int32_t v) {
      return v >= 0 && std::ranges::any_of(patch_.tetrahedra_at(v), [&](std::int32_t t) {
               return remedies_.whole(patch_.cell(patch_.tetra(t).cell).number);
             });
    });
  }

  void report(const LeftEdges& left, const Numbers& pierced, CutPlan& plan) {
    const auto add = [&](std::int32_t cell, Unresolved reason) {
      plan.unresolved.emplace_back(patch_.cell(cell).number, reason);
    };
    for (const std::int32_t cell : left.unsound) add(cell, Unresolved::shape);
    for (const std::int32_t cell : left.folded) add(cell, Unresolved::folded);
    for (const std::int32_t cell : left.merged) add(cell, Unresolved::bridge);
    for (const std::int32_t t : pierced) {
      const std::int32_t cell = patch_.tetra(t).cell;
      if (!patch_.cell(cell).divided && !patch_.cell(cell).opened) add(cell, Unresolved::pierced);
    }
    std::ranges::sort(plan.unresolved);
    const auto same = std::ranges::unique(plan.unresolved, [](const auto& a, const auto& b) {
                        return a.first == b.first;
                      }).begin();
    plan.unresolved.erase(same, plan.unresolved.end());
  }

  /// An edge on faces opened before may have two fans while its ends, at the front, have one each. A vertex
  /// put on it parts.
  void part_divided_edges(Numbers& touched) {
    for (std::size_t v = 0; v < patch_.vertices.size(); ++v) {
      if (-1 - patch_.vertices[v].number < patch_.old_riders) continue;
      const auto vertex = static_cast<std::int32_t>(v);
      const auto& around = patch_.tetrahedra_at(vertex);
      const bool open = std::ranges::any_of(around, [&](std::int32_t t) {
        const Patch::Tetra& tetra = patch_.tetra(t);
        const auto corner = std::ranges::find(tetra.vertices, vertex) - tetra.vertices.begin();
        return (tetra.cut & ~(1U << static_cast<unsigned>(corner))) != 0;  // a face that has the vertex
      });
      if (!open) continue;
      parted_.push_back(vertex);
      for (const std::int32_t t : around) touched.push_back(patch_.cell(patch_.tetra(t).cell).number);
    }
  }

  /// Cells whose removal left others joined at an edge or a node alone: their copies would not be.
  void part_corners(const Numbers& touched) {
    for (const Patch::Tetra& tetra : patch_.tetrahedra) {
      if (!std::ranges::binary_search(touched, patch_.cell(tetra.cell).number)) continue;
      const auto end = tetra.vertices.begin() + static_cast<std::ptrdiff_t>(tetra.corners());
      parted_.insert(parted_.end(), tetra.vertices.begin(), end);
    }
  }

  bool large_enough(const Replicas& replicas, RaisedT0& raised) const {
    bool all = true;
    for (const Replicas::Replica& replica : replicas.all) {
      const std::int32_t host = patch_.cell(replica.cell).number;
      if (replica.number == host || replica.share >= kLeastShare) continue;
      double& own = raised[host];
      own = std::min(kLargestT0, own > 0.0 ? 2.0 * own : std::max(kFirstRaise, 2.0 * options_.t0));
      all = false;
    }
    return all;
  }

  const Hosts& hosts_;
  const Material& material_;
  ConstReals x_;
  const Sweep& sweep_;
  const std::vector<NearCells>& near_;
  const CutOptions& options_;
  const RaisedT0& raised_;
  Remedies& remedies_;
  double settled_;  ///< crossings so near to each other on an edge may be one or none
  Patch patch_;
  Numbers parted_;  ///< vertices of opened faces
  OnIncisions on_incision_;
};

}  // namespace

CutPlan plan_cut(const Hosts& hosts, const Material& material, ConstReals x, const Sweep& sweep,
                 const CutOptions& asked) {
  check(hosts, x, asked);
  CutOptions options = asked;
  if (options.divide) options.t0 = std::max(options.t0, kLeastT0OfDivided);
  std::vector<NearCells> near;
  near.reserve(sweep.parts.size());
  for (const SweepPart& part : sweep.parts) near.emplace_back(hosts, x, part);
  if (options.divide) {
    for (const NearCells& one : near) refuse_undivided(hosts, material, one.cells());
  }
  RaisedT0 raised;
  Remedies remedies;
  for (int attempt = 1;; ++attempt) {
    CutPlan plan;
    plan.first_node = hosts.node_count();
    if (std::ranges::all_of(near, [](const NearCells& n) { return n.cells().empty(); })) return plan;
    Attempt cut(hosts, material, x, sweep, near, options, raised, remedies);
    if (!cut.cut(plan)) {
      cut.remember(plan);
      return plan;
    }
    if (options.divide) {
      if (cut.divided(plan)) return plan;
      continue;
    }
    RaisedT0 wanted = raised;
    if (cut.finish(plan, wanted, attempt == kAttempts)) return plan;
    raised = std::move(wanted);
  }
}

}  // namespace tissu
