// log, exp and cube roots of batches, for every instruction set of this machine, against long double.

#include <gtest/gtest.h>

#include <bit>
#include <cfloat>
#include <cmath>
#include <limits>
#include <vector>

#include "base/kernel_choice.h"
#include "batch_math_lanes.h"
#include "random.h"
#include "tissu/base/isa.h"

namespace tissu {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kDenormal = std::numeric_limits<double>::denorm_min();
constexpr double kAllowed = 2.0;  // ulp

using test::BatchMath;
using Reference = long double (*)(long double);

class BatchMathTest : public testing::TestWithParam<Isa> {
 protected:
  static BatchMath math() { return TISSU_KERNELS_OF(GetParam(), batch_math()); }

  static std::vector<double> of(BatchMath::Function f, std::vector<double> x) {
    x.resize((x.size() + 7) / 8 * 8, 1.0);
    std::vector<double> y(x.size());
    f(x.data(), y.data(), x.size());
    return y;
  }
  static double of(BatchMath::Function f, double x) { return of(f, std::vector<double>{x}).front(); }

  /// The largest error in units of the last place of the exact value.
  static double error(BatchMath::Function f, Reference exact, const std::vector<double>& x) {
    const std::vector<double> y = of(f, x);
    double largest = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const long double right = exact(static_cast<long double>(x[i]));
      const double rounded = std::abs(static_cast<double>(right));
      if (rounded == 0.0 || rounded == kInf) {
        EXPECT_EQ(std::abs(y[i]), rounded) << x[i];
        continue;
      }
      const long double ulp = rounded == DBL_MAX ? 0x1p971L : std::nextafter(rounded, kInf) - rounded;
      const auto off = static_cast<double>(std::abs(static_cast<long double>(y[i]) - right) / ulp);
      EXPECT_TRUE(off <= kAllowed) << x[i] << " gives " << y[i];
      largest = std::max(largest, off);
    }
    return largest;
  }

  /// Every exponent of the positive numbers, 200 mantissas each; and many numbers near 1.
  static std::vector<double> positive_numbers() {
    std::vector<double> x = {
        kDenormal, DBL_MIN, DBL_MAX, 1.0, std::nextafter(1.0, 2.0), std::nextafter(1.0, 0.0)};
    test::Random random(5);
    for (int exponent = -1074; exponent < 1024; ++exponent) {
      for (int i = 0; i < 200; ++i) x.push_back(std::ldexp(1.5 + random.number(0.5), exponent));
    }
    for (int i = 0; i < 200000; ++i) x.push_back(1.0 + random.number(0.5) * random.number());
    std::erase_if(x, [](double value) { return !(value > 0.0) || value == kInf; });
    return x;
  }
  static void expect_same(double a, double b) {
    if (std::isnan(b)) {
      EXPECT_TRUE(std::isnan(a)) << a;
    } else {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(a), std::bit_cast<std::uint64_t>(b)) << a << " and " << b;
    }
  }
};

TEST_P(BatchMathTest, LogIsRightOverAllPositiveNumbers) {
  RecordProperty("ulp", std::to_string(error(math().log, std::log, positive_numbers())));
}

TEST_P(BatchMathTest, CubeRootsAreRightOverAllNumbers) {
  std::vector<double> x = positive_numbers();
  for (std::size_t i = 0; i < x.size(); i += 2) x[i] = -x[i];
  RecordProperty("cbrt", std::to_string(error(math().cbrt, std::cbrt, x)));
  const Reference inverse = [](long double value) { return 1.0L / std::cbrt(value); };
  RecordProperty("inverse_cbrt", std::to_string(error(math().inverse_cbrt, inverse, x)));
}

TEST_P(BatchMathTest, ExpIsRightFromZeroToInfinity) {
  test::Random random(6);
  std::vector<double> x = {0.0,     -0.0,    709.78,    709.79, -708.39, -708.4,
                           -745.13, -745.14, kDenormal, 1e300,  -1e300};
  for (int i = 0; i < 400000; ++i) x.push_back(random.number(750.0));
  for (int i = 0; i < 200000; ++i) x.push_back(random.number(2.0) * random.number());
  RecordProperty("ulp", std::to_string(error(math().exp, std::exp, x)));
}

TEST_P(BatchMathTest, SpecialValuesAreThoseOfTheStandard) {
  for (const double x : {0.0, -0.0, kInf, -kInf, kNan}) {
    expect_same(of(math().log, x), std::log(x));
    expect_same(of(math().exp, x), std::exp(x));
    expect_same(of(math().cbrt, x), std::cbrt(x));
    expect_same(of(math().inverse_cbrt, x), 1.0 / std::cbrt(x));
  }
  for (const double x : {-kDenormal, -DBL_MIN, -1.0, -DBL_MAX}) expect_same(of(math().log, x), kNan);
  expect_same(of(math().log, 1.0), 0.0);
  expect_same(of(math().cbrt, 27.0), 3.0);
  expect_same(of(math().cbrt, -0.125), -0.5);
}

TEST_P(BatchMathTest, ALaneDoesNotSeeItsNeighbours) {
  const std::vector<double> odd = {kNan, 0.0, -kInf, kDenormal, -1.0, kInf, 1e300};
  for (const BatchMath::Function f : {math().log, math().exp, math().cbrt, math().inverse_cbrt}) {
    const double alone = of(f, 1.7);
    for (std::size_t lane = 0; lane < 8; ++lane) {
      std::vector<double> x = odd;
      x.insert(x.begin() + static_cast<std::ptrdiff_t>(lane), 1.7);
      expect_same(of(f, x)[lane], alone);
    }
  }
}

std::vector<Isa> isas() {
  std::vector<Isa> here;
  for (const Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512}) {
    if (runs_here(isa)) here.push_back(isa);
  }
  return here;
}

INSTANTIATE_TEST_SUITE_P(Isas, BatchMathTest, testing::ValuesIn(isas()),
                         [](const auto& param) { return std::string(name(param.param)); });

}  // namespace
}  // namespace tissu
