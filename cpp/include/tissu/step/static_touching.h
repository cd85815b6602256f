#pragma once

/// Equilibrium of bodies that touch: multipliers of contacts between Newton's iterations (Alart and Curnier
/// 1991, Computer Methods in Applied Mechanics and Engineering 92, 353-375).

#include <memory>
#include <string>
#include <vector>

#include "tissu/contact/implicit_contact.h"
#include "tissu/step/equilibrium.h"

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
class StaticTouching {
 public:
  StaticTouching(Equilibrium& equilibrium, Profile& profile);

  /// The largest part of a path on which no obstacle is led by more than half a mean edge.
  [[nodiscard]] double largest_part(const LoadPath& path, const State& start) const;
  /// Equilibrium at the share `to`, from `state`, which stands at the share `from`; at most `most` of
  /// Newton's iterations. False: none was found, `reason` says why, and the state is undefined.
  bool find(const LoadPath& path, double from, double to, int most, State& state, StepReport& report);
  [[nodiscard]] const std::string& reason() const { return reason_; }
  /// Whether the state that was found is a saddle of the energy of what does not rub.
  [[nodiscard]] bool is_unstable() const { return is_unstable_; }

 private:
  void begin(const LoadPath& path, double from, double to, State& state);
  bool look_until_it_stays(const LoadPath& path, double before, double to, int most, State& state,
                           StepReport& report);
  /// Newton's iteration with the contacts of the latest look; false: it found nothing.
  bool solve(const LoadPath& path, double before, double to, int most, State& state, StepReport& report);
  /// What flew is put where it first meets something.
  void fall(State& state);
  /// Looks again from what was solved; true where equilibrium is reached.
  bool look_again(double share, State& state, StepReport& report);
  void look(const State& at);
  int hold_back(State& to);
  /// Springs against sliding, where looks go round in a circle.
  void soften();
  void measure_mass();
  bool give_up(std::string why);

  Equilibrium& equilibrium_;
  Profile& profile_;
  std::unique_ptr<ImplicitContact> contact_;
  State start_;   ///< of the part, at the time at which what is led stands there
  State before_;  ///< of a look
  State held_;    ///< to where no way is cut
  bool is_loose_;
  bool start_touches_ = false;
  bool is_falling_ = false;  ///< the latest correction was cut, by its length or by what it met
  int falls_ = 0;            ///< such corrections
  bool is_unstable_ = false;
  double other_ = 0.0;    ///< change of the contact forces at the latest look
  double depth_ = 0.0;    ///< at the latest look
  double best_ = 0.0;     ///< the least of them, …
  int idle_ = 0;          ///< … and looks since then
  double tangent_ = 1.0;  ///< times stiffer against sliding
  double relaxed_ = 1.0;  ///< share of the way from the look before that the next one goes
  int held_back_ = 0;
  std::vector<double> blocks_;
  std::vector<double> way_;
  std::string reason_;
  std::size_t detection_row_;
  std::size_t travel_row_;
  std::size_t response_row_;
};

}  // namespace tissu
