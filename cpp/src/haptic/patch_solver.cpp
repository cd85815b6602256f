#include "tissu/haptic/patch_solver.h"

#include <algorithm>
#include <cmath>

#include "haptic/cone_block.h"

namespace tissu::haptic {
namespace {

/// b + A lambda of one row.
double gap(const Patch& patch, const Rows& lambda, int row) noexcept {
  double g = patch.b[row];
  for (int j = 0; j < patch.rows; ++j) g += patch.A(j, row) * lambda[j];  // A is symmetric: down a column
  return g;
}

void solve_cone_block(const Patch& patch, const Block& block, Rows& lambda) noexcept {
  const int i = block.row;
  const Mat3 A = patch.A.block<3, 3>(i, i);
  const Vec3 old = lambda.segment<3>(i);
  const Vec3 g(gap(patch, lambda, i), gap(patch, lambda, i + 1), gap(patch, lambda, i + 2));
  lambda.segment<3>(i) = solve_cone(A, g - A * old, block.bound, old);
}

void solve_single(const Patch& patch, const Block& block, Rows& lambda) noexcept {
  const int i = block.row;
  const double wanted = lambda[i] - gap(patch, lambda, i) / patch.A(i, i);
  lambda[i] =
      block.kind == BlockKind::push ? std::max(0.0, wanted) : std::clamp(wanted, -block.bound, block.bound);
}

}  // namespace

PatchReport solve_patch(const Patch& patch, const SweepLimits& limits, Rows& lambda) noexcept {
  PatchReport report;
  for (report.sweeps = 0; report.sweeps < limits.sweeps;) {
    const Rows before = lambda;
    for (int k = 0; k < patch.blocks; ++k) {
      const Block& block = patch.block[static_cast<std::size_t>(k)];
      if (block.kind == BlockKind::cone) {
        solve_cone_block(patch, block, lambda);
      } else {
        solve_single(patch, block, lambda);
      }
    }
    ++report.sweeps;
    const double largest = lambda.head(patch.rows).cwiseAbs().maxCoeff();
    const double change = (lambda - before).head(patch.rows).cwiseAbs().maxCoeff();
    report.change = change > 0.0 ? change / largest : 0.0;
    if (!(report.change > limits.tolerance)) break;
  }
  return report;
}

double stored_energy(const Patch& patch, const Rows& lambda) noexcept {
  const Rows g = gaps(patch, lambda);
  double energy = 0.0;
  for (int i = 0; i < patch.rows; ++i) energy += 0.5 * lambda[i] * (g[i] - patch.b[i]);
  return energy;
}

Rows gaps(const Patch& patch, const Rows& lambda) noexcept {
  Rows g = Rows::Zero();
  for (int i = 0; i < patch.rows; ++i) g[i] = gap(patch, lambda, i);
  return g;
}

}  // namespace tissu::haptic
