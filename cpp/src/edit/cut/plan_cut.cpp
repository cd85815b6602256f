#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "edit/cut/blade_sides.h"
#include "edit/cut/divide.h"
#include "edit/cut/fans.h"
#include "edit/cut/fragments.h"
#include "edit/cut/incisions.h"
#include "edit/cut/near.h"
#include "edit/cut/part_cutter.h"
#include "edit/cut/patch.h"
#include "edit/cut/remedies.h"
#include "edit/cut/write_plan.h"
#include "tissu/base/error.h"
#include "tissu/base/index.h"
#include "tissu/base/number_text.h"
#include "tissu/base/sort_unique.h"
#include "tissu/edit/cut/cut_plan.h"

namespace tissu {
namespace {

using Numbers = std::vector<std::int32_t>;

constexpr int kAttempts = 6;
/// Of a first-day cell; smaller parts send their crossings to the nodes.
constexpr double kLeastShare = 1e-9;
constexpr double kFirstRaise = 0.02;
constexpr double kLargestT0 = 0.45;
/// Where cells are divided: nearer to an end their parts would be too flat.
constexpr double kLeastT0OfDivided = 0.2;

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
        patch_(hosts, material, x, loaded()),
        cutter_(patch_, material, options, remedies, [this](std::int32_t cell) { return t0(cell); }) {}

  /// Divides and opens. False when the blade crossed no edge and lies in no inner face.
  bool cut(CutPlan& plan) {
    const BladeSides sides(patch_, sweep_, near_);
    bool met = false;
    for (std::size_t i = 0; i < sweep_.parts.size(); ++i)
      met = cutter_.cut(i, sweep_.parts[i], near_[i], plan) || met;
    if (!cutter_.goes_on) {  // what a knife has cut before does not lie on the blade now
      for (const std::int32_t cell : sides.joined(patch_, cutter_.on))
        plan.unresolved.emplace_back(patch_.cell(cell).number, Unresolved::bridge);
    }
    one_reason_each(plan);
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
    sort_unique(cutter_.parted);
    patch_.extend(hosts_, material_, x_, hosts_.with_neighbours(touched));
    const Fragments fragments(hosts_, patch_, touched, {});
    const Replicas replicas = find_replicas(hosts_, patch_, fragments);
    if (!last && !large_enough(replicas, raised)) return false;
    const Fans fans(patch_, fragments, cutter_.parted);
    write_plan(hosts_, material_, patch_, fragments, replicas, fans, plan);
    write_incisions(patch_, material_, cutter_.on_incision, fans, plan);
    plan.parts_nothing = !plan.empty() && plan.nodes.empty();
    report_in_vain(plan);
    return true;
  }

  /// The plan of divided cells. False when one of them would be too flat; then it has another remedy.
  bool divided(CutPlan& plan) {
    if (remedies_.advance(hosts_, patch_)) return false;
    for (const Patch::Cell& cell : patch_.cells) plan.cells_cut += cell.divided || cell.opened ? 1 : 0;
    const bool parts = write_division(hosts_, material_, x_, patch_, cutter_.on_incision, plan);
    plan.parts_nothing = !plan.empty() && !parts;
    report_in_vain(plan);
    return true;
  }

  /// Vertices that a blade met which opened nothing: along faces one opens when its last vertex is met.
  void remember(CutPlan& plan) const { remember_incisions(patch_, material_, cutter_.on_incision, plan); }

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

  static void one_reason_each(CutPlan& plan) {
    std::ranges::sort(plan.unresolved);
    const auto same = std::ranges::unique(plan.unresolved, {}, [](const auto& one) { return one.first; });
    plan.unresolved.erase(same.begin(), same.end());
  }

  /// A blade may open faces all of whose vertices are at the front of the cut: no node has parted, and the
  /// walls move as one. What a knife has not parted yet, its next sweep may part.
  void report_in_vain(CutPlan& plan) const {
    const auto goes_on = [](const SweepPart& part) { return part.incision >= 0; };
    if (!plan.parts_nothing || std::ranges::any_of(sweep_.parts, goes_on)) return;
    for (const Patch::Cell& cell : patch_.cells) {
      if (cell.divided || cell.opened) plan.unresolved.emplace_back(cell.number, Unresolved::ends);
    }
    one_reason_each(plan);
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
      cutter_.parted.push_back(vertex);
      for (const std::int32_t t : around) touched.push_back(patch_.cell(patch_.tetra(t).cell).number);
    }
  }

  /// Cells whose removal left others joined at an edge or a node alone: their copies would not be.
  void part_corners(const Numbers& touched) {
    for (const Patch::Tetra& tetra : patch_.tetrahedra) {
      if (!std::ranges::binary_search(touched, patch_.cell(tetra.cell).number)) continue;
      const auto end = tetra.vertices.begin() + static_cast<std::ptrdiff_t>(tetra.corners());
      cutter_.parted.insert(cutter_.parted.end(), tetra.vertices.begin(), end);
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
  Patch patch_;
  PartCutter cutter_;
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
