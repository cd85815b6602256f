#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "../../base/random.h"
#include "../../cell/reference_nodes.h"
#include "../../force/room.h"
#include "../../force/verbs.h"
#include "tissu/model/fem/elastic.h"
#include "tissu/model/points/elastic_points.h"

/// F, P and W at points against closed forms and the force, for every element there is.
namespace tissu {
namespace {

constexpr double kYoung = 1000.0;
constexpr double kPoisson = 0.3;
constexpr double kRoundOff = 1e-12;  // of a stress of some hundred pascals and areas of size 1
const double kLambda = kYoung * kPoisson / ((1.0 + kPoisson) * (1.0 - 2.0 * kPoisson));
const double kMu = kYoung / (2.0 * (1.0 + kPoisson));
const Mat3 kTilt = Eigen::AngleAxisd(1.1, Vec3(0.36, 0.48, -0.8)).toRotationMatrix();

/// One cell: the nodes of the reference cell, bent a little where it is curved, and tilted below three
/// dimensions.
struct Sample {
  ElasticBlock block;
  std::vector<double> X;
  int dimension;

  Sample(const ElementInfo& element, Plane plane) : dimension(element.dimension) {
    block.body = "body";
    block.element = element.name;
    block.law = "stvk";
    block.parameters = {{"young", {kYoung}}, {"poisson", {kPoisson}}};
    block.density = {1.0};
    block.plane = plane;
    for (std::int32_t a = 0; a < element.nodes; ++a) block.cells.push_back(a);
    for (Vec3 at : test::reference_nodes(element.name)) {
      at[0] += 0.1 * at[0] * at[1];
      const Vec3 place = plane == Plane::free ? Vec3(kTilt * at) : at;
      X.insert(X.end(), place.begin(), place.end());
    }
  }
  [[nodiscard]] State moved(const Mat3& F) const {
    State state;
    for (std::size_t i = 0; i < X.size(); i += 3) {
      const Vec3 x = F * Vec3(X[i], X[i + 1], X[i + 2]);
      state.positions.insert(state.positions.end(), x.begin(), x.end());
    }
    return state;
  }
};

Mat3 stvk_stress(const Mat3& F) {
  const Mat3 E = 0.5 * (F.transpose() * F - Mat3::Identity());
  return F * (kLambda * E.trace() * Mat3::Identity() + 2.0 * kMu * E);
}

struct Case {
  std::string element;
  Plane plane;
};

/// Every element, and sheets as flat bodies too.
std::vector<Case> cases() {
  std::vector<Case> all;
  for (const ElementInfo& element : elements()) {
    all.push_back({std::string(element.name), Plane::free});
    if (element.dimension != 2) continue;
    all.push_back({std::string(element.name), Plane::stress});
    all.push_back({std::string(element.name), Plane::strain});
  }
  return all;
}

class PointFieldsTest : public testing::TestWithParam<Case> {
 protected:
  PointFieldsTest() : sample_(*find_element(GetParam().element), GetParam().plane) {}
  [[nodiscard]] static Plane plane() { return GetParam().plane; }
  [[nodiscard]] PointFields points(const State& state) const {
    return elastic_points(sample_.block, {sample_.X, state, choose_isa()});
  }
  Sample sample_;
  test::Random random_{4};
};

/// sum_g w_g P : dF = -f . dx along any motion: the points hold what makes the force.
TEST_P(PointFieldsTest, DoTheWorkOfTheForce) {
  const Elastic elastic(sample_.block, sample_.X, choose_isa(), Threads(1));
  State state = sample_.moved(Mat3::Identity());
  const auto in_space = [&](std::size_t i) { return plane() == Plane::free || i % 3 != 2; };
  std::vector<double> along(state.positions.size());
  for (std::size_t i = 0; i < along.size(); ++i) {
    if (!in_space(i)) continue;
    state.positions[i] += random_.number(0.03);
    along[i] = random_.number(1.0);
  }
  const PointFields now = points(state);
  std::vector<double> f(along.size(), 0.0);
  elastic.add_force(state, test::scratch(), f);
  double expected = 0.0;
  for (std::size_t i = 0; i < f.size(); ++i) expected -= f[i] * along[i];
  const double h = 1e-5;
  State ahead = state;
  State behind = state;
  for (std::size_t i = 0; i < along.size(); ++i) {
    ahead.positions[i] += h * along[i];
    behind.positions[i] -= h * along[i];
  }
  const PointFields after = points(ahead);
  const PointFields before = points(behind);
  double work = 0.0;
  double energy = 0.0;
  for (std::size_t i = 0; i < now.volumes.size(); ++i) {
    const Mat3 dF = (after.gradient_at(i) - before.gradient_at(i)) / (2.0 * h);
    work += now.volumes[i] * now.stress_at(i).cwiseProduct(dF).sum();
    energy += now.volumes[i] * now.W[i];
  }
  EXPECT_NEAR(work, expected, 1e-7 * std::abs(expected) + 1e-7);  // h^2
  EXPECT_NEAR(energy, elastic.energy(state, test::scratch()), kRoundOff * (1.0 + energy));
}

/// A homogeneous state of a flat body or of a sheet or line in space: that of a volume.
TEST_P(PointFieldsTest, AreThoseOfAVolume) {
  Mat3 F = Mat3::Identity();
  F.topLeftCorner<2, 2>() += random_.matrix(0.2).topLeftCorner<2, 2>();
  if (sample_.dimension == 3) F += random_.matrix(0.1);
  const Mat3 Q = plane() == Plane::free && sample_.dimension < 3 ? kTilt : Mat3(Mat3::Identity());
  if (sample_.dimension == 1) {
    F = Mat3::Identity();
    F(0, 0) = 1.2;
  }
  const double trace = (0.5 * (F.transpose() * F - Mat3::Identity())).trace();
  const double across = sample_.dimension == 2 ? kPoisson / (1.0 - kPoisson) : kPoisson;
  Mat3 whole = F;
  for (int k = sample_.dimension; k < 3 && plane() != Plane::strain; ++k)
    whole.col(k) *= std::sqrt(1.0 - 2.0 * across * trace);
  const PointFields found = points(sample_.moved(Q * F * Q.transpose()));
  for (std::size_t i = 0; i < found.volumes.size(); ++i) {
    EXPECT_LT((found.gradient_at(i) - Q * whole * Q.transpose()).norm(), 1e-12);
    EXPECT_LT((found.stress_at(i) - Q * stvk_stress(whole) * Q.transpose()).norm(), 1e-9);
  }
  const Elastic elastic(sample_.block, sample_.X, choose_isa(), Threads(1));
  const CellFields fields = elastic.fields(sample_.moved(Q * F * Q.transpose()));
  EXPECT_NEAR(fields.volume_ratio[0], whole.determinant(), 1e-12);
  EXPECT_NEAR(fields.von_mises[0], von_mises(cauchy_stress(whole, stvk_stress(whole))), 1e-8);
}

std::string name_of(const testing::TestParamInfo<Case>& info) {
  constexpr std::array kNames = {"free", "stress", "strain"};
  return info.param.element + "_" + kNames[static_cast<std::size_t>(info.param.plane)];
}

INSTANTIATE_TEST_SUITE_P(All, PointFieldsTest, testing::ValuesIn(cases()), name_of);

}  // namespace
}  // namespace tissu
