#pragma once

/// How far points of the bodies give way to forces on them: what a haptic loop has to know of the tissue.
///
///     W = h^2 H A^-1 H^T,   A = M + h D + h^2 K     within a backward Euler step of h
///     W = H K^-1 H^T                                at rest, of a static method
///
/// with K = -df/dx and D = -df/dv, as they are now, and a row of H for each direction of each point: what the
/// rows of the unknown do to the point in that direction. A direction that is held gives way by zero.
///
/// A factor of A is kept from call to call. With X ~ A^-1 H^T of the kept factor and R = H^T - A X,
///
///     W ~ H X + X^T R,   W = that + R^T A^-1 R,   R^T A^-1 R <= R^T M^-1 R  where D and K are semi-definite
///
/// so that the error is of second order in X, is bounded, and has one sign. Where the bound is too large X is
/// corrected: by the factor, then by a solve among the rows whose residual is largest. Where that is not
/// enough, A is factored anew.
///
/// Tissue that moves goes on. Without forces on the points the next step would take them from x_n to
///
///     x_n - W lambda_n + d,   d = h H A^-1 (M (2 v_n - v_(n-1)) + h D v_n)
///
/// with lambda_n the forces of this step: the drift d is its momentum, and the share of lambda_n that its
/// viscosity took and gives back when it stands. It is of first order in the error of X, and zero at rest.

#include <Eigen/Core>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "tissu/assembly/couplings.h"
#include "tissu/simulation/simulation.h"

namespace tissu {

/// A point that rows of the unknown carry, and three directions: the rows of a matrix.
struct CarriedPoint {
  std::vector<CarriedPart> parts;
  Mat3 axes = Mat3::Identity();
};

/// How W is found.
enum class ComplianceWay {
  factor,     ///< by a factor that is kept and corrected
  gradient,   ///< by the conjugate gradient; nothing is kept
  condensed,  ///< from A^-1 between all rows that may be asked for, made once: the matrix has to be constant
  warped      ///< from that of the rest shape, each row turned as its neighbours have turned since
};

class Compliance {
 public:
  struct Settings {
    ComplianceWay way = ComplianceWay::factor;
    double tolerance = 1e-2;         ///< on the bound of the error, of each direction's own compliance
    std::vector<std::int32_t> rows;  ///< of condensed and warped: all that points may have
  };
  struct Report {
    double error = 0.0;    ///< bound of |change of W_ii| / W_ii; zero where the factor is of A itself
    int corrections = 0;   ///< of X
    bool made = false;     ///< a factor or a table was made
    bool definite = true;  ///< A was; else each cell's share was made semi-definite
  };

  explicit Compliance(Settings settings);
  ~Compliance();
  Compliance(const Compliance&) = delete;
  Compliance& operator=(const Compliance&) = delete;

  /// W (3 m, 3 m) [m/N] at the present state: symmetric, and positive semi-definite but for round-off. Throws
  /// ParameterError where the way cannot be taken in this world, or a row is not among those of the settings.
  const Eigen::MatrixXd& find(Simulation& simulation, double h, std::span<const CarriedPoint> points);
  [[nodiscard]] const Report& report() const { return report_; }
  /// The drift d (3 m) [m] of the latest points along their directions; zero at rest, and of tables, which
  /// have no X.
  [[nodiscard]] const Eigen::VectorXd& drift() const { return drift_; }
  /// Most rows of the unknown that condensed and warped take.
  static constexpr std::size_t kMostRows = 1000;
  /// What makes the factors.
  static std::string_view library();

 private:
  struct Kept;
  void follow(const Simulation& simulation, double h);
  void assemble(const State& state);
  void couple(const State& state);
  void remember(const State& state);
  void find_drift(const State& state);
  void find_by_solves(const State& state, std::span<const CarriedPoint> points);
  void find_by_table(const State& state, std::span<const CarriedPoint> points);

  Settings settings_;
  Report report_;
  std::unique_ptr<Kept> kept_;  ///< of a world
  Eigen::MatrixXd W_;
  Eigen::VectorXd drift_;
};

}  // namespace tissu
