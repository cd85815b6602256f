#pragma once

/// Springs (penalty_law.h) and dampers between near surfaces, in explicit steps.
///
///     normal        f = spring(d0 - d) - c u      f >= 0
///     friction      f_T = lambda_T - k u_T - c v_T on the disk of radius mu f
///
/// u = n . J v; u_T is the sliding since the start of the step and lambda_T what the spring of friction held
/// then, so that what sticks does not creep.
///
///     k = sigma omega^2 a      phi / a = largest of sum_r N_r beta_r^2 / m_r      sigma = 1/3
///
/// with the largest frequency omega of the bodies at rest, phi = (d0 - d) / d0 and the sum N_r of phi over
/// the contacts at a row: J^T k J <= sigma omega^2 M (Cauchy-Schwarz), so that contact alone shortens the
/// stable step by sqrt(1 - 1/4), whatever touches. One contact alone at its rows does not feel phi, and one
/// that comes into range changes nothing of the others. A stiffness of the user's [Pa/m] gives k by the area
/// of the contact. c = 2 zeta sqrt(k a), zeta = 0.2, or what gives back the restitution. A spring that is
/// pressed to the last fifth of the gap has a stop there: impulses without restitution.

#include "tissu/contact/impulse.h"
#include "tissu/contact/penalty_law.h"

namespace tissu {

class PenaltyContact final : public ImpulseContact {
 public:
  PenaltyContact(const Contact& contact, const FixedDofs& fixed, const Mass& mass, double frequency);

  [[nodiscard]] ContactRates rates() const override { return rates_; }
  [[nodiscard]] double stiffest() const override { return stiffest_; }
  [[nodiscard]] bool stays() const override { return false; }
  [[nodiscard]] bool strikes_first() const override { return near_stop_; }
  void add_force(const State& at, double share, Reals f) override;

 protected:
  void begin_response() override;
  void keep(const State& end, std::vector<ContactNumbers>& kept) override;
  void begin_blow(Blow& blow, double pushed) const override;

 private:
  /// A contact in its range.
  struct Near {
    std::size_t looked;
    double depth;  ///< d0 - d [m]
    double range;  ///< s0 [m]
    double share;  ///< phi
  };
  void find_near();
  void share_rows();
  Vec3 force_of(ContactNumbers& contact, const Near& near, const State& at);

  double omega2_;              ///< sigma omega^2 [1/s2]
  std::vector<double> zetas_;  ///< of each pair
  ContactRates rates_;
  double stiffest_ = 0.0;
  bool near_stop_ = false;
  std::vector<Near> near_;
  std::vector<double> shared_;         ///< N_r
  std::vector<ContactNumbers> acted_;  ///< in every stage, whose number stands in `sliding`
  double stage_ = 2.0;                 ///< after what stops have there
};

}  // namespace tissu
