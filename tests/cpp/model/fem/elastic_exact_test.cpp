#include <Eigen/LU>
#include <cmath>
#include <numeric>

#include "../../force/room.h"
#include "elastic_sample.h"
#include "tissu/law/generated/hooke.h"
#include "tissu/law/generated/stvk.h"
#include "tissu/law/law.h"
#include "tissu/mesh/quality.h"

/// What is known in closed form: rigid motions, homogeneous strain, volumes and masses.
namespace tissu {
namespace {

using test::force_of;

// Stresses here are of size 1 and areas of size 1: round-off of 1e-16 per product, some hundred of them.
constexpr double kRoundOff = 1e-13;

class ElasticExact : public test::ElasticTest {
 protected:
  /// Values of the law itself for the body's uniform parameters.
  template <class Function>
  auto with_law(Function&& f) {
    const Lame c = lame(kYoung, 0.3);
    return is_stvk() ? f(StVK<double>{c.lambda, c.mu}) : f(Hooke<double>{c.lambda, c.mu});
  }
  double total_volume() const {
    const std::vector<double> v = volumes(mesh_);
    return std::accumulate(v.begin(), v.end(), 0.0);
  }
};

Tensor2<double> tensor(const Mat3& m) {
  Tensor2<double> t;
  for (int i = 0; i < 9; ++i) t(i / 3, i % 3) = m(i / 3, i % 3);
  return t;
}

TEST_P(ElasticExact, RestAndTranslationGiveNoForce) {
  const Elastic elastic = made(varied_block());
  for (const Vec3& shift : {Vec3(0, 0, 0), Vec3(1.5, -2.0, 0.25)}) {
    const State state = affine(Mat3::Identity(), shift);
    EXPECT_LT(force_of(elastic, state).cwiseAbs().maxCoeff(), kRoundOff);
    EXPECT_LT(elastic.energy(state, test::scratch()), kRoundOff);
  }
}

TEST_P(ElasticExact, RotationGivesNoForceForStVKOnly) {
  const Elastic elastic = made(varied_block());
  const State state = affine(Eigen::AngleAxisd(2.5, Vec3(1, 2, -1).normalized()).toRotationMatrix());
  const double largest = force_of(elastic, state).cwiseAbs().maxCoeff();
  if (is_stvk()) {
    EXPECT_LT(largest, kRoundOff);
    EXPECT_LT(elastic.energy(state, test::scratch()), kRoundOff);
  } else {
    EXPECT_GT(largest, 0.1);
    EXPECT_GT(elastic.energy(state, test::scratch()), 0.1);
  }
}

TEST_P(ElasticExact, ForcesBalance) {
  const Elastic elastic = made(varied_block());
  const State state = any_state();
  const Eigen::VectorXd f = force_of(elastic, state);
  Vec3 sum = Vec3::Zero();
  Vec3 moment = Vec3::Zero();
  for (std::int32_t i = 0; i < mesh_.node_count(); ++i) {
    sum += f.segment<3>(3 * i);
    moment += tissu::block(ConstReals(state.positions), i).cross(Vec3(f.segment<3>(3 * i)));
  }
  EXPECT_LT(sum.norm(), kRoundOff);
  if (is_stvk()) {
    EXPECT_LT(moment.norm(), 10 * kRoundOff);  // arms of up to 4 m
  }
}

/// The patch test: constant strain on a distorted mesh leaves the inner nodes without force.
TEST_P(ElasticExact, ConstantStrainLeavesInnerNodesInBalance) {
  const Elastic elastic = made(block());
  const Mat3 F = Mat3::Identity() + random_.matrix(0.2);
  const Eigen::VectorXd f = force_of(elastic, affine(F, Vec3(1, 2, 3)));
  const Mesh grid = box_mesh(Vec3::Zero(), Vec3(3, 2, 2), {3, 2, 2}, GetParam().split);
  const auto inner = test::nodes_where(grid, [](const Vec3& x) {
    return (x.array() > 0.5).all() && x.x() < 2.5 && x.y() < 1.5 && x.z() < 1.5;
  });
  ASSERT_EQ(inner.size(), 2U);
  for (const std::int32_t node : inner) {
    EXPECT_LT(f.segment<3>(3 * node).norm(), 1e-12 * f.cwiseAbs().maxCoeff());
  }
  EXPECT_GT(f.cwiseAbs().maxCoeff(), 0.1);
}

TEST_P(ElasticExact, EnergyOfConstantStrainIsDensityTimesVolume) {
  const Elastic elastic = made(block());
  const Mat3 F = Mat3::Identity() + random_.matrix(0.2);
  const double W = with_law([&](const auto& law) { return law.energy(tensor(F)); });
  EXPECT_NEAR(elastic.energy(affine(F), test::scratch()), W * total_volume(), kRoundOff);
}

/// Virtual work of constant stress: f . (G X) = -P : G V.
TEST_P(ElasticExact, WorkOfConstantStress) {
  const Elastic elastic = made(block());
  const Mat3 F = Mat3::Identity() + random_.matrix(0.2);
  const Mat3 G = random_.matrix();
  const Tensor2<double> P = with_law([&](const auto& law) { return law.stress(tensor(F)); });
  double expected = 0.0;
  for (int i = 0; i < 9; ++i) expected -= P(i / 3, i % 3) * G(i / 3, i % 3) * total_volume();
  const State virtual_motion = affine(G);
  EXPECT_NEAR(force_of(elastic, affine(F)).dot(test::view(virtual_motion.positions)), expected,
              10 * kRoundOff);
}

TEST_P(ElasticExact, VolumesAreThoseOfTheMesh) {
  const Elastic elastic = made(varied_block());
  const std::vector<double> expected = volumes(mesh_);
  ASSERT_EQ(elastic.volumes().size(), expected.size());
  ASSERT_EQ(elastic.cell_count(), mesh_.cell_count());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(elastic.volumes()[i], expected[i], 1e-14);
  const Elastic box(
      test::elastic_block(box_mesh(Vec3::Zero(), Vec3(3, 2, 1), {3, 2, 1}, GetParam().split).blocks[0], {}),
      box_mesh(Vec3::Zero(), Vec3(3, 2, 1), {3, 2, 1}, GetParam().split).positions, GetParam().isa,
      Threads(1));
  EXPECT_NEAR(std::accumulate(box.volumes().begin(), box.volumes().end(), 0.0), 6.0, 1e-14);
}

TEST_P(ElasticExact, MassesSumToDensityTimesVolume) {
  const ElasticBlock varied = varied_block();
  const Elastic elastic = made(varied);
  std::vector<double> masses(static_cast<std::size_t>(mesh_.node_count()), 0.0);
  elastic.add_masses(masses);
  double expected = 0.0;
  for (std::size_t i = 0; i < varied.density.size(); ++i)
    expected += varied.density[i] * elastic.volumes()[i];
  EXPECT_NEAR(std::accumulate(masses.begin(), masses.end(), 0.0), expected, 1e-13 * expected);
  for (const double m : masses) EXPECT_GT(m, 0.0);
}

/// The centre of mass of the lumped masses of linear elements is that of the body.
TEST_P(ElasticExact, MassesKeepTheCentre) {
  const Mesh mesh = box_mesh(Vec3(1, 2, 3), Vec3(3, 2, 1), {3, 2, 1}, GetParam().split);
  const Elastic elastic(test::elastic_block(mesh.blocks[0], {}), mesh.positions, GetParam().isa, Threads(1));
  std::vector<double> masses(static_cast<std::size_t>(mesh.node_count()), 0.0);
  elastic.add_masses(masses);
  Vec3 sum = Vec3::Zero();
  for (std::int32_t i = 0; i < mesh.node_count(); ++i)
    sum += masses[static_cast<std::size_t>(i)] * mesh.node(i);
  EXPECT_LT((sum / 12.0 - Vec3(2.5, 3.0, 3.5)).norm(), 1e-14);  // 12 kg: 6 m3 of 2 kg/m3
}

/// Cauchy stress P F^T / det F of a homogeneous state that turns and shears too.
TEST_P(ElasticExact, FieldsOfConstantStrain) {
  const Elastic elastic = made(block());
  const Mat3 F =
      Eigen::AngleAxisd(0.7, Vec3(1, 1, 0).normalized()) * (Mat3::Identity() + random_.matrix(0.2));
  const auto P = with_law([&](const auto& law) { return law.stress(tensor(F)); });
  const double W = with_law([&](const auto& law) { return law.energy(tensor(F)); });
  const Tensor2<double> PFt = product_transposed(P, tensor(F));
  Mat3 cauchy;
  for (int i = 0; i < 9; ++i) cauchy(i / 3, i % 3) = PFt(i / 3, i % 3) / F.determinant();
  cauchy = 0.5 * (cauchy + cauchy.transpose()).eval();
  const Mat3 deviator = cauchy - cauchy.trace() / 3.0 * Mat3::Identity();
  const CellFields fields = elastic.fields(affine(F));
  ASSERT_EQ(fields.von_mises.size(), static_cast<std::size_t>(mesh_.cell_count()));
  for (std::size_t i = 0; i < fields.von_mises.size(); ++i) {
    if (is_stvk()) {
      EXPECT_NEAR(fields.von_mises[i], std::sqrt(1.5) * deviator.norm(), kRoundOff);
    }
    EXPECT_NEAR(fields.energy_density[i], W, kRoundOff);
    EXPECT_NEAR(fields.volume_ratio[i], F.determinant(), kRoundOff);
  }
}

/// nu = 0, stretch s along x: the only stress is sigma_xx = P_xx, since the section keeps its area.
TEST_P(ElasticExact, FieldsOfUniaxialTension) {
  ElasticBlock bar = varied_block();
  bar.parameters["poisson"] = {0.0};
  const double s = 1.3;
  const CellFields fields = made(bar).fields(affine(Vec3(s, 1, 1).asDiagonal()));
  for (std::size_t i = 0; i < bar.parameters["young"].size(); ++i) {
    const double E =
        bar.parameters["young"][i];  // differs from cell to cell: the fields are in the order of the cells
    EXPECT_NEAR(fields.von_mises[i], is_stvk() ? E / 2 * s * (s * s - 1) : E * (s - 1), kRoundOff);
    EXPECT_NEAR(fields.energy_density[i],
                is_stvk() ? E / 8 * std::pow(s * s - 1, 2) : E / 2 * std::pow(s - 1, 2), kRoundOff);
  }
}

TEST_P(ElasticExact, EnergyDensitiesSumToTheEnergy) {
  const Elastic elastic = made(varied_block());
  const State state = any_state();
  const CellFields fields = elastic.fields(state);
  double sum = 0.0;
  for (std::size_t i = 0; i < fields.energy_density.size(); ++i)
    sum += fields.energy_density[i] * elastic.volumes()[i];
  EXPECT_NEAR(sum, elastic.energy(state, test::scratch()), 1e-13 * sum);
}

INSTANTIATE_TEST_SUITE_P(All, ElasticExact, testing::ValuesIn(test::elastic_cases()), test::case_name);

}  // namespace
}  // namespace tissu
