#pragma once

/// The iterations of the conjugate gradient, in one precision, with their preconditioner.

#include <memory>
#include <span>
#include <vector>

#include "dot.h"
#include "preconditioner.h"
#include "renewal.h"
#include "single_matrix.h"

namespace tissu {

/// Why iterations ended.
enum class End {
  reached,    ///< their own count of the residual is at the target
  exhausted,  ///< there were as many as allowed
  renewal,    ///< with a preconditioner that does not pay any more
  curvature,  ///< p . A p <= 0 or r . M^-1 r <= 0: not positive definite, as far as this precision can tell
  lost,       ///< the residual grew without bound, as with a singular matrix
};

template <class T>
class Iteration {
 public:
  explicit Iteration(Preconditioning kind);

  /// Makes the preconditioner where there is none for this operator, where another is due, or where it is
  /// `forced` and not of these values already; true when it did.
  bool prepare(const LinearOperator& A, bool forced);
  /// Lowers |r| to `target` and gives what it takes as d.
  End run(const LinearOperator& A, std::span<T> r, std::span<T> d, double target, int most);
  /// The next run goes on in the directions of the latest one, whose residual it is given computed anew and
  /// divided by `scale` times what the latest was divided by. Otherwise it starts its own.
  void go_on(double scale);
  /// What was made last was made of this operator, for the solve that has begun.
  void take_over(const LinearOperator& A);
  /// A solve begins, or is over.
  void begin_solve();
  void end_solve();
  /// Iterations of the latest run.
  [[nodiscard]] int iterations() const { return iterations_; }
  /// |r| at its end, as the iterations count it.
  [[nodiscard]] double residual() const { return residual_; }
  /// Work of this solve so far without makings, of its makings, of what a new pattern asked for, and of an
  /// iteration.
  [[nodiscard]] double solving() const { return work_; }
  [[nodiscard]] double making() const { return making_; }
  [[nodiscard]] double once() const { return once_; }
  [[nodiscard]] double iteration_work(const LinearOperator& A) const;
  /// What the matrix that it works with was multiplied by.
  [[nodiscard]] double scale() const;
  void forget();
  [[nodiscard]] std::size_t bytes() const;

 private:
  void multiply(const LinearOperator& A);
  /// Iterations that couplings cost which the preconditioner does not know, or knows in vain.
  double expected(const LinearOperator& A);
  /// p = z + beta p
  void turn(const Threads& threads, double beta);
  /// d += alpha p, r -= alpha q, z = M^-1 r; r . z, and |r|^2 into `square`.
  double advance(const Threads& threads, std::span<T> r, std::span<T> d, double alpha, double& square);

  std::unique_ptr<Preconditioner<T>> M_;
  Renewal renewal_;
  bool made_ = false;
  bool made_midway_ = false;
  bool in_parts_ = false;  ///< a making has begun that takes several solves
  int parts_ = 0;          ///< of it that this solve has made
  std::uint64_t id_ = 0;
  std::uint64_t version_ = 0;
  const std::vector<std::uint8_t>* given_ = nullptr;
  std::vector<Couplings::Key> known_;  ///< couplings for which it was made
  std::vector<Couplings::Key> keys_;
  int spent_ = 0;  ///< iterations of this solve
  double work_ = 0.0;
  double making_ = 0.0;
  double once_ = 0.0;
  int iterations_ = 0;
  double residual_ = 0.0;
  bool goes_on_ = false;
  double rz_ = 0.0;      ///< r . z when p_ was made
  SingleMatrix matrix_;  ///< of single precision only
  std::vector<T> z_;
  std::vector<T> p_;
  std::vector<T> q_;
  std::vector<double> partial_;
  std::vector<double> squares_;
};

}  // namespace tissu
