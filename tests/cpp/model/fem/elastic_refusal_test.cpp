#include <limits>

#include "elastic_sample.h"
#include "tissu/law/law_info.h"

/// What an elastic block refuses, and in which words.
namespace tissu {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

class ElasticRefusal : public testing::TestWithParam<Split> {
 protected:
  Mesh mesh_ = box_mesh(Vec3::Zero(), Vec3(3, 2, 2), {3, 2, 2}, GetParam());
  ElasticBlock block_ = test::elastic_block(mesh_.blocks[0], {});

  Elastic make() { return {block_, mesh_.positions, Isa::baseline, Threads(1)}; }
  std::size_t nodes() const { return static_cast<std::size_t>(info(mesh_.blocks[0].type).nodes); }
  std::string message() {
    try {
      make();
    } catch (const Error& error) {
      return error.what();
    }
    return "nothing was refused";
  }
};

TEST_P(ElasticRefusal, AcceptsTheMeshItself) { EXPECT_NO_THROW(make()); }

/// Mirrored numbering turns a cell inside out.
TEST_P(ElasticRefusal, CountsInvertedCells) {
  for (const std::size_t cell : {1U, 4U, 7U}) {
    std::int32_t* first = block_.cells.data() + cell * nodes();
    if (GetParam() == Split::none) {
      std::swap_ranges(first, first + 4, first + 4);
    } else {
      std::swap(first[0], first[1]);
    }
  }
  EXPECT_THROW(make(), MeshError);
  EXPECT_NE(message().find("3 of " + std::to_string(mesh_.cell_count())), std::string::npos) << message();
  EXPECT_NE(message().find("1, 4, 7"), std::string::npos) << message();
}

TEST_P(ElasticRefusal, NamesTheFirstFiveInOrder) {
  for (double& x : mesh_.positions) x = -x;  // a point mirror: every cell is inside out
  EXPECT_THROW(make(), MeshError);
  const std::string all = std::to_string(mesh_.cell_count());
  EXPECT_NE(message().find(all + " of " + all), std::string::npos) << message();
  EXPECT_NE(message().find("0, 1, 2, 3, 4"), std::string::npos) << message();
  EXPECT_EQ(message().find(", 5,"), std::string::npos) << message();
}

TEST_P(ElasticRefusal, FlatCells) {
  for (std::size_t i = 2; i < mesh_.positions.size(); i += 3) mesh_.positions[i] = 0.5;
  EXPECT_THROW(make(), MeshError);
}

TEST_P(ElasticRefusal, PositionsThatAreNotNumbers) {
  mesh_.positions[4] = kNaN;
  EXPECT_THROW(make(), MeshError);
  mesh_.positions[4] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(make(), MeshError);
}

TEST_P(ElasticRefusal, UnknownNames) {
  for (auto* name : {&block_.law, &block_.element, &block_.quadrature}) {
    const std::string before = *name;
    *name = "nonsense";
    EXPECT_THROW(make(), ParameterError);
    EXPECT_NE(message().find("nonsense"), std::string::npos);
    *name = before;
  }
}

TEST_P(ElasticRefusal, SaysWhatThereIs) {
  block_.law = "nonsense";
  for (const LawInfo& law : all_laws()) {
    EXPECT_NE(message().find(std::string(law.name)), std::string::npos) << message();
  }
  block_.law = "stvk";
  block_.element = "nonsense";
  for (const ElementInfo& element : elements()) {
    EXPECT_NE(message().find(std::string(element.name)), std::string::npos) << message();
  }
}

TEST_P(ElasticRefusal, TablesOfAnotherLength) {
  const auto cells = static_cast<std::size_t>(mesh_.cell_count());
  for (auto* values : {&block_.parameters["young"], &block_.parameters["poisson"], &block_.density}) {
    const std::vector<double> before = *values;
    for (const std::size_t length : {std::size_t{0}, std::size_t{2}, cells - 1, cells + 1}) {
      values->assign(length, before[0]);
      EXPECT_THROW(make(), ParameterError) << length << " values";
    }
    values->assign(cells, before[0]);
    EXPECT_NO_THROW(make());
    *values = before;
  }
}

TEST_P(ElasticRefusal, ParametersOutOfRange) {
  for (const double nu : {0.5, -1.0, kNaN}) {
    block_.parameters["poisson"] = {nu};
    EXPECT_THROW(make(), ParameterError) << nu;
  }
  block_.parameters["poisson"] = {0.3};
  for (const double E : {0.0, -1.0, kNaN}) {
    block_.parameters["young"].assign(static_cast<std::size_t>(mesh_.cell_count()), 1.0);
    block_.parameters["young"].back() = E;  // one bad cell among good ones
    EXPECT_THROW(make(), ParameterError) << E;
  }
}

TEST_P(ElasticRefusal, DensitiesOutOfRange) {
  for (const double density : {-1.0, kNaN, std::numeric_limits<double>::infinity()}) {
    block_.density = {density};
    EXPECT_THROW(make(), ParameterError) << density;
  }
}

TEST_P(ElasticRefusal, HalfACell) {
  block_.cells.pop_back();
  EXPECT_THROW(make(), Error);
}

INSTANTIATE_TEST_SUITE_P(Elements, ElasticRefusal, testing::Values(Split::none, Split::six),
                         [](const auto& info) { return info.param == Split::none ? "hexahedron" : "tetra"; });

}  // namespace
}  // namespace tissu
