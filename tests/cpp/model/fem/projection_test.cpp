// Definite matrices of continuum elements: every element with every law, in states that a law survives and
// in such that make its tangent indefinite.

#include <cmath>
#include <cstring>

#include "../projection_sample.h"
#include "tissu/law/generated/all.h"
#include "tissu/model/fem/elastic.h"

namespace tissu {
namespace {

using Matrix9 = Eigen::Matrix<double, 9, 9>;

struct Case {
  std::string element;
  std::string law;
  std::string addition;
};

std::string text(const Case& c) { return c.element + "_" + c.law + c.addition; }
void PrintTo(const Case& c, std::ostream* out) { *out << text(c); }

LawParameters typical(const std::string& law) {
  LawParameters parameters;
  for (const LawParameter& p : find_law(law)->parameters) parameters[std::string(p.name)] = {p.typical};
  return parameters;
}

/// dP/dF of a law with its typical parameters, row 3 i + J for F_iJ.
Matrix9 tangent_of(const std::string& name, const Mat3& F) {
  const LawInfo& info = *find_law(name);
  std::vector<double> parameters;
  for (const LawParameter& p : info.parameters) parameters.push_back(p.typical);
  std::vector<double> constants(info.constants.size());
  law_constants(info, parameters, constants);
  Matrix9 result = Matrix9::Zero();
  AllLaws::for_each([&](auto tag) {
    using L = typename decltype(tag)::template Of<double>;
    if (L::kName != name) return;
    L law{};
    std::memcpy(static_cast<void*>(&law), constants.data(), sizeof law);
    Tensor2<double> at;
    for (int k = 0; k < 9; ++k) at(k / 3, k % 3) = F(k / 3, k % 3);
    const Tangent<double> A = law.tangent(at);
    for (int r = 0; r < 9; ++r) {
      for (int c = 0; c < 9; ++c) result(r, c) = A(r / 3, r % 3, c / 3, c % 3);
    }
  });
  return result;
}

class Projection : public testing::TestWithParam<Case> {
 protected:
  Projection() : reference_(reference_cell(GetParam().element, "full")) {
    test::Random random(11);
    for (Vec3 x : test::reference_nodes(GetParam().element)) {
      x += random.vector(0.04);
      positions_.insert(positions_.end(), x.data(), x.data() + 3);
    }
  }
  ElasticBlock block(bool fused = true) const {
    ElasticBlock block;
    block.body = "body";
    block.element = GetParam().element;
    block.law = GetParam().law;
    block.parameters = typical(block.law);
    if (!GetParam().addition.empty()) {
      block.reinforcements = {{GetParam().addition, typical(GetParam().addition)}};
    }
    block.density = {1000.0};
    if (volume()) block.cross_section = {1.0};
    block.model = FemOptions{.fused = fused};
    for (std::int32_t a = 0; a < reference_.nodes; ++a) block.cells.push_back(a);
    return block;
  }
  bool volume() const { return reference_.dimension == 3; }
  Eigen::MatrixXd matrix(const State& state, StiffnessScale scale, Isa isa = choose_isa(),
                         bool fused = true) const {
    Elastic elastic(block(fused), positions_, isa, Threads(1));
    const Sparsity pattern = test::bind_alone(elastic, reference_.nodes);
    return test::stiffness_of(elastic, state, scale, pattern, isa);
  }
  Mat3 gradient(const ReferenceCell::Point& point, ConstReals x) const {
    Mat3 G = Mat3::Zero();
    for (std::size_t a = 0; a < point.gradients.size(); ++a) {
      G += tissu::block(x, static_cast<std::int32_t>(a)) *
           Eigen::Map<const Eigen::RowVector3d>(point.gradients[a].data());
    }
    return G;
  }
  /// Whether the law has a tangent there: those with J^(-2/3) or ln J have none near J = 0, and that of
  /// fibres jumps where they go slack, as they are where all directions are stretched alike.
  bool has_tangent(const State& state) const {
    const std::string& law = GetParam().law;
    const bool any_shape = law == "hooke" || law == "stvk" || law == "stable_neo_hooke";
    if (any_shape && GetParam().addition.empty()) return true;
    for (const auto& point : reference_.points) {
      const Mat3 F = gradient(point, state.positions) * gradient(point, positions_).inverse();
      const double J = F.determinant();
      if (!(J > 0.02)) return false;
      if (GetParam().addition.empty()) continue;
      const double stretch = (F * Vec3(0.6, -0.48, 0.64)).squaredNorm() / std::cbrt(J * J);
      if (std::abs(stretch - 1.0) < 1e-6) return false;
    }
    return true;
  }
  /// sum_g w_g grad_a . A . grad_b with A clamped at every point, all of it dense.
  Eigen::MatrixXd expected(const State& state) const {
    const Eigen::Index n = 3 * reference_.nodes;
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
    for (const auto& point : reference_.points) {
      const Mat3 J = gradient(point, positions_);
      const Mat3 F = gradient(point, state.positions) * J.inverse();
      Matrix9 A = tangent_of(GetParam().law, F);
      if (!GetParam().addition.empty()) A += tangent_of(GetParam().addition, F);
      Eigen::MatrixXd B = Eigen::MatrixXd::Zero(9, n);  // dF = B dx
      for (Eigen::Index a = 0; a < reference_.nodes; ++a) {
        const Eigen::RowVector3d grad =
            Eigen::Map<const Eigen::RowVector3d>(point.gradients[static_cast<std::size_t>(a)].data()) *
            J.inverse();
        for (Eigen::Index i = 0; i < 3; ++i) B.block<3, 1>(3 * i, 3 * a + i) = grad.transpose();
      }
      K += point.weight * J.determinant() * B.transpose() * test::clamped(A) * B;
    }
    return K;
  }

  ReferenceCell reference_;
  std::vector<double> positions_;
};

TEST_P(Projection, HasNoNegativeEigenvalue) {
  for (const std::string& name : test::states()) {
    SCOPED_TRACE(name);
    const State state = test::put(positions_, name);
    if (!volume() || has_tangent(state)) test::expect_definite(matrix(state, test::kDefinite));
  }
}

// Of the laws that come to it, StVK's matrix is indefinite in every state that is squeezed.
TEST_P(Projection, HasSomethingToDo) {
  if (GetParam().law != "stvk" || !GetParam().addition.empty()) return;
  for (const char* name : {"compressed", "halved", "flat"}) {
    EXPECT_LT(test::least_share(matrix(test::put(positions_, name), test::kExact)), -1e-3) << name;
  }
}

TEST_P(Projection, LeavesADefiniteTangentAlone) {
  for (const char* name : {"rest", "stretched"}) {
    SCOPED_TRACE(name);
    const State state = test::put(positions_, name);
    test::expect_near(matrix(state, test::kDefinite), matrix(state, test::kExact), 1e-12);
  }
  if (GetParam().law != "hooke" || !GetParam().addition.empty()) return;
  for (const std::string& name : test::states()) {  // Hooke's, bit for bit
    const State state = test::put(positions_, name);
    EXPECT_EQ(matrix(state, test::kDefinite), matrix(state, test::kExact)) << name;
  }
}

// Round-off of the reference's own eigenvalues is 1e-15; the matrices cancel a few digits.
TEST_P(Projection, IsTheNearestAtEveryPoint) {
  if (!volume()) return;
  for (const std::string& name : test::states()) {
    SCOPED_TRACE(name);
    const State state = test::put(positions_, name);
    if (has_tangent(state)) test::expect_near(matrix(state, test::kDefinite), expected(state), 1e-11);
  }
}

TEST_P(Projection, EveryInstructionSetAndKernelSaysTheSame) {
  for (const std::string& name : test::states()) {
    SCOPED_TRACE(name);
    const State state = test::put(positions_, name);
    if (volume() && !has_tangent(state)) continue;
    const Eigen::MatrixXd one = matrix(state, test::kDefinite);
    for (const Isa isa : test::available_isas()) {
      test::expect_near(matrix(state, test::kDefinite, isa), one, 1e-12);
    }
    test::expect_near(matrix(state, test::kDefinite, choose_isa(), false), one, 1e-12);
  }
}

TEST_P(Projection, TurnsWithTheCell) {
  if (!find_law(GetParam().law)->frame_invariant) return;
  const Mat3 R = Eigen::AngleAxisd(1.1, Vec3(0.36, 0.48, -0.8)).toRotationMatrix();
  for (const std::string& name : test::states()) {
    SCOPED_TRACE(name);
    const State state = test::put(positions_, name);
    if (volume() && !has_tangent(state)) continue;
    test::expect_near(matrix(test::turned(state, R), test::kDefinite),
                      test::turned(matrix(state, test::kDefinite), R), 1e-11);
  }
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const ElementInfo& element : elements()) {
    const std::string name(element.name);
    const auto add = [&](auto tag) {
      all.push_back({name, std::string(decltype(tag)::template Of<double>::kName), ""});
    };
    if (element.dimension < 3) {
      ThinLaws::for_each(add);
      continue;
    }
    BaseLaws::for_each(add);
    for (const char* law : {"neo_hooke", "stvk"}) all.push_back({name, law, "fibre"});
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Every, Projection, testing::ValuesIn(cases()),
                         [](const auto& info) { return text(info.param); });

}  // namespace
}  // namespace tissu
