#include "tissu/law/loaded_law.h"

#include "../force/room.h"
#include "../model/fem/elastic_sample.h"

/// A law from a shared library: the same numbers as the law of the library that it repeats, and what is
/// refused.
namespace tissu {
namespace {

constexpr double kLambda = 3.0;
constexpr double kMu = 2.0;

std::string message_of(const std::string& path) {
  try {
    const LoadedLaw law(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was refused";
}

class LoadedLawTest : public testing::TestWithParam<Split> {
 protected:
  Mesh mesh_ = test::distorted_box({3, 2, 2}, GetParam(), 0.12);
  std::shared_ptr<const LoadedLaw> law_ = std::make_shared<LoadedLaw>(TISSU_TEST_LAW);

  ElasticBlock own() {
    ElasticBlock block = test::elastic_block(mesh_.blocks[0], {});
    block.law = "sample";
    block.loaded = law_;
    block.parameters = {{"lambda", {kLambda}}, {"mu", {kMu}}};
    return block;
  }
  ElasticBlock repeated() {
    ElasticBlock block = test::elastic_block(mesh_.blocks[0], {});
    block.law = "neo_hooke";
    const double young = kMu * (3.0 * kLambda + 2.0 * kMu) / (kLambda + kMu);
    block.parameters = {{"young", {young}}, {"poisson", {kLambda / (2.0 * (kLambda + kMu))}}};
    return block;
  }
  Elastic made(ElasticBlock block) const {
    return {std::move(block), mesh_.positions, Isa::baseline, Threads(1)};
  }
};

TEST_P(LoadedLawTest, ComputesWhatTheLawItRepeatsComputes) {
  Elastic own_law = made(own());
  Elastic of_library = made(repeated());
  const Sparsity pattern = test::bind_alone(own_law, mesh_.node_count());
  test::bind_alone(of_library, mesh_.node_count());
  test::Random random(5);
  State state;
  state.positions = mesh_.positions;
  for (double& x : state.positions) x = 1.1 * x + random.number(0.03);
  // Lamé's constants come back from Young's modulus and Poisson's ratio with a few roundings.
  const Eigen::VectorXd f = test::force_of(of_library, state);
  EXPECT_GT(f.norm(), 0.1);
  EXPECT_LT(test::relative_difference(test::force_of(own_law, state), f), 1e-14);
  const Eigen::MatrixXd K = test::stiffness_of(of_library, state, {1.0, 0.0}, pattern, Isa::baseline);
  EXPECT_LT(
      test::relative_difference(test::stiffness_of(own_law, state, {1.0, 0.0}, pattern, Isa::baseline), K),
      1e-14);
  EXPECT_NEAR(own_law.energy(state, test::scratch()), of_library.energy(state, test::scratch()),
              1e-14 * of_library.energy(state, test::scratch()));
  EXPECT_FALSE(own_law.has_constant_stiffness());
}

TEST_P(LoadedLawTest, StaysOpenAsLongAsABlockUsesIt) {
  const Elastic elastic = made(own());
  const std::weak_ptr<const LoadedLaw> seen = law_;
  law_.reset();
  EXPECT_FALSE(seen.expired());
  State state;
  state.positions = mesh_.positions;
  EXPECT_LT(test::force_of(elastic, state).norm(), 1e-13);
}

TEST_P(LoadedLawTest, ParametersOutOfRangeAreRefused) {
  ElasticBlock block = own();
  block.parameters["mu"] = {-1.0};
  EXPECT_THROW(made(block), ParameterError);
  block.parameters["mu"] = {1.0};
  block.parameters["lambda"] = {-1.0};  // the bulk modulus is negative
  EXPECT_THROW(made(block), ParameterError);
  block.parameters["young"] = {1.0};
  EXPECT_THROW(made(block), ParameterError);
}

TEST_P(LoadedLawTest, NeedsCellsWithAVolume) {
  EXPECT_EQ(law_->kernels(2), nullptr);
  EXPECT_NE(law_->kernels(3), nullptr);
}

INSTANTIATE_TEST_SUITE_P(Cells, LoadedLawTest, testing::Values(Split::six, Split::none));

TEST(LoadedLaw, TellsItsLimit) {
  const LoadedLaw law(TISSU_TEST_LAW);
  const std::optional<Lame> limit = law.small_strain(std::array{kLambda, kMu});
  ASSERT_TRUE(limit.has_value());
  EXPECT_EQ(limit->lambda, kLambda);
  EXPECT_EQ(limit->mu, kMu);
  EXPECT_EQ(law.info().name, "sample");
  EXPECT_EQ(law.isa(), Isa::baseline);
}

TEST(LoadedLaw, RefusesWhatIsNoLaw) {
  EXPECT_NE(message_of("/there/is/no.so").find("/there/is/no.so cannot be loaded"), std::string::npos);
  EXPECT_NE(message_of(TISSU_TEST_NO_LAW).find("it has no tissu_law_v2"), std::string::npos);
  EXPECT_NE(message_of(TISSU_TEST_OLD_LAW).find("has the layout 0, and 2 is accepted"), std::string::npos);
  EXPECT_NE(message_of(TISSU_TEST_FOREIGN_LAW).find("compiled for sve, which does not run here"),
            std::string::npos);
}

}  // namespace
}  // namespace tissu
