#pragma once

/// The iterations of the conjugate gradient with their preconditioner, in one precision or in two.

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
  part,       ///< `prepare` may make another part of a preconditioner, after which they go on; r is exact
  curvature,  ///< p . A p <= 0 or r . M^-1 r <= 0: not positive definite, as far as this precision can tell
  lost,       ///< the residual grew without bound, as with a singular matrix
};

/// T: the precision of the preconditioner. The iterations have the same one, or double: in single precision
/// the matrix itself is rounded, which a long thin body in equilibrium does not bear, whose softest motions
/// are a millionth as stiff as its cells; a preconditioner may be rounded.
template <class T>
class Iteration {
 public:
  explicit Iteration(Preconditioning kind);

  /// Makes the preconditioner where there is none for this operator, where another is due, or where it is
  /// `forced` and not of these values already; true when it did. V: the precision of the iterations.
  template <class V>
  bool prepare(const LinearOperator& A, bool forced);
  /// Lowers |r| to `target` and gives what it takes as d, in iterations of precision V.
  template <class V>
  End run(const LinearOperator& A, std::span<V> r, std::span<V> d, double target, int most);
  /// The next run goes on in the directions of the latest one, which had the same precision, whose residual
  /// it is given computed anew and divided by `scale` times what the latest was divided by. Otherwise it
  /// starts its own.
  template <class V>
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
  template <class V>
  [[nodiscard]] double iteration_work(const LinearOperator& A) const;
  /// What the matrix that it works with was multiplied by.
  [[nodiscard]] double scale() const;
  void forget();
  [[nodiscard]] std::size_t bytes() const;

 private:
  template <class V>
  struct Vectors {
    std::vector<V> z;
    std::vector<V> p;
    std::vector<V> q;
    [[nodiscard]] std::size_t bytes() const { return (z.size() + p.size() + q.size()) * sizeof(V); }
  };
  template <class V>
  Vectors<V>& vectors();
  /// q = A p
  template <class V>
  void multiply(const LinearOperator& A);
  /// Iterations that couplings cost which the preconditioner does not know, or knows in vain.
  double expected(const LinearOperator& A);
  /// p = z + beta p
  template <class V>
  void turn(const Threads& threads, double beta);
  /// d += alpha p, r -= alpha q, z = M^-1 r; r . z, and |r|^2 into `square`.
  template <class V>
  double advance(const Threads& threads, std::span<V> r, std::span<V> d, double alpha, double& square);
  /// Rows of r in the precision of the preconditioner, and rows of its z in that of the iterations.
  void narrow(std::span<const double> r, std::size_t first, std::size_t last);
  void widen(std::size_t first, std::size_t last);

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
  double rz_ = 0.0;         ///< r . z when p was made
  double curvature_ = 1.0;  ///< p . A p
  SingleMatrix matrix_;     ///< of single precision only
  Vectors<T> own_;
  Vectors<double> wide_;  ///< of iterations in double with a preconditioner in single precision, …
  std::vector<T> r_;      ///< … what that is given, divided by unit_, …
  std::vector<T> z_;      ///< … and what it answers
  double unit_ = 1.0;     ///< |r| at the beginning of the run
  std::vector<double> partial_;
  std::vector<double> squares_;
};

}  // namespace tissu
