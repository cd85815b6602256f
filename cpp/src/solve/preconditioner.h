#pragma once

/// What the iterations ask of a preconditioner M.

#include <span>

#include "tissu/assembly/linear_operator.h"
#include "tissu/solve/conjugate_gradient.h"

namespace tissu {

/// T: the precision in which it stores and works.
template <class T>
class Preconditioner {
 public:
  Preconditioner() = default;
  virtual ~Preconditioner() = default;
  Preconditioner(const Preconditioner&) = delete;
  Preconditioner& operator=(const Preconditioner&) = delete;

  /// Made from the values that A has now, each multiplied by `scale`; symmetric and positive definite
  /// whatever A is.
  virtual void make(const LinearOperator& A, double scale) = 0;
  /// A part of a making, so that no solve pays for all of it: what it was before and what is new serve
  /// together. True: that was the last part. Parts of one making follow each other, unless `make` comes
  /// between.
  virtual bool make_part(const LinearOperator& A, double scale) {
    make(A, scale);
    return true;
  }
  /// The price of the latest making, counted in iterations.
  [[nodiscard]] virtual double price() const = 0;
  /// Work (work.h) of the latest making, and of applying it once.
  [[nodiscard]] virtual double making() const = 0;
  [[nodiscard]] virtual double application() const = 0;
  /// Work of what the latest making did because the pattern was new; not a part of `making`.
  [[nodiscard]] virtual double once() const { return 0.0; }
  /// What is coupled beside the matrix has a part in it.
  [[nodiscard]] virtual bool takes_couplings() const { return true; }
  /// Rows of z = M^-1 r depend on the same rows of r only, and `apply_rows` gives them.
  [[nodiscard]] virtual bool is_local() const { return false; }
  virtual void apply_rows(std::int32_t /*begin*/, std::int32_t /*end*/, const T* /*r*/, T* /*z*/) {}
  /// z = M^-1 r
  virtual void apply(std::span<const T> r, std::span<T> z) {
    apply_rows(0, static_cast<std::int32_t>(r.size() / 3), r.data(), z.data());
  }
  /// The next making gives the bits of a first one.
  virtual void forget() {}
  [[nodiscard]] virtual std::size_t bytes() const = 0;
};

/// Bytes that an iteration reads beside the matrix and the preconditioner, for each row of three: its
/// vectors.
inline constexpr double kVectorBytes = 12 * 3 * sizeof(double);

}  // namespace tissu
