#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <numeric>

#include "../../base/dense_solution.h"
#include "../../base/eigenvalues.h"
#include "../corotational/corotational_sample.h"
#include "tissu/cell/cell_patches.h"

/// How well displacements control the pressures of patches (inf-sup): for a cube held all around,
///   beta^2 = smallest eigenvalue but 0 of  B A^-1 B^T q = beta^2 M q,
/// B_pa = dv_p/dx_a, M the volumes, A Hooke's stiffness with E = 1, nu = 0. Where beta goes to 0 with the
/// cells, displacements lock or pressures oscillate; pressures that no displacement feels stand like a
/// chessboard. One of them, the same everywhere, is the cube's own.
namespace tissu {
namespace {

struct Control {
  int patches;
  int unfelt;  ///< pressures, but for the one that is the same everywhere
  double beta;
};

class PatchPressures : public testing::TestWithParam<const char*> {
 protected:
  Control control(int n, bool grouped) const {
    const test::CellBox box = test::cell_box(GetParam(), {n, n, n}, 0.0);
    const ReferenceCell cell = reference_cell(GetParam(), "full");
    std::vector<std::int32_t> of_cell = group_cells(GetParam(), box.cells, cell.nodes);
    if (!grouped) std::iota(of_cell.begin(), of_cell.end(), 0);
    const std::vector<int> inside = inner_unknowns(box, n);
    const Eigen::MatrixXd A = stiffness(box)(inside, inside);
    const int patches = *std::ranges::max_element(of_cell) + 1;
    Eigen::MatrixXd B = Eigen::MatrixXd::Zero(patches, static_cast<Eigen::Index>(box.positions.size()));
    const Eigen::VectorXd volumes = add_gradients(box, cell, of_cell, B);
    const Eigen::VectorXd scale = volumes.cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd inner = scale.asDiagonal() * B(Eigen::all, inside);
    const Eigen::MatrixXd S = inner * test::dense_solution(A, inner.transpose());
    const Eigen::VectorXd values = test::eigenvalues(S);
    int zeros = 0;
    while (zeros < patches && values[zeros] < 1e-10) ++zeros;
    return {patches, zeros - 1, zeros < patches ? std::sqrt(values[zeros]) : 0.0};
  }

 private:
  Eigen::MatrixXd stiffness(const test::CellBox& box) const {
    ElasticBlock block = test::corotational_block(box, GetParam());
    block.model = {};
    block.parameters = {{"young", {1.0}}, {"poisson", {0.0}}};
    Elastic elastic(block, box.positions, choose_isa(), Threads(1));
    const Sparsity pattern = test::bind_alone(elastic, static_cast<std::int32_t>(box.positions.size() / 3));
    State state;
    state.positions = box.positions;
    return test::stiffness_of(elastic, state, {-1.0, 0.0}, pattern, choose_isa());
  }
  static std::vector<int> inner_unknowns(const test::CellBox& box, int n) {
    std::vector<int> result;
    const Vec3 corner(0.3, -0.2, 0.1);
    for (int i = 0; i < static_cast<int>(box.positions.size() / 3); ++i) {
      const Vec3 x = block(ConstReals(box.positions), i) - corner;
      if (x.minCoeff() < 1e-9 || x.maxCoeff() > n - 1e-9) continue;
      for (int axis = 0; axis < 3; ++axis) result.push_back(3 * i + axis);
    }
    return result;
  }
  /// Adds to B, and gives the patches' volumes.
  static Eigen::VectorXd add_gradients(const test::CellBox& box, const ReferenceCell& cell,
                                       const std::vector<std::int32_t>& of_cell, Eigen::MatrixXd& B) {
    const auto nodes = static_cast<std::size_t>(cell.nodes);
    Eigen::VectorXd volumes = Eigen::VectorXd::Zero(B.rows());
    for (std::size_t e = 0; e < of_cell.size(); ++e) {
      const std::int32_t* of = box.cells.data() + e * nodes;
      for (const ReferenceCell::Point& point : cell.points) {
        const auto gradient = [&](std::size_t a) {
          return Eigen::Map<const Vec3>(point.gradients[a].data());
        };
        Mat3 J = Mat3::Zero();
        for (std::size_t a = 0; a < nodes; ++a) {
          J += block(ConstReals(box.positions), of[a]) * gradient(a).transpose();
        }
        const double w = point.weight * J.determinant();
        volumes[of_cell[e]] += w;
        const Mat3 inverse = J.inverse().transpose();
        for (std::size_t a = 0; a < nodes; ++a) {
          B.block<1, 3>(of_cell[e], 3 * of[a]) += w * (inverse * gradient(a)).transpose();
        }
      }
    }
    return volumes;
  }
};

/// Measured, cubes of 3 to 6 cells a side: tetrahedra 0.05 to 0.08 and at most 7 unfelt pressures, wedges
/// 0.26 to 0.35 and pyramids 0.25 to 0.39 with none. Cell by cell there are hundreds.
TEST_P(PatchPressures, AreFeltByDisplacements) {
  const bool tetra = std::string_view(GetParam()) == "tetra";
  for (const int n : {3, 5}) {
    const Control patches = control(n, true);
    const Control cells = control(n, false);
    EXPECT_GT(cells.unfelt, 8 * n) << n;
    EXPECT_LE(patches.unfelt, tetra ? 7 : 0) << n;
    EXPECT_GT(patches.beta, tetra ? 0.045 : 0.2) << n;
  }
}

INSTANTIATE_TEST_SUITE_P(Elements, PatchPressures, testing::Values("tetra", "wedge", "pyramid"),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace tissu
