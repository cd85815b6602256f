#include <algorithm>

#include "tissu/edit/cut/cut_plan.h"

namespace tissu {

std::int32_t CutPlan::bridges() const {
  const auto is_bridge = [](const auto& one) { return one.second == Unresolved::bridge; };
  return static_cast<std::int32_t>(std::ranges::count_if(unresolved, is_bridge));
}

std::string_view words(Unresolved reason) {
  switch (reason) {
    case Unresolved::pierced:
      return "the blade is narrower than the cell there and crosses none of its edges";
    case Unresolved::ends:
      return "the blade ends inside the cell and parts nothing";
    case Unresolved::folded:
      return "the blade crosses an edge of the cell more often than a cut follows";
    case Unresolved::shape:
      return "a tetrahedron between corners of the cell has no volume above zero at rest";
    case Unresolved::flat:
      return "the cut would leave a part of the cell too flat to be a cell";
    case Unresolved::bridge:
      return "the blade passes the cell more than once, and material between its sheets may stay joined";
  }
  return {};
}

}  // namespace tissu
