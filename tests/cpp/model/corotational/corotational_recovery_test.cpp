#include "../../base/singular_values.h"
#include "corotational_sample.h"

/// Cells that are crushed, flat or inside out come back to their rest shape by steps of implicit Euler with
/// damping, and what the model refuses.
namespace tissu {
namespace {

using test::CellBox;

struct RecoveryCase {
  std::string element;
  std::string rotation;
};

void PrintTo(const RecoveryCase& c, std::ostream* out) { *out << c.element << "_" << c.rotation; }

class CorotationalRecovery : public testing::TestWithParam<RecoveryCase> {
 protected:
  static constexpr double kReturned = 1e-3;  ///< of a cell's edge: what the damping leaves after a while

  static CellBox one_cell() {
    CellBox box = test::cell_box(GetParam().element, {1, 1, 1}, 0.05);
    box.cells.resize(static_cast<std::size_t>(find_element(GetParam().element)->nodes));
    CellBox cell;
    for (const std::int32_t node : box.cells) {
      const Vec3 x = block(ConstReals(box.positions), node);
      cell.cells.push_back(static_cast<std::int32_t>(cell.cells.size()));
      cell.positions.insert(cell.positions.end(), x.data(), x.data() + 3);
    }
    return cell;
  }
  static Simulation free_body(const CellBox& box) {
    BodyDescription body;
    body.name = "body";
    body.positions = box.positions;
    body.elastic = {test::corotational_block(box, GetParam().element)};
    body.elastic.front().parameters["young"] = {100.0};
    body.elastic.front().model = CorotationalOptions{.rotation = GetParam().rotation};
    body.rayleigh = RayleighDamping{0.5, 0.01};
    WorldDescription world;
    world.bodies = {body};
    return test::simulate(std::move(world), test::implicit_euler(), test::conjugate_gradient(1e-8));
  }
  /// The largest distance of a node from the rest shape in its nearest position.
  static double off(const std::vector<double>& x, const std::vector<double>& X) {
    const auto count = static_cast<Eigen::Index>(x.size() / 3);
    const Eigen::Map<const Eigen::Matrix3Xd> now(x.data(), 3, count);
    const Eigen::Map<const Eigen::Matrix3Xd> rest(X.data(), 3, count);
    const Eigen::Matrix3Xd a = now.colwise() - now.rowwise().mean();
    const Eigen::Matrix3Xd b = rest.colwise() - rest.rowwise().mean();
    const auto [U, values, V] = test::singular_values(a * b.transpose());
    const double sign = (U * V.transpose()).determinant() < 0.0 ? -1.0 : 1.0;
    const Mat3 R = U * Vec3(1, 1, sign).asDiagonal() * V.transpose();
    return (a - R * b).colwise().norm().maxCoeff();
  }
  static void expect_return(const CellBox& box, const std::vector<double>& start) {
    Simulation simulation = free_body(box);
    simulation.state().positions = start;
    for (int i = 0; i < 200; ++i) simulation.step(0.1);
    EXPECT_LT(off(simulation.state().positions, box.positions), kReturned);
  }
};

TEST_P(CorotationalRecovery, OneCellFromAnywhere) {
  const CellBox box = one_cell();
  const std::size_t size = box.positions.size();
  test::Random random(21);
  expect_return(box, std::vector<double>(size, 0.7));  // all nodes at one point
  std::vector<double> mirrored = box.positions;
  std::vector<double> flat = box.positions;
  std::vector<double> line(size, 0.2);
  for (std::size_t i = 0; i < size; i += 3) {
    mirrored[i] = -mirrored[i];
    flat[i + 1] = 0.2;
    line[i] = box.positions[i];
  }
  expect_return(box, mirrored);
  expect_return(box, flat);
  expect_return(box, line);
  for (int i = 0; i < 20; ++i) expect_return(box, random.numbers(size, i % 2 == 0 ? 1.0 : 0.01));
}

TEST_P(CorotationalRecovery, BoxFromAPointAndFromAPlane) {
  const CellBox box = test::cell_box(GetParam().element, {3, 2, 2}, 0.05);
  expect_return(box, std::vector<double>(box.positions.size(), 0.7));
  std::vector<double> flat = box.positions;
  for (std::size_t i = 0; i < flat.size(); i += 3) flat[i] = 0.2;
  expect_return(box, flat);
}

/// Nodes anywhere: the box may come to rest in another equilibrium, some of its cells inside out. With
/// `frame` moments are not in balance on the way, and it may be left spinning.
TEST_P(CorotationalRecovery, BoxFromNodesAnywhereComesToRest) {
  const CellBox box = test::cell_box(GetParam().element, {3, 2, 2}, 0.05);
  for (unsigned seed = 1; seed < 6; ++seed) {
    Simulation simulation = free_body(box);
    test::Random random(seed);
    simulation.state().positions = random.numbers(box.positions.size(), 1.0);
    const double before = simulation.energy().elastic;
    for (int i = 0; i < 200; ++i) simulation.step(0.1);
    EXPECT_LT(simulation.energy().kinetic, (GetParam().rotation == "polar" ? 1e-4 : 1e-2) * before);
    EXPECT_LT(simulation.energy().elastic, 0.5 * before);
  }
}

std::vector<RecoveryCase> cases() {
  std::vector<RecoveryCase> all;
  for (const char* element : {"tetra", "hexahedron", "wedge", "pyramid"}) {
    for (const char* rotation : {"frame", "polar"}) all.push_back({element, rotation});
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(All, CorotationalRecovery, testing::ValuesIn(cases()),
                         testing::PrintToStringParamName());

class CorotationalRefusal : public testing::Test {
 protected:
  CellBox box_ = test::cell_box("hexahedron", {2, 1, 1}, 0.0);
  ElasticBlock block_ = test::corotational_block(box_, "hexahedron");

  std::string message() const {
    try {
      make_model(block_, box_.positions, Isa::baseline, Threads(1));
    } catch (const Error& error) {
      return error.what();
    }
    return "nothing was refused";
  }
  void expect_refused(std::initializer_list<const char*> words) const {
    EXPECT_THROW(make_model(block_, box_.positions, Isa::baseline, Threads(1)), ParameterError);
    for (const char* word : words) EXPECT_NE(message().find(word), std::string::npos) << message();
  }
};

TEST_F(CorotationalRefusal, TakesTheMeshItself) {
  const auto model = make_model(block_, box_.positions, Isa::baseline, Threads(1));
  EXPECT_EQ(model_name(model->block().model), "corotational");
  EXPECT_EQ(model->reals_per_cell(), 7U);  // J^-1 as a triangle and the volume, one for all points
  EXPECT_GT(model->bytes(), 0U);
}

TEST_F(CorotationalRefusal, Laws) {
  block_.law = "stvk";
  expect_refused({"stvk", "hooke"});
}

TEST_F(CorotationalRefusal, Elements) {
  block_.element = "tetra10";
  expect_refused({"tetra10", "tetra, hexahedron, wedge, pyramid"});
}

TEST_F(CorotationalRefusal, RotationsTangentsAndQuadratures) {
  block_.model = CorotationalOptions{.rotation = "svd"};
  expect_refused({"rotation", "svd", "small, frame and polar"});
  block_.model = CorotationalOptions{.tangent = "secant"};
  expect_refused({"tangent", "secant", "approximate and exact"});
  block_.model = CorotationalOptions{.tangent = "exact"};
  block_.quadrature = "reduced";
  expect_refused({"quadrature", "reduced", "full"});
}

TEST_F(CorotationalRefusal, ParametersOutOfRangeAndCellsInsideOut) {
  block_.parameters["poisson"] = {0.5};
  expect_refused({"poisson"});
  block_.parameters["poisson"] = {0.3};
  std::swap_ranges(block_.cells.begin(), block_.cells.begin() + 4, block_.cells.begin() + 4);
  EXPECT_THROW(make_model(block_, box_.positions, Isa::baseline, Threads(1)), MeshError);
}

}  // namespace
}  // namespace tissu
