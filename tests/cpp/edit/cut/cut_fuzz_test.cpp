/// Random cuts, one after the other, of small bodies of every cell type. Every failure prints its seed;
/// TISSU_CUTS sets how many cuts there are, TISSU_CUT_SEED the first seed.

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <string>

#include "cut_body.h"

namespace tissu {
namespace {

using Random = std::mt19937_64;

long from_environment(const char* name, long otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtol(text, nullptr, 10);
}

constexpr std::array kTypes{CellType::tetra,        CellType::hexahedron, CellType::wedge,
                            CellType::pyramid,      CellType::tetra10,    CellType::hexahedron20,
                            CellType::hexahedron27, CellType::wedge15,    CellType::pyramid13};

test::CutBody random_body(Random& random) {
  const CellType type = random() % 2 == 0 ? CellType::tetra : kTypes[random() % kTypes.size()];
  const auto count = [&] { return 1 + static_cast<int>(random() % 3); };
  const std::array<int, 3> cells{1 + count(), count(), count()};
  const double jitter = random() % 3 == 0 ? 0.0 : 0.15;
  test::CutBody body(test::typed_box(type, Vec3(0.02, 0.012, 0.009), cells, jitter, random()));
  if (random() % 2 == 0) {
    Mat3 turn = Mat3::Identity();
    std::uniform_real_distribution<double> part(-0.2, 0.2);
    for (int i = 0; i < 9; ++i) turn(i / 3, i % 3) += part(random);
    body.move([&](const Vec3& X) -> Vec3 { return turn * X + Vec3(0, 3.0 * X[0] * X[0], 0); });
  }
  return body;
}

/// Cuts a body of this seed up to twenty times; what is wrong, or nothing, and how many cuts there were.
std::string cut_some(std::uint64_t seed, long& cuts) {
  Random random(seed);
  test::CutBody body = random_body(random);
  constexpr std::array kT0{0.0, 0.02, 0.02, 0.2};
  const auto many = static_cast<int>(1 + random() % (random() % 4 == 0 ? 20 : 4));
  for (int i = 0; i < many; ++i, ++cuts) {
    const CutOptions options{kT0[random() % kT0.size()], random() % 4 == 0};
    body.cut(test::random_sweep(random, body), options);
    const std::string fault = body.fault();
    if (!fault.empty()) {
      return "seed " + std::to_string(seed) + ", cut " + std::to_string(i) + ": " + fault;
    }
  }
  return {};
}

TEST(CutFuzzTest, RandomCutsKeepEveryInvariant) {
  const long wanted = from_environment("TISSU_CUTS", 2000);
  long cuts = 0;
  auto seed = static_cast<std::uint64_t>(from_environment("TISSU_CUT_SEED", 1));
  for (; cuts < wanted; ++seed) {
    const std::string fault = cut_some(seed, cuts);
    ASSERT_TRUE(fault.empty()) << fault;
  }
}

/// Seeds that once failed: an edge with two fans, on faces opened before, that a later cut divides.
TEST(CutFuzzTest, SeedsThatOnceFailed) {
  for (const std::uint64_t seed : {6732U}) {
    long cuts = 0;
    EXPECT_EQ(cut_some(seed, cuts), "");
  }
}

}  // namespace
}  // namespace tissu
