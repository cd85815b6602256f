#include "tissu/element/reference_cell.h"

#include <algorithm>

#include "tissu/element/generated/all.h"

namespace tissu {
namespace {

template <class Rule>
constexpr RuleInfo rule_info(std::string_view name) {
  return {name, Rule::kPoints, Rule::kDegree, Rule::kZeroEnergyModes, Rule::kExactFor};
}

template <class Element>
constexpr ElementInfo element_info() {
  return {Element::kName,
          Element::kNodes,
          Element::kDimension,
          Element::kOrder,
          Element::kAffine,
          {rule_info<typename Element::Reduced>("reduced"), rule_info<typename Element::Full>("full"),
           rule_info<typename Element::Over>("over")}};
}

constexpr std::array<ElementInfo, kElementCount> kElements = [] {
  std::array<ElementInfo, kElementCount> all{};
  std::size_t count = 0;
  for_each_element([&](auto element) { all[count++] = element_info<decltype(element)>(); });
  return all;
}();

template <class Element, class Rule>
std::vector<ReferenceCell::Point> tabulate() {
  std::vector<ReferenceCell::Point> points;
  for (const auto& [xi, weight] : Rule::points) {
    const auto values = Element::values(xi);
    ReferenceCell::Point point{weight, {values.begin(), values.end()}, {}};
    for (const auto& gradient : Element::gradients(xi)) {
      std::ranges::copy(gradient, point.gradients.emplace_back().begin());
    }
    points.push_back(std::move(point));
  }
  return points;
}

template <class Element>
std::vector<ReferenceCell::Point> tabulate(std::string_view quadrature) {
  if (quadrature == "reduced") return tabulate<Element, typename Element::Reduced>();
  if (quadrature == "full") return tabulate<Element, typename Element::Full>();
  if (quadrature == "over") return tabulate<Element, typename Element::Over>();
  return {};
}

}  // namespace

const RuleInfo* ElementInfo::rule(std::string_view quadrature) const {
  const auto* found = std::ranges::find(rules, quadrature, &RuleInfo::name);
  return found == rules.end() ? nullptr : &*found;
}

std::span<const ElementInfo> elements() { return kElements; }

const ElementInfo* find_element(std::string_view name) {
  const auto* found = std::ranges::find(kElements, name, &ElementInfo::name);
  return found == kElements.end() ? nullptr : &*found;
}

ReferenceCell reference_cell(std::string_view element, std::string_view quadrature) {
  ReferenceCell cell{element, 0, 0, {}};
  for_each_element([&](auto candidate) {
    using Element = decltype(candidate);
    if (element != Element::kName) return;
    cell = {Element::kName, Element::kNodes, Element::kDimension, tabulate<Element>(quadrature)};
  });
  return cell;
}

}  // namespace tissu
