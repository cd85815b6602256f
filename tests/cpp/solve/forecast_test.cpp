#include "solve/forecast.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "../base/differences.h"
#include "../base/random.h"
#include "../world/sample_worlds.h"
#include "tissu/assembly/block_matrix.h"
#include "tissu/base/vec.h"

/// Guesses from earlier answers: exact where the new answer is made of them, never worse than none, seldom
/// where they do not pay.
namespace tissu {
namespace {

constexpr std::int32_t kRows = 40;
constexpr std::size_t kSize = 3 * kRows;

/// A diagonal matrix that counts its products.
class Counted final : public LinearOperator {
 public:
  [[nodiscard]] std::int32_t rows() const override { return kRows; }
  [[nodiscard]] const Threads& threads() const override { return threads_; }
  void multiply(ConstReals p, Reals out) const override {
    ++products;
    for (std::size_t i = 0; i < kSize; ++i) out[i] = entry(i) * p[i];
  }
  void diagonal_blocks(Reals /*blocks*/) const override {}
  [[nodiscard]] double diagonal_cost() const override { return 0.0; }
  [[nodiscard]] double round_off(ConstReals /*x*/) const override { return 0.0; }
  [[nodiscard]] std::size_t bytes() const override { return 0; }
  static double entry(std::size_t i) { return 1.0 + 0.1 * static_cast<double>(i); }

  mutable int products = 0;

 private:
  Threads threads_;
};

double norm(const std::vector<double>& v) {
  return std::sqrt(std::inner_product(v.begin(), v.end(), v.begin(), 0.0));
}

std::vector<double> numbers(unsigned seed) { return test::Random(seed).numbers(kSize); }

/// r = b - A x for x, which the guess made.
std::vector<double> residual(const std::vector<double>& b, const std::vector<double>& x) {
  std::vector<double> r = b;
  for (std::size_t i = 0; i < kSize; ++i) r[i] -= Counted::entry(i) * x[i];
  return r;
}

struct Guess {
  std::vector<double> x = std::vector<double>(kSize, 0.0);
  std::vector<double> r;
  double size = 0.0;
};

Guess guess(Forecast& forecast, const Counted& A, const std::vector<double>& b) {
  Guess g;
  g.r = b;
  double work = 0.0;
  g.size = forecast.start(A, norm(b), g.r, g.x, work);
  return g;
}

TEST(Forecast, FindsAnAnswerThatIsMadeOfEarlierOnes) {
  const Counted A;
  Forecast forecast;
  const std::vector<double> first = numbers(1);
  const std::vector<double> second = numbers(2);
  forecast.keep(A, first);
  forecast.keep(A, second);
  std::vector<double> answer(kSize);
  for (std::size_t i = 0; i < kSize; ++i) answer[i] = 2.0 * second[i] - first[i];
  std::vector<double> b(kSize);
  for (std::size_t i = 0; i < kSize; ++i) b[i] = Counted::entry(i) * answer[i];
  const Guess g = guess(forecast, A, b);
  EXPECT_LT(g.size, 1e-14 * norm(b));  // round-off of some hundred sums
  for (std::size_t i = 0; i < kSize; ++i) EXPECT_NEAR(g.x[i], answer[i], 1e-12);
}

TEST(Forecast, IsNeverWorseThanNoGuessAndSaysItsResidual) {
  const Counted A;
  for (unsigned seed = 1; seed < 20; ++seed) {
    Forecast forecast;
    for (unsigned k = 0; k < 5; ++k) forecast.keep(A, numbers(100 * seed + k));
    const std::vector<double> b = numbers(seed);
    const Guess g = guess(forecast, A, b);
    EXPECT_LE(g.size, norm(b));
    const std::vector<double> r = residual(b, g.x);
    for (std::size_t i = 0; i < kSize; ++i) EXPECT_NEAR(r[i], g.r[i], 1e-12);
    EXPECT_NEAR(norm(r), g.size, 1e-12);
  }
}

TEST(Forecast, IsNotMisledByTheSameAnswerTwice) {
  const Counted A;
  Forecast forecast;
  for (int k = 0; k < 3; ++k) forecast.keep(A, numbers(1));
  const Guess g = guess(forecast, A, numbers(2));
  EXPECT_TRUE(std::isfinite(g.size));
  const std::vector<double> r = residual(numbers(2), g.x);
  EXPECT_NEAR(norm(r), g.size, 1e-12);
}

TEST(Forecast, IsTriedMoreAndMoreSeldomWhereItDoesNotPay) {
  const Counted A;
  Forecast forecast;
  for (unsigned k = 0; k < 200; ++k) {
    const std::vector<double> b = numbers(k);
    guess(forecast, A, b);
    forecast.keep(A, numbers(1000 + k));
  }
  // Pauses of 1, 2, 4, 8, then 16: some fifteen trials of three products.
  EXPECT_LE(A.products, 3 * 17);
  EXPECT_GE(A.products, 3 * 10);
}

TEST(Forecast, ForgetsTheAnswersOfAnotherOperator) {
  const Counted A;
  const Counted B;
  Forecast forecast;
  forecast.keep(A, numbers(1));
  guess(forecast, B, numbers(2));
  forecast.keep(B, numbers(3));
  guess(forecast, A, numbers(2));
  EXPECT_EQ(A.products + B.products, 0);
}

TEST(Forecast, ForgetsAndFollowsAnotherSize) {
  const Counted A;
  Forecast forecast;
  forecast.keep(A, numbers(1));
  forecast.forget();
  guess(forecast, A, numbers(2));
  forecast.keep(A, std::vector<double>(12, 1.0));
  guess(forecast, A, numbers(2));
  EXPECT_EQ(A.products, 0);
}

/// With blocks and couplings, where three products are made in one reading of the matrix: the residual is
/// that of the guess, and as small as a combination of the answers can leave it, by Householder's QR.
TEST(Forecast, IsTheBestGuessOfAMatrixWithCouplings) {
  SparsityBuilder builder(kRows);
  std::vector<std::int32_t> cells;
  for (std::int32_t i = 0; i + 4 <= kRows; ++i) cells.insert(cells.end(), {i, i + 1, i + 2, i + 3});
  builder.add_cells(cells, 4);
  const Sparsity pattern = builder.build();
  for (const Isa isa : test::available_isas()) {
    test::Random random(7);
    BlockMatrix A(pattern, isa, Threads(1));
    for (std::int32_t i = 0; i < kRows; ++i) {
      for (std::int32_t j = i; j < std::min(kRows, i + 4); ++j) {
        const Mat3 block = random.matrix();
        A.add(i, j, block);
        A.add(j, i, block.transpose());
      }
    }
    Couplings couplings;
    couplings.add({.vertex = {3, 30, 0, 0}, .beta = {1.0, -1.0, 0.0, 0.0}, .H = Mat3::Identity()});
    couplings.close(kRows, nullptr);
    A.set_couplings(&couplings);
    Forecast forecast;
    Eigen::MatrixXd products(static_cast<Eigen::Index>(kSize), 3);
    for (unsigned k = 0; k < 3; ++k) {
      const std::vector<double> answer = random.numbers(kSize);
      std::vector<double> product(kSize);
      A.multiply(answer, product);
      products.col(k) = test::view(product);
      forecast.keep(A, answer);
    }
    const std::vector<double> b = random.numbers(kSize);
    Guess g;
    g.r = b;
    double work = 0.0;
    g.size = forecast.start(A, norm(b), g.r, g.x, work);
    std::vector<double> product(kSize);
    A.multiply(g.x, product);
    for (std::size_t i = 0; i < kSize; ++i) EXPECT_NEAR(b[i] - product[i], g.r[i], 1e-12);
    const Eigen::VectorXd share = products.householderQr().solve(test::view(b));
    EXPECT_NEAR(g.size, (test::view(b) - products * share).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace tissu
