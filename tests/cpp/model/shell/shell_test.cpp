#include "tissu/model/shell/shell.h"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

#include "../../force/room.h"
#include "../../force/verbs.h"
#include "../projection_sample.h"
#include "shell_mesh.h"
#include "tissu/base/error.h"
#include "tissu/model/models.h"

/// What models_test.cpp asks of the models of volumes, with rotations.
namespace tissu {
namespace {

using test::Random;
using test::ShellMesh;

/// A part of a cylinder whose frames are numbered otherwise than its nodes, behind two blocks of others.
class ShellTest : public testing::Test {
 protected:
  explicit ShellTest(int n = 4)
      : mesh_(test::grid(n, n, [](double x, double y) { return Vec3(std::sin(x), y, std::cos(x)); })) {
    nodes_ = static_cast<std::int32_t>(mesh_.nodes.size());
    rest_.resize(static_cast<std::size_t>(6 * nodes_ + 6), 0.0);
    for (std::int32_t i = 0; i < nodes_; ++i) {
      tissu::block(Reals(rest_), i) = mesh_.nodes[static_cast<std::size_t>(i)];
    }
  }

  std::int32_t frame(std::int32_t node) const { return nodes_ - 1 - node; }
  std::int32_t rotation(std::int32_t frame) const { return nodes_ + 2 + frame; }

  ElasticBlock block() const {
    ElasticBlock block;
    block.body = "wall";
    block.element = "triangle";
    block.law = "hooke";
    block.model = ShellOptions{};
    block.parameters = {{"young", {}}, {"poisson", {0.3}}};
    block.density = {2.0};
    block.cross_section.clear();
    Random random(2);
    for (const auto& cell : mesh_.cells) {
      for (const int node : cell) {
        block.cells.push_back(node);
        block.frames.push_back(frame(node));
      }
      block.parameters["young"].push_back(10.0 + random.number());
      block.cross_section.push_back(0.05 + random.number(0.01));
    }
    block.first_rotation = rotation(0);
    return block;
  }
  std::unique_ptr<BodyModel> made(int threads = 1) const {
    return make_model(block(), rest_, Isa::baseline, Threads(threads));
  }
  State at_rest() const {
    State state;
    state.positions = rest_;
    state.velocities.assign(rest_.size(), 0.0);
    state.rotations.assign(static_cast<std::size_t>(nodes_), Quaternion::Identity());
    return state;
  }
  /// Of a change p of every block: nodes move, frames turn.
  State moved(const State& state, ConstReals p, double t) const {
    State to = state;
    for (std::int32_t i = 0; i < nodes_; ++i) {
      tissu::block(Reals(to.positions), i) += t * tissu::block(p, i);
      Quaternion& q = to.rotations[static_cast<std::size_t>(i)];
      q = Quaternion(test::turn(t * tissu::block(p, rotation(i)))) * q;
    }
    return to;
  }
  /// Zero in the blocks of nobody.
  std::vector<double> any_change(unsigned seed, double size) const {
    std::vector<double> p = Random(seed).numbers(rest_.size(), size);
    std::fill_n(p.begin() + 3 * nodes_, 6, 0.0);
    return p;
  }
  /// Nodes and frames moved by a fifth of an edge, and all of it turned.
  State any_state() const {
    State state = moved(at_rest(), any_change(7, 0.05), 1.0);
    const Quaternion R = Random(1).rotation();
    for (std::int32_t i = 0; i < nodes_; ++i) {
      tissu::block(Reals(state.positions), i) = R * Vec3(tissu::block(ConstReals(state.positions), i));
      state.rotations[static_cast<std::size_t>(i)] = R * state.rotations[static_cast<std::size_t>(i)];
    }
    return state;
  }

  ShellMesh mesh_;
  std::int32_t nodes_ = 0;
  std::vector<double> rest_;
};

TEST_F(ShellTest, SaysWhatItIs) {
  const ModelInfo& info = *find_model("shell");
  for (const Ability* ability :
       {&info.poisson, &info.rotation, &info.strain, &info.inversion, &info.topology}) {
    EXPECT_FALSE(ability->how.empty());
  }
  const auto model = made();
  EXPECT_EQ(model->effect(), "shell");
  EXPECT_EQ(model->cell_count(), static_cast<std::int32_t>(mesh_.cells.size()));
  EXPECT_EQ(model->nodes_per_cell(), 3);
  EXPECT_GT(model->bytes(), 0U);
  EXPECT_GT(model->reals_per_cell(), 0U);
}

TEST_F(ShellTest, HasMassAndInertiaOfItsCells) {
  const auto model = made();
  std::vector<double> masses(rest_.size() / 3, 0.0);
  std::vector<double> weights(rest_.size() / 3, 0.0);
  std::vector<Mat3> inertias(static_cast<std::size_t>(nodes_), Mat3::Zero());
  model->add_masses(masses);
  model->add_weights(weights);
  model->add_inertias(inertias);
  const double volume = std::accumulate(model->volumes().begin(), model->volumes().end(), 0.0);
  EXPECT_NEAR(std::accumulate(masses.begin(), masses.end(), 0.0), 2.0 * volume, 1e-14);
  EXPECT_EQ(masses, weights);
  for (std::int32_t i = 0; i < nodes_; ++i) {
    const Mat3& inertia = inertias[static_cast<std::size_t>(frame(i))];
    EXPECT_EQ(inertia, inertia(0, 0) * Mat3::Identity());
    // m A / 8 of right triangles with sides 1/4, a little less along the chord
    EXPECT_NEAR(inertia(0, 0) / masses[static_cast<std::size_t>(i)], 1.0 / 32.0 / 8.0, 2e-5);
  }
}

TEST_F(ShellTest, RestsAtRestHoweverItIsTurned) {
  const auto model = made();
  State state = at_rest();
  const double scale = test::force_of(*model, any_state()).norm();
  EXPECT_LT(test::force_of(*model, state).norm(), 1e-13 * scale);
  const Quaternion R = Random(1).rotation();
  for (std::int32_t i = 0; i < nodes_; ++i) {
    tissu::block(Reals(state.positions), i) =
        R * Vec3(tissu::block(ConstReals(state.positions), i)) + Vec3(1.0, 2.0, 3.0);
    state.rotations[static_cast<std::size_t>(i)] = R;
  }
  EXPECT_LT(test::force_of(*model, state).norm(), 1e-13 * scale);
  EXPECT_LT(model->energy(state, test::scratch()), 1e-26);
}

// Differences of fourth order, h = 1e-3 of an edge of 1/4: 1e-8 of the force.
TEST_F(ShellTest, ForceIsMinusTheGradientOfItsEnergy) {
  const auto model = made();
  const State state = any_state();
  const Eigen::VectorXd f = test::force_of(*model, state);
  for (unsigned seed = 20; seed < 25; ++seed) {
    const std::vector<double> p = any_change(seed, 1.0);
    const double slope =
        test::derivative([&](double t) { return model->energy(moved(state, p, t), test::scratch()); }, 1e-3);
    EXPECT_NEAR(f.dot(test::view(p)), -slope, 1e-8 * f.norm() * test::view(p).norm());
  }
}

TEST_F(ShellTest, ProductIsItsMatrixIsTheDerivativeOfTheForce) {
  const auto model = made();
  const Sparsity pattern = test::bind_alone(*model, static_cast<std::int32_t>(rest_.size() / 3));
  const State state = any_state();
  const std::vector<double> p = any_change(5, 1.0);
  const Eigen::MatrixXd K = test::stiffness_of(*model, state, {-0.3, 0.0}, pattern);
  const Eigen::VectorXd Kp = test::product_of(*model, state, {-0.3, 0.0}, p);
  EXPECT_LT((K * test::view(p) - Kp).norm(), 1e-13 * Kp.norm());
  EXPECT_EQ(K, K.transpose());
  EXPECT_EQ(test::product_of(*model, state, {0.0, 1.0}, p).norm(), 0.0);  // elastic: no df/dv

  // What is left out is 1/2 m x p in the blocks of rotations, m the moment on the frame.
  const Eigen::VectorXd f = test::force_of(*model, state);
  Eigen::VectorXd change =
      test::derivative([&](double t) { return test::force_of(*model, moved(state, p, t)); }, 1e-3);
  for (std::int32_t i = 0; i < nodes_; ++i) {
    const Eigen::Index at = 3 * rotation(i);
    change.segment<3>(at) += 0.5 * Vec3(f.segment<3>(at)).cross(Vec3(test::view(p).segment<3>(at)));
  }
  EXPECT_LT((0.3 * change + Kp).norm(), 1e-7 * Kp.norm());
}

TEST_F(ShellTest, HasADefiniteMatrixWhenAskedFor) {
  const auto model = made();
  const Sparsity pattern = test::bind_alone(*model, static_cast<std::int32_t>(rest_.size() / 3));
  for (const State& state : {at_rest(), any_state(), moved(any_state(), any_change(8, 2.0), 1.0)}) {
    const Eigen::MatrixXd K = test::stiffness_of(*model, state, test::kDefinite, pattern);
    test::expect_definite(K, test::stiffness_of(*model, state, test::kExact, pattern));
    test::expect_near(test::stiffness_of(*model, state, {0.25, 0.0, true}, pattern), -0.25 * K, 1e-15);
  }
  test::expect_near(test::stiffness_of(*model, at_rest(), test::kDefinite, pattern),
                    test::stiffness_of(*model, at_rest(), test::kExact, pattern), 1e-13);
}

TEST_F(ShellTest, KnowsEnergyAndStressOfItsCells) {
  const auto model = made();
  const State state = any_state();
  const CellFields fields = model->fields(state);
  double energy = 0.0;
  for (std::size_t i = 0; i < mesh_.cells.size(); ++i) {
    energy += fields.energy_density[i] * model->volumes()[i];
    EXPECT_GT(fields.von_mises[i], 0.0);
    EXPECT_GT(fields.volume_ratio[i], 0.0);
  }
  EXPECT_NEAR(energy, model->energy(state, test::scratch()), 1e-13 * energy);
  EXPECT_NEAR(model->fields(at_rest()).volume_ratio[3], 1.0, 1e-14);
}

TEST_F(ShellTest, TakesItsFramesAlongWhenItIsCut) {
  const ElasticBlock part = part_of(block(), {1, 3});
  ASSERT_EQ(part.frames.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(part.frames[i], frame(part.cells[i]));
  EXPECT_EQ(make_model(part, rest_, Isa::baseline, Threads(1))->cell_count(), 2);
}

TEST_F(ShellTest, RefusesWhatItDoesNotTake) {
  const auto message = [&](auto&& change) -> std::string {
    ElasticBlock wrong = block();
    change(wrong);
    try {
      (void)make_model(wrong, rest_, Isa::baseline, Threads(1));
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  const auto expect = [&](auto&& change, const char* words) {
    const std::string found = message(change);
    EXPECT_NE(found.find(words), std::string::npos) << found;
  };
  expect([](ElasticBlock& b) { b.element = "tetra"; }, "this model takes triangle");
  expect([](ElasticBlock& b) { b.law = "stvk"; }, "this model takes hooke");
  expect([](ElasticBlock& b) { b.quadrature = "reduced"; }, "this model takes full");
  expect([](ElasticBlock& b) { b.plane = Plane::strain; }, "take plane stress");
  expect([](ElasticBlock& b) { b.frames.clear(); }, "the frame of its node");
  expect([](ElasticBlock& b) { b.frames[0] = b.frames[1]; }, "one frame of its own");
  expect([](ElasticBlock& b) { b.frames[0] = -1; }, "one frame of its own");
  expect([](ElasticBlock& b) { b.density = {-1.0}; }, "density of -1");
  expect([](ElasticBlock& b) { b.cross_section = {0.0}; }, "thickness");
  expect([](ElasticBlock& b) { b.parameters["young"] = {-3.0}; }, "young");
  expect([](ElasticBlock& b) { b.model = ShellOptions{.drilling = 0.0}; }, "drilling");
  expect([](ElasticBlock& b) { b.cells[1] = b.cells[0], b.frames[1] = b.frames[0]; }, "no volume");
}

/// 1152 cells: several chunks of each colour.
class LargeShellTest : public ShellTest {
 protected:
  LargeShellTest() : ShellTest(24) {}
};

TEST_F(LargeShellTest, GivesTheSameBitsForAnyNumberOfThreads) {
  const auto one = made();
  const Sparsity pattern = test::bind_alone(*one, static_cast<std::int32_t>(rest_.size() / 3));
  const State state = moved(at_rest(), any_change(7, 0.01), 1.0);
  const std::vector<double> p = any_change(5, 1.0);
  const auto values = [&](const BodyModel& model) {
    BlockMatrix matrix(pattern, Isa::baseline, Threads(1));
    matrix.clear();
    model.add_stiffness(state, test::scratch(), {-1.0, 0.0, false}, matrix);
    return std::vector<double>(matrix.values(), matrix.values() + 9 * pattern.blocks());
  };
  for (const int threads : {2, 3, 4}) {
    const auto other = made(threads);
    other->bind(pattern);
    EXPECT_EQ(test::force_of(*other, state), test::force_of(*one, state));
    EXPECT_EQ(test::product_of(*other, state, {-1.0, 0.0}, p), test::product_of(*one, state, {-1.0, 0.0}, p));
    EXPECT_EQ(values(*other), values(*one));
    EXPECT_EQ(other->energy(state, test::scratch()), one->energy(state, test::scratch()));
  }
}

}  // namespace
}  // namespace tissu
