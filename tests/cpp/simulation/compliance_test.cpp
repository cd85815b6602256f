#include "tissu/simulation/compliance.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cstring>

#include "../assembly/dense.h"
#include "../world/sample_worlds.h"
#include "tissu/simulation/matrices.h"

/// W against a dense inverse of the matrices, by a factor that is made, kept and corrected.
namespace tissu {
namespace {

constexpr double kStep = 0.02;

WorldDescription world(int threads) {
  const Mesh mesh = test::distorted_box({3, 3, 2}, Split::six, 0.05);
  WorldDescription world;
  world.bodies = {test::body_of(mesh, {.law = "neo_hooke", .young = 300.0})};
  world.bodies[0].rayleigh = {0.1, 0.001};
  world.gravity = Vec3(0.0, 0.0, -2.0);
  world.fixed = {test::fixed(test::nodes_where(mesh, [](const Vec3& x) { return x.z() < 0.4; }))};
  world.threads = threads;
  return world;
}

std::vector<CarriedPoint> points() {
  Mat3 axes = Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, -1.0).normalized()).toRotationMatrix();
  return {{{{40, 1.0}}, axes}, {{{41, 0.5}, {44, 0.3}, {47, 0.2}}, axes.transpose()}};
}

Eigen::MatrixXd exact(const Simulation& simulation) {
  const World& world = simulation.world();
  const auto dense = [](const AssembledMatrix& matrix) { return test::dense(*matrix.blocks); };
  Eigen::MatrixXd A = dense(mass_matrix(world, simulation.state())) +
                      kStep * dense(damping_matrix(world, simulation.state())) +
                      kStep * kStep * dense(stiffness_matrix(world, simulation.state()));
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(A.rows(), 6);
  for (int i = 0; i < 2; ++i) {
    const CarriedPoint point = points()[static_cast<std::size_t>(i)];
    for (const CarriedPart& part : point.parts) {
      B.block<3, 3>(3 * part.row, 3 * i) += part.weight * point.axes.transpose();
    }
  }
  const auto& masks = world.fixed().masks();
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    if (((masks[static_cast<std::size_t>(i / 3)] >> (i % 3)) & 1) == 0) continue;
    A.row(i).setZero();
    A.col(i).setZero();
    A(i, i) = 1.0;
    B.row(i).setZero();
  }
  return kStep * kStep * B.transpose() * A.fullPivLu().solve(B);
}

Simulation simulation(int threads = 1) {
  return test::simulate(world(threads), test::implicit_euler(), test::conjugate_gradient());
}

TEST(Compliance, IsTheInverseOfTheStepsMatrix) {
  Simulation s = simulation();
  s.step(kStep);
  Compliance compliance({});
  const Eigen::MatrixXd W = compliance.find(s, kStep, points());
  EXPECT_TRUE(compliance.report().made);
  EXPECT_LT((W - exact(s)).norm(), 1e-10 * W.norm());
  EXPECT_EQ(W, W.transpose());
}

TEST(Compliance, StaysWithinItsBoundWhileTheFactorIsKept) {
  Simulation s = simulation();
  Compliance compliance({});
  int kept = 0;
  for (int i = 0; i < 20; ++i) {
    s.step(kStep);
    const Eigen::MatrixXd W = compliance.find(s, kStep, points());
    const Eigen::MatrixXd all = exact(s);
    EXPECT_LE(compliance.report().error, 1e-2);
    for (Eigen::Index k = 0; k < W.rows(); ++k) {
      EXPECT_LE(W(k, k), all(k, k) * (1.0 + 1e-10));
      EXPECT_LE(all(k, k) - W(k, k), (compliance.report().error + 1e-10) * all(k, k));
    }
    kept += compliance.report().made ? 0 : 1;
  }
  EXPECT_GT(kept, 0);
}

TEST(Compliance, HasTheSameBitsOnAnyNumberOfThreads) {
  Simulation one = simulation(1);
  Simulation three = simulation(3);
  Compliance::Settings settings;
  settings.tolerance = 1e-5;
  Compliance first(settings);
  Compliance second(settings);
  for (int i = 0; i < 8; ++i) {
    one.step(kStep);
    three.step(kStep);
    const Eigen::MatrixXd W = first.find(one, kStep, points());
    EXPECT_EQ(W, second.find(three, kStep, points()));
  }
}

}  // namespace
}  // namespace tissu
