#pragma once

/// Multipliers that settle slowly are led on to where they are going. While the same contacts act, what a
/// system changes multipliers by is a linear function of what the one before changed them by; where one mode
/// of it is left, changes d_k shrink by one ratio rho (Aitken 1926; vectors: Irons and Tuck 1969,
/// International Journal for Numerical Methods in Engineering 1, 275-277):
///
///     lambda <- lambda + rho / (1 - rho) d_k      rho = d_k . d_(k-1) / |d_(k-1)|^2
///
/// d_k has the normal force of each contact and its friction, so that normals may turn from system to system.
///
/// What the next system starts from is all that changes: its forces are solved for, and judged, as before.

#include <Eigen/Core>
#include <span>
#include <tuple>
#include <vector>

#include "tissu/base/vec.h"
#include "tissu/contact/contact.h"

namespace tissu {

class Extrapolation {
 public:
  /// A step begins.
  void forget() { count_ = 0; }
  /// `solved`: contacts with the multipliers that a system left. `next`: those of the next system, whose
  /// forces are led on.
  void lead(std::span<const ContactNumbers> solved, std::span<ContactNumbers> next);

 private:
  [[nodiscard]] bool is_known(std::span<const ContactNumbers> contacts) const;
  [[nodiscard]] double factor() const;

  std::vector<std::tuple<double, double, double, double>> keys_;
  std::vector<Eigen::Vector4d> latest_;  ///< multipliers: normal, and friction [N]
  std::vector<Eigen::Vector4d> change_;  ///< of them by the latest system, …
  std::vector<Eigen::Vector4d> before_;  ///< … and by the one before it
  int count_ = 0;  ///< systems in a row with these contacts, since multipliers were led on
};

}  // namespace tissu
