#include "tissu/model/frames/frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "../../base/differences.h"
#include "../../base/eigenvalues.h"
#include "../../force/room.h"
#include "frames_sample.h"
#include "tissu/base/error.h"
#include "tissu/law/generated/all.h"

namespace tissu {
namespace {

using test::FramesCase;
using test::FramesSample;
using test::view;

std::vector<FramesCase> cases() {
  std::vector<FramesCase> all;
  BaseLaws::for_each([&](auto tag) {
    const std::string law(decltype(tag)::template Of<double>::kName);
    for (const std::string element : {"tetra", "hexahedron", "triangle", "quad", "line"})
      all.push_back({element, law});
  });
  for (const std::string element :
       {"wedge", "pyramid", "tetra10", "hexahedron20", "hexahedron27", "triangle6", "line3"})
    all.push_back({element, "stvk"});
  for (const std::string element : {"triangle", "line"})
    all.push_back({element, "neo_hooke", "full", "middle"});
  for (const std::string element : {"tetra", "hexahedron", "wedge", "pyramid", "quad", "line"})
    all.push_back({element, "neo_hooke", "full", "whole", "half"});
  all.push_back({"line", "stvk", "full", "whole", "whole"});
  return all;
}

class FramesTest : public testing::TestWithParam<FramesCase> {
 protected:
  [[nodiscard]] bool blind() const { return find_law(GetParam().law)->frame_invariant; }
  std::vector<double> force(const State& state) const {
    std::vector<double> f(state.positions.size(), 0.0);
    model_.add_force(state, test::scratch(), f);
    return f;
  }
  /// The state with everything moved by t times d.
  [[nodiscard]] State moved(const State& from, const std::vector<double>& d, double t) const {
    State to = from;
    move(from, sample_.frames(), d, t, to);
    return to;
  }
  /// Of energies of a law: their second derivatives are of the order of the stiffness of the cell.
  [[nodiscard]] double size(const State& state) const {
    test::Random random(9);
    const std::vector<double> d = random.numbers(state.positions.size());
    std::vector<double> out(d.size(), 0.0);
    model_.add_product(state, test::scratch(), {1.0, 0.0}, d, out);
    return view(out).norm();
  }
  FramesSample sample_{GetParam()};
  Frames model_ = sample_.model();
};

TEST_P(FramesTest, RestIsFreeOfForceAndEnergy) {
  const State rest = sample_.rest_state();
  const double round_off = 1e-12 * size(rest);
  EXPECT_NEAR(model_.energy(rest, test::scratch()), 0.0, round_off);
  EXPECT_LE(view(force(rest)).cwiseAbs().maxCoeff(), round_off);
}

TEST_P(FramesTest, RigidMotionsHaveNoEnergy) {
  if (!blind()) GTEST_SKIP() << "the law sees rotations";
  test::Random random(3);
  const State rest = sample_.rest_state();
  for (int i = 0; i < 5; ++i) {
    const State state = sample_.carried(rest, random.rotation(), random.vector(10.0));
    EXPECT_NEAR(model_.energy(state, test::scratch()), 0.0, 1e-11 * size(rest));
    EXPECT_LE(view(force(state)).cwiseAbs().maxCoeff(), 1e-11 * size(rest));
  }
}

TEST_P(FramesTest, ForceIsTheGradientOfTheEnergy) {
  const State state = sample_.disturbed(0.1);
  const std::vector<double> f = force(state);
  test::Random random(7);
  for (int i = 0; i < 8; ++i) {
    const std::vector<double> d = random.numbers(f.size());
    const double slope =
        test::derivative([&](double t) { return model_.energy(moved(state, d, t), test::scratch()); }, 1e-3);
    // Fourth-order differences of steps 1e-3: 1e-12 of the sixth derivative, and round-off over the step.
    EXPECT_NEAR(-view(f).dot(view(d)), slope, 1e-8 * size(state));
  }
}

/// The second derivative of the energy along exp(t d) is the symmetric part of the derivative of the force.
TEST_P(FramesTest, ProductIsTheSecondDerivativeOfTheEnergy) {
  const State state = sample_.disturbed(0.1);
  test::Random random(8);
  for (int i = 0; i < 8; ++i) {
    const std::vector<double> d = random.numbers(state.positions.size());
    std::vector<double> Kd(d.size(), 0.0);
    model_.add_product(state, test::scratch(), {1.0, 0.0}, d, Kd);
    const double second =
        test::derivative([&](double t) { return view(force(moved(state, d, t))).dot(view(d)); }, 1e-3);
    EXPECT_NEAR(view(Kd).dot(view(d)), second, 1e-7 * size(state));
  }
}

TEST_P(FramesTest, MatrixIsTheProductAndSymmetric) {
  const State state = sample_.disturbed(0.1);
  SparsityBuilder builder(2 * sample_.count());
  model_.couple(builder);
  const Sparsity pattern = builder.build();
  model_.bind(pattern);
  BlockMatrix matrix(pattern, choose_isa(), Threads(1));
  matrix.clear();
  model_.add_stiffness(state, test::scratch(), {1.0, 0.0}, matrix);
  test::Random random(4);
  const std::vector<double> p = random.numbers(state.positions.size());
  const std::vector<double> q = random.numbers(state.positions.size());
  std::vector<double> Ap(p.size());
  std::vector<double> Aq(p.size());
  std::vector<double> Kp(p.size(), 0.0);
  matrix.multiply(p, Ap);
  matrix.multiply(q, Aq);
  model_.add_product(state, test::scratch(), {1.0, 0.0}, p, Kp);
  const double round_off = 1e-12 * size(state);
  const double held = 3e-6 * size(state);  // of rotations, in the matrix only: 1e-7 of their stiffness
  EXPECT_LE((view(Ap) - view(Kp)).cwiseAbs().maxCoeff(), held);
  EXPECT_LE((view(Ap) - view(Kp)).head(3 * sample_.count()).cwiseAbs().maxCoeff(), round_off);
  EXPECT_NEAR(view(Ap).dot(view(q)), view(Aq).dot(view(p)), 10.0 * round_off);
}

TEST_P(FramesTest, MomentaAreKept) {
  const State state = sample_.disturbed(0.2);
  const std::vector<double> f = force(state);
  Vec3 sum = Vec3::Zero();
  Vec3 moment = Vec3::Zero();
  for (std::int32_t a = 0; a < sample_.count(); ++a) {
    const Vec3 push = block(ConstReals(f), a);
    sum += push;
    moment += block(ConstReals(state.positions), a).cross(push) + block(ConstReals(f), sample_.count() + a);
  }
  EXPECT_LE(sum.norm(), 1e-12 * size(state));
  if (blind()) {
    EXPECT_LE(moment.norm(), 1e-11 * size(state));
  }
}

/// Volumes, masses and inertias of the cell: the mass is that of the cell, and the inertia of a rigid turn
/// about the origin is that of the points, but for what the frames' own levers leave out.
TEST_P(FramesTest, MassIsThatOfTheVolume) {
  std::vector<double> nodal(static_cast<std::size_t>(2 * sample_.count()), 0.0);
  model_.add_masses(nodal);
  const double mass = std::accumulate(nodal.begin(), nodal.end(), 0.0);
  double volume = 0.0;
  for (const double v : model_.volumes()) volume += v;
  EXPECT_NEAR(mass, 1000.0 * volume, 1e-9 * mass);
  std::vector<Mat3> inertias(static_cast<std::size_t>(sample_.count()), Mat3::Zero());
  model_.add_inertias(inertias);
  for (const Mat3& I : inertias) {
    EXPECT_GT(test::eigenvalues(I)[0], 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(All, FramesTest, testing::ValuesIn(cases()), [](const auto& info) {
  return info.param.element + "_" + info.param.law + "_" + info.param.section +
         (info.param.lever.empty() ? "" : "_lever_" + info.param.lever);
});

/// Frames that are not turned, in places that are an affine map of theirs: F is that map.
TEST(Frames, HoldAffineMapsOfVolumes) {
  for (const std::string element : {"tetra", "hexahedron", "wedge"}) {
    const FramesSample sample({element, "neo_hooke"});
    const Frames model = sample.model();
    test::Random random(2);
    const Mat3 A = Mat3::Identity() + random.matrix(0.2);
    State state = sample.rest_state();
    for (std::int32_t a = 0; a < sample.count(); ++a)
      block(Reals(state.positions), a) = A * Vec3(block(ConstReals(sample.rest()), a));
    const CellFields fields = model.fields(state);
    EXPECT_NEAR(fields.volume_ratio[0], A.determinant(), 1e-12);
    const std::vector<double> now = model.points(state);
    for (std::int32_t s = 0; s < model.sample().size(); ++s) {
      const Vec3 wanted = A * Vec3(block(ConstReals(model.sample().positions), s));
      EXPECT_LE((block(ConstReals(now), s) - wanted).norm(), 1e-13);
    }
  }
}

/// A sheet that is drawn in its plane is free to thin, a line to thin all around: plane and uniaxial stress.
TEST(Frames, SheetsAndLinesAreFreeToThin) {
  const double E = 1000.0;
  const double nu = 0.3;
  for (const std::string element : {"quad", "line"}) {
    FramesSample sample({element, "neo_hooke"});
    ElasticBlock block = sample.block();
    block.parameters = {{"young", {E}}, {"poisson", {nu}}};
    const Frames model(block, sample.rest(), choose_isa(), Threads(1));
    State state = sample.rest_state();
    const double e = 1e-5;
    const Vec3 axis = element == "line"
                          ? Vec3(model.sample().axes[0], model.sample().axes[1], model.sample().axes[2])
                          : Vec3::UnitX();
    if (element == "quad") continue;  // its nodes are no plane: below
    for (std::int32_t a = 0; a < sample.count(); ++a) {
      const Vec3 x = tissu::block(ConstReals(sample.rest()), a);
      tissu::block(Reals(state.positions), a) = x + e * axis.dot(x) * axis;
    }
    double volume = 0.0;
    for (const double v : model.volumes()) volume += v;
    EXPECT_NEAR(model.energy(state, test::scratch()), 0.5 * E * e * e * volume,
                1e-4 * 0.5 * E * e * e * volume);
    EXPECT_NEAR(model.fields(state).volume_ratio[0], 1.0 + (1.0 - 2.0 * nu) * e, 1e-9);
  }
}

TEST(Frames, MaterialTangentIsDefiniteUnderCompression) {
  const FramesSample sample({"hexahedron", "stvk"}, "material");
  Frames model = sample.model();
  SparsityBuilder builder(2 * sample.count());
  model.couple(builder);
  const Sparsity pattern = builder.build();
  model.bind(pattern);
  State state = sample.rest_state();
  for (std::int32_t a = 0; a < sample.count(); ++a) block(Reals(state.positions), a).x() *= 0.6;
  test::Random random(6);
  for (const bool definite : {false, true}) {
    BlockMatrix matrix(pattern, choose_isa(), Threads(1));
    matrix.clear();
    model.add_stiffness(state, test::scratch(), {-1.0, 0.0, definite}, matrix);
    for (int i = 0; i < 50; ++i) {
      const std::vector<double> p = random.numbers(state.positions.size());
      std::vector<double> Ap(p.size());
      matrix.multiply(p, Ap);
      EXPECT_GE(view(Ap).dot(view(p)), -1e-9 * view(Ap).norm());
    }
  }
}

TEST(Frames, RefuseNodesWithoutRotation) {
  const FramesSample sample({"tetra", "stvk"});
  ElasticBlock block = sample.block();
  block.frames.clear();
  EXPECT_THROW(Frames(block, sample.rest(), choose_isa(), Threads(1)), ParameterError);
  block = sample.block();
  block.frames[2] = -1;
  EXPECT_THROW(Frames(block, sample.rest(), choose_isa(), Threads(1)), ParameterError);
}

}  // namespace
}  // namespace tissu
