// Singular values and nearest semi-definite matrices in the lanes of every instruction set of this machine,
// against Eigen's.

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "../base/singular_values.h"
#include "../model/projection_sample.h"
#include "base/kernel_choice.h"
#include "projection_lanes.h"

namespace tissu {
namespace {

using test::Random;

constexpr std::size_t kSizes[] = {3, 6, 9, 24};

class Semidefinite : public testing::TestWithParam<Isa> {
 protected:
  static test::Projections projections() { return TISSU_KERNELS_OF(GetParam(), projections()); }
  static std::vector<Mat3> columns(const std::vector<double>& values, std::size_t count) {
    std::vector<Mat3> result(count);
    for (std::size_t i = 0; i < count; ++i) {
      for (int k = 0; k < 9; ++k) result[i](k / 3, k % 3) = values[static_cast<std::size_t>(k) * count + i];
    }
    return result;
  }
  /// F = U diag(s) V^T, U and V rotations, s in order, and as Eigen has them: all to round-off of |F|.
  static void expect_singular_values(std::vector<Mat3> F) {
    while (F.size() % 8 != 0) F.push_back(Mat3::Identity());
    const std::size_t count = F.size();
    std::vector<double> in(9 * count);
    std::vector<double> U(9 * count);
    std::vector<double> V(9 * count);
    std::vector<double> s(3 * count);
    for (std::size_t i = 0; i < count; ++i) {
      for (int k = 0; k < 9; ++k) in[static_cast<std::size_t>(k) * count + i] = F[i](k / 3, k % 3);
    }
    projections().singular_values(in.data(), U.data(), s.data(), V.data(), count);
    const std::vector<Mat3> left = columns(U, count);
    const std::vector<Mat3> right = columns(V, count);
    for (std::size_t i = 0; i < count; ++i) {
      SCOPED_TRACE(testing::Message() << F[i]);
      const Vec3 values(s[i], s[count + i], s[2 * count + i]);
      const double size = F[i].cwiseAbs().maxCoeff();
      for (const Mat3& R : {left[i], right[i]}) {
        EXPECT_LT((R.transpose() * R - Mat3::Identity()).cwiseAbs().maxCoeff(), 1e-14);
        EXPECT_NEAR(R.determinant(), 1.0, 1e-14);
      }
      const Mat3 back = left[i] * values.asDiagonal() * right[i].transpose();
      EXPECT_LE((back - F[i]).cwiseAbs().maxCoeff(), 1e-14 * size);
      EXPECT_GE(values[0], values[1] * (1.0 - 1e-14));
      EXPECT_GE(values[1], std::abs(values[2]) * (1.0 - 1e-14));
      const Vec3 expected = test::singular_values(F[i] / size).values * size;
      EXPECT_LE((values.cwiseAbs() - expected).cwiseAbs().maxCoeff(), 1e-14 * size);
    }
  }
  static Mat3 stretched(Random& random, const Vec3& stretches) {
    return random.rotation().toRotationMatrix() * stretches.asDiagonal() *
           random.rotation().toRotationMatrix();
  }
  /// Lanes from dense matrices of n rows and back.
  static std::vector<Eigen::MatrixXd> projected(std::size_t which, std::vector<Eigen::MatrixXd> A) {
    const std::size_t n = kSizes[which];
    const std::size_t given = A.size();
    while (A.size() % 8 != 0) A.push_back(A.front());
    std::vector<double> lanes(n * n * A.size());
    const auto at = [&](std::size_t r, std::size_t c, std::size_t i) { return (r * n + c) * A.size() + i; };
    const auto entry = [](Eigen::MatrixXd& M, std::size_t r, std::size_t c) -> double& {
      return M(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c));
    };
    for (std::size_t i = 0; i < A.size(); ++i) {
      for (std::size_t k = 0; k < n * n; ++k) lanes[at(k / n, k % n, i)] = entry(A[i], k / n, k % n);
    }
    projections().semidefinite[which](lanes.data(), A.size());
    for (std::size_t i = 0; i < A.size(); ++i) {
      for (std::size_t k = 0; k < n * n; ++k) entry(A[i], k / n, k % n) = lanes[at(k / n, k % n, i)];
    }
    A.resize(given);
    return A;
  }
  /// Q diag(values) Q^T with Q random.
  static Eigen::MatrixXd with_eigenvalues(Random& random, const Eigen::VectorXd& values) {
    Eigen::MatrixXd M(values.size(), values.size());
    for (Eigen::Index k = 0; k < M.size(); ++k) M(k) = random.number();
    const Eigen::MatrixXd Q = Eigen::HouseholderQR<Eigen::MatrixXd>(M).householderQ();
    const Eigen::MatrixXd A = Q * values.asDiagonal() * Q.transpose();
    return 0.5 * (A + A.transpose());
  }
};

TEST_P(Semidefinite, SingularValuesOfAnyMatrix) {
  Random random(1);
  std::vector<Mat3> F;
  for (int i = 0; i < 4000; ++i) {
    F.push_back(random.matrix());
    F.push_back(random.rotation() * (Mat3::Identity() + random.matrix(std::pow(10.0, -(i % 16)))));
  }
  expect_singular_values(F);
}

TEST_P(Semidefinite, SingularValuesOfInvertedFlatEqualAndTinyOnes) {
  Random random(2);
  std::vector<Mat3> F = {Mat3::Identity(), -Mat3::Identity(),          Mat3::Zero(),
                         Mat3::Ones(),     Vec3(0, 1, 0).asDiagonal(), Vec3(0, 0, -1).asDiagonal()};
  for (int i = 0; i < 500; ++i) {
    for (const Vec3& s : {Vec3(1.1, 0.9, -0.3), Vec3(1, 1, -1), Vec3(1.3, 0.4, 0), Vec3(2, 0, 0),
                          Vec3(1, 1, 0), Vec3(1, 1e-8, 1e-8), Vec3(1, 1e-8, -1e-9), Vec3(1e8, 1, 1e-8),
                          Vec3(1, 1e-15, -1e-15), Vec3(1, 1e-120, 0), Vec3(1, 1 + 1e-15, 1 - 1e-15)}) {
      F.push_back(stretched(random, s));
      F.push_back(stretched(random, s) * std::pow(10.0, random.number(90.0)));
    }
  }
  expect_singular_values(F);
}

// Eigenvalues of both signs, of sizes far apart, equal ones, and none but zero.
TEST_P(Semidefinite, IsTheNearest) {
  Random random(3);
  for (std::size_t which = 0; which < 4; ++which) {
    const auto n = static_cast<Eigen::Index>(kSizes[which]);
    std::vector<Eigen::MatrixXd> A = {Eigen::MatrixXd::Zero(n, n), -Eigen::MatrixXd::Identity(n, n)};
    for (int i = 0; i < 60; ++i) {
      Eigen::VectorXd values(n);
      for (double& v : values) v = random.number();
      if (i % 4 == 1) values = values.array().sign();
      if (i % 4 == 2) {
        for (double& v : values) v = std::copysign(std::pow(10.0, random.number(12.0)), v);
      }
      if (i % 4 == 3) values.head(n / 2).setZero();
      A.push_back(with_eigenvalues(random, values));
    }
    const std::vector<Eigen::MatrixXd> found = projected(which, A);
    for (std::size_t i = 0; i < A.size(); ++i) {
      const double size = A[i].norm();
      EXPECT_LE((found[i] - test::clamped(A[i])).norm(), 1e-13 * size) << n << "\n" << A[i];
      EXPECT_EQ(found[i], found[i].transpose());
    }
  }
}

// A lane keeps its bits where it has no negative eigenvalue, also one of no full rank, and whatever its
// neighbours do.
TEST_P(Semidefinite, LeavesWhatIsDefiniteAndDoesNotMindTheNeighbours) {
  Random random(4);
  for (std::size_t which = 0; which < 4; ++which) {
    const auto n = static_cast<Eigen::Index>(kSizes[which]);
    std::vector<Eigen::MatrixXd> A;
    for (int i = 0; i < 40; ++i) {
      Eigen::VectorXd values(n);
      for (double& v : values) v = std::abs(random.number());
      values.head(n / 3).setZero();
      if (i % 3 == 2) values[n - 1] = -0.5;
      A.push_back(with_eigenvalues(random, values));
    }
    const std::vector<Eigen::MatrixXd> found = projected(which, A);
    for (std::size_t i = 0; i < A.size(); ++i) {
      if (i % 3 != 2) {
        EXPECT_EQ(found[i], A[i]);
      } else {
        EXPECT_GT((found[i] - A[i]).norm(), 0.4);
      }
      EXPECT_EQ(found[i], projected(which, std::vector<Eigen::MatrixXd>(8, A[i])).front());
    }
  }
}

TEST_P(Semidefinite, NotANumberStaysOne) {
  for (std::size_t which = 0; which < 4; ++which) {
    const auto n = static_cast<Eigen::Index>(kSizes[which]);
    const Eigen::MatrixXd A = Eigen::MatrixXd::Constant(n, n, std::numeric_limits<double>::quiet_NaN());
    EXPECT_TRUE(projected(which, {A}).front().array().isNaN().all());
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, Semidefinite, testing::ValuesIn(test::available_isas()),
                         [](const auto& info) { return std::string(name(info.param)); });

}  // namespace
}  // namespace tissu
