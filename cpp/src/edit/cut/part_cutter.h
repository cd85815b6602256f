#pragma once

/// One part of a sweep cuts the material of a patch.

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "edit/cut/bisect.h"
#include "edit/cut/crossings.h"
#include "edit/cut/crowded.h"
#include "edit/cut/incisions.h"
#include "edit/cut/near.h"
#include "edit/cut/patch.h"
#include "edit/cut/remedies.h"
#include "tissu/edit/cut/cut_plan.h"

namespace tissu {

class PartCutter {
 public:
  /// `share`: of an edge of a cell of the patch, within which a crossing goes to the end.
  PartCutter(Patch& patch, const Material& material, const CutOptions& options, Remedies& remedies,
             std::function<double(std::int32_t)> share);

  /// Divides and opens, and adds to the plan what it opened and what is unresolved. False when the part
  /// crossed no edge and lies in no inner face. `number`: of the part in its sweep.
  bool cut(std::size_t number, const SweepPart& part, const NearCells& near, CutPlan& plan);

  std::vector<std::int32_t> parted;  ///< vertices of the faces that all parts opened
  std::vector<char> on;  ///< of each vertex, 1: a part put it on the cut, or an earlier sweep of its incision
  bool goes_on = false;  ///< earlier sweeps of an incision have put vertices on the cut
  OnIncisions on_incision;

 private:
  /// What is on the cut before it begins: vertices of the incision, and nodes that were moved onto the part.
  [[nodiscard]] OnCut known_at_start(std::size_t number, const SweepPart& part) const;
  std::vector<CrossedEdge> find(std::size_t number, const SweepPart& part, const NearCells& near,
                                OnCut& known);
  bool refine(const SweepPart& part, const NearCells& near, OnCut known,
              const std::vector<CrossedEdge>& edges);
  [[nodiscard]] bool stays_whole(const Patch::Tetra& tetra) const;
  std::vector<Patch::Cell> begin();
  void end(const std::vector<Patch::Cell>& before);
  void report(const LeftEdges& left, CutPlan& plan) const;
  void report(const std::vector<std::int32_t>& cells, Unresolved reason, CutPlan& plan) const;
  void report_in_vain(CutPlan& plan) const;
  void report_pierced(const std::vector<std::int32_t>& tetrahedra, CutPlan& plan) const;

  Patch& patch_;
  const Material& material_;
  const CutOptions& options_;
  Remedies& remedies_;
  std::function<double(std::int32_t)> share_;
  double settled_;  ///< crossings so near to each other on an edge may be one or none
};

}  // namespace tissu
