#pragma once

/// What a force model adds, as vectors and matrices of its own.

#include "../assembly/dense.h"
#include "../base/differences.h"
#include "room.h"
#include "tissu/force/force_model.h"

namespace tissu::test {

inline Eigen::VectorXd force_of(const ForceModel& model, const State& state) {
  std::vector<double> f(state.positions.size(), 0.0);
  model.add_force(state, test::scratch(), f);
  return view(f);
}

inline Eigen::VectorXd product_of(const ForceModel& model, const State& state, StiffnessScale scale,
                                  ConstReals p) {
  std::vector<double> out(p.size(), 0.0);
  model.add_product(state, test::scratch(), scale, p, out);
  return view(out);
}

/// The dense matrix that a model, bound to `pattern`, assembles.
inline Eigen::MatrixXd stiffness_of(const ForceModel& model, const State& state, StiffnessScale scale,
                                    const Sparsity& pattern, Isa isa = Isa::baseline) {
  BlockMatrix matrix(pattern, isa, Threads(1));
  matrix.clear();
  model.add_stiffness(state, test::scratch(), scale, matrix);
  Couplings couplings;
  model.add_couplings(state, scale, couplings);
  couplings.close(pattern.rows(), nullptr);
  matrix.set_couplings(couplings.empty() ? nullptr : &couplings);
  return dense(matrix);
}

/// The pattern of one model alone, to which it is then bound.
inline Sparsity bind_alone(ForceModel& model, std::int32_t rows) {
  SparsityBuilder builder(rows);
  model.couple(builder);
  Sparsity pattern = builder.build();
  model.bind(pattern);
  return pattern;
}

/// The state with its mesh nodes moved by t p.
inline State moved(const State& state, ConstReals p, double t) {
  State result = state;
  for (std::size_t i = 0; i < p.size(); ++i) result.positions[i] += t * p[i];
  return result;
}

}  // namespace tissu::test
