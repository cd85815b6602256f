#pragma once

#include <string_view>
#include <vector>

#include "tissu/base/vec.h"
#include "tissu/element/generated/all.h"

namespace tissu::test {

/// Reference coordinates of an element's nodes, zero beyond its dimension.
inline std::vector<Vec3> reference_nodes(std::string_view element) {
  std::vector<Vec3> found;
  for_each_element([&](auto candidate) {
    if (candidate.kName != element) return;
    for (const auto& node : candidate.nodes) {
      Vec3 x = Vec3::Zero();
      for (std::size_t i = 0; i < node.size(); ++i) x[static_cast<Eigen::Index>(i)] = node[i];
      found.push_back(x);
    }
  });
  return found;
}

}  // namespace tissu::test
