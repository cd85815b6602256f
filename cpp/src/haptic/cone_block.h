#pragma once

/// Coulomb's law of one contact, solved by itself.

#include "tissu/base/vec.h"

namespace tissu::haptic {

/// lambda (normal, two tangents) with g = r + A lambda, 0 <= lambda_n _|_ g_n >= 0, |lambda_t| <= mu
/// lambda_n, and slip g_t against lambda_t. `A` (3 x 3) positive definite; `start` gives the direction that
/// the iteration begins with.
Vec3 solve_cone(const Mat3& A, const Vec3& r, double mu, const Vec3& start) noexcept;

}  // namespace tissu::haptic
