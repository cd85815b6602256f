#include <gtest/gtest.h>

#include "../../cell/reference_nodes.h"
#include "../../force/room.h"
#include "../../world/sample_worlds.h"
#include "tissu/assembly/block_matrix.h"
#include "tissu/law/generated/all.h"
#include "tissu/law/law_info.h"
#include "tissu/model/fem/elastic.h"

/// Every element with every law: two ways of computing the same, derivatives by differences, rest, frames.
namespace tissu {
namespace {

/// How a surface or a line lies: bent and tilted in space, or in a plane of constant z.
enum class Lie : std::uint8_t { volume, space, flat };

struct Case {
  std::string element;
  std::string quadrature;
  std::string law;
  Lie lie = Lie::volume;
  Plane plane = Plane::stress;
};

std::string text(const Case& c) {
  const std::string of_volume = c.element + "_" + c.quadrature + "_" + c.law;
  if (c.lie == Lie::volume) return of_volume;
  return of_volume + (c.lie == Lie::space ? "_space" : "_flat") +
         (c.plane == Plane::stress ? "_stress" : "_strain");
}

void PrintTo(const Case& c, std::ostream* out) { *out << text(c); }

LawParameters typical(const LawInfo& law) {
  LawParameters parameters;
  for (const LawParameter& p : law.parameters) parameters[std::string(p.name)] = {p.typical};
  return parameters;
}

/// The reference cell, a little distorted; below three dimensions turned in space or in its plane.
struct Sample {
  std::vector<double> positions;
  ElasticBlock block;
};

Sample sample(const Case& c) {
  Sample made;
  test::Random random(11);
  Mat3 turn = Mat3::Identity();
  if (c.lie == Lie::space) turn = Eigen::AngleAxisd(0.9, Vec3(0.48, -0.6, 0.64)).toRotationMatrix();
  if (c.lie == Lie::flat) turn = Eigen::AngleAxisd(0.9, Vec3::UnitZ()).toRotationMatrix();
  for (Vec3 x : test::reference_nodes(c.element)) {
    for (int i = 0; i < (c.lie == Lie::flat ? 2 : 3); ++i) x[i] += random.number(0.04);
    x = turn * x;
    made.positions.insert(made.positions.end(), x.data(), x.data() + 3);
  }
  made.block.body = "body";
  made.block.element = c.element;
  made.block.quadrature = c.quadrature;
  made.block.law = c.law;
  made.block.parameters = typical(*find_law(c.law));
  made.block.density = {1000.0};
  made.block.plane = c.plane;
  if (c.lie != Lie::volume) made.block.cross_section = {0.3};
  for (std::size_t a = 0; a < made.positions.size() / 3; ++a) {
    made.block.cells.push_back(static_cast<std::int32_t>(a));
  }
  return made;
}

std::vector<std::string> laws_for(int dimension) {
  std::vector<std::string> names;
  if (dimension == 3) {
    BaseLaws::for_each([&](auto tag) { names.emplace_back((decltype(tag)::template Of<double>::kName)); });
  } else {
    ThinLaws::for_each([&](auto tag) { names.emplace_back((decltype(tag)::template Of<double>::kName)); });
  }
  return names;
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const ElementInfo& element : elements()) {
    for (const std::string quadrature : {"reduced", "full", "over"}) {
      if (reference_cell(element.name, quadrature).points.empty()) continue;
      for (const std::string& law : laws_for(element.dimension)) {
        const std::string name(element.name);
        if (element.dimension == 3) {
          all.push_back({name, quadrature, law});
          continue;
        }
        for (const Lie lie : {Lie::space, Lie::flat}) {
          for (const Plane plane : {Plane::stress, Plane::strain})
            all.push_back({name, quadrature, law, lie, plane});
        }
      }
    }
  }
  return all;
}

class ShapeTest : public testing::TestWithParam<Case> {
 protected:
  ShapeTest()
      : sample_(sample(GetParam())), elastic_(sample_.block, sample_.positions, choose_isa(), Threads(1)) {
    state_.positions = sample_.positions;
    state_.velocities.assign(sample_.positions.size(), 0.0);
    test::Random random(5);
    for (double& x : state_.positions) x += random.number(0.03);
  }
  [[nodiscard]] std::vector<double> force(const State& state) const {
    std::vector<double> f(state.positions.size(), 0.0);
    elastic_.add_force(state, test::scratch(), f);
    return f;
  }
  static double size(const std::vector<double>& values) {
    double largest = 0.0;
    for (const double v : values) largest = std::max(largest, std::abs(v));
    return largest;
  }
  Sample sample_;
  Elastic elastic_;
  State state_;
};

/// Central differences with a step of 1e-6 are right to about 1e-9 of the energy's curvature times the step.
TEST_P(ShapeTest, ForceIsMinusTheGradientOfTheEnergy) {
  const std::vector<double> f = force(state_);
  constexpr double h = 1e-5;
  for (std::size_t i = 0; i < f.size(); ++i) {
    State moved = state_;
    moved.positions[i] += h;
    const double up = elastic_.energy(moved, test::scratch());
    moved.positions[i] -= 2 * h;
    EXPECT_NEAR(f[i], -(up - elastic_.energy(moved, test::scratch())) / (2 * h), 2e-6 * size(f)) << i;
  }
}

TEST_P(ShapeTest, ProductIsTheDerivativeOfTheForceAndTheMatrixSaysTheSame) {
  test::Random random(3);
  std::vector<double> p(state_.positions.size());
  for (double& v : p) v = random.number();
  std::vector<double> product(p.size(), 0.0);
  elastic_.add_product(state_, test::scratch(), {1.0, 0.0}, p, product);

  constexpr double h = 1e-6;
  State up = state_;
  State down = state_;
  for (std::size_t i = 0; i < p.size(); ++i) {
    up.positions[i] += h * p[i];
    down.positions[i] -= h * p[i];
  }
  const std::vector<double> f_up = force(up);
  const std::vector<double> f_down = force(down);
  for (std::size_t i = 0; i < p.size(); ++i) {
    EXPECT_NEAR(product[i], (f_up[i] - f_down[i]) / (2 * h), 1e-6 * size(product)) << i;
  }

  SparsityBuilder builder(static_cast<std::int32_t>(p.size() / 3));
  elastic_.couple(builder);
  const Sparsity sparsity = builder.build();
  elastic_.bind(sparsity);
  BlockMatrix matrix(sparsity, choose_isa(), Threads(1));
  elastic_.add_stiffness(state_, test::scratch(), {1.0, 0.0}, matrix);
  std::vector<double> out(p.size(), 0.0);
  matrix.multiply(p, out);
  for (std::size_t i = 0; i < p.size(); ++i) EXPECT_NEAR(out[i], product[i], 1e-12 * size(product)) << i;
  for (std::int32_t a = 0; a < sparsity.rows(); ++a) {
    for (std::int32_t b = 0; b < sparsity.rows(); ++b) {
      const Eigen::Map<const Mat3> ab(matrix.values() + 9 * sparsity.slot(a, b));
      const Eigen::Map<const Mat3> ba(matrix.values() + 9 * sparsity.slot(b, a));
      EXPECT_LT((ab - ba.transpose()).cwiseAbs().maxCoeff(), 1e-12 * size(product) * 100);
    }
  }
}

TEST_P(ShapeTest, RestAndRigidMotionsHaveNoForce) {
  State rest = state_;
  rest.positions = sample_.positions;
  const double scale = size(force(state_));
  EXPECT_LT(size(force(rest)), 1e-12 * scale);
  if (GetParam().law == "hooke") return;  // not frame-invariant, and not meant to be
  const Mat3 R = Eigen::AngleAxisd(1.1, Vec3(0.36, 0.48, -0.8)).toRotationMatrix();
  State turned = state_;
  for (std::int32_t i = 0; i < turned.blocks(); ++i) {
    block(Reals(turned.positions), i) = R * block(ConstReals(sample_.positions), i) + Vec3(1.0, 2.0, 3.0);
  }
  EXPECT_LT(size(force(turned)), 1e-11 * scale);
  // A turned strained body has the turned force.
  const std::vector<double> f = force(state_);
  for (std::int32_t i = 0; i < turned.blocks(); ++i) {
    block(Reals(turned.positions), i) = R * block(ConstReals(state_.positions), i);
  }
  const std::vector<double> g = force(turned);
  for (std::int32_t i = 0; i < turned.blocks(); ++i) {
    EXPECT_LT((R * block(ConstReals(f), i) - block(ConstReals(g), i)).norm(), 1e-11 * scale);
  }
}

TEST_P(ShapeTest, FusedKernelsSayTheSame) {
  ElasticBlock other = sample_.block;
  other.model = FemOptions{.fused = false};
  const Elastic by_shape(other, sample_.positions, choose_isa(), Threads(1));
  std::vector<double> f(state_.positions.size(), 0.0);
  by_shape.add_force(state_, test::scratch(), f);
  const std::vector<double> expected = force(state_);
  for (std::size_t i = 0; i < f.size(); ++i) EXPECT_NEAR(f[i], expected[i], 1e-12 * size(expected));
  EXPECT_NEAR(by_shape.energy(state_, test::scratch()), elastic_.energy(state_, test::scratch()),
              1e-12 * elastic_.energy(state_, test::scratch()));
  const CellFields a = by_shape.fields(state_);
  const CellFields b = elastic_.fields(state_);
  EXPECT_NEAR(a.von_mises[0], b.von_mises[0], 1e-11 * b.von_mises[0]);
  EXPECT_NEAR(a.volume_ratio[0], b.volume_ratio[0], 1e-12);
}

TEST_P(ShapeTest, MassesArePositiveAndSumToTheMassOfTheVolume) {
  std::vector<double> masses(state_.positions.size() / 3, 0.0);
  std::vector<double> weights(masses.size(), 0.0);
  elastic_.add_masses(masses);
  elastic_.add_weights(weights);
  double mass = 0.0;
  double weight = 0.0;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    if (GetParam().quadrature != "reduced") {
      EXPECT_GT(masses[i], 0.0);
    }
    mass += masses[i];
    weight += weights[i];
  }
  EXPECT_NEAR(mass, 1000.0 * elastic_.volumes()[0], 1e-12 * mass);
  EXPECT_NEAR(weight, mass, 1e-12 * mass);
}

INSTANTIATE_TEST_SUITE_P(Every, ShapeTest, testing::ValuesIn(cases()),
                         [](const auto& info) { return text(info.param); });

}  // namespace
}  // namespace tissu
