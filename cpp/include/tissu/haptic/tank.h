#pragma once

/// An energy tank and an observer. Under sample and hold the energy that a port has given out is exact and
/// needs no velocity: W_out(k) = sum_j tau_(j-1) . (q_j - q_(j-1)).
///
/// What is given out, and what is stored more than before, is paid by the tank; what the device dissipates
/// fills it, as far as it is sure (80 %). A new model that stores more at the same joints is adopted by the
/// share that the tank pays. Hannaford and Ryu 2002 for the observer; Franken, Stramigioli et al. 2011 for
/// the tank.

#include "tissu/haptic/kinematics.h"

namespace tissu::haptic {

struct TankSettings {
  double start = 1e-3;  ///< [J]
  double cap = 5e-3;    ///< [J]
  double credit = 0.8;  ///< of the device's own dissipation
  bool gate = true;     ///< false: models are adopted whole, whatever it costs (to show what the tank is for)
};

/// What the tank remembers.
struct Tank {
  double energy = 0.0;     ///< E_t [J]; below 0: the observer has tripped
  double given_out = 0.0;  ///< W_out since the start [J]
  double credited = 0.0;   ///< of the device's dissipation since the start [J]
  double models = 0.0;     ///< what adopted models stored more than those before, since the start [J]
  double stiffness = 1.0;  ///< share of K_c that the observer leaves, from 1/8 to 1
  double debt = 0.0;       ///< E_t at the last trip [J]
  int trips = 0;

  void fill(const TankSettings& settings) noexcept { *this = Tank{.energy = settings.start}; }
  /// One tick: `work` = tau_(k-1) . dq, `stored` = S_old(q_k) - S_(k-1), `dissipated` = (b v^2 + f_c |v|) T
  /// [J].
  void settle(const TankSettings& settings, double work, double stored, double dissipated) noexcept;
  /// The share of `more` = S_new(q_k) - S_old(q_k) that the tank pays: 1 where more <= 0, which is credited.
  double pay(const TankSettings& settings, double more) noexcept;
  /// After `settle`: halves the stiffness where E_t < 0 and deeper than at the last trip; without a debt it
  /// recovers by 10 % a second.
  void observe(const TankSettings& settings, double period) noexcept;
  /// Damping torques that pay a debt: -beta b v, beta = min(1, -E_t / (T sum b v^2)), only of joints above
  /// `slow` = 2 counts a tick.
  [[nodiscard]] Joints damping(const Joints& viscous, const Joints& v, const Joints& slow,
                               double period) const noexcept;
};

}  // namespace tissu::haptic
