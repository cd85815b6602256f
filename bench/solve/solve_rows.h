#pragma once

/// The rows "solve/WHAT/PRECISION/SIZE/THREADS", of the matrix of an implicit step of the cube (scale/cube.h)
/// with about SIZE tetrahedra.

namespace tissu::bench {

/// For a size that stays in L2, one in L3 and one in memory, on one thread and on two.
void add_solve_rows();

/// WHAT is "product": out = A p by the assembled matrix.
void add_product_rows(int size, int threads);

/// WHAT is "PRECONDITIONER set-up", with the values of the matrix but not its pattern, which is looked at
/// once, and "PRECONDITIONER application". The factor of an earlier matrix is left out at a million.
void add_preconditioner_rows(int size, int threads);

}  // namespace tissu::bench
