#include "tissu/element/reference_cell.h"

#include "tissu/element/hexahedron.h"
#include "tissu/element/tetra.h"

namespace tissu {
namespace {

template <class Element, class Rule>
ReferenceCell tabulate() {
  ReferenceCell cell{Element::kName, Element::kNodes, {}};
  for (const QuadraturePoint& point : Rule::points) {
    const auto values = Element::values(point.xi);
    const auto gradients = Element::gradients(point.xi);
    cell.points.push_back(
        {point.weight, {values.begin(), values.end()}, {gradients.begin(), gradients.end()}});
  }
  return cell;
}

template <class Element>
bool tabulate_if(std::string_view element, std::string_view quadrature, ReferenceCell& cell) {
  if (element != Element::kName) return false;
  if (quadrature == "full") cell = tabulate<Element, typename Element::Full>();
  if (quadrature == "over") cell = tabulate<Element, typename Element::Over>();
  return true;
}

}  // namespace

ReferenceCell reference_cell(std::string_view element, std::string_view quadrature) {
  ReferenceCell cell{element, 0, {}};
  (void)(tabulate_if<Tetra4>(element, quadrature, cell) ||
         tabulate_if<Hexahedron8>(element, quadrature, cell));
  return cell;
}

}  // namespace tissu
