#include "edit/cut/material_before.h"

namespace tissu {

MaterialBefore::MaterialBefore(const Material& material, const CutPlan& plan)
    : riders_(material.riders.size()) {
  for (const auto& [place, rider] : plan.material.riders_changed)
    changed_.emplace_back(place, material.riders[static_cast<std::size_t>(place)]);
  for (const std::int32_t cell : plan.gone) keep(material, cell);
  for (const auto& [cell, list] : plan.material.cells) keep(material, cell);
  if (!plan.material.incisions.empty()) incisions_ = material.incisions;
}

void MaterialBefore::keep(const Material& material, std::int32_t cell) {
  const auto known = material.cells.find(cell);
  cells_.emplace_back(cell, std::nullopt);
  if (known != material.cells.end()) cells_.back().second = known->second;
}

void MaterialBefore::restore(Material& material) const {
  material.riders.resize(riders_);
  for (const auto& [place, rider] : changed_) material.riders[static_cast<std::size_t>(place)] = rider;
  for (const auto& [cell, list] : cells_) {
    if (list) {
      material.cells[cell] = *list;
    } else {
      material.cells.erase(cell);
    }
  }
  if (incisions_) material.incisions = *incisions_;
}

}  // namespace tissu
