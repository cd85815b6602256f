#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numeric>

#include "../../base/random.h"
#include "../../force/room.h"
#include "../../force/verbs.h"
#include "tissu/base/error.h"
#include "tissu/element/generated/all.h"
#include "tissu/model/fem/elastic.h"

/// Sheets and lines against closed forms, and what they refuse.
namespace tissu {
namespace {

constexpr double kYoung = 3.0;
constexpr double kPoisson = 0.3;
constexpr double kThickness = 0.2;
constexpr double kRoundOff = 1e-13;  // stresses and areas of size 1, some hundred products

const Mat3 kTilt = Eigen::AngleAxisd(1.1, Vec3(0.36, 0.48, -0.8)).toRotationMatrix();

ElasticBlock thin_block(const std::string& element, std::vector<std::int32_t> cells, std::string law) {
  ElasticBlock block;
  block.body = "body";
  block.element = element;
  block.law = std::move(law);
  block.cells = std::move(cells);
  block.parameters = {{"young", {kYoung}}, {"poisson", {kPoisson}}};
  block.density = {2.0};
  block.cross_section = {kThickness};
  return block;
}

std::vector<double> flattened(const std::vector<Vec3>& points, const Mat3& F) {
  std::vector<double> values;
  for (const Vec3& X : points) {
    const Vec3 x = F * X;
    values.insert(values.end(), x.data(), x.data() + 3);
  }
  return values;
}

State state_of(const std::vector<Vec3>& points, const Mat3& F) {
  State state;
  state.positions = flattened(points, F);
  state.velocities.assign(state.positions.size(), 0.0);
  return state;
}

Elastic made(const ElasticBlock& block, const std::vector<Vec3>& points, const Mat3& placed) {
  return {block, flattened(points, placed), choose_isa(), Threads(1)};
}

/// Four cells around one inner node at number 4, distorted, in the plane z = 0.
struct Patch {
  std::vector<Vec3> points;
  ElasticBlock block;
};

Patch patch(const std::string& element, const std::string& law) {
  Patch p;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) p.points.emplace_back(i, j, 0.0);
  }
  test::Random random(3);
  for (Vec3& x : p.points) x += Vec3(random.number(0.15), random.number(0.15), 0.0);
  std::vector<std::int32_t> cells;
  for (const std::int32_t a : {0, 1, 3, 4}) {
    const std::int32_t b = a + 1;
    const std::int32_t c = a + 4;
    const std::int32_t d = a + 3;
    const std::vector<std::int32_t> nodes =
        element == "quad" ? std::vector{a, b, c, d} : std::vector{a, b, c, a, c, d};
    cells.insert(cells.end(), nodes.begin(), nodes.end());
  }
  p.block = thin_block(element, cells, law);
  return p;
}

/// Lamé's lambda as it acts in a plane: without stress across, E nu / (1 - nu^2).
double lambda_of(Plane plane) {
  return plane == Plane::stress ? kYoung * kPoisson / (1.0 - kPoisson * kPoisson)
                                : kYoung * kPoisson / ((1.0 + kPoisson) * (1.0 - 2.0 * kPoisson));
}
constexpr double kMu = kYoung / (2.0 * (1.0 + kPoisson));

/// F of a plane piece: any in the plane, nothing else.
Mat3 any_plane_F(test::Random& random) {
  Mat3 F = Mat3::Identity();
  F.topLeftCorner<2, 2>() += random.matrix(0.25).topLeftCorner<2, 2>();
  return F;
}

class ThinPatch : public testing::TestWithParam<std::tuple<const char*, const char*, Plane>> {
 protected:
  ThinPatch() : patch_(patch(std::get<0>(GetParam()), std::get<1>(GetParam()))) {
    patch_.block.plane = std::get<2>(GetParam());
  }
  [[nodiscard]] bool hooke() const { return patch_.block.law == "hooke"; }
  /// Strain that the law sees, and the stress P of it in the plane.
  [[nodiscard]] Mat3 strain(const Mat3& F) const {
    return hooke() ? Mat3(0.5 * (F + F.transpose()) - Mat3::Identity())
                   : Mat3(0.5 * (F.transpose() * F - Mat3::Identity()));
  }
  [[nodiscard]] Mat3 stress(const Mat3& F) const {
    const Mat3 E = strain(F);
    Mat3 S = 2.0 * kMu * E;
    S(0, 0) += lambda_of(patch_.block.plane) * E.trace();
    S(1, 1) += lambda_of(patch_.block.plane) * E.trace();
    return hooke() ? S : Mat3(F * S);
  }
  Patch patch_;
  test::Random random_{9};
};

/// Energy and virtual work f . (G X) = -P : G V of constant strain, in the plane of x and y and tilted.
TEST_P(ThinPatch, ConstantStrain) {
  const Mat3 F = any_plane_F(random_);
  const Mat3 E = strain(F);
  const double W = 0.5 * lambda_of(patch_.block.plane) * E.trace() * E.trace() + kMu * (E * E).trace();
  const Mat3 G = random_.matrix();
  for (const Mat3& Q : {Mat3(Mat3::Identity()), kTilt}) {
    const Elastic elastic = made(patch_.block, patch_.points, Q);
    const std::vector<double>& v = elastic.volumes();
    const double volume = std::accumulate(v.begin(), v.end(), 0.0);
    const State state = state_of(patch_.points, Q * F);
    EXPECT_NEAR(elastic.energy(state, test::scratch()), W * volume, kRoundOff);
    const State motion = state_of(patch_.points, Q * G);
    EXPECT_NEAR(test::force_of(elastic, state).dot(test::view(motion.positions)),
                -stress(F).cwiseProduct(G).sum() * volume, 10 * kRoundOff);
  }
}

TEST_P(ThinPatch, InnerNodeIsInBalance) {
  const Mat3 F = any_plane_F(random_);
  for (const Mat3& Q : {Mat3(Mat3::Identity()), kTilt}) {
    const Eigen::VectorXd f =
        test::force_of(made(patch_.block, patch_.points, Q), state_of(patch_.points, Q * F));
    EXPECT_LT(f.segment<3>(12).norm(), kRoundOff);
    EXPECT_GT(f.cwiseAbs().maxCoeff(), 0.01);
  }
}

/// A tilted sheet, bent out of its plane, has the force of the flat one turned: Hooke's law too, whose axes
/// are those of space for the flat one and the cell's own for the other.
TEST_P(ThinPatch, TiltedIsTheFlatOneTurned) {
  std::vector<Vec3> now = patch_.points;
  for (Vec3& x : now) x += Vec3(random_.number(0.1), random_.number(0.1), random_.number(0.1));
  const Eigen::VectorXd flat =
      test::force_of(made(patch_.block, patch_.points, Mat3::Identity()), state_of(now, Mat3::Identity()));
  const Eigen::VectorXd tilted =
      test::force_of(made(patch_.block, patch_.points, kTilt), state_of(now, kTilt));
  for (Eigen::Index i = 0; i < flat.size(); i += 3) {
    EXPECT_LT((kTilt * flat.segment<3>(i) - tilted.segment<3>(i)).norm(), kRoundOff);
  }
}

TEST_P(ThinPatch, VolumeIsAreaTimesThickness) {
  double area = 0.0;  // of the outline, by the shoelace formula
  const int outline[] = {0, 1, 2, 5, 8, 7, 6, 3};
  for (int i = 0; i < 8; ++i) {
    const Vec3& a = patch_.points[static_cast<std::size_t>(outline[i])];
    const Vec3& b = patch_.points[static_cast<std::size_t>(outline[(i + 1) % 8])];
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  const Elastic elastic = made(patch_.block, patch_.points, kTilt);
  const std::vector<double>& v = elastic.volumes();
  EXPECT_NEAR(std::accumulate(v.begin(), v.end(), 0.0), area * kThickness, 1e-14);
  ElasticBlock varied = patch_.block;
  varied.cross_section.clear();
  for (std::size_t e = 0; e < v.size(); ++e) varied.cross_section.push_back(0.1 * (1.0 + double(e)));
  const Elastic other = made(varied, patch_.points, kTilt);
  for (std::size_t e = 0; e < v.size(); ++e) {
    EXPECT_NEAR(other.volumes()[e], v[e] / kThickness * varied.cross_section[e], 1e-14);
  }
}

INSTANTIATE_TEST_SUITE_P(Sheets, ThinPatch,
                         testing::Combine(testing::Values("triangle", "quad"),
                                          testing::Values("hooke", "stvk"),
                                          testing::Values(Plane::stress, Plane::strain)),
                         [](const auto& info) {
                           return std::string(std::get<0>(info.param)) + "_" + std::get<1>(info.param) +
                                  (std::get<2>(info.param) == Plane::stress ? "_stress" : "_strain");
                         });

/// A square pulled along x to the stretch s, free along y: E_y = -nu E_x and P_x = E/2 (s^2 - 1) s without
/// stress across; without strain across E -> E / (1 - nu^2) and nu -> nu / (1 - nu).
TEST(ThinSheet, UniaxialStress) {
  const std::vector<Vec3> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (const Plane plane : {Plane::stress, Plane::strain}) {
    const bool stress = plane == Plane::stress;
    const double E = stress ? kYoung : kYoung / (1.0 - kPoisson * kPoisson);
    const double nu = stress ? kPoisson : kPoisson / (1.0 - kPoisson);
    ElasticBlock block = thin_block("quad", {0, 1, 2, 3}, "stvk");
    block.plane = plane;
    for (const double s : {0.8, 1.1, 1.5}) {
      Mat3 F = Mat3::Identity();
      F(0, 0) = s;
      F(1, 1) = std::sqrt(1.0 - nu * (s * s - 1.0));
      const Eigen::VectorXd f = test::force_of(made(block, square, kTilt), state_of(square, Mat3(kTilt * F)));
      const Vec3 right = kTilt.transpose() * Vec3(f.segment<3>(3) + f.segment<3>(6));
      EXPECT_LT((right - Vec3(-kThickness * E / 2.0 * (s * s - 1.0) * s, 0.0, 0.0)).norm(), kRoundOff) << s;
    }
  }
}

/// N = A E/2 (s^2 - 1) s: the quadratic spring; E -> lambda + 2 mu where it cannot thin.
TEST(ThinLine, IsTheQuadraticSpring) {
  const std::vector<Vec3> ends = {{0, 0, 0}, {2, 0, 0}};
  const std::vector<Vec3> three = {{0, 0, 0}, {2, 0, 0}, {1, 0, 0}};
  for (const Plane plane : {Plane::stress, Plane::strain}) {
    const double E = plane == Plane::stress ? kYoung : lambda_of(Plane::strain) + 2.0 * kMu;
    for (const double s : {0.3, 0.9, 1.0, 1.4}) {
      const double N = kThickness * E / 2.0 * (s * s - 1.0) * s;
      for (const auto* points : {&ends, &three}) {
        std::vector<std::int32_t> nodes(points->size());
        std::iota(nodes.begin(), nodes.end(), 0);
        ElasticBlock block = thin_block(points == &ends ? "line" : "line3", nodes, "stvk");
        block.plane = plane;
        const Elastic line = made(block, *points, kTilt);
        EXPECT_NEAR(line.volumes()[0], 2.0 * kThickness, 1e-15);
        const State state = state_of(*points, s * kTilt);
        const Eigen::VectorXd f = test::force_of(line, state);
        EXPECT_LT((f.segment<3>(3) + N * kTilt.col(0)).norm(), kRoundOff);
        EXPECT_LT((f.segment<3>(0) - N * kTilt.col(0)).norm(), kRoundOff);
        // Free all around its section goes with 1 - nu (s^2 - 1); else lambda E pushes at its sides.
        const double strain = (s * s - 1.0) / 2.0;
        const double side = plane == Plane::stress ? 0.0 : lambda_of(Plane::strain) * strain / s;
        const double section = plane == Plane::stress ? 1.0 - 2.0 * kPoisson * strain : 1.0;
        EXPECT_NEAR(line.fields(state).von_mises[0], std::abs(N / kThickness / section - side), kRoundOff);
      }
    }
  }
}

/// Along its own axis a small stretch of a Hooke line costs A E eps, whichever way it lies.
TEST(ThinLine, HookeAlongItsAxis) {
  const std::vector<Vec3> ends = {{0, 0, 0}, {2, 0, 0}};
  for (const Mat3& Q : {Mat3(Mat3::Identity()), kTilt}) {
    const Elastic line = made(thin_block("line", {0, 1}, "hooke"), ends, Q);
    const Eigen::VectorXd f = test::force_of(line, state_of(ends, Mat3(1.25 * Q)));
    EXPECT_LT((f.segment<3>(3) + kThickness * kYoung * 0.25 * Q.col(0)).norm(), kRoundOff);
  }
}

std::string refusal(const ElasticBlock& block, const std::vector<Vec3>& points) {
  try {
    (void)made(block, points, kTilt);
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was refused";
}

TEST(ThinRefusal, CellsWithoutAreaOrLength) {
  const std::vector<Vec3> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}};
  EXPECT_EQ(refusal(thin_block("quad", {0, 1, 2, 3}, "stvk"), square), "nothing was refused");
  EXPECT_EQ(refusal(thin_block("quad", {3, 2, 1, 0}, "stvk"), square), "nothing was refused");  // no inside
  for (const auto& [element, cells] : {std::pair<std::string, std::vector<std::int32_t>>{
                                           "quad", {0, 1, 2, 3, 0, 2, 1, 3}},  // the second one is folded
                                       {"triangle", {0, 1, 2, 0, 1, 4}},
                                       {"line", {0, 1, 1, 1}}}) {
    const std::string text = refusal(thin_block(element, cells, "stvk"), square);
    EXPECT_NE(text.find("1 of 2 cells of type " + element), std::string::npos) << text;
    EXPECT_NE(text.find("(1)"), std::string::npos) << text;
  }
}

TEST(ThinRefusal, LawsOfVolumes) {
  const std::vector<Vec3> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (const char* law : {"neo_hooke", "yeoh"}) {
    EXPECT_EQ(refusal(thin_block("triangle", {0, 1, 2}, law), square),
              "body \"body\": the law \"" + std::string(law) +
                  "\" needs cells with a volume, and triangle has none.");
  }
}

TEST(ThinRefusal, Thicknesses) {
  const std::vector<Vec3> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  ElasticBlock block = thin_block("quad", {0, 1, 2, 3}, "stvk");
  for (const double size : {0.0, -1.0, std::nan("")}) {
    block.cross_section = {size};
    EXPECT_NE(refusal(block, square).find("must be positive"), std::string::npos);
  }
  block.cross_section = {0.1, 0.2};
  EXPECT_NE(refusal(block, square).find("2 values of thickness"), std::string::npos);
}

}  // namespace
}  // namespace tissu
