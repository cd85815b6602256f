/// The surface that is followed from edit to edit against the one that is looked for from scratch.

#include "edit/cut/kerf_table.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

#include "cut_body.h"

namespace tissu {
namespace {

void expect_same(const KerfSurface& found, const KerfSurface& expected) {
  EXPECT_EQ(found.triangles, expected.triangles);
  ASSERT_EQ(found.carried.size(), expected.carried.size());
  for (std::size_t i = 0; i < found.carried.size(); ++i) {
    ASSERT_EQ(found.carried[i].first, expected.carried[i].first);
    EXPECT_EQ(found.carried[i].second.node, expected.carried[i].second.node);
    EXPECT_EQ(found.carried[i].second.weight, expected.carried[i].second.weight);
  }
}

/// A body and what is kept of its surface, with walls that coincide and with walls that are apart.
struct Followed {
  test::CutBody body;
  std::array<double, 2> depths = {0.0, 2e-3};
  std::vector<KerfTable> tables = {};

  explicit Followed(const Mesh& mesh) : body(mesh) {
    for (const double depth : depths) tables.emplace_back(body.hosts, body.material, depth);
  }
  template <class Edit>
  void follow(const CutPlan& plan, Edit&& edit) {
    for (KerfTable& table : tables) table.begin(body.hosts, body.material, plan);
    edit();
    for (std::size_t i = 0; i < tables.size(); ++i) {
      tables[i].end(body.hosts, body.material, plan);
      expect_same(tables[i].surface(), kerf_surface(body.hosts, body.material, depths[i]));
    }
  }
  void cut(const Sweep& sweep, const CutOptions& options) {
    follow(plan_cut(body.hosts, body.material, body.x, sweep, options), [&] { body.cut(sweep, options); });
  }
  void ablate(const std::vector<std::int32_t>& cells) {
    follow(plan_ablation(body.hosts, body.material, cells), [&] { body.ablate(cells); });
  }
};

class KerfFollowed : public testing::TestWithParam<std::pair<CellType, bool>> {};

TEST_P(KerfFollowed, IsTheSurfaceLookedForAnew) {
  const auto [type, divide] = GetParam();
  CutOptions options;
  options.divide = divide;
  if (divide) options.t0 = 0.2;
  int cuts = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    std::mt19937_64 random(seed);
    Followed followed(test::typed_box(type, Vec3(1, 1, 1), {4, 3, 3}, 0.2, seed));
    for (int k = 0; k < 6; ++k) {
      if (k % 3 == 2) {
        const std::vector<std::int32_t> cells = followed.body.hosts.numbers();
        followed.ablate({cells[random() % cells.size()]});
      } else {
        followed.cut(test::random_sweep(random, followed.body), options);
        ++cuts;
      }
      ASSERT_FALSE(HasFailure()) << "seed " << seed << ", edit " << k;
    }
  }
  EXPECT_GT(cuts, 40);
}

INSTANTIATE_TEST_SUITE_P(Cells, KerfFollowed,
                         testing::Values(std::pair(CellType::tetra, false), std::pair(CellType::tetra, true),
                                         std::pair(CellType::hexahedron, false),
                                         std::pair(CellType::wedge, false)),
                         [](const auto& info) {
                           return std::string(tissu::info(info.param.first).name) +
                                  (info.param.second ? "_divided" : "");
                         });

}  // namespace
}  // namespace tissu
