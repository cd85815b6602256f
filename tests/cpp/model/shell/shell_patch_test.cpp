#include <gtest/gtest.h>

#include "shell_mesh.h"

/// What the linear triangles of a shell represent exactly, on any mesh.
namespace tissu {
namespace {

using test::ShellMesh;
using test::ShellStructure;

constexpr ShellSection kSection = {0.02, 3.0, 0.3};

/// 4 x 3 cells, those inside moved by up to a third of an edge; turned in space by R.
ShellMesh patch(const Mat3& R) {
  test::Random random(3);
  return test::grid(4, 3, [&](double x, double y) {
    const bool inside = x > 0.01 && x < 0.99 && y > 0.01 && y < 0.99;
    const Vec3 X(x, y, 0.0);
    return Vec3(R * (inside ? Vec3(X + Vec3(random.number(0.08), random.number(0.1), 0.0)) : X));
  });
}

/// The answer where the edge is held as `field` (six numbers of a flat place) is that field.
void expect_exact(const std::function<Vec18(double, double)>& field, double tolerance) {
  const Mat3 R = test::Random(9).rotation().toRotationMatrix();
  ShellStructure structure(patch(R), kSection);
  Eigen::VectorXd exact(structure.freedoms());
  for (Eigen::Index n = 0; n < exact.size() / 6; ++n) {
    const Vec3 X = R.transpose() * structure.mesh.nodes[static_cast<std::size_t>(n)];
    const Vec18 u = field(X[0], X[1]);
    exact.segment<3>(6 * n) = R * u.segment<3>(0);
    exact.segment<3>(6 * n + 3) = R * u.segment<3>(3);
  }
  structure.hold("xyzXYZ", [&](const Vec3& x) {
    const Vec3 X = R.transpose() * x;
    return std::min({X[0], 1.0 - X[0], X[1], 1.0 - X[1]}) < 1e-9;
  });
  Eigen::VectorXd given = exact;
  for (Eigen::Index i = 0; i < given.size(); ++i) {
    if (structure.held[static_cast<std::size_t>(i)] == 0) given[i] = 0.0;
  }
  EXPECT_LT((structure.linear_answer(given) - exact).norm(), tolerance * exact.norm());
}

// Round-off of a matrix whose condition is (h / t)^2 times that of a plate, 1e5.
TEST(ShellPatch, ConstantStrain) {
  for (const Vec3& strain : {Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0), Vec3(0.3, -0.2, 0.5)}) {
    expect_exact(
        [&](double x, double y) {
          Vec18 u = Vec18::Zero();  // a mean rotation of 0.7 too
          u.head<6>() << strain[0] * x + (strain[2] - 0.7) * y, (strain[2] + 0.7) * x + strain[1] * y, 0.0,
              0.0, 0.0, 0.7;
          return u;
        },
        1e-11);
  }
}

// w = a x^2 / 2 + b y^2 / 2 + c x y, theta = (dw/dy, -dw/dx)
TEST(ShellPatch, ConstantCurvature) {
  for (const Vec3& k :
       {Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0), Vec3(0.0, 0.0, 1.0), Vec3(0.3, -1.0, 0.5)}) {
    expect_exact(
        [&](double x, double y) {
          Vec18 u = Vec18::Zero();
          u.head<6>() << 0.0, 0.0, 0.5 * k[0] * x * x + 0.5 * k[1] * y * y + k[2] * x * y,
              k[1] * y + k[2] * x, -k[0] * x - k[2] * y, 0.0;
          return u;
        },
        1e-11);
  }
}

// The optimal triangle's claim: u = x y, v = -(x^2 + nu y^2) / 2 of a rectangle of two triangles has the
// energy of the beam, E J a / 2, whatever its aspect and Poisson's ratio. Moments that it takes out of
// nu y^2 cost nothing.
TEST(ShellPatch, BendsInItsPlaneAsABeam) {
  for (const double nu : {0.0, 0.25, 0.3, 0.45}) {
    for (const double a : {0.25, 1.0, 4.0, 16.0}) {
      const ShellMesh mesh =
          test::grid(1, 1, [&](double x, double y) { return Vec3(a * (x - 0.5), y - 0.5, 0.0); });
      ShellStructure structure(mesh, {0.1, 2.0, nu});
      Eigen::VectorXd u = Eigen::VectorXd::Zero(structure.freedoms());
      for (Eigen::Index n = 0; n < 4; ++n) {
        const Vec3& X = mesh.nodes[static_cast<std::size_t>(n)];
        u.segment<6>(6 * n) << X[0] * X[1], -0.5 * (X[0] * X[0] + nu * X[1] * X[1]), 0.0, 0.0, 0.0, -X[0];
      }
      EXPECT_NEAR(0.5 * u.dot(structure.stiffness() * u), 0.5 * 2.0 * 0.1 / 12.0 * a, 1e-13 * a) << nu << a;
    }
  }
}

}  // namespace
}  // namespace tissu
