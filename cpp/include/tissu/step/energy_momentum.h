#pragma once

#include <memory>
#include <vector>

#include "tissu/contact/implicit_contact.h"
#include "tissu/step/discrete_gradient.h"
#include "tissu/step/integrator.h"
#include "tissu/step/system.h"

namespace tissu {

/// The energy-momentum method with Gonzalez's discrete gradient (Time integration and discrete Hamiltonian
/// systems, J. Nonlinear Sci. 6, 1996): the implicit midpoint rule with a force whose work over the step is
/// the change of the stored energy,
///   M (v1 - v0) = h (f(x) + a M d),  x1 - x0 = h (v0 + v1) / 2,  x = (x0 + x1) / 2.
/// Each connected part has its own correction a M d, which has no resultant on a free one (DiscreteGradient):
/// energy, linear and angular momentum of each are kept to Newton's tolerance for any step and any law. Of
/// second order; the correction is of second order too.
///
/// Contacts act as in implicit Euler: their impulse moves the end as a whole, and they take energy.
class EnergyMomentum final : public Integrator {
 public:
  explicit EnergyMomentum(NewtonSettings newton = {20, 1e-9});
  [[nodiscard]] std::string_view name() const override { return "energy-momentum method"; }
  [[nodiscard]] bool is_undamped() const override { return true; }
  void prepare(const World& world, LinearSolver* solver, Profile& profile) override;
  StepReport step(State& state, double h) override;

 private:
  /// A step from start_, in halves where Newton's method does not converge.
  bool advance(const State& from, double h, int halvings, State& state, StepReport& report);
  bool solve(const State& from, double h, State& state, StepReport& report);
  /// Newton's iteration from mean_.
  bool iterate(const State& from, double h, StepReport& report);
  /// h / 2 (f + a M d) - M (v - v0) at the mean velocity mean_; its norm.
  double residual(const State& from, double h);
  /// The residual that rounding may leave.
  [[nodiscard]] double round_off(double h) const;
  bool is_at_round_off(double now, double floor);
  /// The change of mean_, by the midpoint rule's matrix and the slope of a.
  bool find_change(double h, StepReport& report);

  // energy_momentum_touching.cpp: steps of a world with contact.
  void prepare_touching(Profile& profile);
  void begin_touching(const State& from, double h);
  /// Newton's iteration with the contacts of one look, and looks until they stay.
  bool iterate_touching(const State& from, double h, StepReport& report);
  /// Takes what the impulses of the way give twice out of the velocities at the end, which have their own.
  void finish_touching(const State& from, double h, State& state, StepReport& report);
  /// Where the mean velocities lead.
  void place_end(const State& from, double h);
  double look();
  int hold_back();

  NewtonSettings newton_;
  std::unique_ptr<System> system_;
  DiscreteGradient gradient_;
  State start_;
  State middle_;
  State end_;
  std::vector<State> halves_;                 ///< of steps that are taken in halves
  double acting_ = 0.0;                       ///< what the residual is judged by
  double external_ = 0.0;                     ///< h / 2 times the external force
  double load_ = 0.0;                         ///< the same without contact, at the start; 0: nothing touches
  std::unique_ptr<ImplicitContact> contact_;  ///< null where nothing touches
  std::unique_ptr<EndImpulses> impulses_;
  Profile* profile_ = nullptr;
  std::size_t detection_row_ = 0;  ///< of the profile; there where something touches
  std::size_t travel_row_ = 0;
  std::size_t response_row_ = 0;
  std::vector<double> blocks_;  ///< diagonal of the matrix without contact
  std::vector<double> placed_;  ///< at the end, before ways were cut
  std::vector<double> mean_, given_, right_, change_, way_, answer_, work_;
};

}  // namespace tissu
