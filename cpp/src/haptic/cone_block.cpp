#include "haptic/cone_block.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace tissu::haptic {
namespace {

using Vec2 = Eigen::Vector2d;

/// A contact that slips in a direction: lambda_t = mu lambda_n e with g_n = 0.
struct Slipping {
  const Mat3& A;
  const Vec3& r;
  double mu;

  [[nodiscard]] Vec3 force(const Vec2& e) const noexcept {
    const double across = A(0, 1) * e[0] + A(0, 2) * e[1];
    // Where friction would press as fast as the contact gives way, no lambda_n has g_n = 0: then a bound, and
    // g_n > 0.
    const double stiff = std::max(A(0, 0) + mu * across, 0.05 * A(0, 0));
    const double n = -r[0] / stiff;
    return {n, mu * n * e[0], mu * n * e[1]};
  }
  [[nodiscard]] Vec2 slip(const Vec3& lambda) const noexcept { return (r + A * lambda).tail<2>(); }
};

/// The direction that does not change under e <- -(g_t - rho lambda_t), rho at least the largest eigenvalue
/// of the tangents' A: in it slip is against the force.
Vec2 slip_direction(const Slipping& contact, Vec2 e) noexcept {
  const Mat3& A = contact.A;
  const double rho = 0.5 * (A(1, 1) + A(2, 2)) + std::hypot(0.5 * (A(1, 1) - A(2, 2)), A(1, 2));
  for (int i = 0; i < 40; ++i) {
    const Vec3 lambda = contact.force(e);
    const Vec2 towards = rho * lambda.tail<2>() - contact.slip(lambda);
    const double size = towards.norm();
    if (!(size > 0.0)) break;
    const Vec2 next = towards / size;
    const double turn = (next - e).squaredNorm();
    e = next;
    if (turn < 1e-30) break;
  }
  return e;
}

}  // namespace

Vec3 solve_cone(const Mat3& A, const Vec3& r, double mu, const Vec3& start) noexcept {
  if (r[0] >= 0.0) {
    // Without a force it is open. With normal and tangents coupled a stuck force may shut it too; open comes
    // first.
    return Vec3::Zero();
  }
  if (!(mu > 0.0)) return {-r[0] / A(0, 0), 0.0, 0.0};
  const Vec3 stuck = -(A.inverse() * r);
  if (stuck[0] > 0.0 && stuck.tail<2>().norm() <= mu * stuck[0]) return stuck;
  Vec2 e = start.tail<2>();
  if (!(e.norm() > 0.0)) e = stuck.tail<2>();
  const double size = e.norm();
  e = size > 0.0 ? Vec2(e / size) : Vec2(1.0, 0.0);
  const Slipping contact{A, r, mu};
  return contact.force(slip_direction(contact, e));
}

}  // namespace tissu::haptic
