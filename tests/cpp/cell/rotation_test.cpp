// The rotation of a deformation gradient, for every instruction set of this machine, against Eigen's singular
// values with the sign put right.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "../base/random.h"
#include "../base/singular_values.h"
#include "base/kernel_choice.h"
#include "rotation_lanes.h"
#include "tissu/base/isa.h"

namespace tissu {
namespace {

using test::Random;
using test::Rotations;

/// U V^T with the last column of U turned when that is a reflection.
struct Reference {
  explicit Reference(const Mat3& F) {
    const auto [U, s, V] = test::singular_values(F);
    const Mat3 UV = U * V.transpose();
    sign = UV.determinant() < 0.0 ? -1.0 : 1.0;
    R = U * Vec3(1, 1, sign).asDiagonal() * V.transpose();
    best = s[0] + s[1] + sign * s[2];
    gap = s[1] + sign * s[2];
  }
  double sign;
  Mat3 R;
  double best;  ///< tr(R^T F)
  double gap;   ///< how far R is from jumping
};

/// Round-off, over the least z / |F|^3 that rotation.h takes without an eigenvector, 1e-2.
constexpr double kProper = 1e-13;

class RotationTest : public testing::TestWithParam<Isa> {
 protected:
  static Rotations rotations() { return TISSU_KERNELS_OF(GetParam(), rotations()); }
  static std::vector<Mat3> of(Rotations::Function f, const std::vector<Mat3>& F) {
    const std::size_t count = (F.size() + 7) / 8 * 8;
    std::vector<double> in(9 * count, 0.5);
    std::vector<double> out(9 * count);
    for (std::size_t i = 0; i < F.size(); ++i) {
      for (int k = 0; k < 9; ++k) in[static_cast<std::size_t>(k) * count + i] = F[i](k / 3, k % 3);
    }
    f(in.data(), out.data(), count);
    std::vector<Mat3> R(F.size());
    for (std::size_t i = 0; i < F.size(); ++i) {
      for (int k = 0; k < 9; ++k) R[i](k / 3, k % 3) = out[static_cast<std::size_t>(k) * count + i];
    }
    return R;
  }
  static void expect_proper(const Mat3& R, const Mat3& F) {
    EXPECT_LT((R.transpose() * R - Mat3::Identity()).cwiseAbs().maxCoeff(), kProper) << F;
    EXPECT_NEAR(R.determinant(), 1.0, kProper) << F;
  }
  /// A proper rotation, none nearer to F, and the reference's own where that is the only one. Rotations that
  /// differ by an angle a give traces that differ by gap a^2: round-off of F moves R by 1e-16 |F| / gap.
  static void expect_polar(Rotations::Function f, const std::vector<Mat3>& F, double round_off = kProper) {
    const std::vector<Mat3> R = of(f, F);
    for (std::size_t i = 0; i < F.size(); ++i) {
      const Reference reference(F[i]);
      const double size = F[i].norm();
      expect_proper(R[i], F[i]);
      EXPECT_GE((R[i].transpose() * F[i]).trace(), reference.best - kProper * size) << F[i];
      if (!(reference.gap > 1e-6 * size)) continue;
      EXPECT_LT((R[i] - reference.R).norm() * reference.gap, round_off * size) << F[i] << "\n\n" << R[i];
    }
  }
  static void expect_polar(const std::vector<Mat3>& F) {
    expect_polar(rotations().polar, F);
    expect_polar(rotations().by_eigenvector, F);
  }
};

Mat3 stretched(Random& random, const Vec3& stretches) {
  return random.rotation().toRotationMatrix() * stretches.asDiagonal() * random.rotation().toRotationMatrix();
}

TEST_P(RotationTest, PolarOfAnyMatrix) {
  Random random(1);
  std::vector<Mat3> F;
  for (int i = 0; i < 20000; ++i) F.push_back(random.matrix());
  expect_polar(F);
}

TEST_P(RotationTest, PolarNearRest) {
  Random random(2);
  std::vector<Mat3> F;
  for (int i = 0; i < 20000; ++i) {
    F.push_back(random.rotation() * (Mat3::Identity() + random.matrix(std::pow(10.0, -(i % 10)))));
  }
  expect_polar(F);
}

/// Half a turn about any axis, where the trace of R is -1 and a quaternion has no scalar part.
TEST_P(RotationTest, PolarNearHalfATurn) {
  Random random(3);
  std::vector<Mat3> F;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 axis = i < 3 ? Vec3(Vec3::Unit(i)) : Vec3(random.vector().normalized());
    const double off = i % 2 == 0 ? 0.0 : random.number(1e-6);
    F.push_back(Eigen::AngleAxisd(std::numbers::pi + off, axis).toRotationMatrix() *
                stretched(random, Vec3(1.2, 1.0, 0.7)) * Mat3::Identity());
    F.push_back(Eigen::AngleAxisd(std::numbers::pi + off, axis).toRotationMatrix());
  }
  expect_polar(F);
}

TEST_P(RotationTest, PolarOfInvertedFlatAndTinyOnes) {
  Random random(4);
  std::vector<Mat3> F;
  for (int i = 0; i < 2000; ++i) {
    F.push_back(stretched(random, Vec3(1.1, 0.9, -0.3)));
    F.push_back(stretched(random, Vec3(1.0, 1.0, -1.0)));         // any axis may be turned: all are as near
    F.push_back(stretched(random, Vec3(1.0, 0.8, -0.8 + 1e-9)));  // about to jump
    F.push_back(stretched(random, Vec3(1.3, 0.4, 0.0)));          // rank 2
    F.push_back(stretched(random, Vec3(1.3, 1e-12, 0.0)));
    F.push_back(stretched(random, Vec3(2.0, 0.0, 0.0)));  // rank 1
    F.push_back(stretched(random, Vec3(2.0, 1.0, -0.5)) * std::pow(10.0, random.number(90.0)));
    F.push_back(stretched(random, Vec3(1e8, 1.0, 1e-8)));
  }
  F.push_back(-Mat3::Identity());
  F.push_back(Vec3(1, 1, -1).asDiagonal());
  F.push_back(Mat3::Ones());
  F.push_back(Vec3(0, 0, 1e-305).asDiagonal());
  expect_polar(F);
}

TEST_P(RotationTest, NothingHasTheRotationOfRest) {
  for (const auto f : {rotations().polar, rotations().by_eigenvector, rotations().frame}) {
    EXPECT_EQ(of(f, {Mat3::Zero()}).front(), Mat3::Identity());
  }
}

/// F of a body that is turned: R is turned, whatever F.
TEST_P(RotationTest, TurnsWithTheBody) {
  Random random(5);
  std::vector<Mat3> F;
  std::vector<Mat3> turned;
  std::vector<Mat3> turn;
  for (int i = 0; i < 1000; ++i) {
    F.push_back(stretched(random, Vec3(1.5, 1.0 + random.number(0.4), i % 2 == 0 ? 0.5 : -0.2)));
    turn.push_back(random.rotation().toRotationMatrix());
    turned.push_back(turn.back() * F.back());
  }
  for (const auto f : {rotations().polar, rotations().frame}) {
    const std::vector<Mat3> R = of(f, F);
    const std::vector<Mat3> after = of(f, turned);
    for (std::size_t i = 0; i < F.size(); ++i) {
      EXPECT_LT((after[i] - turn[i] * R[i]).norm(), 1e-12);  // 1e-16 |F| / gap, and ill-conditioned columns
    }
  }
}

TEST_P(RotationTest, ResultOfALaneDoesNotDependOnItsNeighbours) {
  Random random(6);
  const Mat3 F = stretched(random, Vec3(1.2, 1.0, 0.8));
  const Mat3 flat = stretched(random, Vec3(1.2, 0.0, 0.0));
  const std::vector<Mat3> among_good(8, F);
  std::vector<Mat3> among_flat(8, flat);
  among_flat[3] = F;
  EXPECT_EQ(of(rotations().polar, among_good)[3], of(rotations().polar, among_flat)[3]);
}

TEST_P(RotationTest, NotANumberGivesNoNumberAndComesBack) {
  Mat3 F = Mat3::Identity();
  F(1, 2) = std::numeric_limits<double>::quiet_NaN();
  const Mat3 good = Mat3::Identity();
  EXPECT_EQ(of(rotations().polar, {F, good})[1], good);
}

TEST_P(RotationTest, FrameHasTheFirstTwoColumns) {
  Random random(7);
  std::vector<Mat3> F;
  for (int i = 0; i < 5000; ++i) F.push_back(random.matrix());
  const std::vector<Mat3> R = of(rotations().frame, F);
  for (std::size_t i = 0; i < F.size(); ++i) {
    expect_proper(R[i], F[i]);
    const Mat3 A = R[i].transpose() * F[i];
    EXPECT_NEAR(A(1, 0), 0.0, 1e-15);
    EXPECT_NEAR(A(2, 0), 0.0, 1e-15);
    EXPECT_NEAR(A(2, 1), 0.0, 1e-14);
    EXPECT_GT(A(0, 0), 0.0);
    EXPECT_GT(A(1, 1), 0.0);
  }
}

TEST_P(RotationTest, FrameOfDegenerateOnesIsProper) {
  Random random(8);
  std::vector<Mat3> F;
  for (int i = 0; i < 1000; ++i) {
    F.push_back(stretched(random, Vec3(2.0, 0.0, 0.0)));  // columns along one line
    F.push_back(F.back() + random.matrix(1e-14));
    F.push_back(F.back() * 1e-180);
    Mat3 first_gone = random.matrix();
    first_gone.col(0).setZero();
    F.push_back(first_gone);
    Mat3 second_along = random.matrix();
    second_along.col(1) = -3.0 * second_along.col(0);
    F.push_back(second_along);
    F.push_back(stretched(random, Vec3(1.0, 1.0, -1.0)));
  }
  for (int i = 0; i < 3; ++i) F.emplace_back(Vec3::Unit(i) * Vec3::Ones().transpose());
  const std::vector<Mat3> R = of(rotations().frame, F);
  for (std::size_t i = 0; i < F.size(); ++i) expect_proper(R[i], F[i]);
}

std::vector<Isa> isas_here() {
  std::vector<Isa> found;
  for (const Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512}) {
    if (runs_here(isa)) found.push_back(isa);
  }
  return found;
}

INSTANTIATE_TEST_SUITE_P(Sets, RotationTest, testing::ValuesIn(isas_here()),
                         [](const auto& info) { return std::string(name(info.param)); });

}  // namespace
}  // namespace tissu
