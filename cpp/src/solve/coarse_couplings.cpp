#include "coarse_couplings.h"

namespace tissu {
namespace {

/// What an aggregate does to a vertex through one of its rows: a point at x moves by t + r x (x - c), a
/// rotation by r.
void add_parts(const CarriedPart& part, const Aggregates& aggregates, const RowPlaces& fine,
               const RowPlaces& coarse, std::vector<CarriedPart>& parts) {
  const std::int32_t aggregate = aggregates.of[static_cast<std::size_t>(part.row)];
  if (aggregate < 0) return;
  CarriedPart moved = part;
  if (fine.is_rotation(part.row)) {
    moved.row = 2 * aggregate + 1;
    parts.push_back(moved);
    return;
  }
  moved.row = 2 * aggregate;
  parts.push_back(moved);
  if (part.turns) return;
  moved.row = 2 * aggregate + 1;
  moved.turns = true;
  moved.arm =
      block(ConstReals(fine.positions), part.row) - block(ConstReals(coarse.positions), 2 * aggregate);
  parts.push_back(moved);
}

}  // namespace

void coarsen_couplings(const Couplings& fine, const Aggregates& aggregates, const RowPlaces& fine_places,
                       const RowPlaces& coarse_places, std::vector<CarriedPart>& scratch, Couplings& coarse) {
  coarse.clear();
  std::vector<CarriedPart>& parts = scratch;
  for (const Coupling& coupling : fine.list()) {
    Coupling moved = coupling;
    bool moves = false;
    for (std::size_t v = 0; v < 4; ++v) {
      if (coupling.beta[v] == 0.0) continue;
      parts.clear();
      const std::int32_t vertex = coupling.vertex[v];
      if (vertex > Couplings::kCarried) {
        add_parts({vertex, 1.0}, aggregates, fine_places, coarse_places, parts);
      } else {
        for (const CarriedPart& part : fine.parts(vertex))
          add_parts(part, aggregates, fine_places, coarse_places, parts);
      }
      if (parts.empty()) {
        moved.beta[v] = 0.0;
        continue;
      }
      moves = true;
      moved.vertex[v] = coarse.carry(parts);
    }
    if (moves) coarse.add(moved);
  }
  coarse.close(2 * aggregates.count, nullptr);
}

}  // namespace tissu
