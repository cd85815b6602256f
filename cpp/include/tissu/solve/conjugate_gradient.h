#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "tissu/solve/linear_solver.h"

namespace tissu {

enum class Preconditioning {
  jacobi,               ///< the inverse of the diagonal
  block_jacobi,         ///< the inverses of the diagonal 3x3 blocks
  incomplete_cholesky,  ///< of 3x3 blocks, in the pattern of the matrix
  stale_cholesky,       ///< the factor of an earlier matrix
  multigrid,            ///< a cycle through coarser and coarser rigid aggregates
};

/// How the preconditioner is stored, and how the iterations compute where that pays; residuals are always
/// double.
enum class Precision { full, single };

/// What the iterations multiply with: an assembled matrix, or the forces' own products.
enum class Product { assembled, free };

class Ahead;
class Forecast;
template <class T>
class Iteration;
enum class End;

/// Preconditioned conjugate gradient in rounds: r = b - A x from x itself, then iterations that lower r until
/// their own count of it is at the tolerance. It converged when the next true residual says so.
///
/// It stops at the first direction p with p . A p <= 0 or residual with r . M^-1 r <= 0: such a matrix is not
/// positive definite, and the report says so. In single precision, where that or a residual that does not
/// fall may be round-off, the solve goes on with iterations in double and the same preconditioner. The
/// iterations of a multigrid are double from the first: in single precision the rounded matrix made a bar
/// eight times as long as thick, in equilibrium, take 94 iterations in place of 15.
///
/// A preconditioner is made again when that pays: when the iterations spent beyond those of its first solve
/// cost as much as making it (renewal.h).
class ConjugateGradient final : public LinearSolver {
 public:
  struct Settings {
    double tolerance = 1e-6;
    int iterations = 1000;
    Preconditioning preconditioning = Preconditioning::block_jacobi;
    Precision precision = Precision::full;
    Product product = Product::assembled;
  };
  explicit ConjugateGradient(Settings settings);
  ~ConjugateGradient() override;
  [[nodiscard]] std::string_view name() const override { return name_; }
  [[nodiscard]] std::string_view preparation() const override { return "preconditioner"; }
  [[nodiscard]] bool needs_matrix() const override { return settings_.product == Product::assembled; }
  [[nodiscard]] bool needs_places() const override {
    return settings_.preconditioning == Preconditioning::multigrid;
  }
  SolveReport solve(const LinearOperator& A, ConstReals b, Reals x, double floor) override;
  bool prepare_ahead(const LinearOperator& A) override;
  /// The next solves stop, not converged, when they have taken so much work (SolveReport), makings not
  /// counted: for a caller that has another way. Infinite at first.
  void allow(double work) { allowance_ = work; }
  void forget() override;
  [[nodiscard]] std::size_t bytes() const override;

 private:
  /// A solve begins, with what was made ahead if that serves it.
  void begin_solve(const LinearOperator& A);
  /// r_ = b - A x; |r_|
  double residual(const LinearOperator& A, ConstReals b, ConstReals x, SolveReport& report);
  /// Work of this solve so far, makings not counted.
  [[nodiscard]] double spent(const SolveReport& report) const;
  /// Iterations of precision V, with a preconditioner of precision T, that it may still take.
  template <class T, class V>
  int left(const LinearOperator& A, const SolveReport& report);
  /// Precision of a round: of its iterations and its preconditioner (single, full), or double with a
  /// preconditioner in single precision.
  enum class Way : unsigned char { single, mixed, full };
  [[nodiscard]] Way first_way() const;
  End round(Way way, const LinearOperator& A, Reals x, double size, double target, bool renew,
            SolveReport& report);
  void rounds(const LinearOperator& A, ConstReals b, Reals x, double reference, SolveReport& report);
  template <class T, class V>
  void prepare(const LinearOperator& A, bool forced, SolveReport& report);
  /// Iterations from r_ with a preconditioner of precision T, whose sum is added to x.
  template <class T>
  End double_round(const LinearOperator& A, Reals x, double target, SolveReport& report);
  End single_round(const LinearOperator& A, Reals x, double length, double target, SolveReport& report);
  template <class T>
  Iteration<T>& iteration();

  Settings settings_;
  double allowance_ = std::numeric_limits<double>::infinity();
  std::string name_;
  std::vector<double> r_;
  std::vector<double> change_;  ///< of x in a round
  std::vector<float> single_r_;
  std::vector<float> single_change_;
  std::vector<double> partial_;
  std::unique_ptr<Forecast> forecast_;
  std::unique_ptr<Ahead> ahead_;
  std::unique_ptr<Iteration<double>> full_;
  std::unique_ptr<Iteration<float>> single_;
  int pause_ = 0;   ///< solves that still go without iterations in single precision
  int pauses_ = 0;  ///< length of the latest pause
};

}  // namespace tissu
