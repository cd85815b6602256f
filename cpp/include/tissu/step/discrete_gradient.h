#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "tissu/model/part_energies.h"
#include "tissu/step/momentum_free.h"
#include "tissu/step/parts.h"
#include "tissu/step/system.h"

namespace tissu {

/// Gonzalez's discrete gradient, part by part: what makes the work of the midpoint rule's force over a step
/// the change of the energy that each connected part stores,
///   a_p M d_p,  a_p = -(W_p(x1) - W_p(x0) + f_p(x) . (x1 - x0)) / (d_p . M d_p),
/// d_p the way x1 - x0 of the part, of a free one without its rigid motion (MomentumFree). So parts exchange
/// nothing by it. Links store k l^2 / 2, whose work along a chord is exact: they need no correction, and do
/// not join parts.
class DiscreteGradient {
 public:
  void prepare(System& system);
  /// The factors a_p of a way: `middle` is without velocities. Afterwards `way` is as it was.
  void find(const State& from, const State& middle, const State& end, ConstReals way);
  /// f += scale sum_p a_p M d_p
  void add_force(double scale, Reals f) const;
  /// No part has a correction.
  [[nodiscard]] bool is_zero() const { return active_ == 0; }
  /// The least a_p: what a matrix with one share of mass errs with on the safe side.
  [[nodiscard]] double least_factor() const;
  /// The residual that the round-off of the energies may leave, of pushes over `time`.
  [[nodiscard]] double round_off(double time) const;

  /// The change of a velocity whose matrix A lacks the slope of a_p in it: a matrix of rank one for each
  /// part, solved with by Sherman and Morrison's formula. `change` solves A x = `right`, and `solve(b, x)`
  /// does so again. False where a part has no finite answer.
  template <class Solve>
  bool add_slopes(const State& middle, const State& end, ConstReals way, double h, ConstReals right,
                  Solve&& solve, std::vector<double>& change);

 private:
  struct Part {
    double factor = 0.0;            ///< a
    double square = 0.0;            ///< d . M d
    double energy_round_off = 0.0;  ///< of the stored energy at rest
    double force_round_off = 0.0;   ///< of the elastic force there
    double energy_floor = 0.0;      ///< below it, what the correction would give back is round-off
    double share = 0.0;             ///< of what solves with its push, in a change
  };
  void find_round_off();
  /// W of each part.
  void stored(const State& state, std::vector<double>& energies);
  /// The force of the models that are corrected, without velocities.
  void elastic_force(const State& state, std::vector<double>& f);
  void find_slopes(const State& middle, const State& end, ConstReals way, double h);
  /// Of each part; false where one is not finite.
  bool find_shares(double h, ConstReals change);
  [[nodiscard]] double dot(std::size_t part, ConstReals a, ConstReals b) const;
  /// out += shares times `v`, on the rows of each part.
  void add_shares(ConstReals v, Reals out) const;

  System* system_ = nullptr;
  MomentumFree momentum_free_;
  std::vector<ConnectedPart> parts_;
  std::vector<std::int32_t> part_of_;  ///< each row; -1: of none
  std::vector<const PartEnergies*> models_;
  std::vector<Part> corrections_;  ///< of each part
  int active_ = 0;                 ///< parts whose factor is not zero
  bool are_tied_ = false;          ///< contacts or links may couple parts in the matrix
  std::vector<double> before_, after_, free_way_, push_, elastic_, slope_, answer_, work_;
};

template <class Solve>
bool DiscreteGradient::add_slopes(const State& middle, const State& end, ConstReals way, double h,
                                  ConstReals right, Solve&& solve, std::vector<double>& change) {
  find_slopes(middle, end, way, h);
  solve(ConstReals(push_), answer_);
  if (!find_shares(h, change)) return false;
  if (active_ == 1) {
    const auto only = std::ranges::find_if(corrections_, [](const Part& part) { return part.factor != 0.0; });
    for (std::size_t i = 0; i < change.size(); ++i) change[i] += only->share * answer_[i];
  } else if (are_tied_) {
    // What the push of a part moves reaches others: with pushes in the equation itself, no momentum is lost.
    work_.assign(right.begin(), right.end());
    add_shares(push_, work_);
    solve(ConstReals(work_), change);
  } else {
    add_shares(answer_, change);
  }
  return true;
}

}  // namespace tissu
