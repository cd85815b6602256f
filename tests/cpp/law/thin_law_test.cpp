// The laws of sheets and lines: functions of F (3 x M) in the axes of the piece.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <string>

#include "../base/differences.h"
#include "../base/random.h"
#include "tissu/law/generated/all.h"
#include "tissu/law/tensor.h"

namespace tissu {
namespace {

constexpr double kLambda = 1.7;
constexpr double kMu = 0.9;

template <class Made, int Dimension>
struct Thin {
  using Law = Made;
  static constexpr int M = Dimension;
};

template <class Case>
class ThinLaw : public testing::Test {
 protected:
  static constexpr int M = Case::M;
  using Matrix = Eigen::Matrix<double, 3, M>;
  using Tensor = Columns<double, M>;

  static Tensor tensor(const Matrix& m) {
    Tensor t;
    for (int k = 0; k < 3 * M; ++k) t(k / M, k % M) = m(k / M, k % M);
    return t;
  }
  static Matrix matrix(const Tensor& t) {
    Matrix m;
    for (int k = 0; k < 3 * M; ++k) m(k / M, k % M) = t(k / M, k % M);
    return m;
  }
  double energy(const Matrix& F) const { return law_.energy(tensor(F)); }
  Matrix stress(const Matrix& F) const { return matrix(law_.stress(tensor(F))); }
  Matrix stress_change(const Matrix& F, const Matrix& dF) const {
    return matrix(law_.stress_change(tensor(F), tensor(dF)));
  }
  Matrix any(double amount) { return random_.matrix(amount).template leftCols<M>(); }
  /// Strains of some tens of percent, out of the plane too.
  Matrix any_F() { return Matrix(Mat3::Identity().leftCols<M>()) + any(0.5); }

  typename Case::Law law_{kLambda, kMu};
  test::Random random_{4};
};

using Cases = testing::Types<Thin<Hooke<double>, 1>, Thin<Hooke<double>, 2>, Thin<StVK<double>, 1>,
                             Thin<StVK<double>, 2>>;
TYPED_TEST_SUITE(ThinLaw, Cases);

static_assert(ThinLaws::kSize == 2, "a new law of sheets and lines belongs in the cases above");

TYPED_TEST(ThinLaw, RestIsFree) {
  const typename TestFixture::Matrix I = Mat3::Identity().leftCols<TypeParam::M>();
  EXPECT_EQ(this->energy(I), 0.0);
  EXPECT_EQ(this->stress(I).norm(), 0.0);
}

// The differences are exact but for round-off: 1e-16 W / h with W of 1 and h = 1e-2 leaves 1e-14; two digits
// more.
TYPED_TEST(ThinLaw, StressIsGradientOfEnergy) {
  using Matrix = typename TestFixture::Matrix;
  for (int state = 0; state < 20; ++state) {
    const Matrix F = this->any_F();
    const Matrix P = this->stress(F);
    for (int i = 0; i < 3 * TypeParam::M; ++i) {
      Matrix dF = Matrix::Zero();
      dF(i) = 1.0;
      EXPECT_NEAR(P(i), test::derivative([&](double t) { return this->energy(Matrix(F + t * dF)); }, 1e-2),
                  1e-12);
    }
  }
}

TYPED_TEST(ThinLaw, StressChangeIsDerivativeOfStress) {
  using Matrix = typename TestFixture::Matrix;
  for (int state = 0; state < 20; ++state) {
    const Matrix F = this->any_F();
    const Matrix dF = this->any(1.0);
    const Matrix difference =
        test::derivative([&](double t) { return this->stress(Matrix(F + t * dF)); }, 1e-2);
    EXPECT_LT((this->stress_change(F, dF) - difference).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TYPED_TEST(ThinLaw, TangentContractedIsStressChange) {
  constexpr int M = TypeParam::M;
  for (int state = 0; state < 20; ++state) {
    const auto F = this->any_F();
    const auto dF = this->any(1.0);
    const auto A = this->law_.tangent(this->tensor(F));
    typename TestFixture::Matrix dP = TestFixture::Matrix::Zero();
    for (int r = 0; r < 3 * M; ++r) {
      for (int c = 0; c < 3 * M; ++c) dP(r / M, r % M) += A(r / M, r % M, c / M, c % M) * dF(c / M, c % M);
    }
    EXPECT_LT((dP - this->stress_change(F, dF)).cwiseAbs().maxCoeff(), 1e-13);
  }
}

/// F of a volume whose other directions stay as long as they are and square to the piece: no strain across.
/// Hooke's law sees the piece in its own axes only.
template <int M>
Mat3 unstrained_across(const Eigen::Matrix<double, 3, M>& F, bool in_axes) {
  Mat3 whole = Mat3::Identity();
  if (in_axes) {
    whole.topLeftCorner<M, M>() = F.template topRows<M>();
    return whole;
  }
  whole.leftCols<M>() = F;
  if constexpr (M == 1) {
    whole.col(1) = F.col(0).unitOrthogonal();
    whole.col(2) = F.col(0).normalized().cross(whole.col(1));
  } else {
    whole.col(2) = F.col(0).cross(F.col(1)).normalized();
  }
  return whole;
}

TYPED_TEST(ThinLaw, IsTheLawOfVolumesWithoutStrainAcross) {
  constexpr int M = TypeParam::M;
  constexpr bool in_axes = !TypeParam::Law::kFrameInvariant;
  for (int state = 0; state < 20; ++state) {
    const auto F = this->any_F();
    const Mat3 whole = unstrained_across<M>(F, in_axes);
    Tensor2<double> of_volume;
    for (int k = 0; k < 9; ++k) of_volume(k / 3, k % 3) = whole(k / 3, k % 3);
    EXPECT_NEAR(this->energy(F), this->law_.energy(of_volume), 1e-13);
    const Tensor2<double> P = this->law_.stress(of_volume);
    for (int k = 0; k < 3 * M; ++k) {
      EXPECT_NEAR(this->stress(F)(k / M, k % M), P(k / M, k % M), 1e-13) << k;
    }
  }
}

TYPED_TEST(ThinLaw, TurnsWithThePieceWhereTheLawDoes) {
  for (int state = 0; state < 20; ++state) {
    const auto F = this->any_F();
    const Mat3 Q = this->random_.rotation().toRotationMatrix();
    const double change = std::abs(this->energy(Q * F) - this->energy(F));
    if (TypeParam::Law::kFrameInvariant) {
      EXPECT_LT(change, 1e-13);
      EXPECT_LT((this->stress(Q * F) - Q * this->stress(F)).norm(), 1e-12);
    } else {
      EXPECT_GT(change, 1e-6);
    }
  }
}

}  // namespace
}  // namespace tissu
