#pragma once

/// Contact forces of a few rows with Coulomb friction: block Gauss-Seidel, and every few sweeps the rows that
/// bear all at once. The same bits for the same input.

#include <Eigen/Core>
#include <array>

#include "tissu/haptic/local_model.h"

namespace tissu::haptic {

/// Contacts, a blade and the end stops of pitch, roll and depth.
inline constexpr int kStops = 3;
inline constexpr int kMaxRows = 3 * kMaxContacts + 1 + kStops;
inline constexpr int kMaxBlocks = kMaxContacts + 1 + kStops;
using Rows = Eigen::Matrix<double, kMaxRows, 1>;
using RowMatrix = Eigen::Matrix<double, kMaxRows, kMaxRows>;

enum class BlockKind : unsigned char {
  cone,    ///< 3 rows: 0 <= lambda_n _|_ g_n >= 0; |lambda_t| <= mu lambda_n, slip against lambda_t
  push,    ///< 1 row: 0 <= lambda _|_ g >= 0
  bounded  ///< 1 row: |lambda| <= bound, g = 0 inside, slip against lambda at the bound
};

struct Block {
  BlockKind kind = BlockKind::push;
  int row = 0;         ///< its first
  double bound = 0.0;  ///< mu of a cone, [N] of a bounded row
};

/// g = b + A lambda; A symmetric and positive semi-definite with a positive diagonal.
struct Patch {
  int rows = 0;
  int blocks = 0;
  std::array<Block, kMaxBlocks> block{};
  Rows b = Rows::Zero();
  RowMatrix A = RowMatrix::Zero();
};

struct SweepLimits {
  int sweeps = 30;
  double tolerance = 1e-6;  ///< of the largest |lambda| [1]
};

struct PatchReport {
  int sweeps = 0;
  double change = 0.0;  ///< of the last sweep, relative to the largest |lambda|
};

/// The forces, from `lambda` as a start, in the fixed order of the blocks. Rows past `patch.rows` are not
/// touched.
PatchReport solve_patch(const Patch& patch, const SweepLimits& limits, Rows& lambda) noexcept;
/// 1/2 lambda^T A lambda [J].
double stored_energy(const Patch& patch, const Rows& lambda) noexcept;
/// b + A lambda.
Rows gaps(const Patch& patch, const Rows& lambda) noexcept;

}  // namespace tissu::haptic
