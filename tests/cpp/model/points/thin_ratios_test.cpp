#include "tissu/model/points/thin_ratios.h"

#include <gtest/gtest.h>

#include "../../base/random.h"
#include "../../cell/reference_nodes.h"
#include "tissu/model/fem/elastic.h"

/// The check without memory finds the same cells as their fields.

namespace tissu {
namespace {

/// Five cells, so that their points do not fill the groups of eight, each with nodes of its own.
struct Cells {
  ElasticBlock block;
  std::vector<double> X;

  Cells(const ElementInfo& element, const char* law, Plane plane) {
    block.body = "body";
    block.element = element.name;
    block.law = law;
    block.parameters = {{"young", {3.0}}, {"poisson", {0.3}}};
    block.density = {1.0};
    block.cross_section = {0.2};
    block.plane = plane;
    for (int k = 0; k < 5; ++k) {
      for (const Vec3& at : test::reference_nodes(element.name)) {
        block.cells.push_back(static_cast<std::int32_t>(X.size() / 3));
        X.insert(X.end(), {at[0] + 0.1 * at[0] * at[1] + 3.0 * k, at[1], at[2]});
      }
    }
  }
  /// Each node moved by up to `amount`, in the plane of a flat body.
  [[nodiscard]] State moved(double amount) const {
    State state;
    state.positions = X;
    test::Random random(5);
    for (std::size_t i = 0; i < X.size(); ++i) {
      const bool away = block.plane != Plane::free && i % 3 == 2;
      state.positions[i] += away ? 0.0 : random.number(amount);
    }
    return state;
  }
};

template <class Function>
void for_thin(Function&& f) {
  for (const ElementInfo& element : elements()) {
    if (element.dimension == 3) continue;
    for (const char* law : {"hooke", "stvk"}) {
      for (const Plane plane : {Plane::free, Plane::stress, Plane::strain}) {
        SCOPED_TRACE(std::string(element.name) + ", " + law + ", " + std::to_string(static_cast<int>(plane)));
        f(Cells(element, law, plane));
      }
    }
  }
}

TEST(ThinRatios, TheLeastIsThatOfTheFields) {
  int seen = 0;
  for_thin([&](const Cells& cells) {
    const ThinRatios ratios(cells.block, choose_isa());
    const Elastic model(cells.block, cells.X, choose_isa(), Threads(1));
    for (const double amount : {0.0, 0.1, 0.6}) {
      const State state = cells.moved(amount);
      const double expected = least(model.fields(state).volume_ratio);
      EXPECT_EQ(ratios.least(cells.block, cells.X, state.positions), expected);
    }
    ++seen;
  });
  EXPECT_EQ(seen, 7 * 2 * 3);  // lines of two orders, triangles of two, quads of three
}

/// In its plane a flat body has a right side: seen from behind, det F is that of the mirror.
TEST(ThinRatios, AMirroredFlatCellIsInsideOut) {
  for_thin([&](const Cells& cells) {
    if (cells.block.plane == Plane::free || find_element(cells.block.element)->dimension == 1) return;
    const ThinRatios ratios(cells.block, choose_isa());
    std::vector<double> x = cells.X;
    EXPECT_NEAR(ratios.least(cells.block, cells.X, x), 1.0, 1e-12);  // some products of size 1
    const std::size_t last = x.size() * 4 / 5;
    for (std::size_t i = last; i < x.size(); i += 3) x[i] = -x[i];
    EXPECT_LT(ratios.least(cells.block, cells.X, x), 0.0);
  });
}

}  // namespace
}  // namespace tissu
