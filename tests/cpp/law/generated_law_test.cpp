// Every law of the library, as it is made from its energy: a law that is added is tested here by itself.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "../base/differences.h"
#include "../base/random.h"
#include "tissu/base/batch.h"
#include "tissu/base/error.h"
#include "tissu/law/generated/all.h"
#include "tissu/law/law.h"
#include "tissu/law/law_info.h"
#include "tissu/law/law_sum.h"

namespace tissu {
namespace {

using Tensor = Tensor2<double>;

Tensor tensor(const Mat3& m) {
  Tensor t;
  for (int i = 0; i < 9; ++i) t(i / 3, i % 3) = m(i / 3, i % 3);
  return t;
}

Mat3 matrix(const Tensor& t) {
  Mat3 m;
  for (int i = 0; i < 9; ++i) m(i / 3, i % 3) = t(i / 3, i % 3);
  return m;
}

Mat3 contracted(const Tangent<double>& A, const Mat3& dF) {
  Mat3 dP = Mat3::Zero();
  for (int row = 0; row < 9; ++row) {
    for (int column = 0; column < 9; ++column) {
      dP(row / 3, row % 3) += A(row / 3, row % 3, column / 3, column % 3) * dF(column / 3, column % 3);
    }
  }
  return dP;
}

double largest(const Tangent<double>& A) {
  double value = 0.0;
  for (const double a : A.a) value = std::max(value, std::abs(a));
  return value;
}

std::vector<double> typical(const LawInfo& info) {
  std::vector<double> values;
  for (const LawParameter& p : info.parameters) values.push_back(p.typical);
  return values;
}

/// A law with the typical parameters of its table.
template <class L>
L made() {
  const LawInfo& info = *find_law(L::kName);
  static_assert(sizeof(L) % sizeof(double) == 0);
  std::array<double, sizeof(L) / sizeof(double)> constants{};
  law_constants(info, typical(info), constants);
  L law;
  std::memcpy(&law, constants.data(), sizeof(L));
  return law;
}

const Vec3 kDirection(0.6, -0.48, 0.64);  // the typical one of the fibre

/// 20 states, near rest and far from it (stretches from 0.6 to 1.8 along any axes), away from the stretch at
/// which a fibre goes slack, where tangents may jump.
std::vector<Mat3> states() {
  test::Random random(3);
  std::vector<Mat3> made;
  while (made.size() < 20) {
    const bool near = made.size() % 2 == 0;
    const Vec3 stretch = Vec3::Constant(1.2) + random.vector(0.6);
    const Mat3 far = random.rotation().toRotationMatrix() * Mat3(stretch.asDiagonal()) *
                     random.rotation().toRotationMatrix();
    const Mat3 F = near ? Mat3(Mat3::Identity() + random.matrix(0.05)) : far;
    const double fibre = (F * kDirection).squaredNorm() * std::pow(F.determinant(), -2.0 / 3.0);
    if (std::abs(fibre - 1.0) > 0.01) made.push_back(F);
  }
  return made;
}

template <class L>
class GeneratedLaw : public testing::Test {
 protected:
  [[nodiscard]] double energy(const Mat3& F) const { return law_.energy(tensor(F)); }
  [[nodiscard]] Mat3 stress(const Mat3& F) const { return matrix(law_.stress(tensor(F))); }
  [[nodiscard]] Mat3 stress_change(const Mat3& F, const Mat3& dF) const {
    return matrix(law_.stress_change(tensor(F), tensor(dF)));
  }
  /// The stiffness at a state, with the stiffness beside rest below it: what errors are measured in.
  [[nodiscard]] double scale(const Mat3& F) const {
    const Mat3 stretched = Mat3::Identity() + 0.1 * kDirection * kDirection.transpose();
    return std::max(largest(law_.tangent(tensor(F))), largest(law_.tangent(tensor(stretched))));
  }
  L law_ = made<L>();
};

using Laws = AllLaws::As<testing::Types, double>;
TYPED_TEST_SUITE(GeneratedLaw, Laws);

TYPED_TEST(GeneratedLaw, RestIsFree) {
  const double scale = this->scale(Mat3::Identity());
  EXPECT_NEAR(this->energy(Mat3::Identity()), 0.0, 1e-14 * scale);
  EXPECT_LT(this->stress(Mat3::Identity()).cwiseAbs().maxCoeff(), 1e-14 * scale);
}

// Differences of fourth order with h = 1e-3: h^4 = 1e-12 times the fifth derivative, some thousands of the
// second for the series and the exponential; round-off 1e-16 / h.
TYPED_TEST(GeneratedLaw, StressIsGradientOfEnergy) {
  for (const Mat3& F : states()) {
    const Mat3 P = this->stress(F);
    for (int i = 0; i < 9; ++i) {
      Mat3 dF = Mat3::Zero();
      dF(i) = 1.0;
      const double slope = test::derivative([&](double t) { return this->energy(F + t * dF); }, 1e-3);
      EXPECT_NEAR(P(i), slope, 1e-8 * this->scale(F)) << "F =\n" << F;
    }
  }
}

TYPED_TEST(GeneratedLaw, StressChangeIsDerivativeOfStress) {
  test::Random random(4);
  for (const Mat3& F : states()) {
    const Mat3 dF = random.matrix();
    const Mat3 slope = test::derivative([&](double t) { return this->stress(F + t * dF); }, 1e-3);
    EXPECT_LT((this->stress_change(F, dF) - slope).cwiseAbs().maxCoeff(), 1e-8 * this->scale(F));
  }
}

TYPED_TEST(GeneratedLaw, TangentIsDerivativeOfStress) {
  for (const Mat3& F : states()) {
    const Tangent<double> A = this->law_.tangent(tensor(F));
    for (int c = 0; c < 9; ++c) {
      Mat3 dF = Mat3::Zero();
      dF(c / 3, c % 3) = 1.0;
      const Mat3 slope = test::derivative([&](double t) { return this->stress(F + t * dF); }, 1e-3);
      EXPECT_LT((contracted(A, dF) - slope).cwiseAbs().maxCoeff(), 1e-8 * this->scale(F));
    }
  }
}

// Two ways to the same number; nine products of the size of the stiffness.
TYPED_TEST(GeneratedLaw, TangentContractedIsStressChange) {
  test::Random random(5);
  for (const Mat3& F : states()) {
    const Mat3 dF = random.matrix();
    const Mat3 difference = contracted(this->law_.tangent(tensor(F)), dF) - this->stress_change(F, dF);
    EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-13 * this->scale(F));
  }
}

TYPED_TEST(GeneratedLaw, LimitOfSmallStrainIsHooke) {
  const LawInfo& info = *find_law(TypeParam::kName);
  if (info.addition) {
    EXPECT_EQ(info.small_strain, nullptr);
    return;
  }
  const auto constants = std::bit_cast<std::array<double, sizeof(TypeParam) / sizeof(double)>>(this->law_);
  const Lame c = info.small_strain(constants.data());
  EXPECT_GT(c.mu, 0.0);
  test::Random random(6);
  for (int k = 0; k < 5; ++k) {
    const Mat3 dF = random.matrix();
    const Mat3 expected = c.lambda * dF.trace() * Mat3::Identity() + c.mu * (dF + dF.transpose());
    const Mat3 found = this->stress_change(Mat3::Identity(), dF);
    EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-13 * this->scale(Mat3::Identity()));
  }
}

TYPED_TEST(GeneratedLaw, DoesNotSeeRotations) {
  test::Random random(7);
  double worst = 0.0;
  for (const Mat3& F : states()) {
    const Mat3 Q = random.rotation().toRotationMatrix();
    const double scale = this->scale(F);
    worst = std::max(worst, std::abs(this->energy(Q * F) - this->energy(F)) / scale);
    worst = std::max(worst, (this->stress(Q * F) - Q * this->stress(F)).cwiseAbs().maxCoeff() / scale);
  }
  if (TypeParam::kFrameInvariant) {
    EXPECT_LT(worst, 1e-13);
  } else {
    EXPECT_GT(worst, 1e-3);  // so the flag is not set for nothing
  }
}

// The moment of the stress vanishes: P F^T is symmetric, for every law that does not see rotations.
TYPED_TEST(GeneratedLaw, CauchyStressIsSymmetric) {
  if (!TypeParam::kFrameInvariant) return;
  for (const Mat3& F : states()) {
    const Mat3 tau = this->stress(F) * F.transpose();
    EXPECT_LT((tau - tau.transpose()).cwiseAbs().maxCoeff(), 1e-13 * this->scale(F));
  }
}

TYPED_TEST(GeneratedLaw, MeetsTheTable) {
  const LawInfo* info = find_law(TypeParam::kName);
  ASSERT_NE(info, nullptr);
  EXPECT_EQ(sizeof(TypeParam), info->constants.size() * sizeof(double));
  EXPECT_EQ(TypeParam::kFrameInvariant, info->frame_invariant);
  EXPECT_EQ(TypeParam::kAddition, info->addition);
}

/// Calls a question of a law in batches, each lane at its own state.
template <template <class> class L>
void expect_lanes_equal() {
  namespace kernels = TISSU_KERNELS;
  using Batch = kernels::Batch;
  const L<double> law = made<L<double>>();
  constexpr std::size_t kCount = sizeof(law) / sizeof(double);
  const auto constants = std::bit_cast<std::array<double, kCount>>(law);
  std::array<Batch, kCount> lanes;
  for (std::size_t i = 0; i < kCount; ++i) lanes[i] = Batch(constants[i]);
  L<Batch> batch_law;
  std::memcpy(static_cast<void*>(&batch_law), lanes.data(), sizeof(batch_law));
  const std::vector<Mat3> F = states();
  Tensor2<Batch> F_lanes;
  for (int i = 0; i < 9; ++i) {
    Batch& entry = F_lanes(i / 3, i % 3);
    for (int lane = 0; lane < kernels::kWidth; ++lane) entry.v[lane] = F[lane + 1](i / 3, i % 3);
  }
  const Batch W = batch_law.energy(F_lanes);
  const Tensor2<Batch> P = batch_law.stress(F_lanes);
  const Tangent<Batch> A = batch_law.tangent(F_lanes);
  for (int lane = 0; lane < kernels::kWidth; ++lane) {
    const Tensor one = tensor(F[static_cast<std::size_t>(lane) + 1]);
    const Tangent<double> tangent = law.tangent(one);
    const double tolerance = 1e-13 * largest(tangent) + 1e-9;
    EXPECT_NEAR(W[lane], law.energy(one), tolerance);
    for (int i = 0; i < 9; ++i)
      EXPECT_NEAR(P.m[i / 3][i % 3][lane], law.stress(one).m[i / 3][i % 3], tolerance);
    for (int i = 0; i < 45; ++i) EXPECT_NEAR(A.a[i][lane], tangent.a[i], tolerance);
  }
}

TEST(AllLawsTest, BatchesGiveWhatSingleNumbersGive) {
  AllLaws::for_each([](auto tag) { expect_lanes_equal<decltype(tag)::template Of>(); });
}

TEST(AllLawsTest, ListAndTableAreTheSame) {
  ASSERT_EQ(static_cast<std::size_t>(AllLaws::kSize), all_laws().size());
  EXPECT_EQ(BaseLaws::kSize + AdditionLaws::kSize, AllLaws::kSize);
  std::size_t i = 0;
  AllLaws::for_each([&](auto tag) {
    static_assert(Law<decltype(tag)::template Of>);
    EXPECT_EQ((decltype(tag)::template Of<double>::kName), all_laws()[i].name);
    ++i;
  });
}

std::string refusal(std::string_view name, std::vector<double> parameters) {
  const LawInfo& info = *find_law(name);
  std::vector<double> constants(info.constants.size());
  try {
    law_constants(info, parameters, constants);
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "";
}

TEST(LawTable, RefusesValuesOutOfRange) {
  EXPECT_EQ(refusal("stvk", {3e3, 0.5}), "stvk: poisson is 0.5; accepted is above -1 and below 0.5.");
  EXPECT_EQ(refusal("hooke", {-1.0, 0.3}), "hooke: young is -1 Pa; accepted is above 0.");
  EXPECT_EQ(refusal("hooke", {3e3}), "hooke: 1 parameters are given; accepted are 2, for 2 constants.");
  EXPECT_EQ(refusal("mooney_rivlin", {1.0, -1.0, 5.0}),
            "mooney_rivlin: c1 + c2 is 0; accepted is a sum above 0 (half the shear modulus).");
  EXPECT_EQ(refusal("fibre", {1.0, 1.0, 0.0, 0.0, 0.0}),
            "fibre: direction is 0; accepted is a vector that is not zero.");
  for (const LawInfo& law : all_laws()) {
    for (std::size_t i = 0; i < law.parameters.size(); ++i) {
      std::vector<double> values = typical(law);
      EXPECT_EQ(refusal(law.name, values), "");
      values[i] = std::nan("");
      EXPECT_NE(refusal(law.name, values).find(law.parameters[i].name), std::string::npos) << law.name;
    }
  }
}

TEST(LawTable, DirectionIsMadeUnit) {
  const LawInfo& info = *find_law("fibre");
  std::array<double, 5> constants{};
  law_constants(info, std::array{1.0, 1.0, 3.0, 0.0, -4.0}, constants);
  EXPECT_DOUBLE_EQ(constants[2], 0.6);
  EXPECT_DOUBLE_EQ(constants[4], -0.8);
}

// nu = 0.3: lambda' = lambda + 5/6 mu, mu' = 4/3 mu (Smith, de Goes, Kim 2018).
TEST(StableNeoHookeLaw, IsFiniteWhereElementsAreFlatOrInverted) {
  const StableNeoHooke<double> law = made<StableNeoHooke<double>>();
  for (const Mat3& F :
       {Mat3(Mat3::Zero()), Mat3(-Mat3::Identity()), Mat3(Vec3(1.0, 1.0, 0.0).asDiagonal())}) {
    EXPECT_TRUE(std::isfinite(law.energy(tensor(F))));
    EXPECT_TRUE(matrix(law.stress(tensor(F))).allFinite());
    EXPECT_TRUE(std::isfinite(largest(law.tangent(tensor(F)))));
    EXPECT_GT(law.energy(tensor(F)), 0.0);
  }
}

// Stretch s along a, s^(-1/2) across: Ibar4 = s^2, sigma_a = s dW/ds, W = k1/(2 k2) (exp(k2 (s^2-1)^2) - 1).
TEST(FibreLaw, UniaxialClosedFormAndSlackness) {
  const Fibre<double> law = made<Fibre<double>>();
  const Mat3 aa = kDirection * kDirection.transpose();
  const auto stretched = [&](double s) { return Mat3(s * aa + (Mat3::Identity() - aa) / std::sqrt(s)); };
  const double s = 1.2;
  const double x = s * s - 1.0;
  const Mat3 P = matrix(law.stress(tensor(stretched(s))));
  const double slope = (P * stretched(s).transpose()).cwiseProduct(aa - 0.5 * (Mat3::Identity() - aa)).sum();
  EXPECT_NEAR(slope, s * law.k1 * x * std::exp(law.k2 * x * x) * 2.0 * s, 1e-9 * law.k1);
  EXPECT_EQ(law.energy(tensor(stretched(0.9))), 0.0);
  EXPECT_EQ(matrix(law.stress(tensor(stretched(0.9)))), Mat3::Zero());
  EXPECT_EQ(largest(law.tangent(tensor(stretched(0.9)))), 0.0);
}

TEST(LawSumTest, IsTheSum) {
  using Sum = LawSum<NeoHooke, Fibre>;
  static_assert(Law<Sum::Of>);
  static_assert(Sum::Of<double>::kName == "neo_hooke+fibre");
  static_assert(sizeof(Sum::Of<double>) == sizeof(NeoHooke<double>) + sizeof(Fibre<double>));
  const Sum::Of<double> law{made<NeoHooke<double>>(), made<Fibre<double>>()};
  test::Random random(8);
  const Tensor F = tensor(states()[1]);
  const Tensor dF = tensor(random.matrix());
  EXPECT_EQ(law.energy(F), law.first.energy(F) + law.second.energy(F));
  EXPECT_EQ(matrix(law.stress(F)), matrix(law.first.stress(F)) + matrix(law.second.stress(F)));
  EXPECT_EQ(matrix(law.stress_change(F, dF)),
            matrix(law.first.stress_change(F, dF)) + matrix(law.second.stress_change(F, dF)));
  EXPECT_EQ(law.tangent(F)(0, 1, 2, 2), law.first.tangent(F)(0, 1, 2, 2) + law.second.tangent(F)(0, 1, 2, 2));
}

}  // namespace
}  // namespace tissu
