#pragma once

/// What counts as how much work. Its unit is one byte of a matrix that a product reads; what takes another
/// time than the reading of its bytes has a weight, found once from docs/measured/solvers.md. Work is
/// counted, never timed, so that what is decided by it is decided the same in every run, on any machine and
/// any number of threads.

namespace tissu {

/// Of a byte of a triangle: rows of its solves wait for each other.
inline constexpr double kSweep = 1.4;
/// Of a byte of a sparse factor, whose solves gather and scatter.
inline constexpr double kFactorSolve = 1.7;
/// Of each number of a sparse factor, which is gathered and scattered, beside the operations.
inline constexpr double kFactorNumber = 330.0;
/// Of each row of three of a sparse factor, beside its numbers: what a small supernode costs.
inline constexpr double kFactorRow = 15e3;
/// Of a byte of the matrix in double precision that becomes one in single: it is read, and half is written.
inline constexpr double kConversion = 1.5;
/// Of a byte of the inverses of diagonal blocks, which take some tens of operations each.
inline constexpr double kInverse = 3.0;
/// Of a row of three in the ordering of a factor, which a new pattern asks for.
inline constexpr double kOrdering = 2e5;
/// Of a row of three in the search for aggregates, which a new pattern asks for.
inline constexpr double kAggregation = 6e4;

}  // namespace tissu
