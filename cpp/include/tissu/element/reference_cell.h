#pragma once

/// An element and one of its rules as tables, for what is done once: rest shapes, masses, checks.

#include <array>
#include <string_view>
#include <vector>

namespace tissu {

struct ReferenceCell {
  std::string_view element;
  int nodes;
  struct Point {
    double weight;
    std::vector<double> values;                    ///< N_a
    std::vector<std::array<double, 3>> gradients;  ///< dN_a/dxi
  };
  std::vector<Point> points;
};

/// The tables of an element ("tetra", "hexahedron") and a rule ("full", "over"); no points when there is
/// none.
ReferenceCell reference_cell(std::string_view element, std::string_view quadrature);

}  // namespace tissu
