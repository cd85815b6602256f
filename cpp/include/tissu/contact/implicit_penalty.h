#pragma once

/// Springs and dampers between near surfaces, in implicit and static steps.
///
///     f = spring(d0 - d) - c u            u = n . J (x1 - x0) / h, f >= 0; no damper in static steps
///     f = t, t = lambda_n - k (d - stop)  where that is more: a spring at its end bears any load
///     friction                            with multipliers, as of the augmented method
///
/// k = 3 a with 1/a = |sum_r N_r beta_r^2 K_rr^-1| / phi of the stiffness K of the bodies at rest, so that it
/// is the same for every step; phi = (d0 - d) / d0 and the sum N_r of phi over the contacts at a row, so that
/// a contact that comes into range changes nothing of the others. Or a stiffness of the user's [Pa/m] times
/// the area of the contact. c = 2 zeta sqrt(k m), 1/m = sum_r beta_r^2 / m_r.

#include "tissu/assembly/mass.h"
#include "tissu/contact/implicit_contact.h"
#include "tissu/contact/penalty_law.h"

namespace tissu {

class ImplicitPenalty final : public ImplicitContact {
 public:
  /// `mass`: null in static steps.
  ImplicitPenalty(const Contact& contact, const FixedDofs& fixed, const Mass* mass, std::vector<double> rest);

 protected:
  [[nodiscard]] bool may_press(std::size_t i) const override;
  [[nodiscard]] bool rests_at_gap() const override { return false; }
  void begin_press() override;
  std::optional<double> press(std::size_t i, ContactNumbers& contact) override;

 private:
  /// c / h of a spring of stiffness k [N/m].
  [[nodiscard]] double damper_over_step(const ContactNumbers& contact, double k) const;

  const Mass* mass_;
  std::vector<double> rest_;     ///< diagonal blocks of the stiffness at rest
  std::vector<double> zetas_;    ///< of each pair
  std::vector<double> depths_;   ///< d0 - d of what was looked at [m]
  std::vector<double> ranges_;   ///< s0 of it [m]
  std::vector<double> shares_;   ///< phi of it
  std::vector<double> springs_;  ///< k of it [N/m]
};

}  // namespace tissu
