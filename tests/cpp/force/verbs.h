#pragma once

/// What a force model adds, as vectors and matrices of its own.

#include <algorithm>

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

/// The products with all unit vectors.
inline Eigen::MatrixXd products_of(const ForceModel& model, const State& state, StiffnessScale scale) {
  const auto size = static_cast<Eigen::Index>(state.positions.size());
  Eigen::MatrixXd all(size, size);
  std::vector<double> p(state.positions.size(), 0.0);
  for (Eigen::Index j = 0; j < size; ++j) {
    p[static_cast<std::size_t>(j)] = 1.0;
    all.col(j) = product_of(model, state, scale, p);
    p[static_cast<std::size_t>(j)] = 0.0;
  }
  return all;
}

/// What drives an arm r on as it turns under a force g, of which a definite matrix has nothing: the energy
/// -g . r of the arm falls by half of this times the turn squared, along the mean of both and across them.
inline Mat3 driven(const Vec3& r, const Vec3& g) {
  const Vec3 mean = (r.normalized() + g.normalized()).normalized();
  const Vec3 across = r.cross(g).normalized();
  return 0.5 * (r.norm() * g.norm() - r.dot(g)) * mean * mean.transpose() +
         std::max(-r.dot(g), 0.0) * across * across.transpose();
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
