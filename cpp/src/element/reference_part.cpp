#include "tissu/element/reference_part.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tissu/element/generated/all.h"

namespace tissu {
namespace {

/// Adds the point of an element at some coordinates to the rule of a part.
template <class Element>
void add_point(ReferenceCell& cell, const ReferencePoint& at, double weight) {
  typename Element::Point xi{};
  std::copy_n(at.begin(), xi.size(), xi.begin());
  const auto values = Element::values(xi);
  ReferenceCell::Point point{weight, {values.begin(), values.end()}, {}};
  for (const auto& gradient : Element::gradients(xi))
    std::ranges::copy(gradient, point.gradients.emplace_back().begin());
  cell.points.push_back(std::move(point));
}

ReferencePoint mean(std::span<const double> weights, std::span<const ReferencePoint> points) {
  ReferencePoint sum{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weights[i] * points[i][k];
  }
  return sum;
}

/// The triangle has a rule of its own for low degrees. For others it is a square with one side drawn together
/// into its last corner.
template <class Element>
void add_points(ReferenceCell& cell, std::span<const ReferencePoint> part, int degree) {
  const double measure = reference_measure(part);
  if (part.size() == 2) {
    for (const auto& [xi, weight] : Line3::Over::points)
      add_point<Element>(cell, mean(Line2::values(xi), part), 0.5 * weight * measure);
    return;
  }
  if (degree <= Triangle6::Over::kDegree) {
    for (const auto& [xi, weight] : Triangle6::Over::points)
      add_point<Element>(cell, mean(Triangle3::values(xi), part), 2.0 * weight * measure);
    return;
  }
  for (const auto& [xi, weight] : Quad9::Over::points) {
    const double along = 0.5 * (1.0 + xi[0]);
    const double left = 0.5 * (1.0 - xi[1]);  // of the width of the triangle
    const std::array<double, 3> shares{(1.0 - along) * left, along * left, 1.0 - left};
    add_point<Element>(cell, mean(shares, part), 0.5 * weight * left * measure);
  }
}

}  // namespace

std::vector<ReferencePoint> reference_nodes(std::string_view element) {
  std::vector<ReferencePoint> nodes;
  for_each_element([&](auto candidate) {
    using Element = decltype(candidate);
    if (element != Element::kName) return;
    for (const auto& node : Element::nodes) std::ranges::copy(node, nodes.emplace_back().begin());
  });
  return nodes;
}

double reference_measure(std::span<const ReferencePoint> part) {
  const auto& a = part[0];
  const auto& b = part[1];
  if (part.size() == 2) return std::abs(b[0] - a[0]);
  const auto& c = part[2];
  return 0.5 * std::abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
}

ReferenceCell reference_part(std::string_view element, std::span<const ReferencePoint> part, int degree) {
  ReferenceCell cell{element, 0, 0, {}};
  for_each_element([&](auto candidate) {
    using Element = decltype(candidate);
    if (element != Element::kName) return;
    cell.element = Element::kName;
    cell.nodes = Element::kNodes;
    cell.dimension = Element::kDimension;
    add_points<Element>(cell, part, degree);
  });
  return cell;
}

}  // namespace tissu
