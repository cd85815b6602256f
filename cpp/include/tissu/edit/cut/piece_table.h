#pragma once

/// The connected parts of a body's material, followed from cut to cut: after an edit only what it touched is
/// searched, and of two parts the smaller one.

#include <cstdint>
#include <vector>

#include "tissu/edit/cut/material_mesh.h"

namespace tissu {

class PieceTable {
 public:
  PieceTable(const Hosts& hosts, const Material& material);

  /// Before the plan is applied to hosts and material, …
  void begin(const Hosts& hosts, const CutPlan& plan);
  /// … and afterwards.
  void end(const Hosts& hosts, const Material& material, const CutPlan& plan);
  /// As pieces() gives them, but for round-off in the volumes.
  [[nodiscard]] std::vector<Piece> list(const Hosts& hosts, const Material& material) const;

 private:
  void part(const Hosts& hosts, const Material& material, const std::vector<std::int32_t>& seeds);
  [[nodiscard]] double volume(const Hosts& hosts, std::int32_t cell) const;

  bool single_ = true;                ///< every host is in one piece; else pieces are searched anew each time
  std::vector<std::int32_t> piece_;   ///< of each cell by its number; -1: it is gone
  std::vector<double> volumes_;       ///< of each piece [m3]
  std::vector<std::int32_t> counts_;  ///< of its cells
  std::vector<std::int32_t> near_;    ///< cells around the plan that is being applied
  std::vector<std::int32_t> met_;     ///< of each cell -1, for searches
};

}  // namespace tissu
