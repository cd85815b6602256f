#include "tissu/law/law.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "../base/differences.h"
#include "../base/random.h"
#include "tissu/base/error.h"
#include "tissu/law/generated/hooke.h"
#include "tissu/law/generated/stvk.h"

namespace tissu {
namespace {

static_assert(Law<Hooke>);
static_assert(Law<StVK>);

using Tensor = Tensor2<double>;

constexpr double kYoung = 3.0;

Tensor tensor(const Mat3& m) {
  Tensor t;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) t(i, j) = m(i, j);
  }
  return t;
}

Mat3 matrix(const Tensor& t) {
  Mat3 m;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) m(i, j) = t(i, j);
  }
  return m;
}

Mat3 diagonal(double x, double y, double z) { return Vec3(x, y, z).asDiagonal(); }

template <class L>
class LawTest : public testing::Test {
 protected:
  static L made(double poisson = 0.3) {
    const Lame constants = lame(kYoung, poisson);
    return {constants.lambda, constants.mu};
  }
  double energy(const Mat3& F) const { return law_.energy(tensor(F)); }
  Mat3 stress(const Mat3& F) const { return matrix(law_.stress(tensor(F))); }
  Mat3 stress_change(const Mat3& F, const Mat3& dF) const {
    return matrix(law_.stress_change(tensor(F), tensor(dF)));
  }
  /// A deformation gradient with strains of some tens of percent.
  Mat3 any_F() { return Mat3::Identity() + random_.matrix(0.5); }

  L law_ = made();
  test::Random random_{1};
};

using Laws = testing::Types<Hooke<double>, StVK<double>>;
TYPED_TEST_SUITE(LawTest, Laws);

TYPED_TEST(LawTest, RestIsFree) {
  EXPECT_EQ(this->energy(Mat3::Identity()), 0.0);
  EXPECT_EQ(this->stress(Mat3::Identity()), Mat3::Zero());
}

// The differences are exact but for round-off: 1e-16 W / h with W of 1 and h = 1e-2 leaves 1e-14; two digits
// more.
TYPED_TEST(LawTest, StressIsGradientOfEnergy) {
  for (int state = 0; state < 20; ++state) {
    const Mat3 F = this->any_F();
    const Mat3 P = this->stress(F);
    for (int i = 0; i < 9; ++i) {
      Mat3 dF = Mat3::Zero();
      dF(i) = 1.0;
      EXPECT_NEAR(P(i), test::derivative([&](double t) { return this->energy(F + t * dF); }, 1e-2), 1e-12);
    }
  }
}

TYPED_TEST(LawTest, StressChangeIsDerivativeOfStress) {
  for (int state = 0; state < 20; ++state) {
    const Mat3 F = this->any_F();
    const Mat3 dF = this->random_.matrix();
    const Mat3 difference = test::derivative([&](double t) { return this->stress(F + t * dF); }, 1e-2);
    EXPECT_LT((this->stress_change(F, dF) - difference).cwiseAbs().maxCoeff(), 1e-12);
  }
}

// A sum of nine products of numbers of size 10: 1e-14.
TYPED_TEST(LawTest, TangentContractedIsStressChange) {
  for (int state = 0; state < 20; ++state) {
    const Mat3 F = this->any_F();
    const Mat3 dF = this->random_.matrix();
    const Tangent<double> A = this->law_.tangent(tensor(F));
    Mat3 dP = Mat3::Zero();
    for (int i = 0; i < 3; ++i) {
      for (int J = 0; J < 3; ++J) {
        for (int k = 0; k < 3; ++k) {
          for (int L = 0; L < 3; ++L) dP(i, J) += A(i, J, k, L) * dF(k, L);
        }
      }
    }
    EXPECT_LT((dP - this->stress_change(F, dF)).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TYPED_TEST(LawTest, StressChangeIsSymmetric) {
  for (int state = 0; state < 20; ++state) {
    const Mat3 F = this->any_F();
    const Mat3 a = this->random_.matrix();
    const Mat3 b = this->random_.matrix();
    EXPECT_NEAR(this->stress_change(F, a).cwiseProduct(b).sum(),
                this->stress_change(F, b).cwiseProduct(a).sum(), 1e-13);
  }
}

TYPED_TEST(LawTest, TangentNumbersTheUpperTriangle) {
  EXPECT_EQ(Tangent<double>::index(0, 0), 0);
  EXPECT_EQ(Tangent<double>::index(0, 8), 8);
  EXPECT_EQ(Tangent<double>::index(1, 1), 9);
  EXPECT_EQ(Tangent<double>::index(8, 8), 44);
  EXPECT_EQ(Tangent<double>::index(7, 2), Tangent<double>::index(2, 7));
}

TYPED_TEST(LawTest, SameTangentAtRest) {
  const Mat3 dF = this->random_.matrix();
  const Lame c = lame(kYoung, 0.3);
  const Mat3 expected = c.lambda * dF.trace() * Mat3::Identity() + c.mu * (dF + dF.transpose());
  EXPECT_LT((this->stress_change(Mat3::Identity(), dF) - expected).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(StVKLaw, IsFrameInvariant) {
  test::Random random(2);
  const StVK<double> law{1.7, 0.9};
  for (int state = 0; state < 20; ++state) {
    const Mat3 Q = random.rotation().toRotationMatrix();
    const Mat3 F = Mat3::Identity() + random.matrix(0.5);
    EXPECT_NEAR(law.energy(tensor(Q * F)), law.energy(tensor(F)), 1e-13);
    EXPECT_LT((matrix(law.stress(tensor(Q * F))) - Q * matrix(law.stress(tensor(F)))).cwiseAbs().maxCoeff(),
              1e-13);
  }
}

// A turn by an angle a about z is a strain cos a - 1 along x and y.
TEST(HookeLaw, TakesRotationForStrain) {
  const Hooke<double> law{1.7, 0.9};
  const Mat3 Q = Eigen::AngleAxisd(0.5, Vec3::UnitZ()).toRotationMatrix();
  const double eps = std::cos(0.5) - 1.0;
  EXPECT_NEAR(law.energy(tensor(Q)), 0.5 * 1.7 * 4.0 * eps * eps + 0.9 * 2.0 * eps * eps, 1e-15);
  EXPECT_NEAR(law.stress(tensor(Q))(2, 2), 1.7 * 2.0 * eps, 1e-15);
  EXPECT_GT(law.energy(tensor(Q)), 0.01);
}

// The stresses differ in the second order of the strain: halving it divides the difference by four, to the
// third order, 1e-3 of it.
TEST(StVKLaw, IsHookeAtSmallStrain) {
  test::Random random(3);
  const Hooke<double> hooke{1.7, 0.9};
  const StVK<double> stvk{1.7, 0.9};
  const Mat3 G = random.matrix();
  const auto difference = [&](double s) {
    const Tensor F = tensor(Mat3::Identity() + s * G);
    return (matrix(stvk.stress(F)) - matrix(hooke.stress(F))).norm();
  };
  EXPECT_LT(difference(1e-4), 1e-6);
  EXPECT_NEAR(difference(1e-3) / difference(5e-4), 4.0, 1e-2);
}

// nu = 0: P = E/2 F (F^2 - 1)
TEST(StVKLaw, UniaxialClosedForm) {
  const Lame constants = lame(kYoung, 0.0);
  const StVK<double> law{constants.lambda, constants.mu};
  for (const double F : {0.3, 0.57735, 0.8, 1.0, 1.2, 2.0}) {
    const Mat3 P = matrix(law.stress(tensor(diagonal(F, 1.0, 1.0))));
    const Mat3 expected = diagonal(kYoung / 2.0 * F * (F * F - 1.0), 0.0, 0.0);
    EXPECT_LT((P - expected).cwiseAbs().maxCoeff(), 1e-14) << "F = " << F;
  }
}

TEST(StVKLaw, CompressionIsStrongestAtOneOverRootThree) {
  const Lame constants = lame(kYoung, 0.0);
  const StVK<double> law{constants.lambda, constants.mu};
  const double F = 1.0 / std::sqrt(3.0);
  const Tensor along = tensor(diagonal(1.0, 0.0, 0.0));
  const auto slope = [&](double f) { return law.stress_change(tensor(diagonal(f, 1.0, 1.0)), along)(0, 0); };
  EXPECT_NEAR(slope(F), 0.0, 1e-15);
  EXPECT_LT(slope(F - 0.01), 0.0);
  EXPECT_GT(slope(F + 0.01), 0.0);
  EXPECT_NEAR(law.stress(tensor(diagonal(F, 1.0, 1.0)))(0, 0), -kYoung / (3.0 * std::sqrt(3.0)), 1e-15);
}

// F = I + g e1 (x) e2: E_12 = g/2, E_22 = g^2/2; Hooke sees eps_12 = g/2 only.
TEST(StVKLaw, SimpleShearClosedForm) {
  const double g = 0.4;
  Mat3 F = Mat3::Identity();
  F(0, 1) = g;
  const double E22 = 0.5 * g * g;
  EXPECT_NEAR((StVK<double>{1.7, 0.9}.energy(tensor(F))),
              0.5 * 1.7 * E22 * E22 + 0.9 * (E22 * E22 + 2.0 * 0.25 * g * g), 1e-15);
  EXPECT_NEAR((Hooke<double>{1.7, 0.9}.energy(tensor(F))), 0.9 * 2.0 * 0.25 * g * g, 1e-15);
}

TEST(Lame, ClosedForm) {
  const Lame c = lame(1.0, 0.25);
  EXPECT_NEAR(c.lambda, 0.4, 1e-15);
  EXPECT_NEAR(c.mu, 0.4, 1e-15);
  EXPECT_EQ(lame(2.0, 0.0).lambda, 0.0);
  EXPECT_LT(lame(1.0, -0.3).lambda, 0.0);
}

TEST(Lame, RefusesWhatNoBodyHas) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double young : {0.0, -1.0, nan, infinity})
    EXPECT_THROW(lame(young, 0.3), ParameterError) << young;
  for (const double poisson : {-1.0, -1.5, 0.5, 0.6, nan})
    EXPECT_THROW(lame(1.0, poisson), ParameterError) << poisson;
  EXPECT_NO_THROW(lame(1.0, 0.4999));
  EXPECT_NO_THROW(lame(1.0, -0.999));
}

}  // namespace
}  // namespace tissu
