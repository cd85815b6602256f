#pragma once

/// Multipliers (augmented Lagrangian: Alart and Curnier 1991, Computer Methods in Applied Mechanics and
/// Engineering 92, 353-375).
///
///     normal      t = lambda_n - k g          f_n = <t> n,  H_n = k n n^T where t > 0
///                 f_n = t n, the same H_n     where lambda_n > 0 in the first systems of a step of time
///     friction    t_T = lambda_T - k u_T      F = mu <t>, f_T = t_T on the disk of radius F
///     F = mu <lambda_n - k g / (1 + s)> of rigid bodies: what the solve leaves of t
///     slides where |lambda_T - k u_T / (1 + s)| > F, for the same reason
///     after each solve  lambda_n <- n . f,  lambda_T <- f_T on the disk

#include "tissu/contact/extrapolation.h"
#include "tissu/contact/implicit_contact.h"

namespace tissu {

class AugmentedContact final : public ImplicitContact {
 public:
  using ImplicitContact::ImplicitContact;

  /// Steps are those of time: what presses may pull in their first systems, and multipliers are led on.
  void step_in_time() { in_time_ = true; }
  void take() override;
  [[nodiscard]] bool holds_on() const override;

 protected:
  /// It has a multiplier, or is shut, or will be.
  [[nodiscard]] bool may_press(std::size_t i) const override {
    return run_.looked()[i].force > 0.0 || run_.gap(i) < 0.0 || run_.is_predicted(i);
  }
  std::optional<double> press(std::size_t i, ContactNumbers& contact) override;

 private:
  bool in_time_ = false;
  Extrapolation extrapolation_;
};

}  // namespace tissu
