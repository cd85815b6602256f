#include "edit/repair/judge.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tissu/base/sort_unique.h"

namespace tissu {
namespace {

constexpr double kRise = 1e-3;     ///< of the least quality
constexpr double kVolume = 1e-14;  ///< of the volume of the body

}  // namespace

double Judge::least(const std::vector<std::int32_t>& patch) const {
  double least = std::numeric_limits<double>::infinity();
  for (const std::int32_t number : patch)
    least = std::min(least, tetra_quality(rest_corners(mesh_, mesh_.cell(number))));
  return least;
}

PatchCells Judge::before(const Operation& operation) const {
  PatchCells placed;
  for (const std::int32_t number : operation.patch) {
    const RepairCell cell = mesh_.cell(number);
    placed.nodes.push_back(cell.nodes);
    placed.rest.push_back(rest_corners(mesh_, cell));
    placed.now.push_back(present_corners(mesh_, cell));
  }
  return placed;
}

PatchCells Judge::after(const Operation& operation) const {
  PatchCells placed;
  for (const auto& [number, cell] : operation.after) {
    placed.nodes.push_back(cell.nodes);
    placed.rest.push_back(rest_corners(mesh_, cell));
    placed.now.push_back(present_corners(mesh_, cell));
    if (!operation.move) continue;
    const std::size_t own = place_in(cell, operation.move->node);
    placed.rest.back()[own] = operation.move->to.at(mesh_.all_rest());
    placed.now.back()[own] = operation.move->to.at(mesh_.all_now());
  }
  return placed;
}

Judge::Shape Judge::shape_of(const std::vector<CellCorners>& cells) const {
  Shape shape;
  for (const CellCorners& corners : cells) {
    shape.quality = std::min(shape.quality, tetra_quality(corners));
    shape.bad += worst_measure(corners, below_) < 1.0 ? 1 : 0;
    shape.volume += tetra_volume(corners);
  }
  return shape;
}

bool Judge::improves(Operation& operation) const {
  const PatchCells then = after(operation);
  for (const CellCorners& corners : then.now) {
    if (!(tetra_volume(corners) > 0.0)) return false;
  }
  const Shape old = shape_of(before(operation).rest);
  const Shape made = shape_of(then.rest);
  operation.least = made.quality;
  return made.quality > 0.0 && made.quality > (1.0 + kRise) * old.quality && made.bad <= old.bad &&
         std::abs(made.volume - old.volume) <= kVolume * volume_;
}

bool Judge::allows(const Operation& operation) const {
  std::vector<std::int32_t> parents;
  parents.reserve(operation.patch.size());
  for (const std::int32_t number : operation.patch) parents.push_back(mesh_.cell(number).parent);
  sort_unique(parents);
  if (rules_.are_alike && !rules_.are_alike(parents)) return false;
  return !rules_.allows_jump || rules_.allows_jump(parents.front(), before(operation), after(operation));
}

}  // namespace tissu
