#include "haptic/active_rows.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tissu::haptic {
namespace {

constexpr double kFull = 1.0 - 1e-9;  // of Coulomb's bound: more is slip

/// Unknown j is the force of row `row[j]`; those of a slipping contact's tangents follow its normal's.
struct Active {
  int count = 0;
  std::array<int, kMaxRows> row{};
  RowMatrix share = RowMatrix::Zero();  ///< lambda = fixed + share x
  Rows fixed = Rows::Zero();

  void add(int r) noexcept {
    share(r, count) = 1.0;
    row[static_cast<std::size_t>(count++)] = r;
  }
};

void add_cone(const Block& block, const Rows& lambda, Active& active) noexcept {
  const int i = block.row;
  if (!(lambda[i] > 0.0)) return;
  const double size = lambda.segment<2>(i + 1).norm();
  if (size < kFull * block.bound * lambda[i]) {
    for (int k = 0; k < 3; ++k) active.add(i + k);
    return;
  }
  active.add(i);
  if (!(size > 0.0)) return;
  for (int k = 1; k < 3; ++k) active.share(i + k, active.count - 1) = block.bound * lambda[i + k] / size;
}

Active active_rows(const Patch& patch, const Rows& lambda) noexcept {
  Active active;
  for (int k = 0; k < patch.blocks; ++k) {
    const Block& block = patch.block[static_cast<std::size_t>(k)];
    const double force = lambda[block.row];
    if (block.kind == BlockKind::cone) {
      add_cone(block, lambda, active);
    } else if (block.kind == BlockKind::push) {
      if (force > 0.0) active.add(block.row);
    } else if (std::abs(force) < kFull * block.bound) {
      active.add(block.row);
    } else {
      active.fixed[block.row] = force;
    }
  }
  return active;
}

/// Gauss's elimination with the largest pivot of the column; false where there is none.
bool eliminate(int n, RowMatrix& M, Rows& x) noexcept {
  for (int k = 0; k < n; ++k) {
    int pivot = k;
    for (int i = k + 1; i < n; ++i) {
      if (std::abs(M(i, k)) > std::abs(M(pivot, k))) pivot = i;
    }
    if (!(std::abs(M(pivot, k)) > 0.0)) return false;
    if (pivot != k) {
      for (int j = k; j < n; ++j) std::swap(M(k, j), M(pivot, j));
      std::swap(x[k], x[pivot]);
    }
    for (int i = k + 1; i < n; ++i) {
      const double factor = M(i, k) / M(k, k);
      if (factor == 0.0) continue;
      for (int j = k + 1; j < n; ++j) M(i, j) -= factor * M(k, j);
      x[i] -= factor * x[k];
    }
  }
  for (int k = n - 1; k >= 0; --k) {
    for (int j = k + 1; j < n; ++j) x[k] -= M(k, j) * x[j];
    x[k] /= M(k, k);
  }
  return x.head(n).allFinite();
}

/// Into the cone or the bounds of each block.
void bring_back(const Patch& patch, Rows& lambda) noexcept {
  for (int k = 0; k < patch.blocks; ++k) {
    const Block& block = patch.block[static_cast<std::size_t>(k)];
    double& force = lambda[block.row];
    if (block.kind == BlockKind::bounded) {
      force = std::clamp(force, -block.bound, block.bound);
      continue;
    }
    force = std::max(0.0, force);
    if (block.kind == BlockKind::push) continue;
    auto across = lambda.segment<2>(block.row + 1);
    const double most = block.bound * force;
    const double size = across.norm();
    if (size > most) across *= most / size;
  }
}

}  // namespace

void solve_active_rows(const Patch& patch, Rows& lambda) noexcept {
  const Active active = active_rows(patch, lambda);
  const int n = active.count;
  if (n < 2) return;  // a sweep is exact
  const double more = 1e-11 * patch.A.topLeftCorner(patch.rows, patch.rows).trace();
  RowMatrix M;
  Rows x;
  for (int i = 0; i < n; ++i) {
    const int r = active.row[static_cast<std::size_t>(i)];
    double rest = patch.b[r];
    for (int j = 0; j < patch.rows; ++j) rest += patch.A(j, r) * active.fixed[j];
    x[i] = -rest;
    for (int j = 0; j < n; ++j) {
      double sum = i == j ? more : 0.0;
      const int first = active.row[static_cast<std::size_t>(j)];
      const int last = std::min(first + 3, patch.rows);  // a normal and its tangents stand together
      for (int k = first; k < last; ++k) sum += patch.A(k, r) * active.share(k, j);
      M(i, j) = sum;
    }
  }
  if (!eliminate(n, M, x)) return;
  Rows solved = active.fixed;
  solved.head(patch.rows) += active.share.topLeftCorner(patch.rows, n) * x.head(n);
  for (int i = 0; i < patch.rows; ++i) lambda[i] = solved[i];
  bring_back(patch, lambda);
}

}  // namespace tissu::haptic
