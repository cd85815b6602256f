#pragma once

/// What a plan changes of a material, as it was before: the way back from a plan that was applied.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "tissu/edit/cut/cut_plan.h"
#include "tissu/edit/cut/material.h"

namespace tissu {

class MaterialBefore {
 public:
  /// Of a plan that is not applied yet.
  MaterialBefore(const Material& material, const CutPlan& plan);
  /// Takes the plan back.
  void restore(Material& material) const;

 private:
  void keep(const Material& material, std::int32_t cell);

  std::size_t riders_;  ///< their number
  std::vector<std::pair<std::int32_t, Rider>> changed_;
  std::vector<std::pair<std::int32_t, std::optional<std::vector<MaterialTetra>>>> cells_;  ///< null: none
  std::optional<std::vector<Incision>> incisions_;  ///< null: they stay
};

}  // namespace tissu
