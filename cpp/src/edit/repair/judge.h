#pragma once

/// Which operations may be made.

#include <cstdint>
#include <limits>
#include <vector>

#include "edit/repair/repair_mesh.h"
#include "edit/repair/shape.h"
#include "tissu/edit/repair/plan_repair.h"

namespace tissu {

class Judge {
 public:
  /// `volume`: of the body [m3]. `below`: bound of bad cells.
  Judge(const RepairMesh& mesh, const RepairRules& rules, double volume, double below)
      : mesh_(mesh), rules_(rules), volume_(volume), below_(below) {}

  /// The least quality of the cells of a patch.
  [[nodiscard]] double least(const std::vector<std::int32_t>& patch) const;
  /// Sets the least quality afterwards. Whether that is greater, no more cells are bad, and all volumes are
  /// above 0 and have the same sum.
  [[nodiscard]] bool improves(Operation& operation) const;
  /// Whether the patch is of one kind, and its energy stays about as it is.
  [[nodiscard]] bool allows(const Operation& operation) const;

 private:
  /// Of some cells at rest.
  struct Shape {
    double quality = std::numeric_limits<double>::infinity();  ///< the least
    int bad = 0;
    double volume = 0.0;  ///< [m3]
  };
  [[nodiscard]] Shape shape_of(const std::vector<CellCorners>& cells) const;
  [[nodiscard]] PatchCells before(const Operation& operation) const;
  [[nodiscard]] PatchCells after(const Operation& operation) const;

  const RepairMesh& mesh_;
  const RepairRules& rules_;
  double volume_;
  double below_;
};

}  // namespace tissu
