#pragma once

/// Derivatives by differences, and long arrays seen as Eigen's vectors.

#include "tissu/base/vec.h"

namespace tissu::test {

inline Eigen::Map<const Eigen::VectorXd> view(ConstReals values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

/// df/dt at t = 0 from four values. Its error is that of a polynomial of degree five: for the energies of
/// Hooke's and St-Venant–Kirchhoff's laws (degree 2 and 4 in the positions) it is exact, and only round-off
/// is left.
template <class Function>
auto derivative(Function&& f, double h) {
  using Value = decltype(f(h));
  return Value((8.0 * (f(h) - f(-h)) - (f(2.0 * h) - f(-2.0 * h))) / (12.0 * h));
}

}  // namespace tissu::test
