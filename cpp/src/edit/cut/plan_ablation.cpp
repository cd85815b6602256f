#include <algorithm>
#include <string>

#include "edit/cut/fans.h"
#include "edit/cut/fragments.h"
#include "edit/cut/patch.h"
#include "edit/cut/write_plan.h"
#include "tissu/base/error.h"
#include "tissu/edit/cut/cut_plan.h"

namespace tissu {

CutPlan plan_ablation(const Hosts& hosts, const Material& material, std::vector<std::int32_t> cells) {
  std::ranges::sort(cells);
  cells.erase(std::ranges::unique(cells).begin(), cells.end());
  for (const std::int32_t cell : cells) {
    if (!hosts.has(cell))
      throw ParameterError("the body has no cell " + std::to_string(cell) + " (any more).");
  }
  Patch patch(hosts, material, hosts.rest(), hosts.with_neighbours(cells));
  std::vector<std::int32_t> parted;
  for (const Patch::Tetra& tetra : patch.tetrahedra) {
    if (!std::ranges::binary_search(cells, patch.cell(tetra.cell).number)) continue;
    const auto end = tetra.vertices.begin() + static_cast<std::ptrdiff_t>(tetra.corners());
    parted.insert(parted.end(), tetra.vertices.begin(), end);
  }
  std::ranges::sort(parted);
  parted.erase(std::ranges::unique(parted).begin(), parted.end());
  CutPlan plan;
  plan.gone = cells;
  const Fragments fragments(hosts, patch, cells, cells);
  const Replicas replicas = find_replicas(hosts, patch, fragments);
  write_plan(hosts, material, patch, fragments, replicas, Fans(patch, fragments, parted), plan);
  return plan;
}

}  // namespace tissu
