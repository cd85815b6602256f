#include "edit/cut/riders.h"

#include <cmath>
#include <map>

#include "tissu/base/index.h"

namespace tissu {

Rider rider_of(const Material& material, std::int32_t vertex) {
  if (vertex < 0) return material.riders[at(-1 - vertex)];
  return {{vertex, -1, -1, -1}, {1.0, 0.0, 0.0, 0.0}, 1};
}

std::optional<Rider> between(const Material& material, std::span<const std::int32_t> vertices,
                             std::span<const double> weights) {
  std::map<std::int32_t, double> sums;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Rider own = rider_of(material, vertices[i]);
    for (std::size_t k = 0; k < at(own.count); ++k) sums[own.node[k]] += weights[i] * own.weight[k];
  }
  Rider result;
  if (sums.size() > result.node.size()) return std::nullopt;
  for (const auto& [node, weight] : sums) {
    if (!std::isfinite(weight)) return std::nullopt;
    result.node[at(result.count)] = node;
    result.weight[at(result.count++)] = weight;
  }
  return result;
}

}  // namespace tissu
