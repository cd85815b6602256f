#pragma once

/// What the parts of a solve move between memory and processor at the least, by formulae: every number that
/// is needed is read once, and what is written is written once. Bytes; `number` is the size of one number,
/// 8 or 4.

#include "tissu/assembly/sparsity.h"
#include "tissu/solve/conjugate_gradient.h"

namespace tissu::bench {

/// What the solve moves is known from the pattern of the matrix: not that of a factor or of coarser levels.
inline bool is_counted(Preconditioning kind) {
  return kind != Preconditioning::stale_cholesky && kind != Preconditioning::multigrid;
}
/// The matrix alone: nine numbers and a column for each block, the begin of each row.
double matrix_bytes(const Sparsity& pattern, double number);
/// out = A p: the matrix and two vectors.
double product_bytes(const Sparsity& pattern, double number);
/// What a preconditioner in the matrix's pattern keeps and reads to be applied once, its vectors not
/// counted; 0 where it is not in the pattern.
double preconditioner_bytes(Preconditioning kind, const Sparsity& pattern, double number);
/// z = M^-1 r with its vectors: two, and twice two more for the sweeps of an incomplete factor.
double apply_bytes(Preconditioning kind, const Sparsity& pattern, double number);
/// One iteration of the conjugate gradient: matrix, preconditioner and twelve passes over vectors.
double iteration_bytes(const ConjugateGradient::Settings& settings, const Sparsity& pattern);

}  // namespace tissu::bench
