#include <algorithm>

#include "tissu/force/elastic.h"

namespace tissu {
namespace {

constexpr int kLanes = ElementOrder::kLanes;

double of_cell(const std::vector<double>& values, std::int32_t cell) {
  return values.size() == 1 ? values.front() : values[static_cast<std::size_t>(cell)];
}

}  // namespace

/// Calls f(node, mass of the cell, sum_g w_g rho N_a, share of the node in sum_g w_g N_a^2).
template <class Function>
void Elastic::for_nodes(Function&& f) const {
  const auto nodes = static_cast<std::size_t>(reference_.nodes);
  const std::size_t points = reference_.points.size();
  const auto rest_points = static_cast<std::size_t>(shape_.rest_points);
  const std::size_t rest = shape_.reals;
  std::vector<double> first(nodes);
  std::vector<double> second(nodes);
  for (std::size_t i = 0; i < order_.element.size(); ++i) {
    if (order_.real[i] == 0) continue;
    const auto e = static_cast<std::size_t>(order_.element[i]);
    const double density = of_cell(block_.density, order_.element[i]);
    std::ranges::fill(first, 0.0);
    std::ranges::fill(second, 0.0);
    double squares = 0.0;
    for (std::size_t g = 0; g < points; ++g) {
      const std::size_t at = i / kLanes * rest_points + (rest_points == 1 ? 0 : g);
      const double w = shape_.rest[(at * rest + rest - 1) * kLanes + i % kLanes] * shape_.weights[g];
      for (std::size_t a = 0; a < nodes; ++a) {
        const double N = reference_.points[g].values[a];
        first[a] += w * density * N;
        second[a] += w * N * N;
        squares += w * N * N;
      }
    }
    for (std::size_t a = 0; a < nodes; ++a) {
      const auto node = static_cast<std::size_t>(block_.cells[e * nodes + a]);
      f(node, density * shape_.volumes[e], first[a], second[a] / squares);
    }
  }
}

void Elastic::add_weights(std::vector<double>& nodal) const {
  for_nodes([&](std::size_t node, double, double weight, double) { nodal[node] += weight; });
}

void Elastic::add_masses(std::vector<double>& nodal) const {
  const bool linear = find_element(block_.element)->order == 1;
  for_nodes([&](std::size_t node, double mass, double weight, double share) {
    nodal[node] += linear ? weight : mass * share;
  });
}

}  // namespace tissu
