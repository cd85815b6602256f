#pragma once

/// Positions and velocities that are put right after an explicit step (Chendeb 2007, section 4.3.2, with the
/// masses and along the normal of the contact):
///
///     places      dp_k = (xi - d) (beta_k / m_k) / sum(beta^2 / m) n / N_k, in four sweeps at most
///     velocities  of what is shut: u = n . J v becomes zero where it closes, and the sliding v_T shorter by
///                 mu |du|, one contact after the other in the order of their keys
///
/// Linear momentum is kept to round-off. Contacts that share nodes undo a part of each other's work, which
/// the next step does again: nothing is solved.

#include "tissu/contact/impulse.h"

namespace tissu {

class GeometricContact final : public ImpulseContact {
 public:
  using ImpulseContact::ImpulseContact;

  void strike_way(ConstReals way, Reals change) override;
  void strike_end(ConstReals velocities, const State& end, Reals change) override;

 protected:
  void begin_blow(Blow& blow, double pushed) const override;
  void keep(const State& end, std::vector<ContactNumbers>& kept) override;
};

}  // namespace tissu
