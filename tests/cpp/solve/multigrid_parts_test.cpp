#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "../base/random.h"
#include "../world/sample_worlds.h"
#include "solve/multigrid.h"
#include "tissu/solve/conjugate_gradient.h"
#include "tissu/step/system.h"

/// A multigrid that is made in parts, so that no solve pays for all of it.
namespace tissu {
namespace {

/// A held cube of tetrahedra, and its matrix with as much stiffness as is asked for.
class Cube {
 public:
  Cube() : world_(described()), chosen_({.preconditioning = Preconditioning::multigrid}) { assemble(1.0); }
  void assemble(double stiffness) { system_.assemble(world_.rest_state(), 1.0, {-stiffness, 0.0}); }
  [[nodiscard]] const BlockMatrix& matrix() const { return system_.matrix(); }
  [[nodiscard]] std::vector<double> numbers(unsigned seed) const {
    return test::Random(seed).numbers(static_cast<std::size_t>(3 * world_.blocks()));
  }

 private:
  static WorldDescription described() {
    const Mesh mesh = box_mesh(Vec3::Zero(), Vec3::Ones(), {9, 9, 9}, Split::six);
    WorldDescription description;
    description.bodies = {test::body_of(mesh, {.young = 1e4})};
    description.fixed = {test::fixed(test::nodes_at(mesh, 2, 0.0))};
    return description;
  }
  World world_;
  ConjugateGradient chosen_;
  Profile profile_;
  System system_{world_, &chosen_, profile_};
};

std::vector<double> applied(Multigrid<double>& M, std::vector<double> r) {
  std::vector<double> z(r.size());
  M.apply(r, z);
  return z;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

TEST(MultigridParts, SumUpToTheWhole) {
  Cube cube;
  Multigrid<double> whole;
  Multigrid<double> parts;
  whole.make(cube.matrix(), 1.0);
  parts.make(cube.matrix(), 1.0);
  ASSERT_GT(whole.level_rows().size(), 2U);
  cube.assemble(3.0);
  whole.make(cube.matrix(), 1.0);
  // One making in four measures the largest eigenvalues anew, as the whole does.
  int calls = 0;
  for (int renewal = 0; renewal < 4; ++renewal) {
    do ++calls;
    while (!parts.make_part(cube.matrix(), 1.0));
  }
  EXPECT_GE(calls, 4 * 3);  // the smoother, the matrix, the level below
  EXPECT_EQ(applied(whole, cube.numbers(1)), applied(parts, cube.numbers(1)));
}

TEST(MultigridParts, StaySymmetricAndPositiveWhileTheMatrixChanges) {
  Cube cube;
  Multigrid<double> M;
  M.make(cube.matrix(), 1.0);
  const std::vector<double> u = cube.numbers(1);
  const std::vector<double> v = cube.numbers(2);
  double stiffness = 1.0;
  for (int call = 0; call < 40; ++call) {
    stiffness *= 1.05;
    cube.assemble(stiffness);
    M.make_part(cube.matrix(), 1.0);
    const std::vector<double> Mu = applied(M, u);
    const std::vector<double> Mv = applied(M, v);
    const double scale = std::sqrt(dot(u, Mu) * dot(v, Mv));
    EXPECT_GT(dot(u, Mu), 0.0);
    EXPECT_NEAR(dot(u, Mv), dot(v, Mu), 1e-12 * scale);  // sums of some thousand products
  }
}

/// A solve that makes several parts goes on between them without computing its residual; what it reports is
/// the residual of x all the same, also where it was stopped.
TEST(MultigridParts, OfOneSolveLeaveItsReportExact) {
  for (const Precision precision : {Precision::full, Precision::single}) {
    for (const int most : {14, 1000}) {
      Cube cube;
      ConjugateGradient solver({1e-6, most, Preconditioning::multigrid, precision, Product::assembled});
      const auto& given = *cube.matrix().given();
      int most_parts = 0;
      for (int solve = 0; solve < 60; ++solve) {
        cube.assemble(std::pow(10.0, -(4 * solve % 7)));  // from stiffness alone to mass alone
        std::vector<double> b = cube.numbers(static_cast<unsigned>(solve));
        for (std::size_t i = 0; i < b.size(); ++i) {
          if (((given[i / 3] >> (i % 3)) & 1) != 0) b[i] = 0.0;
        }
        std::vector<double> x(b.size(), 0.0);
        std::vector<double> product(b.size());
        const SolveReport report = solver.solve(cube.matrix(), b, x, 0.0);
        cube.matrix().multiply(x, product);
        for (std::size_t i = 0; i < b.size(); ++i) product[i] = b[i] - product[i];
        const double residual = std::sqrt(dot(product, product) / dot(b, b));
        EXPECT_NEAR(report.residual, residual, 1e-6 * residual);  // sums of some thousand products
        EXPECT_EQ(report.converged, residual <= 1e-6);
        EXPECT_LE(report.iterations, most);
        EXPECT_TRUE(report.converged || most == 14);
        most_parts = std::max(most_parts, report.preparations);
      }
      EXPECT_TRUE(most_parts >= 2 || most == 14);
    }
  }
}

TEST(MultigridParts, AreBegunAgainByAWholeMaking) {
  Cube cube;
  Multigrid<double> whole;
  Multigrid<double> parts;
  whole.make(cube.matrix(), 1.0);
  parts.make(cube.matrix(), 1.0);
  cube.assemble(2.0);
  parts.make_part(cube.matrix(), 1.0);
  parts.make_part(cube.matrix(), 1.0);
  cube.assemble(3.0);
  whole.make(cube.matrix(), 1.0);
  parts.make(cube.matrix(), 1.0);
  EXPECT_EQ(applied(whole, cube.numbers(1)), applied(parts, cube.numbers(1)));
}

}  // namespace
}  // namespace tissu
