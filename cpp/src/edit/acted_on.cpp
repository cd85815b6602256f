#include "acted_on.h"

#include <algorithm>

namespace tissu {

void mark_held(const WorldDescription& description, std::string_view body, std::vector<char>& is_held) {
  for (const FixedNodes& fixed : description.fixed) {
    if (fixed.body != body) continue;
    for (const std::int32_t node : fixed.nodes) is_held[static_cast<std::size_t>(node)] = 1;
  }
}

void keep_acted_on(const WorldDescription& description, std::string_view body, std::vector<char>& may_move) {
  const auto keep = [&](std::int32_t node) { may_move[static_cast<std::size_t>(node)] = 0; };
  for (const FixedNodes& fixed : description.fixed) {
    if (fixed.body == body) std::ranges::for_each(fixed.nodes, keep);
  }
  for (const LoadDescription& load : description.loads) {
    if (load.body == body) std::ranges::for_each(load.nodes, keep);
  }
  for (const BodyDescription& tissue : description.bodies) {
    for (const SharedNode& tie : tissue.shared) {
      if (tie.body == body) keep(tie.node);
    }
  }
}

}  // namespace tissu
