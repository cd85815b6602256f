/// A swept edge that turns back between two moments: the blade is a V, whose walls part the material between
/// them from the rest. Either that happens, or the report names cells in which it may stay joined.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>
#include <vector>

#include "cut_body.h"

namespace tissu {
namespace {

/// A V of an opening [degrees] in the x y plane from above the unit cube to a corner inside it, as an edge
/// along z sweeps it in three moments.
Sweep vee(double opening, const Vec3& corner, double lean) {
  const double half = 0.5 * opening * std::numbers::pi / 180.0;
  std::vector<double> places;
  for (const double angle : {lean - half, 0.0, lean + half}) {
    const bool is_corner = places.size() == 6;
    const double reach = is_corner ? 0.0 : 1.5;
    for (const double z : {-0.3, 1.3}) {
      const Vec3 p = corner + reach * Vec3(std::sin(angle), std::cos(angle), 0.0);
      places.insert(places.end(), {p.x(), p.y(), z});
    }
  }
  return edge_sweep(places, 3, 2);
}

struct Count {
  int parted = 0;
  int named = 0;
  int joined = 0;  ///< and not named
};

Count count(double opening, CellType type, bool divide) {
  Count count;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    std::mt19937_64 random(seed);
    const auto real = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    test::CutBody body(test::typed_box(type, Vec3(1, 1, 1), {6, 6, 6}, 0.2, seed));
    CutOptions options;
    options.divide = divide;
    const Vec3 corner(real(0.4, 0.6), real(0.3, 0.5), 0.0);
    const CutPlan plan = body.cut(vee(opening, corner, real(-0.2, 0.2)), options);
    if (body.piece_count() > 1) {
      ++count.parted;
    } else if (plan.bridges() > 0) {
      ++count.named;
    } else {
      ++count.joined;
    }
  }
  return count;
}

TEST(TurnBack, PartsOrNamesWhatIsBetweenTheWalls) {
  for (const auto& [type, divide] : {std::pair(CellType::tetra, false), std::pair(CellType::tetra, true),
                                     std::pair(CellType::hexahedron, false)}) {
    for (const double opening : {1.0, 3.0, 4.0, 6.0, 10.0, 20.0, 40.0, 55.0, 65.0, 70.0, 110.0}) {
      const Count found = count(opening, type, divide);
      EXPECT_EQ(found.joined, 0) << opening << " degrees, " << info(type).name << (divide ? " divided" : "");
      if (opening < 40.0) continue;
      EXPECT_GE(found.parted, opening < 70.0 ? 7 : 10)
          << opening << " degrees, " << info(type).name << divide;
    }
  }
}

const Vec3 kBar(0.08, 0.04, 0.04);

/// A V in the x z plane: down along x = corner.x to the corner, and up again with an opening [degrees].
Sweep vee_down(const Vec3& corner, double opening) {
  constexpr double kUp = 0.047;
  const double across = kUp * std::tan(opening * std::numbers::pi / 180.0);
  const std::array<Vec3, 3> ends{Vec3(corner.x(), 0, 0.05), corner, corner + Vec3(across, 0, kUp)};
  std::vector<double> places;
  for (const Vec3& p : ends) {
    for (const double y : {-0.01, 0.02, 0.05}) places.insert(places.end(), {p.x(), y, p.z()});
  }
  return edge_sweep(places, 3, 3);
}

/// Whether a V parts its wedge from the bar, or the plan names cells.
bool parts_or_names(const Vec3& corner, double opening, bool divide) {
  test::CutBody body(test::typed_box(CellType::tetra, kBar, {20, 2, 10}, 0.0, 0));
  const CutPlan plan = body.cut(vee_down(corner, opening), {.divide = divide});
  return body.piece_count() > 1 || plan.bridges() > 0;
}

/// Places at which one cell at the corner stays joined: no wall of the V passes it twice.
TEST(TurnBack, ACellThatStaysJoinedAtTheCornerIsNamed) {
  EXPECT_TRUE(parts_or_names(Vec3(0.036783, 0, 0.014538), 37.8275, false));
  EXPECT_TRUE(parts_or_names(Vec3(0.036846, 0, 0.018469), 36.4599, false));
  EXPECT_TRUE(parts_or_names(Vec3(0.032801, 0, 0.010689), 34.7556, false));
}

/// TISSU_VEES: how many; of each third one the corner lies in a plane of nodes.
TEST(TurnBack, RandomVsPartOrThePlanNamesCells) {
  const char* text = std::getenv("TISSU_VEES");
  const long count = text == nullptr ? 15 : std::strtol(text, nullptr, 10);
  for (long seed = 0; seed < count; ++seed) {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    const auto real = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    Vec3 corner(real(0.025, 0.04), 0, real(0.01, 0.02));
    if (seed % 3 == 0) corner.z() = 0.004 * std::round(corner.z() / 0.004);
    const double opening = real(20.0, 50.0);
    for (const bool divide : {false, true})
      EXPECT_TRUE(parts_or_names(corner, opening, divide)) << "seed " << seed << (divide ? " divided" : "");
  }
}

/// A blade that goes back on its own way cuts once, and no corner is named.
TEST(TurnBack, AWayBackOnTheSameWayIsOneCut) {
  test::CutBody body(test::typed_box(CellType::tetra, Vec3(1, 1, 1), {4, 4, 4}, 0.2, 1));
  const CutPlan plan = body.cut(vee(0.0, Vec3(0.5, 0.45, 0.0), 0.1));
  EXPECT_GT(plan.cells_cut, 20);
  EXPECT_EQ(plan.bridges(), 0);
  EXPECT_EQ(body.piece_count(), 1U);
}

}  // namespace
}  // namespace tissu
