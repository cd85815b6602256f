#include "traffic.h"

#include <cstdint>

namespace tissu::bench {
namespace {

constexpr double kColumn = sizeof(std::int32_t);
constexpr double kRowBegin = sizeof(std::int64_t);

double vectors(const Sparsity& pattern, double number, double count) {
  return count * 3.0 * number * pattern.rows();
}

}  // namespace

double matrix_bytes(const Sparsity& pattern, double number) {
  return static_cast<double>(pattern.blocks()) * (9.0 * number + kColumn) + kRowBegin * pattern.rows();
}

double product_bytes(const Sparsity& pattern, double number) {
  return matrix_bytes(pattern, number) + vectors(pattern, number, 2.0);
}

double preconditioner_bytes(Preconditioning kind, const Sparsity& pattern, double number) {
  const double rows = pattern.rows();
  switch (kind) {
    case Preconditioning::jacobi:
      return rows * 3.0 * number;
    case Preconditioning::block_jacobi:
      return rows * 9.0 * number;
    case Preconditioning::incomplete_cholesky: {
      const double off_diagonal = static_cast<double>(pattern.blocks()) - rows;  // both triangles
      return off_diagonal * (9.0 * number + kColumn) + rows * (9.0 * number + 2.0 * kRowBegin);
    }
    case Preconditioning::stale_cholesky:
    case Preconditioning::multigrid:
      break;
  }
  return 0.0;
}

double apply_bytes(Preconditioning kind, const Sparsity& pattern, double number) {
  const double count = kind == Preconditioning::incomplete_cholesky ? 6.0 : 2.0;
  return preconditioner_bytes(kind, pattern, number) + vectors(pattern, number, count);
}

double iteration_bytes(const ConjugateGradient::Settings& settings, const Sparsity& pattern) {
  const double number = settings.precision == Precision::single ? sizeof(float) : sizeof(double);
  return matrix_bytes(pattern, number) + preconditioner_bytes(settings.preconditioning, pattern, number) +
         vectors(pattern, number, 12.0);
}

}  // namespace tissu::bench
