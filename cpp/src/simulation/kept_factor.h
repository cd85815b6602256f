#pragma once

/// H A^-1 H^T from the factor of an earlier A, with a bound of what is wrong with it (compliance.h).

#include <Eigen/Core>
#include <unordered_map>

#include "point_loads.h"
#include "solve/sparse_factor.h"
#include "tissu/assembly/mass.h"

namespace tissu {

/// What bounds R^T A^-1 R: M, where every unknown has some.
struct Inertia {
  const Mass* mass = nullptr;  ///< null: the factor estimates it
  const State* state = nullptr;
  /// r . M^-1 r
  [[nodiscard]] double bound(const Eigen::VectorXd& r) const;
};

class KeptFactor {
 public:
  /// False: A is not positive definite.
  bool find(const BlockMatrix& A, const PointLoads& loads, const Inertia& inertia, double tolerance);
  /// The same by the conjugate gradient alone.
  bool iterate(const BlockMatrix& A, const PointLoads& loads, const Inertia& inertia, double tolerance);
  /// A^-1 among rows, (3 k, 3 k).
  Eigen::MatrixXd among(const BlockMatrix& A, std::span<const std::int32_t> rows);
  /// H A^-1 H^T, a bound of its relative error, and how it came about.
  [[nodiscard]] const Eigen::MatrixXd& found() const { return W_; }
  /// X ~ A^-1 H^T
  [[nodiscard]] const Eigen::MatrixXd& motions() const { return X_; }
  [[nodiscard]] double error() const { return error_; }
  [[nodiscard]] int corrections() const { return corrections_; }
  [[nodiscard]] bool made() const { return made_; }

 private:
  bool renew(const BlockMatrix& A);
  bool correct(const BlockMatrix& A, const PointLoads& loads, const Inertia& inertia, double tolerance);
  /// X from columns of A^-1 that are kept with the factor.
  void combine(const BlockMatrix& A, const PointLoads& loads);
  void solve_columns(std::int32_t rows, const std::vector<std::int32_t>& numbers);
  /// W = H X + X^T R, and the bound of its error.
  void judge(const PointLoads& loads, const Inertia& inertia);
  /// X += Z c, R -= A Z c with the c that brings W nearest to what it is.
  void improve(const BlockMatrix& A);
  /// Z = A_ZZ^-1 R_Z among the rows Z whose residual is largest.
  void solve_near(const BlockMatrix& A);
  void solve_far();

  SparseFactor factor_;
  std::uint64_t id_ = 0;                                    ///< of the matrix that it is of
  std::unordered_map<std::int32_t, Eigen::VectorXd> kept_;  ///< columns of A^-1 by their number
  Eigen::MatrixXd X_;
  Eigen::MatrixXd R_;
  Eigen::MatrixXd Z_;
  Eigen::MatrixXd Y_;  ///< A Z
  Eigen::MatrixXd W_;
  double error_ = 0.0;
  int corrections_ = 0;
  bool iterates_ = false;  ///< without a factor
  bool made_ = false;
};

}  // namespace tissu
