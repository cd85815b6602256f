#pragma once

/// The elements by name, and an element with one of its rules as tables, for what is done once: rest shapes,
/// masses, checks. Elements are made from python/tissu/codegen/elements.py; names are meshio's.

#include <array>
#include <span>
#include <string_view>
#include <vector>

namespace tissu {

struct RuleInfo {
  std::string_view name;  ///< "reduced", "full" or "over"
  int points;
  int degree;                  ///< polynomials of this total degree are integrated exactly
  int zero_energy_modes;       ///< displacements without energy beyond the rigid ones, of one element alone
  std::string_view exact_for;  ///< "hooke" or "stvk" on affine cells, or empty
};

struct ElementInfo {
  std::string_view name;
  int nodes;
  int dimension;  ///< m of the reference cell
  int order;      ///< holds every polynomial of this degree
  bool affine;    ///< one Jacobian serves the whole cell, whatever its nodes
  std::array<RuleInfo, 3> rules;

  /// The rule of that name, null when there is none.
  const RuleInfo* rule(std::string_view quadrature) const;
};

/// Every element, in the order of the table.
std::span<const ElementInfo> elements();

/// The element of that name, null when there is none.
const ElementInfo* find_element(std::string_view name);

struct ReferenceCell {
  std::string_view element;
  int nodes;
  int dimension;  ///< m
  struct Point {
    double weight;
    std::vector<double> values;                    ///< N_a
    std::vector<std::array<double, 3>> gradients;  ///< dN_a/dxi, the entries beyond m are zero
  };
  std::vector<Point> points;
};

/// The tables of an element and one of its rules. No points when there is no such rule, and no nodes either
/// when there is no such element.
ReferenceCell reference_cell(std::string_view element, std::string_view quadrature);

}  // namespace tissu
