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
  /// `masses` is zero outside the body.
  Rayleigh(std::vector<std::unique_ptr<ForceModel>> elastic, std::vector<double> masses, double alpha,
           double beta);
  [[nodiscard]] std::string_view effect() const override { return "elasticity with Rayleigh damping"; }
  [[nodiscard]] ForceKind kind() const override { return ForceKind::elastic; }
  [[nodiscard]] bool has_constant_stiffness() const override;
  void couple(SparsityBuilder& builder) const override;
  void bind(const Sparsity& pattern) override;
  void add_force(const State& state, Reals f) const override;
  void add_stiffness(const State& state, StiffnessScale scale, BlockMatrix& matrix) const override;
  void add_product(const State& state, StiffnessScale scale, ConstReals p, Reals out) const override;
  [[nodiscard]] double energy(const State& state) const override;

 private:
  std::vector<std::unique_ptr<ForceModel>> elastic_;
  std::vector<double> masses_;
  double alpha_;  ///< [1/s]
  double beta_;   ///< [s]
};

}  // namespace tissu
