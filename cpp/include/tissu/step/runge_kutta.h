#pragma once

#include "tissu/step/explicit_method.h"

namespace tissu {

/// Runge's and Kutta's explicit methods of second order (the midpoint rule) and of fourth (the classical
/// one). The second makes undamped vibrations grow, by 1 + (h omega)^4 / 8 a step; the fourth damps them
/// while h omega < 2 sqrt(2). Of first order where surfaces meet. Frames turn by a vector u, R = exp(u) R0,
/// whose slope is omega - 1/2 u x omega + 1/12 u x (u x omega) (Munthe-Kaas, BIT 38, 1998).
class RungeKutta final : public ExplicitMethod {
 public:
  /// `order` is 2 or 4.
  explicit RungeKutta(int order);
  [[nodiscard]] std::string_view name() const override;
  void prepare(const World& world, LinearSolver* solver, Profile& profile) override;

 protected:
  [[nodiscard]] Amplification amplification() const override;
  [[nodiscard]] bool has_stages() const override { return true; }
  [[nodiscard]] bool turns_freely() const override { return false; }
  void advance(State& state, double h) override;

 private:
  /// Of the latest stage, into which v_ led in `since`: its angular velocities, from those of its momenta at
  /// the start, and the slopes of all positions, which go into v_.
  void find_slopes(double since);

  int order_;
  State stage_;
  std::vector<double> a_;
  std::vector<double> v_;             ///< slopes of the latest stage
  std::vector<double> velocity_;      ///< weighted sum of those of the stages
  std::vector<double> acceleration_;  ///< the same
  std::vector<Vec3> turns_;           ///< of frames, from the start to the latest stage
};

}  // namespace tissu
