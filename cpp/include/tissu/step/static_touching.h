#pragma once

/// Equilibrium of bodies that touch: multipliers of contacts between Newton's iterations (Alart and Curnier
/// 1991, Computer Methods in Applied Mechanics and Engineering 92, 353-375).

#include "tissu/step/static_contact.h"

namespace tissu {

/// A part of a load is looked at again and again. A look finds the contacts, and their forces stay linear in
/// the positions while Newton's iteration solves for equilibrium with them; then multipliers become the
/// forces there. It is over where the contact forces and the depth stay, no way was cut, and the residual
/// with the forces that contacts may have - none that pulls, friction within Coulomb's disk - meets the
/// tolerance.
///
/// Bodies that the supports do not hold fall onto what they meet: a share of the mass stands beside the
/// tangent, and such a correction goes as far as the first contact. The mass changes the way, not where it
/// ends.
class StaticTouching final : public StaticContact {
 public:
  StaticTouching(Equilibrium& equilibrium, Profile& profile);

 private:
  bool seek(const LoadPath& path, double from, double to, int most, State& state,
            StepReport& report) override;
  void begin_part(const LoadPath& path, double from, double to, State& state);
  /// Newton's iteration with the contacts of the latest look; false: it found nothing.
  bool solve(const LoadPath& path, double before, double to, int most, State& state, StepReport& report);
  /// What flew is put where it first meets something.
  void fall(State& state);
  /// Looks again from what was solved; true where equilibrium is reached.
  bool look_again(double share, State& state, StepReport& report);
  void look_at(const State& at) { other_ = look(at); }
  /// Springs against sliding, where looks go round in a circle.
  void soften();

  State before_;  ///< of a look
  bool start_touches_ = false;
  bool is_falling_ = false;  ///< the latest correction was cut, by its length or by what it met
  int falls_ = 0;            ///< such corrections
  double other_ = 0.0;       ///< change of the contact forces at the latest look
  double depth_ = 0.0;       ///< at the latest look
  double best_ = 0.0;        ///< the least of them, …
  int idle_ = 0;             ///< … and looks since then
  double tangent_ = 1.0;     ///< times stiffer against sliding
  double relaxed_ = 1.0;     ///< share of the way from the look before that the next one goes
  int held_back_ = 0;
  std::size_t response_row_;
};

}  // namespace tissu
