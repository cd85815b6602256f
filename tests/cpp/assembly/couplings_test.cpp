#include "tissu/assembly/couplings.h"

#include <gtest/gtest.h>

#include <cstring>

#include "../base/differences.h"
#include "../base/random.h"

/// C = sum J^T H J, whose J the tests build by hand from what carries a vertex.
namespace tissu {
namespace {

using test::view;

constexpr std::int32_t kRows = 40;
constexpr double kRoundOff = 1e-12;  // some hundred products of numbers of size 1

/// A random positive semi-definite H of rank 1 to 3.
Mat3 semidefinite(test::Random& random, int rank) {
  Mat3 H = Mat3::Zero();
  for (int k = 0; k < rank; ++k) {
    const Vec3 g = random.vector();
    H += g * g.transpose();
  }
  return H;
}

/// A list and the dense matrix that it stands for.
struct Sample {
  Couplings list;
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(3 * kRows, 3 * kRows);
};

struct Vertex {
  std::int32_t number;
  Eigen::MatrixXd J;  ///< 3 x unknowns
};

std::int32_t any_row(test::Random& random) {
  return static_cast<std::int32_t>((random.number(0.5) + 0.5) * kRows) % kRows;
}

/// A row itself, a point of a frame (row 2 k its origin, the next its rotation), or a point of three rows.
Vertex any_vertex(test::Random& random, int kind, Couplings& list) {
  Vertex vertex{any_row(random), Eigen::MatrixXd::Zero(3, 3 * kRows)};
  if (kind == 0) {
    vertex.J.block<3, 3>(0, 3 * vertex.number).setIdentity();
    return vertex;
  }
  if (kind == 1) {
    const std::int32_t origin = vertex.number / 2 * 2;
    const Vec3 arm = random.vector();
    vertex.number = list.carry(std::array{CarriedPart{origin, 1.0}, CarriedPart{origin + 1, 1.0, arm, true}});
    vertex.J.block<3, 3>(0, 3 * origin).setIdentity();
    for (int k = 0; k < 3; ++k) vertex.J.col(3 * origin + 3 + k) = Vec3(Vec3::Unit(k)).cross(arm);
    return vertex;
  }
  std::vector<CarriedPart> parts;
  for (const double weight : {0.5, 0.3, 0.2}) {
    parts.push_back({any_row(random), weight});
    vertex.J.block<3, 3>(0, 3 * parts.back().row) += weight * Mat3::Identity();
  }
  vertex.number = list.carry(parts);
  return vertex;
}

void fill(Sample& sample, int count, const std::vector<std::uint8_t>* given, unsigned seed = 3) {
  test::Random random(seed);
  sample.list.clear();
  sample.C.setZero();
  const std::array<double, 4> beta = {1.0, -0.25, -0.5, -0.25};
  for (int c = 0; c < count; ++c) {
    const Mat3 H = semidefinite(random, 1 + c % 3);
    const std::size_t vertices = c % 2 == 0 ? 2 : 4;
    Coupling coupling{{0, 0, 0, 0}, {0.0, 0.0, 0.0, 0.0}, H};
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, 3 * kRows);
    for (std::size_t v = 0; v < vertices; ++v) {
      const Vertex vertex = any_vertex(random, (c + static_cast<int>(v)) % 3, sample.list);
      coupling.vertex[v] = vertex.number;
      coupling.beta[v] = vertices == 2 ? (v == 0 ? 1.0 : -1.0) : beta[v];
      J += coupling.beta[v] * vertex.J;
    }
    sample.list.add(coupling);
    for (int i = 0; given != nullptr && i < 3 * kRows; ++i) {
      if ((((*given)[static_cast<std::size_t>(i / 3)] >> (i % 3)) & 1) != 0) J.col(i).setZero();
    }
    sample.C += J.transpose() * H * J;
  }
  sample.list.close(kRows, given);
}

std::vector<std::uint8_t> some_given() {
  std::vector<std::uint8_t> masks(kRows, 0);
  masks[3] = 7;
  masks[4] = 5;
  masks[11] = 2;
  masks[20] = 7;
  return masks;
}

class CouplingsTest : public testing::TestWithParam<bool> {
 protected:
  std::vector<std::uint8_t> masks_ = some_given();
  const std::vector<std::uint8_t>* given_ = GetParam() ? &masks_ : nullptr;
};

TEST_P(CouplingsTest, MultiplyAsADenseMatrix) {
  Sample sample;
  for (const int count : {0, 1, 10, 1000}) {
    fill(sample, count, given_);
    EXPECT_EQ(sample.list.size(), static_cast<std::size_t>(count));
    test::Random random(8);
    const std::vector<double> p = random.numbers(3 * kRows);
    std::vector<double> out = p;
    sample.list.add_product(Threads(1), -2.0, p.data(), out.data());
    const Eigen::VectorXd expected = view(p) - 2.0 * sample.C * view(p);
    EXPECT_LT((view(out) - expected).norm(), kRoundOff * (1.0 + expected.norm())) << count;
    std::vector<float> single(p.begin(), p.end());
    std::vector<float> sum(single.size(), 0.0F);
    sample.list.add_product(Threads(1), 1.0, single.data(), sum.data());
    const Eigen::VectorXd exact =
        sample.C * Eigen::Map<const Eigen::VectorXf>(single.data(), 3 * kRows).cast<double>();
    for (int i = 0; i < 3 * kRows; ++i) {
      EXPECT_NEAR(sum[static_cast<std::size_t>(i)], exact[i], 1e-6 * (1.0 + std::abs(exact[i])));
    }
  }
}

TEST_P(CouplingsTest, GiveTheirBlocks) {
  Sample sample;
  fill(sample, 50, given_);
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(3 * kRows, 3 * kRows);
  sample.list.for_blocks([&](std::int32_t row, std::int32_t column, const Mat3& value) {
    C.block<3, 3>(3 * row, 3 * column) += value;
  });
  EXPECT_LT((C - sample.C).norm(), kRoundOff * sample.C.norm());
  std::vector<double> blocks(9 * kRows, 1.0);
  sample.list.add_diagonal(blocks);
  for (std::int32_t row = 0; row < kRows; ++row) {
    const Mat3 expected = Mat3(sample.C.block<3, 3>(3 * row, 3 * row)) + Mat3::Ones();
    EXPECT_LT((Eigen::Map<const Mat3>(blocks.data() + 9 * row) - expected).norm(),
              kRoundOff * (1.0 + expected.norm()));
    const std::int32_t place = sample.list.place(row);
    if (place < 0) continue;
    EXPECT_EQ(sample.list.rows()[static_cast<std::size_t>(place)], row);
  }
}

INSTANTIATE_TEST_SUITE_P(Given, CouplingsTest, testing::Bool());

/// beta sums to zero: a translation of nodes (rows 0 to 5) and frames (two rows each after them) feels
/// nothing.
TEST(Couplings, LeaveATranslationAlone) {
  test::Random random(4);
  Couplings list;
  std::vector<double> p(3 * kRows, 0.0);
  for (std::int32_t node = 0; node < 6; ++node) block(Reals(p), node) = Vec3(1.0, 2.0, -3.0);
  for (std::int32_t frame = 6; frame + 1 < kRows; frame += 2) {
    const std::int32_t point =
        list.carry(std::array{CarriedPart{frame, 1.0}, CarriedPart{frame + 1, 1.0, random.vector(), true}});
    list.add({{point, 1, 3, 5}, {1.0, -0.25, -0.5, -0.25}, semidefinite(random, 3)});
    block(Reals(p), frame) = Vec3(1.0, 2.0, -3.0);
  }
  list.close(kRows, nullptr);
  std::vector<double> out(p.size(), 0.0);
  list.add_product(Threads(1), 1.0, p.data(), out.data());
  EXPECT_LT(view(out).norm(), kRoundOff);
  block(Reals(p), 7).x() += 1.0;  // one frame turns
  list.add_product(Threads(1), 1.0, p.data(), out.data());
  EXPECT_GT(view(out).norm(), 0.01);
}

TEST(Couplings, SameBitsForAnyNumberOfThreads) {
  constexpr std::int32_t kMany = 3000;  // some pieces of rows and of couplings
  test::Random random(6);
  Couplings list;
  for (std::int32_t c = 0; c < kMany; ++c) {
    const std::int32_t next = (c * 7 + 11) % kMany;
    list.add({{c, next, (c + 5) % kMany, 0}, {1.0, -0.5, -0.5, 0.0}, semidefinite(random, 3)});
  }
  list.close(kMany, nullptr);
  const std::vector<double> p = random.numbers(3 * kMany);
  std::vector<double> first;
  for (const int threads : {1, 2, 3, 4}) {
    std::vector<double> out(p.size(), 0.0);
    list.add_product(Threads(threads), 1.0, p.data(), out.data());
    if (threads == 1) first = out;
    EXPECT_EQ(std::memcmp(out.data(), first.data(), out.size() * sizeof(double)), 0) << threads;
  }
}

/// A list is what was added since the latest `clear`.
TEST(Couplings, BeginAnew) {
  Sample sample;
  fill(sample, 30, nullptr, 1);
  fill(sample, 5, nullptr, 2);
  Sample fresh;
  fill(fresh, 5, nullptr, 2);
  test::Random random(8);
  const std::vector<double> p = random.numbers(3 * kRows);
  std::vector<double> one(p.size(), 0.0);
  std::vector<double> other(p.size(), 0.0);
  sample.list.add_product(Threads(1), 1.0, p.data(), one.data());
  fresh.list.add_product(Threads(1), 1.0, p.data(), other.data());
  EXPECT_EQ(one, other);
  EXPECT_EQ(sample.list.rows(), fresh.list.rows());
  std::vector<Couplings::Key> keys;
  std::vector<Couplings::Key> others;
  sample.list.keys(keys);
  fresh.list.keys(others);
  EXPECT_EQ(keys, others);
}

}  // namespace
}  // namespace tissu
