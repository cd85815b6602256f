// Definite matrices of one cell of the models that have no quadrature points to clamp: the nearest to the
// cell's own matrix, or what is said here instead.

#include "projection_sample.h"
#include "tissu/force/load.h"
#include "tissu/model/models.h"
#include "tissu/viscosity/prony.h"
#include "tissu/viscosity/rayleigh.h"

namespace tissu {
namespace {

struct Case {
  std::string model;
  std::string element = "tetra";
  std::string law = "stvk";
  std::string rotation = "polar";
};

std::string text(const Case& c) {
  std::string all = c.model + "_" + c.element + "_" + c.law + "_" + c.rotation;
  std::ranges::replace(all, '-', '_');
  return all;
}
void PrintTo(const Case& c, std::ostream* out) { *out << text(c); }

/// Nodes of the reference cell, moved a little.
std::vector<double> rest_of(const std::string& element) {
  std::vector<double> positions;
  test::Random random(11);
  for (Vec3 x : test::reference_nodes(element)) {
    x += random.vector(0.04);
    positions.insert(positions.end(), x.data(), x.data() + 3);
  }
  return positions;
}

ElasticBlock block_of(const Case& c) {
  ElasticBlock block;
  block.body = "body";
  block.element = c.element;
  block.law = c.law;
  block.parameters = {{"young", {3.0}}, {"poisson", {0.4}}};
  block.density = {2.0};
  block.model = options_named(c.model);
  if (auto* corotational = std::get_if<CorotationalOptions>(&block.model))
    *corotational = {.rotation = c.rotation, .tangent = "exact"};
  const auto nodes = static_cast<std::int32_t>(rest_of(c.element).size() / 3);
  for (std::int32_t a = 0; a < nodes; ++a) block.cells.push_back(a);
  return block;
}

Eigen::MatrixXd matrix_of(ForceModel& model, const State& state, StiffnessScale scale,
                          Isa isa = choose_isa()) {
  const Sparsity pattern = test::bind_alone(model, state.blocks());
  return test::stiffness_of(model, state, scale, pattern, isa);
}

class CellProjection : public testing::TestWithParam<Case> {
 protected:
  std::vector<double> positions_ = rest_of(GetParam().element);

  Eigen::MatrixXd matrix(const State& state, StiffnessScale scale, Isa isa = choose_isa()) const {
    const auto model = make_model(block_of(GetParam()), positions_, isa, Threads(1));
    return matrix_of(*model, state, scale, isa);
  }
  /// Neo-Hooke has no energy where a cell is flat or inside out.
  bool has_tangent(const State& state) const {
    if (GetParam().law != "neo_hooke") return true;
    const ConstReals x(state.positions);
    Mat3 edges;
    for (int a = 1; a < 4; ++a) edges.col(a - 1) = block(x, a) - block(x, 0);
    return edges.determinant() > 0.02;
  }
};

TEST_P(CellProjection, IsTheNearest) {
  int indefinite = 0;
  for (const std::string& name : test::states()) {
    SCOPED_TRACE(name);
    const State state = test::put(positions_, name);
    if (!has_tangent(state)) continue;
    const Eigen::MatrixXd exact = matrix(state, test::kExact);
    const Eigen::MatrixXd found = matrix(state, test::kDefinite);
    test::expect_definite(found);
    test::expect_near(found, test::clamped(exact), 1e-12, exact);
    if (test::least_share(exact) < -1e-3) ++indefinite;
  }
  EXPECT_GE(indefinite, 2);
}

TEST_P(CellProjection, LeavesADefiniteMatrixAlone) {
  for (const char* name : {"rest", "stretched"}) {
    const State state = test::put(positions_, name);
    test::expect_near(matrix(state, test::kDefinite), matrix(state, test::kExact), 1e-14);
  }
}

TEST_P(CellProjection, EveryInstructionSetSaysTheSame) {
  for (const std::string& name : test::states()) {
    SCOPED_TRACE(name);
    const State state = test::put(positions_, name);
    if (!has_tangent(state)) continue;
    if (GetParam().model == "corotational" && (name == "line" || name == "mirrored")) continue;  // any R
    for (const Isa isa : test::available_isas()) {
      test::expect_near(matrix(state, test::kDefinite, isa), matrix(state, test::kDefinite), 1e-12);
    }
  }
}

TEST_P(CellProjection, TurnsWithTheCell) {
  const Mat3 R = Eigen::AngleAxisd(1.1, Vec3(0.36, 0.48, -0.8)).toRotationMatrix();
  for (const char* name : {"random", "compressed", "drawn"}) {
    SCOPED_TRACE(name);
    const State state = test::put(positions_, name);
    if (!has_tangent(state)) continue;
    test::expect_near(matrix(test::turned(state, R), test::kDefinite),
                      test::turned(matrix(state, test::kDefinite), R), 1e-11);
  }
}

std::vector<Case> cases() {
  std::vector<Case> all = {{"mass-link"}, {"mass-link", "tetra", "neo_hooke"}};
  for (const char* element : {"tetra", "hexahedron", "wedge", "pyramid"}) {
    for (const char* rotation : {"polar", "frame"}) {
      all.push_back({"corotational", element, "hooke", rotation});
    }
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Every, CellProjection, testing::ValuesIn(cases()),
                         [](const auto& info) { return text(info.param); });

// Each spring's own matrix is clamped: k n n^T is left of one that is too short.
TEST(Projection, OfSpringsIsTheSumOfTheNearestOfEach) {
  const std::vector<double> positions = rest_of("tetra");
  const auto springs = make_model(block_of({"mass-spring"}), positions, choose_isa(), Threads(1));
  const double volume = springs->volumes()[0];
  for (const std::string& name : test::states()) {
    SCOPED_TRACE(name);
    const State state = test::put(positions, name);
    Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(12, 12);
    for (std::int32_t a = 0; a < 4; ++a) {
      for (std::int32_t b = 0; b < a; ++b) {
        const Vec3 d = block(ConstReals(state.positions), a) - block(ConstReals(state.positions), b);
        const double l0 = (block(ConstReals(positions), a) - block(ConstReals(positions), b)).norm();
        const double l = d.norm();
        if (l == 0.0) continue;  // it has no direction
        const double k = 3.0 * volume / (l0 * l0);
        const Mat3 along = d * d.transpose() / (l * l);
        const Mat3 B = k * (l0 / l * along + (1.0 - l0 / l) * Mat3::Identity());
        const Mat3 own = test::clamped(B);
        for (const auto& [row, column, sign] :
             {std::tuple(a, a, 1.0), std::tuple(b, b, 1.0), std::tuple(a, b, -1.0), std::tuple(b, a, -1.0)}) {
          expected.block<3, 3>(3 * row, 3 * column) += sign * own;
        }
      }
    }
    const Eigen::MatrixXd found = matrix_of(*springs, state, test::kDefinite);
    test::expect_definite(found);
    test::expect_near(found, expected, 1e-12);
  }
  const State longer = test::put(positions, "stretched");
  EXPECT_EQ(matrix_of(*springs, longer, test::kDefinite), matrix_of(*springs, longer, test::kExact));
}

TEST(Projection, OfMassTensorIsThatOfContinuumElements) {
  const Mesh mesh = test::distorted_box({2, 2, 2}, Split::six, 0.1);
  ElasticBlock block = test::elastic_block(mesh.blocks[0], {.law = "stvk"});
  block.parameters["young"].assign(static_cast<std::size_t>(mesh.cell_count()), 2.0);
  block.parameters["young"][5] = 7.0;
  const auto continuum = make_model(block, mesh.positions, choose_isa(), Threads(1));
  block.model = MassTensorOptions{};
  const auto tensor = make_model(block, mesh.positions, choose_isa(), Threads(1));
  const std::size_t before = tensor->bytes();
  for (const std::string& name : test::states()) {
    const State state = test::put(mesh.positions, name);
    EXPECT_EQ(matrix_of(*tensor, state, test::kDefinite), matrix_of(*continuum, state, test::kDefinite));
  }
  EXPECT_GT(tensor->bytes(), before);
  // After an edit, with another pattern.
  std::vector<std::size_t> kept;
  for (std::size_t e = 1; e < static_cast<std::size_t>(mesh.cell_count()); ++e) kept.push_back(e);
  const auto left = tensor->without(part_of(tensor->block(), kept), {0});
  const auto anew = make_model(part_of(continuum->block(), kept), mesh.positions, choose_isa(), Threads(1));
  const State state = test::put(mesh.positions, "compressed");
  EXPECT_EQ(matrix_of(*left, state, test::kDefinite), matrix_of(*anew, state, test::kDefinite));
}

// Nothing to do for what is linear in the cell's axes, for df/dv, or for a condensed region.
TEST(Projection, ChangesNothingWhereTheTangentIsNeverIndefinite) {
  const std::vector<double> positions = rest_of("hexahedron");
  ElasticBlock block = block_of({"corotational", "hexahedron", "hooke"});
  block.model = CorotationalOptions{};
  const auto corotational = make_model(block, positions, choose_isa(), Threads(1));
  for (const std::string& name : test::states()) {
    const State state = test::put(positions, name);
    const Eigen::MatrixXd K = matrix_of(*corotational, state, test::kDefinite);
    EXPECT_EQ(K, matrix_of(*corotational, state, test::kExact)) << name;
    test::expect_definite(K);
  }
}

// A branch that remembers a stretch pulls a relaxed body together: its geometric part is indefinite.
TEST(Projection, OfAPronySeries) {
  const std::vector<double> positions = rest_of("hexahedron");
  ElasticBlock block = block_of({"fem", "hexahedron", "stvk"});
  Prony prony(block, {{0.8, 5.0}}, positions, choose_isa(), Threads(1));
  const auto laid = [&](const std::string& name) {
    State state = test::put(positions, name);
    state.memory.assign(1, std::vector<double>(prony.memory_size(), 0.0));
    State before = test::put(positions, "drawn");
    before.memory = state.memory;
    before.time = 1.0;
    prony.remember(before);
    state.memory = before.memory;
    state.memory_time = 1.0;
    state.time = 1.1;
    return state;
  };
  int indefinite = 0;
  for (const std::string& name : test::states()) {
    SCOPED_TRACE(name);
    const State state = laid(name);
    test::expect_definite(matrix_of(prony, state, test::kDefinite));
    if (test::least_share(matrix_of(prony, state, test::kExact)) < -1e-3) ++indefinite;
  }
  EXPECT_GE(indefinite, 2);
}

TEST(Projection, OfRayleighDampingIsThatOfItsBody) {
  const std::vector<double> positions = rest_of("tetra");
  const auto body = make_model(block_of({"fem"}), positions, choose_isa(), Threads(1));
  std::vector<std::unique_ptr<ForceModel>> own;
  own.push_back(make_model(block_of({"fem"}), positions, choose_isa(), Threads(1)));
  Rayleigh rayleigh(std::move(own), {1.0, 1.0, 1.0, 1.0}, 0.0, 0.5);
  const State state = test::put(positions, "compressed");
  const Eigen::MatrixXd K = matrix_of(*body, state, test::kDefinite);
  test::expect_near(matrix_of(rayleigh, state, {-1.0, -2.0, true}), 2.0 * K, 1e-14);
}

TEST(Projection, LeavesFollowerPressureOut) {
  State state;
  state.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  state.velocities.assign(9, 0.0);
  Pressure pressure("wind", {{"triangle", {0, 1, 2}}}, 2.0, {});
  EXPECT_GT(matrix_of(pressure, state, test::kExact).norm(), 0.1);
  EXPECT_EQ(matrix_of(pressure, state, test::kDefinite).norm(), 0.0);
}

}  // namespace
}  // namespace tissu
