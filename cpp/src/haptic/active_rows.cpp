#include "haptic/active_rows.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tissu::haptic {
namespace {

constexpr double kFull = 1.0 - 1e-9;  // of Coulomb's bound: more is slip
constexpr int kPivots = 10;

/// What a block does: nothing, g = 0, or the force at its bound along `along`, a unit vector (a bounded row:
/// its sign).
enum class Role : unsigned char { open, bears, slips };
struct Acting {
  Role role = Role::open;
  Eigen::Vector2d along = Eigen::Vector2d::Zero();
};
using Roles = std::array<Acting, kMaxBlocks>;

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

/// The role that a force says.
Acting acting(const Block& block, const Rows& lambda) noexcept {
  const double force = lambda[block.row];
  if (block.kind == BlockKind::bounded) {
    if (std::abs(force) < kFull * block.bound) return {Role::bears, {}};
    return {Role::slips, {force < 0.0 ? -1.0 : 1.0, 0.0}};
  }
  if (!(force > 0.0)) return {};
  if (block.kind == BlockKind::push) return {Role::bears, {}};
  const Eigen::Vector2d across = lambda.segment<2>(block.row + 1);
  const double size = across.norm();
  if (size < kFull * block.bound * force) return {Role::bears, {}};
  return {Role::slips, size > 0.0 ? Eigen::Vector2d(across / size) : Eigen::Vector2d(0.0, 0.0)};
}

Active active_rows(const Patch& patch, const Roles& roles) noexcept {
  Active active;
  for (int k = 0; k < patch.blocks; ++k) {
    const Block& block = patch.block[static_cast<std::size_t>(k)];
    const Acting& acts = roles[static_cast<std::size_t>(k)];
    if (acts.role == Role::open) continue;
    if (block.kind == BlockKind::bounded && acts.role == Role::slips) {
      active.fixed[block.row] = acts.along[0] * block.bound;
      continue;
    }
    active.add(block.row);
    if (block.kind != BlockKind::cone) continue;
    for (int i = 1; i < 3; ++i) {
      if (acts.role == Role::bears) {
        active.add(block.row + i);
      } else {
        active.share(block.row + i, active.count - 1) = block.bound * acts.along[i - 1];
      }
    }
  }
  return active;
}

/// The role after a solve: what pulls opens, what is inside closes, what asks for too much friction slips,
/// what slips with its force sticks. `close` [m]: gaps that are round-off.
Acting next_role(const Patch& patch, const Block& block, const Acting& acts, const Rows& lambda,
                 const Rows& g, double close) noexcept {
  const int i = block.row;
  if (block.kind == BlockKind::bounded) {
    if (acts.role == Role::bears) return acting(block, lambda);
    return acts.along[0] * g[i] > close ? Acting{Role::bears, {}} : acts;
  }
  if (acts.role == Role::open) return g[i] < -close ? Acting{Role::bears, {}} : acts;
  if (!(lambda[i] > 0.0)) return {};
  if (block.kind == BlockKind::push) return acts;
  if (acts.role == Role::bears) return acting(block, lambda);
  const Eigen::Vector2d slip = g.segment<2>(i + 1);
  if (!(block.bound > 0.0) || slip.norm() <= close) return acts;
  if (slip.dot(acts.along) > 0.0) return {Role::bears, {}};
  const double soft = std::max(patch.A(i + 1, i + 1), patch.A(i + 2, i + 2));
  const Eigen::Vector2d towards = soft * lambda.segment<2>(i + 1) - slip;
  return {Role::slips, towards.normalized()};
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

/// The forces at which g = 0 of all that bears; false where there are none.
bool solve_roles(const Patch& patch, const Roles& roles, Rows& lambda) noexcept {
  const Active active = active_rows(patch, roles);
  const int n = active.count;
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
  if (!eliminate(n, M, x)) return false;
  for (int i = 0; i < patch.rows; ++i) {
    double force = active.fixed[i];
    for (int j = 0; j < n; ++j) force += active.share(i, j) * x[j];
    lambda[i] = force;
  }
  return true;
}

}  // namespace

void solve_active_rows(const Patch& patch, Rows& lambda) noexcept {
  Roles roles;
  for (int k = 0; k < patch.blocks; ++k) {
    roles[static_cast<std::size_t>(k)] = acting(patch.block[static_cast<std::size_t>(k)], lambda);
  }
  // Round-off of gaps: of the terms that they are sums of.
  const double close = 1e-12 * patch.A.topLeftCorner(patch.rows, patch.rows).diagonal().maxCoeff() *
                       lambda.head(patch.rows).cwiseAbs().sum();
  Rows solved = lambda;
  for (int pivot = 0; pivot < kPivots; ++pivot) {
    if (!solve_roles(patch, roles, solved)) return;
    const Rows g = gaps(patch, solved);
    bool settled = true;
    for (int k = 0; k < patch.blocks; ++k) {
      const Block& block = patch.block[static_cast<std::size_t>(k)];
      Acting& acts = roles[static_cast<std::size_t>(k)];
      const Acting next = next_role(patch, block, acts, solved, g, close);
      settled = settled && next.role == acts.role && (next.along - acts.along).norm() < 1e-12;
      acts = next;
    }
    if (settled) break;
  }
  lambda.head(patch.rows) = solved.head(patch.rows);
  bring_back(patch, lambda);
}

}  // namespace tissu::haptic
