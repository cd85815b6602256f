#pragma once

/// A law answers four questions about one material point, and nothing else: how much energy [J/m3], which
/// first Piola–Kirchhoff stress P = dW/dF [Pa], which change of stress for a change of F, and all of dP/dF at
/// once.

#include <concepts>
#include <string_view>

#include "tissu/law/tensor.h"

namespace tissu {

/// `L` is a class template over the scalar; its members are its constants, in the order of `L::kConstants`.
template <template <class> class L>
concept Law = requires(const L<double> law, const Tensor2<double> F, const Tensor2<double> dF) {
  { L<double>::kName } -> std::convertible_to<std::string_view>;
  { law.energy(F) } -> std::same_as<double>;
  { law.stress(F) } -> std::same_as<Tensor2<double>>;
  { law.stress_change(F, dF) } -> std::same_as<Tensor2<double>>;
  { law.tangent(F) } -> std::same_as<Tangent<double>>;
};

/// Lamé's constants of Young's modulus E and Poisson's ratio nu:
///   lambda = E nu / ((1 + nu)(1 - 2 nu)),  mu = E / (2 (1 + nu)).
struct Lame {
  double lambda;  ///< [Pa]
  double mu;      ///< [Pa]
};

/// Refuses E <= 0 and nu outside (-1, 0.5).
Lame lame(double young, double poisson);

/// Lamé's lambda of a piece of 2 or 1 dimensions that is free to thin: 2 lambda mu / (lambda + 2 mu) for a
/// sheet, and E - 2 mu for a line, so that lambda + 2 mu is Young's modulus there; of a volume lambda itself.
inline double free_lambda(Lame c, int dimension) {
  if (dimension == 3) return c.lambda;
  return dimension == 2 ? 2.0 * c.lambda * c.mu / (c.lambda + 2.0 * c.mu)
                        : c.mu * c.lambda / (c.lambda + c.mu);
}

}  // namespace tissu
