#include "edit/cut/part_cutter.h"

#include <algorithm>
#include <limits>

#include "edit/cut/bridges.h"
#include "edit/cut/cells_along.h"
#include "edit/cut/open.h"
#include "edit/cut/pierced.h"
#include "edit/cut/side.h"
#include "tissu/base/index.h"

namespace tissu {
namespace {

using Numbers = std::vector<std::int32_t>;

constexpr int kRefinements = 3;
/// Shares of a cell's longest edge: how far from the cut the blade may pass a cell that it does not cut
/// there. Divided cells leave more bridges, and so more of them are named.
constexpr double kFollowed = 0.2;
constexpr double kFollowedByDivided = 0.12;
constexpr double kMostSettled = 0.02;  ///< share of an edge

/// Shares of the largest coordinate: the round-off of a place on the blade.
constexpr double kRoundOff = 1e-10;

/// The triangles on which a place lies, the nearest one at least.
Numbers triangles_at(const SweepPart& part, const Vec3& place) {
  Numbers found;
  std::int32_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(part.triangles.size()); ++t) {
    const double away = distance(part, {&t, 1}, place);
    if (away <= kRoundOff * place.cwiseAbs().maxCoeff()) found.push_back(t);
    if (away < least) nearest = t;
    least = std::min(least, away);
  }
  if (found.empty()) found.push_back(nearest);
  return found;
}

}  // namespace

PartCutter::PartCutter(Patch& patch, const Material& material, const CutOptions& options, Remedies& remedies,
                       std::function<double(std::int32_t)> share)
    : patch_(patch),
      material_(material),
      options_(options),
      remedies_(remedies),
      share_(std::move(share)),
      settled_(std::min(options.t0, kMostSettled)) {}

OnCut PartCutter::known_at_start(std::size_t number, const SweepPart& part) const {
  OnCut known = known_before(patch_, material_, part, options_.divide);
  for (const CutOptions::Met& met : options_.met) {
    const std::int32_t v = met.part == number ? patch_.place_of(met.node) : -1;
    if (v < 0) continue;
    // Of a bent blade all triangles that meet there: the node is on each.
    const std::vector<std::int32_t> triangles = triangles_at(part, met.place);
    for (const std::int32_t t : triangles) known.put_on(v, patch_.vertex(v).place, met.place, t);
  }
  return known;
}

bool PartCutter::cut(std::size_t number, const SweepPart& part, const NearCells& near, CutPlan& plan) {
  OnCut known = known_at_start(number, part);
  std::vector<CrossedEdge> edges = find(number, part, near, known);
  for (const std::int32_t cell : remedies_.apply(patch_, options_.t0, edges))
    plan.unresolved.emplace_back(cell, Unresolved::flat);
  const BladeSheets sheets(part);
  const CrowdedCells crowded(patch_, part, near, sheets);
  const Blade blade{part, sheets, crowded};
  const bool crossed = !edges.empty();
  std::function<bool(std::int32_t)> turned;
  if (remedies_.any()) turned = [&](std::int32_t cell) { return remedies_.turned(patch_.cell(cell).number); };
  const std::vector<Patch::Cell> before = begin();
  report(divide_crossed(patch_, std::move(edges), share_, known, turned), plan);
  report(divide_at_other_sheets(patch_, blade, settled_, options_.t0, share_, known), plan);
  const OpenedFaces opened = open_faces(patch_, blade, near, known, options_.t0);
  plan.faces_opened += opened.count;
  plan.area += opened.area;
  plan.rest_area += opened.rest_area;
  parted.insert(parted.end(), opened.vertices.begin(), opened.vertices.end());
  report(bridged_cells(patch_, blade, settled_, known), Unresolved::bridge, plan);
  report(cells_pierced_between(patch_, blade, known, options_.divide ? kFollowedByDivided : kFollowed),
         Unresolved::bridge, plan);
  report(cells_along(patch_, part.corner), Unresolved::bridge, plan);
  report_pierced(pierced_tetrahedra(patch_, part, near, known, true), plan);
  if (opened.count == 0 && part.incision < 0) report_in_vain(plan);
  end(before);
  on.resize(patch_.vertices.size(), 0);
  for (std::size_t v = 0; v < on.size(); ++v) {
    if (known.vertices[v].on) on[v] = 1;
    goes_on = goes_on || known.vertices[v].before || known.vertices[v].wall;
  }
  if (part.incision >= 0) on_incision.emplace_back(part.incision, std::move(known));
  return crossed || opened.count > 0;
}

/// The edges that the part crosses, after refinement.
std::vector<CrossedEdge> PartCutter::find(std::size_t number, const SweepPart& part, const NearCells& near,
                                          OnCut& known) {
  std::vector<CrossedEdge> edges = crossed_edges(patch_, part, near, settled_, known);
  for (int round = 0; options_.refine && round < kRefinements; ++round) {
    if (!refine(part, near, known, edges)) break;
    known = known_at_start(number, part);
    edges = crossed_edges(patch_, part, near, settled_, known);
  }
  return edges;
}

/// Cells as they were before the part; from now on only those are divided or opened that it divides or opens.
std::vector<Patch::Cell> PartCutter::begin() {
  std::vector<Patch::Cell> before = patch_.cells;
  for (Patch::Cell& cell : patch_.cells) cell.divided = cell.opened = false;
  return before;
}

void PartCutter::end(const std::vector<Patch::Cell>& before) {
  for (std::size_t c = 0; c < before.size(); ++c) {
    patch_.cells[c].divided = patch_.cells[c].divided || before[c].divided;
    patch_.cells[c].opened = patch_.cells[c].opened || before[c].opened;
  }
}

/// Divides the longest edges of the tetrahedra that the blade pierces. False when it pierces none.
bool PartCutter::refine(const SweepPart& part, const NearCells& near, OnCut known,
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
  for (const std::int32_t t : pierced_tetrahedra(patch_, part, near, known, false)) {
    const Patch::Tetra& tetra = patch_.tetra(t);
    if (remedies_.any() && stays_whole(tetra)) continue;
    if (!patch_.cell(tetra.cell).sound || tetra.vertices != before[at(t)].vertices) continue;
    divide_longest(patch_, t);
    any = true;
  }
  return any;
}

/// Whether a cell at one of the vertices of a tetrahedron stays whole.
bool PartCutter::stays_whole(const Patch::Tetra& tetra) const {
  return std::ranges::any_of(tetra.vertices, [&](std::int32_t v) {
    return v >= 0 && std::ranges::any_of(patch_.tetrahedra_at(v), [&](std::int32_t t) {
             return remedies_.whole(patch_.cell(patch_.tetra(t).cell).number);
           });
  });
}

void PartCutter::report(const LeftEdges& left, CutPlan& plan) const {
  report(left.unsound, Unresolved::shape, plan);
  report(left.folded, Unresolved::folded, plan);
  report(left.merged, Unresolved::bridge, plan);
}

void PartCutter::report(const Numbers& cells, Unresolved reason, CutPlan& plan) const {
  for (const std::int32_t cell : cells) plan.unresolved.emplace_back(patch_.cell(cell).number, reason);
}

/// Cells of which it divided the material and parted nothing.
void PartCutter::report_in_vain(CutPlan& plan) const {
  for (const Patch::Cell& cell : patch_.cells)
    if (cell.divided) plan.unresolved.emplace_back(cell.number, Unresolved::ends);
}

/// A cell that the part cuts elsewhere is not pierced.
void PartCutter::report_pierced(const Numbers& tetrahedra, CutPlan& plan) const {
  for (const std::int32_t t : tetrahedra)
    plan.unresolved.emplace_back(patch_.cell(patch_.tetra(t).cell).number, Unresolved::pierced);
}

}  // namespace tissu
