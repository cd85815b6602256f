#include <algorithm>
#include <string>

#include "edit/cut/fans.h"
#include "edit/cut/fragments.h"
#include "edit/cut/missing_cell.h"
#include "edit/cut/patch.h"
#include "edit/cut/write_plan.h"
#include "tissu/base/error.h"
#include "tissu/base/sort_unique.h"
#include "tissu/edit/cut/cut_plan.h"

namespace tissu {

CutPlan plan_ablation(const Hosts& hosts, const Material& material, std::vector<std::int32_t> cells) {
  sort_unique(cells);
  for (const std::int32_t cell : cells) {
    if (!hosts.has(cell)) throw missing_cell(cell);
  }
  Patch patch(hosts, material, hosts.rest(), hosts.with_neighbours(cells));
  std::vector<std::int32_t> parted;
  for (const Patch::Tetra& tetra : patch.tetrahedra) {
    if (!std::ranges::binary_search(cells, patch.cell(tetra.cell).number)) continue;
    const auto end = tetra.vertices.begin() + static_cast<std::ptrdiff_t>(tetra.corners());
    parted.insert(parted.end(), tetra.vertices.begin(), end);
  }
  sort_unique(parted);
  CutPlan plan;
  plan.gone = cells;
  const Fragments fragments(hosts, patch, cells, cells);
  const Replicas replicas = find_replicas(hosts, patch, fragments);
  write_plan(hosts, material, patch, fragments, replicas, Fans(patch, fragments, parted), plan);
  return plan;
}

}  // namespace tissu
