#include "tissu/haptic/patch_solver.h"

#include <algorithm>
#include <cmath>

#include "haptic/active_rows.h"
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

/// One sweep over all blocks; how much it changed, relative to the largest |lambda|.
double sweep(const Patch& patch, Rows& lambda) noexcept {
  const Rows before = lambda;
  for (int k = 0; k < patch.blocks; ++k) {
    const Block& block = patch.block[static_cast<std::size_t>(k)];
    if (block.kind == BlockKind::cone) {
      solve_cone_block(patch, block, lambda);
    } else {
      solve_single(patch, block, lambda);
    }
  }
  const double change = (lambda - before).head(patch.rows).cwiseAbs().maxCoeff();
  return change > 0.0 ? change / lambda.head(patch.rows).cwiseAbs().maxCoeff() : 0.0;
}

/// How far a sequence still is from its end when its last two steps were these: sweeps that change little may
/// have far to go.
double way_left(double change, double before) noexcept {
  const double rate = before > 0.0 ? change / before : 1.0;
  return rate < 1.0 ? change * std::max(1.0, rate / (1.0 - rate)) : 1e300;
}

}  // namespace

PatchReport solve_patch(const Patch& patch, const SweepLimits& limits, Rows& lambda) noexcept {
  constexpr int kBetween = 3;  // sweeps before the rows that bear are solved together
  constexpr int kMost = 3;     // times that they are
  PatchReport report;
  Rows swept = lambda;  // before they were
  double swept_change = 0.0;
  bool together = false;
  double before = 0.0;
  int wait = kBetween;
  int times = 0;
  while (report.sweeps < limits.sweeps) {
    report.change = sweep(patch, lambda);
    ++report.sweeps;
    if (together && report.change > swept_change) {  // the wrong rows: sweeps go on from where they were
      lambda = swept;
      report.change = swept_change;
      wait = 2 * kBetween;
    } else if (report.change == 0.0 ||
               (together ? report.change : way_left(report.change, before)) <= limits.tolerance) {
      break;
    }
    together = false;
    before = report.change;
    if (--wait > 0 || times == kMost) continue;
    ++times;
    swept = lambda;
    swept_change = report.change;
    solve_active_rows(patch, lambda);
    together = true;
    wait = kBetween;
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
