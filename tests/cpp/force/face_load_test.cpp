#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>

#include "../world/sample_worlds.h"
#include "room.h"
#include "tissu/element/generated/all.h"
#include "tissu/force/load.h"
#include "tissu/mesh/quality.h"
#include "tissu/mesh/topology.h"
#include "verbs.h"

/// Loads on whole faces, of every volume element: one cell, a little distorted, inside its own surface.
namespace tissu {
namespace {

using test::derivative;
using test::force_of;
using test::moved;
using test::product_of;
using test::relative_difference;

class FaceLoadTest : public testing::TestWithParam<std::string> {
 protected:
  FaceLoadTest() {
    CellBlock block;
    block.type = *cell_type(GetParam());
    for_each_element([&](auto element) {
      if constexpr (decltype(element)::kDimension == 3) {
        if (element.kName != GetParam()) return;
        for (const auto& node : element.nodes) {
          block.nodes.push_back(static_cast<std::int32_t>(mesh_.positions.size() / 3));
          for (const double x : node) mesh_.positions.push_back(x + random_.number(0.04));
        }
      }
    });
    mesh_.blocks.push_back(block);
    for (const FaceBlock& some : boundary_face_blocks(mesh_)) {
      faces_.push_back({std::string(some.type), some.nodes});
    }
    state_.positions = mesh_.positions;
  }

  test::Random random_{5};
  Mesh mesh_;
  std::vector<FaceCells> faces_;
  State state_;
};

// The faces are exact. The volume is too where its rule is: not for det J of degree 3 on a tetrahedron, nor
// for pyramids, whose shape functions are rational.
TEST_P(FaceLoadTest, EnclosesTheVolume) {
  const double tolerance = GetParam().starts_with("pyramid") ? 2e-3 : GetParam() == "tetra10" ? 1e-5 : 1e-12;
  EXPECT_NEAR(Pressure("p", faces_, 1.0, {}).energy(state_, test::scratch()), volumes(mesh_)[0], tolerance);
}

TEST_P(FaceLoadTest, BalancesOnAClosedSurface) {
  const Eigen::VectorXd f = force_of(Pressure("p", faces_, 2.0, {}), state_);
  Vec3 sum = Vec3::Zero();
  Vec3 moment = Vec3::Zero();
  for (std::int32_t i = 0; i < mesh_.node_count(); ++i) {
    sum += f.segment<3>(3 * i);
    moment += mesh_.node(i).cross(Vec3(f.segment<3>(3 * i)));
  }
  EXPECT_LT(sum.norm(), 1e-12);
  EXPECT_LT(moment.norm(), 1e-12);
  EXPECT_GT(f.norm(), 0.1);
}

TEST_P(FaceLoadTest, IsTheGradientOfItsEnergy) {
  const Pressure pressure("p", faces_, 2.0, {});
  const std::vector<double> p = random_.numbers(state_.positions.size());
  const double slope =
      derivative([&](double t) { return pressure.energy(moved(state_, p, t), test::scratch()); }, 1e-2);
  EXPECT_NEAR(force_of(pressure, state_).dot(test::view(p)), -slope, 1e-11);
}

TEST_P(FaceLoadTest, ProductIsItsDerivative) {
  Pressure pressure("p", faces_, 2.0, {});
  const Sparsity pattern = test::bind_alone(pressure, mesh_.node_count());
  const std::vector<double> p = random_.numbers(state_.positions.size());
  const Eigen::VectorXd slope =
      derivative([&](double t) { return force_of(pressure, moved(state_, p, t)); }, 0.1);
  EXPECT_LT(relative_difference(product_of(pressure, state_, {1.0, 0.0}, p), slope), 1e-11);
  const Eigen::MatrixXd K = test::stiffness_of(pressure, state_, {1.0, 0.0}, pattern);
  EXPECT_LT(relative_difference(K * test::view(p), slope), 1e-11);
}

/// On flat faces a traction gives what a pressure gives, along the normal.
TEST_P(FaceLoadTest, AreasAreThoseOfThePressure) {
  mesh_.positions.clear();
  for_each_element([&](auto element) {
    if constexpr (decltype(element)::kDimension == 3) {
      if (element.kName != GetParam()) return;
      for (const auto& node : element.nodes)
        mesh_.positions.insert(mesh_.positions.end(), node.begin(), node.end());
    }
  });
  state_.positions = mesh_.positions;
  for (const FaceCells& some : faces_) {
    const std::size_t nodes = static_cast<std::size_t>(find_element(some.element)->nodes);
    for (std::size_t first = 0; first < some.nodes.size(); first += nodes) {
      const auto begin = some.nodes.begin() + static_cast<std::ptrdiff_t>(first);
      const FaceCells one{some.element, {begin, begin + static_cast<std::ptrdiff_t>(nodes)}};
      std::vector<double> areas(mesh_.positions.size() / 3, 0.0);
      add_areas(one, mesh_.positions, areas);
      const Eigen::VectorXd f = force_of(Pressure("p", {one}, 1.0, {}), state_);
      Vec3 sum = Vec3::Zero();
      double area = 0.0;
      for (std::size_t i = 0; i < areas.size(); ++i) {
        sum += f.segment<3>(static_cast<Eigen::Index>(3 * i));
        area += areas[i];
      }
      for (std::size_t i = 0; i < areas.size(); ++i) {
        const Vec3 along = areas[i] / area * sum;
        EXPECT_LT((f.segment<3>(static_cast<Eigen::Index>(3 * i)) - along).norm(), 1e-13);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Elements, FaceLoadTest,
                         testing::Values("tetra", "tetra10", "hexahedron", "hexahedron20", "hexahedron27",
                                         "wedge", "wedge15", "pyramid", "pyramid13"),
                         [](const auto& info) { return info.param; });

TEST(FaceLoad, RefusesWhatIsNoFace) {
  EXPECT_THROW(Pressure("p", {{"tetra", {0, 1, 2, 3}}}, 1.0, {}), ParameterError);
  EXPECT_THROW(Pressure("p", {{"line", {0, 1}}}, 1.0, {}), ParameterError);  // an edge has a thickness
}

/// The rim of a flat body of thickness 0.2: a square of side 2, its sides straight or arcs of parabolas that
/// stand out by 0.3 in the middle, so that each adds 2/3 0.3 2 to the area.
class EdgeLoadTest : public testing::TestWithParam<bool> {
 protected:
  EdgeLoadTest() {
    const std::array<Vec3, 4> corners = {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0)};
    for (std::int32_t side = 0; side < 4; ++side) {
      const Vec3& from = corners[static_cast<std::size_t>(side)];
      const Vec3& to = corners[static_cast<std::size_t>((side + 1) % 4)];
      const Vec3 middle = 1.3 * 0.5 * (from + to);
      edges_.nodes.insert(edges_.nodes.end(), {side, (side + 1) % 4});
      if (GetParam()) edges_.nodes.push_back(4 + side);
      state_.positions.insert(state_.positions.end(), from.begin(), from.end());
      middles_.insert(middles_.end(), middle.begin(), middle.end());
    }
    if (GetParam()) state_.positions.insert(state_.positions.end(), middles_.begin(), middles_.end());
    edges_.element = GetParam() ? "line3" : "line";
    edges_.thickness = 0.2;
  }
  FaceCells edges_;
  State state_;
  std::vector<double> middles_;
  test::Random random_{7};
};

TEST_P(EdgeLoadTest, EnclosesAreaTimesThickness) {
  const double area = 4.0 + (GetParam() ? 4.0 * 2.0 / 3.0 * 0.3 * 2.0 : 0.0);
  EXPECT_NEAR(Pressure("p", {edges_}, 3.0, {}).energy(state_, test::scratch()), 3.0 * 0.2 * area, 1e-13);
}

TEST_P(EdgeLoadTest, ForceIsTheSlopeOfItsEnergyAndProductThatOfTheForce) {
  Pressure pressure("p", {edges_}, 3.0, {});
  std::vector<double> p = random_.numbers(state_.positions.size());
  const double slope =
      derivative([&](double t) { return pressure.energy(moved(state_, p, t), test::scratch()); }, 1e-2);
  EXPECT_NEAR(force_of(pressure, state_).dot(test::view(p)), -slope, 1e-11);
  const Sparsity pattern = test::bind_alone(pressure, static_cast<std::int32_t>(state_.positions.size() / 3));
  const Eigen::VectorXd change =
      derivative([&](double t) { return force_of(pressure, moved(state_, p, t)); }, 0.1);
  EXPECT_LT(relative_difference(product_of(pressure, state_, {1.0, 0.0}, p), change), 1e-11);
  const Eigen::MatrixXd K = test::stiffness_of(pressure, state_, {1.0, 0.0}, pattern);
  EXPECT_LT(relative_difference(K * test::view(p), change), 1e-11);
}

TEST_P(EdgeLoadTest, NormalsAreWhatAPressureGives) {
  std::vector<double> normals(state_.positions.size(), 0.0);
  add_normals(edges_, state_.positions, normals);
  EXPECT_LT((force_of(Pressure("p", {edges_}, -1.0, {}), state_) - test::view(normals)).norm(), 1e-14);
  std::vector<double> areas(state_.positions.size() / 3, 0.0);
  add_areas(edges_, state_.positions, areas);
  if (!GetParam()) {
    for (const double area : areas) EXPECT_NEAR(area, 2.0 * 0.2, 1e-14);
  }
}

INSTANTIATE_TEST_SUITE_P(Orders, EdgeLoadTest, testing::Bool(),
                         [](const auto& info) { return info.param ? "line3" : "line"; });

}  // namespace
}  // namespace tissu
