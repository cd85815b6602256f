/// A swept edge that turns back between two moments: the blade is a V, whose walls part the material between
/// them from the rest. Either that happens, or the report names cells in which it may stay joined.

#include <gtest/gtest.h>

#include <cmath>
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
