#include "tissu/force/load.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "../world/sample_worlds.h"
#include "room.h"
#include "tissu/force/gravity.h"
#include "tissu/mesh/topology.h"
#include "verbs.h"

namespace tissu {
namespace {

using test::derivative;
using test::force_of;
using test::moved;
using test::product_of;
using test::relative_difference;
using test::view;

// Forces here are of size 1, sums of some tens of them.
constexpr double kRoundOff = 1e-13;

std::vector<FaceCells> faces(const std::vector<std::array<std::int32_t, 3>>& triangles) {
  FaceCells all;
  for (const auto& t : triangles) all.nodes.insert(all.nodes.end(), t.begin(), t.end());
  return {all};
}

TEST(History, IsLinearBetweenItsTimesAndHeldAtItsEnds) {
  const History history{{1.0, 2.0, 4.0}, {0.0, 3.0, -1.0}};
  EXPECT_EQ(history.at(-5.0), 0.0);
  EXPECT_EQ(history.at(1.0), 0.0);
  EXPECT_DOUBLE_EQ(history.at(1.5), 1.5);
  EXPECT_EQ(history.at(2.0), 3.0);
  EXPECT_DOUBLE_EQ(history.at(3.0), 1.0);
  EXPECT_EQ(history.at(4.0), -1.0);
  EXPECT_EQ(history.at(1e9), -1.0);
}

TEST(History, IsOneWithoutTimes) { EXPECT_EQ(History{}.at(3.0), 1.0); }

TEST(History, HoldsASingleValue) {
  const History history{{1.0}, {0.25}};
  EXPECT_EQ(history.at(0.0), 0.25);
  EXPECT_EQ(history.at(1.0), 0.25);
  EXPECT_EQ(history.at(2.0), 0.25);
}

/// Two equal times are a jump; the value after it counts.
TEST(History, MayJump) {
  const History history{{0.0, 1.0, 1.0, 2.0}, {0.0, 0.0, 5.0, 5.0}};
  EXPECT_EQ(history.at(0.999), 0.0);
  EXPECT_EQ(history.at(1.0), 5.0);
  EXPECT_EQ(history.at(1.5), 5.0);
}

class LoadTest : public testing::Test {
 protected:
  Mesh mesh_ = test::distorted_box({2, 2, 2}, Split::six, 0.2);
  test::Random random_{21};

  State state() const {
    State state;
    state.positions = mesh_.positions;
    state.velocities.assign(mesh_.positions.size(), 0.0);
    return state;
  }
  static Vec3 sum(const Eigen::VectorXd& f) { return f.reshaped(3, f.size() / 3).rowwise().sum(); }
  std::vector<double> any() { return random_.numbers(mesh_.positions.size()); }
};

TEST_F(LoadTest, GravityIsMassTimesAcceleration) {
  std::vector<double> masses = random_.numbers(static_cast<std::size_t>(mesh_.node_count()));
  for (double& m : masses) m = std::abs(m);
  const Vec3 g(1.0, -2.0, -9.81);
  const Gravity gravity(masses, g);
  const Eigen::VectorXd f = force_of(gravity, state());
  for (std::int32_t i = 0; i < mesh_.node_count(); ++i) {
    EXPECT_LT((f.segment<3>(3 * i) - masses[static_cast<std::size_t>(i)] * g).norm(), 1e-15);
  }
  const std::vector<double> p = any();
  const double slope =
      derivative([&](double t) { return gravity.energy(moved(state(), p, t), test::scratch()); }, 0.1);
  EXPECT_NEAR(f.dot(view(p)), -slope, 1e-11);  // energy of size 100, h of 0.1: 1e-13; two digits more
  EXPECT_EQ(gravity.kind(), ForceKind::external);
  EXPECT_FALSE(gravity.has_stiffness());
}

TEST_F(LoadTest, NodalLoadFollowsItsHistoryAndTheLoadFactor) {
  const NodalLoad load("hand", {3, 5}, {1, 2, 3, -4, 5, -6}, {{0.0, 2.0}, {0.0, 1.0}});
  State now = state();
  now.time = 1.0;
  now.load_factor = 0.5;
  const Eigen::VectorXd f = force_of(load, now);
  EXPECT_LT((f.segment<3>(9) - 0.25 * Vec3(1, 2, 3)).norm(), 1e-15);
  EXPECT_LT((f.segment<3>(15) - 0.25 * Vec3(-4, 5, -6)).norm(), 1e-15);
  EXPECT_NEAR(f.norm(), 0.25 * std::sqrt(91.0), 1e-15);
  now.load_factor = 1.0;
  const std::vector<double> p = any();
  const double slope =
      derivative([&](double t) { return load.energy(moved(now, p, t), test::scratch()); }, 0.1);
  EXPECT_NEAR(force_of(load, now).dot(view(p)), -slope, 1e-12);
  EXPECT_EQ(load.effect(), "hand");
}

TEST_F(LoadTest, PressureOnAClosedSurfaceBalances) {
  const Pressure pressure("pressure", faces(boundary_surface(mesh_).triangles), 2.0, {});
  const State now = moved(state(), any(), 0.1);
  const Eigen::VectorXd f = force_of(pressure, now);
  Vec3 moment = Vec3::Zero();
  for (std::int32_t i = 0; i < mesh_.node_count(); ++i) {
    moment += block(ConstReals(now.positions), i).cross(Vec3(f.segment<3>(3 * i)));
  }
  EXPECT_LT(sum(f).norm(), kRoundOff);
  EXPECT_LT(moment.norm(), kRoundOff);
  EXPECT_GT(f.cwiseAbs().maxCoeff(), 0.1);
}

/// Positive pressure pushes against the outward normal: the face x = 2 of the box, 4 m2 at 3 Pa, feels -12 N.
TEST_F(LoadTest, PressurePushesInwards) {
  const Mesh box = box_mesh(Vec3::Zero(), Vec3(2, 2, 2), {2, 2, 2}, Split::six);
  std::vector<std::array<std::int32_t, 3>> face;
  for (const auto& t : boundary_surface(box).triangles) {
    if (std::ranges::all_of(t, [&](std::int32_t node) { return box.node(node).x() > 1.9; }))
      face.push_back(t);
  }
  ASSERT_EQ(face.size(), 8U);
  State now;
  now.positions = box.positions;
  EXPECT_LT((sum(force_of(Pressure("p", faces(face), 3.0, {}), now)) - Vec3(-12, 0, 0)).norm(), kRoundOff);
}

TEST_F(LoadTest, PressureFollowsTheBody) {
  auto triangles = boundary_surface(mesh_).triangles;
  triangles.resize(5);  // an open surface: its force is not zero
  const Pressure pressure("pressure", faces(triangles), 2.0, {});
  const Mat3 Q = random_.rotation().toRotationMatrix();
  State turned = state();
  for (std::int32_t i = 0; i < mesh_.node_count(); ++i) {
    block(Reals(turned.positions), i) = Q * mesh_.node(i) + Vec3(1, 2, 3);
  }
  const Eigen::VectorXd f = force_of(pressure, state());
  const Eigen::VectorXd g = force_of(pressure, turned);
  EXPECT_GT(sum(f).norm(), 0.1);
  for (std::int32_t i = 0; i < mesh_.node_count(); ++i) {
    EXPECT_LT((g.segment<3>(3 * i) - Q * f.segment<3>(3 * i)).norm(), kRoundOff);
  }
}

// The volume is a polynomial of degree 3 in the positions, so the differences are exact but for round-off.
TEST_F(LoadTest, PressureOnAClosedSurfaceHasAnEnergy) {
  const Pressure pressure("pressure", faces(boundary_surface(mesh_).triangles), 2.0,
                          {{0.0, 1.0}, {0.0, 1.0}});
  State now = state();
  now.time = 0.5;
  const std::vector<double> p = any();
  const double slope =
      derivative([&](double t) { return pressure.energy(moved(now, p, t), test::scratch()); }, 1e-2);
  EXPECT_NEAR(force_of(pressure, now).dot(view(p)), -slope, 1e-11);
  const Mesh box = box_mesh(Vec3(1, 2, 3), Vec3(2, 3, 4), {2, 2, 2}, Split::six);
  State rest;
  rest.positions = box.positions;
  EXPECT_NEAR(Pressure("p", faces(boundary_surface(box).triangles), 2.0, {}).energy(rest, test::scratch()),
              48.0, 1e-12);
}

TEST_F(LoadTest, PressureProductIsDerivativeOnAClosedSurface) {
  Pressure pressure("pressure", faces(boundary_surface(mesh_).triangles), 2.0, {});
  const Sparsity pattern = test::bind_alone(pressure, mesh_.node_count());
  const State now = moved(state(), any(), 0.1);
  const std::vector<double> p = any();
  const Eigen::VectorXd slope =
      derivative([&](double t) { return force_of(pressure, moved(now, p, t)); }, 0.1);
  EXPECT_LT(relative_difference(product_of(pressure, now, {1.0, 0.0}, p), slope), 1e-12);
  const Eigen::MatrixXd K = test::stiffness_of(pressure, now, {1.0, 7.0}, pattern);
  EXPECT_LT(relative_difference(K * view(p), slope), 1e-12);
  EXPECT_LT(relative_difference(K, K.transpose()), 1e-15);
}

/// On an open surface it is exact where the rim does not move.
TEST_F(LoadTest, PressureProductIsDerivativeInsideAHeldRim) {
  const Mesh box = box_mesh(Vec3::Zero(), Vec3(2, 2, 2), {2, 2, 2}, Split::six);
  std::vector<std::array<std::int32_t, 3>> face;
  for (const auto& t : boundary_surface(box).triangles) {
    if (std::ranges::all_of(t, [&](std::int32_t node) { return box.node(node).x() > 1.9; }))
      face.push_back(t);
  }
  const auto centre = test::nodes_where(box, [](const Vec3& x) { return (x - Vec3(2, 1, 1)).norm() < 1e-9; });
  ASSERT_EQ(centre.size(), 1U);
  const Pressure pressure("pressure", faces(face), 2.0, {});
  State now;
  now.positions = box.positions;
  std::vector<double> p(box.positions.size(), 0.0);
  block(Reals(p), centre[0]) = Vec3(0.3, -0.5, 0.8);
  now = moved(now, p, 0.2);
  const Eigen::VectorXd slope =
      derivative([&](double t) { return force_of(pressure, moved(now, p, t)); }, 0.1);
  const Eigen::VectorXd product = product_of(pressure, now, {1.0, 0.0}, p);
  EXPECT_LT((product - slope).segment<3>(3 * centre[0]).norm(), kRoundOff);
}

TEST_F(LoadTest, PressureFollowsItsHistoryAndTheLoadFactor) {
  const auto triangles = boundary_surface(mesh_).triangles;
  const Pressure pressure("pressure", faces(triangles), 2.0, {{0.0, 2.0}, {0.0, 1.0}});
  State now = state();
  now.time = 1.0;
  now.load_factor = 0.5;
  EXPECT_LT(relative_difference(force_of(pressure, now),
                                0.25 * force_of(Pressure("p", faces(triangles), 2.0, {}), state())),
            1e-15);
  const std::vector<double> p = any();
  EXPECT_LT(relative_difference(product_of(pressure, now, {4.0, 0.0}, p),
                                product_of(Pressure("p", faces(triangles), 2.0, {}), state(), {1.0, 0.0}, p)),
            1e-15);
}

}  // namespace
}  // namespace tissu
