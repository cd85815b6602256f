// What the benchmarks compare the kernels with computes the same: forces, products and matrices of
// St-Venant–Kirchhoff.

#include <gtest/gtest.h>

#include "../../../bench/baseline/expanded.h"
#include "../../../bench/baseline/textbook.h"
#include "../force/verbs.h"
#include "../world/sample_worlds.h"
#include "tissu/model/fem/elastic.h"

namespace tissu {
namespace {

constexpr double kYoung = 3.0;
constexpr double kPoisson = 0.3;
const Lame kLame = lame(kYoung, kPoisson);
constexpr double kRoundOff = 1e-13;
constexpr double kExpandedRoundOff = 1e-11;  // 286 terms that cancel where displacements are rotations

template <class Part>
class BaselineTest : public testing::Test {
 protected:
  static constexpr bool kTetra = Part::value == 4;
  Mesh mesh_ = test::distorted_box({3, 2, 2}, kTetra ? Split::six : Split::none, 0.12);
  Elastic elastic_{block(), mesh_.positions, choose_isa(), Threads(1)};
  bench::Textbook<Part::value> textbook_{reference_cell(info(mesh_.blocks[0].type).name, "full"),
                                         mesh_.blocks[0].nodes, mesh_.positions, kLame};
  State state_ = moved();
  std::vector<double> p_ = test::Random(4).numbers(mesh_.positions.size());

  ElasticBlock block() const {
    return test::elastic_block(mesh_.blocks[0], {.law = "stvk", .young = kYoung, .poisson = kPoisson});
  }
  State moved() const {
    State state;
    state.positions = mesh_.positions;
    test::Random random(9);
    for (double& x : state.positions) x += random.number(0.2);
    state.velocities.assign(state.positions.size(), 0.0);
    return state;
  }
  static void expect_equal(const Eigen::VectorXd& a, const Eigen::VectorXd& b, double tolerance) {
    EXPECT_GT(b.norm(), 0.1);
    EXPECT_LE((a - b).norm(), tolerance * b.norm());
  }
};

using Parts = testing::Types<std::integral_constant<int, 4>, std::integral_constant<int, 8>>;
TYPED_TEST_SUITE(BaselineTest, Parts);

TYPED_TEST(BaselineTest, TextbookForceIsThatOfTheCore) {
  std::vector<double> f(this->p_.size());
  this->textbook_.add_force(this->state_.positions.data(), f.data());
  this->expect_equal(test::view(f), test::force_of(this->elastic_, this->state_), kRoundOff);
}

TYPED_TEST(BaselineTest, TextbookProductIsThatOfTheCore) {
  std::vector<double> out(this->p_.size());
  this->textbook_.add_product(this->state_.positions.data(), 0.7, this->p_.data(), out.data());
  this->expect_equal(test::view(out), test::product_of(this->elastic_, this->state_, {0.7, 0.0}, this->p_),
                     kRoundOff);
}

TYPED_TEST(BaselineTest, TextbookMatrixIsThatOfTheCore) {
  const Sparsity pattern = test::bind_alone(this->elastic_, this->mesh_.node_count());
  this->textbook_.bind(pattern);
  BlockMatrix matrix(pattern, Isa::baseline, Threads(1));
  matrix.clear();
  this->textbook_.add_stiffness(this->state_.positions.data(), 0.7, matrix.values());
  const Eigen::MatrixXd right = test::stiffness_of(this->elastic_, this->state_, {0.7, 0.0}, pattern);
  EXPECT_LE((test::dense(matrix) - right).norm(), kRoundOff * right.norm());
}

TYPED_TEST(BaselineTest, ExpandedForceIsThatOfTheCore) {
  if constexpr (TestFixture::kTetra) {
    const bench::Expanded expanded(this->mesh_.blocks[0].nodes, this->mesh_.positions, kLame);
    std::vector<double> f(this->p_.size());
    expanded.add_force(this->state_.positions.data(), f.data());
    this->expect_equal(test::view(f), test::force_of(this->elastic_, this->state_), kExpandedRoundOff);
  }
}

TEST(ExpandedTest, ConstantsAreThoseThatPicinbonoCounts) {
  EXPECT_EQ(sizeof(bench::Expanded::Constants), (280 + 6) * sizeof(double));
}

}  // namespace
}  // namespace tissu
