#pragma once

/// Equilibrium of bodies between which contact has a potential (after Li et al. 2020, ACM Transactions on
/// Graphics 39(4), Incremental potential contact).

#include <vector>

#include "tissu/contact/barrier.h"
#include "tissu/step/static_contact.h"

namespace tissu {

/// Newton's iteration along which the energy falls, on ways that lead through nothing. The normal forces of
/// friction are those at the start of an iteration, so that each descends in a potential; where it ends, they
/// are those of the state itself.
///
/// A step from a state with an indefinite tangent goes by a mean of the tangent and the definite matrix.
/// Bodies that the supports do not hold have a share of the mass beside the tangent, as in `StaticTouching`.
class StaticBarrier final : public StaticContact {
 public:
  StaticBarrier(Equilibrium& equilibrium, Profile& profile);

  /// From an equilibrium at a share of the load to that in which surfaces rest near their gap, as augmented
  /// contacts do. False: none was found, and the state is undefined.
  bool find_at_gap(const LoadPath& path, double share, int most, State& state, StepReport& report);

 private:
  bool seek(const LoadPath& path, double from, double to, int most, State& state,
            StepReport& report) override;
  /// `state` goes where ways begin, with what is led at its end. False: something is in the way there.
  [[nodiscard]] bool stand(const LoadPath& path, double to, State& state);
  /// Contacts of `state`, whose friction has the normal forces there.
  void refresh(State& state);
  /// The potential of a state with that of its contacts, which do not act yet [J].
  double energy(State& state);
  /// The change by the tangent, or by a mean of it and the definite matrix; it lowers the energy.
  void solve(const State& state, StepReport& report);
  /// A share of the change that leads through nothing and lowers the energy; false: none.
  bool search(double now, State& state);
  /// Whether `trial_`, to which that share of the change leads from `state`, is nearer to equilibrium.
  bool is_lower(double from, double share, double slope, double now, State& state);

  BarrierContact& barrier_;
  State trial_;
  std::vector<double> change_;
  std::vector<double> work_;
  double mean_ = 0.0;  ///< share of the definite matrix; 0: the tangent was definite
  bool flew_ = false;  ///< the latest change was cut
};

}  // namespace tissu
