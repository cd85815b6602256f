#pragma once

#include <memory>
#include <vector>

#include "tissu/force/force_model.h"

namespace tissu {

/// Rayleigh's damping of one body: f = -alpha M v + beta (df_e/dx) v, where f_e is its elasticity.
///
/// It takes the place of the elastic models that it damps, so that their stiffness is still assembled once:
/// position and velocity parts differ by a factor. The change of df_e/dx itself with x is left out of df/dx.
class Rayleigh final : public ForceModel {
 public:
  /// `masses` is zero outside the body. Refuses models that couple rows at run time: they are not of its
  /// cells.
  Rayleigh(std::vector<std::unique_ptr<ForceModel>> elastic, std::vector<double> masses, double alpha,
           double beta);
  [[nodiscard]] bool may_drive_turns() const override { return beta_ > 0.0 && !has_constant_stiffness(); }
  [[nodiscard]] std::string_view effect() const override { return "elasticity with Rayleigh damping"; }
  [[nodiscard]] ForceKind kind() const override { return ForceKind::elastic; }
  [[nodiscard]] bool has_constant_stiffness() const override;
  void couple(SparsityBuilder& builder) const override;
  void bind(const Sparsity& pattern) override;
  void add_force(const State& state, Scratch& scratch, Reals f) const override;
  void add_stiffness(const State& state, Scratch& scratch, StiffnessScale scale,
                     BlockMatrix& matrix) const override;
  void add_product(const State& state, Scratch& scratch, StiffnessScale scale, ConstReals p,
                   Reals out) const override;
  [[nodiscard]] double energy(const State& state, Scratch& scratch) const override;

  // Those of the models that it damps.
  [[nodiscard]] std::size_t scratch_size() const override;
  [[nodiscard]] RunTime run_time() const override;
  void claim_memory(MemoryPlaces& places) override;
  void begin_step(State& state, Scratch& scratch, double h) const override;
  void remember(State& state) const override;
  void carry_memory(const ForceModel& before, const Memory& then, Memory& now) const override;
  void check_memory(const State& state) const override;

  /// Whether it damps this model; it holds all of one body.
  [[nodiscard]] bool damps(const ForceModel* model) const;
  /// After an edit in place: the mass that the body gives to a node [kg].
  void set_mass(std::int32_t row, double mass) { masses_[static_cast<std::size_t>(row)] = mass; }

 private:
  void add_mass_product(double scale, ConstReals p, Reals out) const;

  std::vector<std::unique_ptr<ForceModel>> elastic_;
  std::vector<double> masses_;
  double alpha_;  ///< [1/s]
  double beta_;   ///< [s]
};

}  // namespace tissu
