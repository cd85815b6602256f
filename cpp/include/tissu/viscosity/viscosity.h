#pragma once

/// What a body's viscosity is made of, as plain data; all of it adds up. Rayleigh's is apart: it belongs to
/// the model it damps.

#include <string>
#include <vector>

namespace tissu {

/// A branch of a generalised Maxwell body: a spring and a damper in a row, beside the law.
struct PronyBranch {
  double weight;  ///< its stiffness beside the law's own at small strain, which is that of long times
  double time;    ///< after which its stress has fallen to 1/e [s]
};

struct Viscosity {
  /// S_v = 2 shear dE/dt + bulk tr(dE/dt) I, of Kelvin and Voigt [Pa s]
  double shear = 0.0;
  double bulk = 0.0;
  /// f_a = -centroid V (v_a - mean v) of each cell [N s/m4]
  double centroid = 0.0;
  std::vector<PronyBranch> prony = {};

  static constexpr std::size_t kMostBranches = 16;
  [[nodiscard]] bool any() const { return shear > 0.0 || bulk > 0.0 || centroid > 0.0 || !prony.empty(); }
};

/// Refuses coefficients that are negative or not finite, branches without a time, and more than there may be.
void check_viscosity(const std::string& body, const Viscosity& viscosity);

}  // namespace tissu
