#pragma once

/// Prony series, a generalised Maxwell body beside the law: finite linear viscoelasticity. Each branch k has
/// an elastic strain q_k of its own and adds the stress
///
///     S_k = g_k C : q_k,   dq_k/dt = dE/dt - q_k / tau_k
///
/// to the law's second Piola–Kirchhoff stress; C are Lamé's moduli of the law at small strain. Through a step
/// E goes evenly, for which q is exact: q1 = a q0 + b (E1 - E0), a = exp(-h/tau), b = (tau/h) (1 - a). So the
/// law alone answers at long times, (1 + sum g_k) times its small-strain stiffness at once. Fibres added to
/// the law have no branches.
///
/// q_k and E0 of every point stand in a place of State::memory; h is the time since that was written. At a
/// given memory the force has a potential, so the tangent is symmetric, its geometric part included.

#include <array>
#include <vector>

#include "tissu/viscosity/prony_kernels.h"
#include "tissu/viscosity/viscosity.h"
#include "tissu/viscosity/viscous_cells.h"

namespace tissu {

class Prony final : public ViscousCells {
 public:
  /// On the cells of `block`. Refuses sheets and lines, and laws without Lamé's moduli at rest.
  Prony(const ElasticBlock& block, const std::vector<PronyBranch>& branches, ConstReals rest_positions,
        Isa isa, Threads threads);
  [[nodiscard]] std::string_view effect() const override { return "Prony viscosity"; }
  /// Its potential is another one after each step.
  [[nodiscard]] bool may_add_energy() const override { return true; }
  void add_force(const State& state, Scratch& scratch, Reals f) const override;
  void add_stiffness(const State& state, Scratch& scratch, StiffnessScale scale,
                     BlockMatrix& matrix) const override;
  void add_product(const State& state, Scratch& scratch, StiffnessScale scale, ConstReals p,
                   Reals out) const override;
  /// In the branches' springs.
  [[nodiscard]] double energy(const State& state, Scratch& scratch) const override;

  [[nodiscard]] RunTime run_time() const override { return {.remembers = true}; }
  void claim_memory(MemoryPlaces& places) override;
  /// Writes q_k and E at state.time.
  void remember(State& state) const override;
  /// Takes the memory of the cells that it shares, by their numbers, with a model of the same body.
  void carry_memory(const ForceModel& before, const Memory& then, Memory& now) const override;
  void check_memory(const State& state) const override;
  [[nodiscard]] std::size_t memory_size() const;

 private:
  /// How far the branches get in some time.
  struct Course {
    std::array<double, Viscosity::kMostBranches> decay;
    std::array<double, Viscosity::kMostBranches> rise;
  };
  [[nodiscard]] Course course(const State& state) const;
  [[nodiscard]] PronyView prony_view(const State& state, const Course& course) const;
  [[nodiscard]] std::size_t reals_of_cell() const;

  const PronyKernels* kernels_;
  const ElasticKernels* shape_kernels_;
  std::size_t place_ = 0;  ///< in State::memory
  std::vector<double> shares_;
  std::vector<double> times_;
};

}  // namespace tissu
