#include "solve/multigrid.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <optional>
#include <set>

#include "../assembly/dense.h"
#include "../base/differences.h"
#include "../base/eigenvalues.h"
#include "../world/sample_worlds.h"
#include "solver_cases.h"
#include "tissu/step/system.h"

/// A multigrid of rigid aggregates: what it is made of, that it stays symmetric, that its iterations stay
/// few.
namespace tissu {
namespace {

using test::dense;
using test::view;

/// A world, its matrix, and where the rows of that are.
class Assembled {
 public:
  explicit Assembled(WorldDescription description, double mass = 0.0)
      : world_(std::move(description)),
        chosen_({.preconditioning = Preconditioning::multigrid}),
        system_(world_, &chosen_, profile_) {
    assemble(mass);
  }
  void assemble(double mass, double stiffness = 1.0) {
    system_.assemble(world_.rest_state(), mass, {-stiffness, 0.0});
  }
  [[nodiscard]] const BlockMatrix& matrix() const { return system_.matrix(); }
  [[nodiscard]] const World& world() const { return world_; }
  [[nodiscard]] const RowPlaces& places() const { return *matrix().places(); }
  [[nodiscard]] LevelMatrix level() const {
    return {&matrix().sparsity().row_begin, &matrix().sparsity().column, matrix().values(), 1.0,
            matrix().given()};
  }
  /// Numbers without a pattern where nothing is given.
  [[nodiscard]] std::vector<double> right_side() const {
    std::vector<double> b = test::Random(3).numbers(static_cast<std::size_t>(3 * world_.blocks()));
    world_.fixed().clear(b);
    return b;
  }
  [[nodiscard]] SolveReport solve(Preconditioning kind, std::vector<double>& x,
                                  Precision precision = Precision::full, double tolerance = 1e-8) const {
    x.assign(static_cast<std::size_t>(3 * world_.blocks()), 0.0);
    return test::gradient_case("", kind, precision).make(tolerance)->solve(matrix(), right_side(), x, 0.0);
  }

 private:
  World world_;
  ConjugateGradient chosen_;
  Profile profile_;
  System system_;
};

/// Tetrahedra, held at the floor or not at all.
WorldDescription cube_of(int cells, bool held = true, int threads = 1) {
  const Mesh mesh = box_mesh(Vec3::Zero(), Vec3::Ones(), {cells, cells, cells}, Split::six);
  WorldDescription description;
  description.threads = threads;
  description.bodies = {test::body_of(mesh, {.young = 1e4})};
  if (held) description.fixed = {test::fixed(test::nodes_at(mesh, 2, 0.0))};
  return description;
}

class Cube : public Assembled {
 public:
  explicit Cube(int cells, bool held = true, double mass = 0.0, int threads = 1)
      : Assembled(cube_of(cells, held, threads), mass) {}
};

/// The motion of rows that a translation and a rotation about the origin make.
Eigen::VectorXd rigid(const RowPlaces& places, const Vec3& translation, const Vec3& rotation) {
  const auto rows = static_cast<Eigen::Index>(places.point.size());
  Eigen::VectorXd motion(3 * rows);
  for (std::int32_t i = 0; i < rows; ++i) {
    motion.segment<3>(3 * i) =
        places.is_rotation(i)
            ? rotation
            : Vec3(translation + rotation.cross(Vec3(block(ConstReals(places.positions), i))));
  }
  return motion;
}

struct Coarse {
  explicit Coarse(const Cube& cube) : level(cube.level()), aggregates(aggregate(level, cube.places())) {
    place_aggregates(aggregates, cube.places(), places);
    pattern.emplace(level, aggregates);
    columns = twice_columns(pattern->prolongation);
    rows = twice_rows(pattern->restriction);
    smoother.make(level, Isa::baseline, Threads(1));
    P.refer(columns.begin, columns.column, Isa::baseline);
    R.refer(rows.begin, rows.column, Isa::baseline);
    fill_prolongation(level, aggregates, cube.places(), places, smoother.inverse(), 1.0 / smoother.largest(),
                      *pattern, Threads(1), P);
    fill_restriction(*pattern, P, Threads(1), R);
  }
  static Eigen::MatrixXd full(const BlockRows<double>& B, const RowPattern& where, Eigen::Index size) {
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3 * where.rows(), size);
    for (std::int32_t i = 0; i < where.rows(); ++i) {
      const std::int64_t first = where.begin[static_cast<std::size_t>(i)];
      const auto row = where.row(i);
      for (std::size_t k = 0; k < row.size(); ++k) {
        result.block<3, 3>(3 * i, 3 * row[k]) =
            Eigen::Map<const Mat3>(B.block(first + static_cast<std::int64_t>(k)));
      }
    }
    return result;
  }
  LevelMatrix level;
  Aggregates aggregates;
  RowPlaces places;
  std::optional<CoarsePattern> pattern;
  RowPattern columns;
  RowPattern rows;
  Chebyshev<double> smoother;
  BlockRows<double> P;
  BlockRows<double> R;
};

TEST(Aggregates, HoldEachFreeRowOnceAndHangTogether) {
  const Cube cube(8);
  const Aggregates found = aggregate(cube.level(), cube.places());
  const Sparsity& pattern = cube.matrix().sparsity();
  std::vector<int> sizes(static_cast<std::size_t>(found.count), 0);
  for (std::int32_t i = 0; i < cube.matrix().rows(); ++i) {
    const std::int32_t own = found.of[static_cast<std::size_t>(i)];
    const bool given = cube.matrix().is_given(i, 0);
    EXPECT_EQ(own < 0, given);
    if (own < 0) continue;
    ASSERT_LT(own, found.count);
    ++sizes[static_cast<std::size_t>(own)];
    bool together = false;  // with a neighbour
    for (auto s = pattern.row_begin[static_cast<std::size_t>(i)];
         s < pattern.row_begin[static_cast<std::size_t>(i) + 1]; ++s) {
      const std::int32_t j = pattern.column[static_cast<std::size_t>(s)];
      together |= j != i && found.of[static_cast<std::size_t>(j)] == own;
    }
    EXPECT_TRUE(together);
  }
  for (const int size : sizes) EXPECT_GE(size, 2);
  // A neighbourhood in this mesh has up to 15 points: 576 free ones give some fifty.
  EXPECT_LE(found.count, 100);
  EXPECT_GE(found.count, 20);
}

/// The ones of axes that are given have no unit: a sheet of nodes that slide is bound as any other.
TEST(Aggregates, DoNotDependOnUnits) {
  const Mesh mesh = box_mesh(Vec3::Zero(), Vec3::Ones(), {7, 7, 7}, Split::six);
  std::vector<std::vector<std::int32_t>> found;
  for (const double young : {1e4, 0x1p-30 * 1e4}) {  // the same bits but for the exponent
    WorldDescription description;
    description.bodies = {test::body_of(mesh, {.young = young})};
    description.fixed = {test::fixed(test::nodes_where(mesh, [](const Vec3&) { return true; }), 4),
                         test::fixed(test::nodes_at(mesh, 0, 0.0))};
    const Assembled body(description);
    const Aggregates aggregates = aggregate(body.level(), body.places());
    EXPECT_GE(aggregates.count, 15);
    found.push_back(aggregates.of);
    std::vector<double> x;
    const SolveReport report = body.solve(Preconditioning::multigrid, x);
    EXPECT_TRUE(report.converged);
    EXPECT_LE(report.iterations, 25);
  }
  EXPECT_EQ(found[0], found[1]);
}

/// 1e6 times as stiff: blocks between the parts are 1e-3 of the mean of their diagonals.
TEST(Aggregates, LeaveAStiffPartAmongItself) {
  const Mesh mesh = box_mesh(Vec3::Zero(), Vec3(8, 4, 4), {8, 4, 4}, Split::six);
  WorldDescription description;
  description.bodies = {test::body_of(mesh)};
  ElasticBlock& elastic = description.bodies[0].elastic[0];
  const std::size_t cells = elastic.cells.size() / 4;
  elastic.parameters["young"].assign(cells, 1e3);
  elastic.parameters["poisson"].assign(cells, 0.3);
  std::vector<bool> stiff(static_cast<std::size_t>(mesh.node_count()), false);
  for (std::size_t e = 0; e < cells; ++e) {
    Vec3 centre = Vec3::Zero();
    for (std::size_t k = 0; k < 4; ++k) centre += 0.25 * mesh.node(elastic.cells[4 * e + k]);
    if (centre[0] < 4.0) continue;
    elastic.parameters["young"][e] = 1e9;
    for (std::size_t k = 0; k < 4; ++k) stiff[static_cast<std::size_t>(elastic.cells[4 * e + k])] = true;
  }
  const Assembled body(description);
  const Aggregates found = aggregate(body.level(), body.places());
  std::vector<std::set<bool>> kinds(static_cast<std::size_t>(found.count));
  for (std::size_t i = 0; i < stiff.size(); ++i) {
    ASSERT_GE(found.of[i], 0);
    kinds[static_cast<std::size_t>(found.of[i])].insert(stiff[i]);
  }
  for (const auto& kind : kinds) EXPECT_EQ(kind.size(), 1U);
}

TEST(Prolongation, CarriesRigidMotionsOfAFreeBodyExactly) {
  const Cube cube(5, false);
  const Coarse coarse(cube);
  const auto size = static_cast<Eigen::Index>(3 * coarse.places.point.size());
  const Eigen::MatrixXd P = Coarse::full(coarse.P, coarse.columns, size);
  for (const auto& [t, w] :
       {std::pair(Vec3(1, -2, 3), Vec3(0, 0, 0)), std::pair(Vec3(0, 0.5, 0), Vec3(2, -1, 3))}) {
    const Eigen::VectorXd fine = rigid(cube.places(), t, w);
    // A times a rigid motion is zero to round-off, which D^-1 leaves as it is
    EXPECT_LE((P * rigid(coarse.places, t, w) - fine).norm(), 1e-13 * fine.norm() * 10.0);
  }
}

TEST(Prolongation, DoesNotMoveWhatIsGiven) {
  const Cube cube(5);
  const Coarse coarse(cube);
  const Eigen::MatrixXd P =
      Coarse::full(coarse.P, coarse.columns, static_cast<Eigen::Index>(3 * coarse.places.point.size()));
  for (std::int32_t i = 0; i < cube.matrix().rows(); ++i) {
    if (cube.matrix().is_given(i, 0)) {
      EXPECT_EQ(P.middleRows<3>(3 * i).cwiseAbs().maxCoeff(), 0.0);
    }
  }
}

/// A P is made in one part and in four, on one thread and on three.
TEST(Prolongation, MakesGalerkinsMatrix) {
  for (const int cells : {5, 9}) {
    const Cube cube(cells);
    const Coarse coarse(cube);
    const auto size = static_cast<Eigen::Index>(3 * coarse.places.point.size());
    const Eigen::MatrixXd P = Coarse::full(coarse.P, coarse.columns, size);
    const Eigen::MatrixXd R = Coarse::full(coarse.R, coarse.rows, 3 * cube.matrix().rows());
    EXPECT_EQ((R - P.transpose()).cwiseAbs().maxCoeff(), 0.0);
    CoarseScratch scratch;
    AlignedVector<double> values;
    fill_coarse_matrix(coarse.level, *coarse.pattern, coarse.P, Threads(1), scratch, values);
    const RowPattern where = twice(coarse.pattern->matrix);
    BlockRows<double> made;
    made.refer(where.begin, where.column, Isa::baseline);
    std::copy_n(values.data(), 9 * where.blocks(), made.block(0));
    const Eigen::MatrixXd wanted = P.transpose() * dense(cube.matrix()) * P;
    EXPECT_LE(test::relative_difference(Coarse::full(made, where, size), wanted), 1e-13);
    AlignedVector<double> again;
    fill_coarse_matrix(coarse.level, *coarse.pattern, coarse.P, Threads(3), scratch, again);
    EXPECT_EQ(again, values);
  }
}

/// Two points on a line: nothing resists their turning about it, and the next level is not singular for that.
TEST(Prolongation, HoldsTurnsAboutALine) {
  const std::vector<std::int64_t> begin{0, 1, 2};
  const std::vector<std::int32_t> column{0, 1};
  std::vector<double> values(18, 0.0);
  for (const std::size_t k : {0U, 4U, 8U, 9U, 13U, 17U}) values[k] = 1.0;
  const LevelMatrix A{&begin, &column, values.data(), 1.0, nullptr};
  const Aggregates aggregates{1, {0, 0}, {2}};
  RowPlaces fine;
  fine.positions = {0, 0, 0, 1, 0, 0};
  fine.point = {0, 1};
  RowPlaces centre;
  place_aggregates(aggregates, fine, centre);
  const CoarsePattern pattern(A, aggregates);
  const RowPattern columns = twice_columns(pattern.prolongation);
  BlockRows<double> P;
  P.refer(columns.begin, columns.column, Isa::baseline);
  fill_prolongation(A, aggregates, fine, centre, values.data(), 0.0, pattern, Threads(1), P);
  CoarseScratch scratch;
  AlignedVector<double> coarse;
  fill_coarse_matrix(A, pattern, P, Threads(1), scratch, coarse);
  // sum over both of [r]x^T [r]x with r = (-+ 1/2, 0, 0) is diag(0, 1/2, 1/2): the zero is held by 1/2
  const Mat3 turning = Eigen::Map<const Mat3>(coarse.data() + 27);
  EXPECT_LE((turning - 0.5 * Mat3::Identity()).norm(), 1e-14);
  EXPECT_LE((Eigen::Map<const Mat3>(coarse.data()) - 2.0 * Mat3::Identity()).norm(), 1e-14);
}

/// CG asks for no more than a symmetric and positive definite preconditioner.
TEST(Multigrid, IsSymmetricAndPositive) {
  const Cube cube(9);
  Multigrid<double> M;
  M.make(cube.matrix(), 1.0);
  const std::vector<std::int32_t> rows = M.level_rows();
  ASSERT_GE(rows.size(), 2U);
  for (std::size_t k = 1; k < rows.size(); ++k) EXPECT_LT(rows[k], rows[k - 1]);
  test::Random random(4);
  const auto size = static_cast<std::size_t>(3 * cube.matrix().rows());
  for (int k = 0; k < 5; ++k) {
    const std::vector<double> a = random.numbers(size);
    const std::vector<double> b = random.numbers(size);
    std::vector<double> Ma(size);
    std::vector<double> Mb(size);
    M.apply(a, Ma);
    M.apply(b, Mb);
    const double scale = std::sqrt(view(a).dot(view(Ma)) * view(b).dot(view(Mb)));
    EXPECT_GT(view(a).dot(view(Ma)), 0.0);
    EXPECT_NEAR(view(a).dot(view(Mb)), view(b).dot(view(Ma)), 1e-12 * scale);
  }
}

TEST(Multigrid, IterationsDoNotGrow) {
  std::vector<double> x;
  for (const Precision precision : {Precision::full, Precision::single}) {
    std::vector<int> iterations;
    for (const int cells : {6, 12, 20}) {
      const SolveReport report = Cube(cells).solve(Preconditioning::multigrid, x, precision);
      EXPECT_TRUE(report.converged);
      iterations.push_back(report.iterations);
    }
    // block-Jacobi's grow as the number of cells along an edge, 3.3 times
    EXPECT_LE(iterations[2], iterations[0] + 6);
    EXPECT_LE(iterations[2], 25);
  }
  EXPECT_GE(Cube(20).solve(Preconditioning::block_jacobi, x).iterations, 150);
}

/// A bar of 8 x 1 x 1 in equilibrium, pulled sideways: its softest motion is a millionth as stiff as its
/// cells, of which a matrix in single precision knows nothing. Only the preconditioner is rounded.
TEST(Multigrid, RoundedTakesNoMoreIterationsOnALongBar) {
  for (const Split split : {Split::six, Split::none}) {
    const Mesh mesh = box_mesh(Vec3::Zero(), {8.0, 1.0, 1.0}, {48, 6, 6}, split);
    WorldDescription description;
    description.bodies = {test::body_of(mesh, {.young = 50e6})};
    description.fixed = {test::fixed(test::nodes_at(mesh, 0, 0.0))};
    const Assembled bar(std::move(description));
    std::vector<double> b(static_cast<std::size_t>(3 * bar.world().blocks()), 0.0);
    for (std::size_t i = 2; i < b.size(); i += 3) b[i] = -1.0;
    bar.world().fixed().clear(b);
    const auto iterations = [&](Precision precision) {
      std::vector<double> x(b.size(), 0.0);
      const auto solver = test::gradient_case("", Preconditioning::multigrid, precision).make(1e-5);
      const SolveReport report = solver->solve(bar.matrix(), b, x, 0.0);
      EXPECT_TRUE(report.converged);
      return report.iterations;
    };
    // It rounds the residual that it is given, so its iterations are others, but not many more.
    EXPECT_LE(iterations(Precision::single), iterations(Precision::full) + 2);
  }
}

/// The diagonal of held rows is 1, in any units. Steel in metres has 1e11 beside it, and a body of 10 Pa 1e2.
TEST(Multigrid, IsPositiveInAnyUnits) {
  for (const double young : {1e-6, 1e1, 1e11, 1e16}) {
    const Mesh mesh = box_mesh(Vec3::Zero(), {20.0, 5.0, 5.0}, {24, 6, 6}, Split::none);
    WorldDescription description;
    description.bodies = {test::body_of(mesh, {.young = young})};
    description.fixed = {test::fixed(test::nodes_at(mesh, 0, 0.0))};
    const Assembled bar(std::move(description));
    std::vector<double> x;
    for (const Precision precision : {Precision::full, Precision::single}) {
      const SolveReport report = bar.solve(Preconditioning::multigrid, x, precision, 1e-6);
      EXPECT_TRUE(report.positive_definite) << young;
      EXPECT_TRUE(report.converged) << young;
      EXPECT_LE(report.iterations, 25) << young;  // 16 are counted
    }
  }
}

/// The first matrix, of inertia alone, binds no rows; the second does, and makes the levels.
TEST(Multigrid, MakesItsLevelsWhenThereIsSomethingToBind) {
  Cube cube(8, true, 1e9);
  Multigrid<double> M;
  M.make(cube.matrix(), 1.0);
  EXPECT_EQ(M.level_rows().size(), 1U);
  cube.assemble(0.0);
  M.make(cube.matrix(), 1.0);
  EXPECT_GE(M.level_rows().size(), 2U);
}

/// Made of one matrix, then of another: what is kept between is not seen in the answer.
TEST(Multigrid, FollowsTheMatrix) {
  Cube cube(7);
  const std::vector<double> r = cube.right_side();
  Multigrid<double> kept;
  kept.make(cube.matrix(), 1.0);
  std::vector<double> first(r.size());
  kept.apply(r, first);
  // Four times the matrix, to the bit: the same aggregates, and a quarter of the answer.
  cube.assemble(0.0, 4.0);
  Multigrid<double> fresh;
  kept.make(cube.matrix(), 1.0);
  fresh.make(cube.matrix(), 1.0);
  std::vector<double> a(r.size());
  std::vector<double> b(r.size());
  kept.apply(r, a);
  fresh.apply(r, b);
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(double)), 0);
  // the ones of given axes, which stay ones, have a part in the start of Lanczos' method
  EXPECT_LE((view(first) - 4.0 * view(a)).norm(), 1e-5 * view(first).norm());
}

/// Lanczos' estimate, against the eigenvalues of the dense matrix: a polynomial that grows beyond it would
/// make the preconditioner indefinite.
TEST(Multigrid, KnowsTheLargestEigenvalue) {
  for (const double moved : {0.0, 0.09}) {
    Mesh mesh = box_mesh(Vec3::Zero(), Vec3::Ones(), {7, 7, 7}, Split::six);
    block(Reals(mesh.positions), 4 * 64 + 4 * 8 + 4)[0] += moved;  // one sliver among good cells
    WorldDescription description;
    description.bodies = {test::body_of(mesh)};
    description.fixed = {test::fixed(test::nodes_at(mesh, 2, 0.0))};
    const Assembled body(description);
    const BlockMatrix& A = body.matrix();
    Chebyshev<double> smoother;
    smoother.make(body.level(), A.isa(), Threads(1));
    const Eigen::MatrixXd full = dense(A);
    Eigen::MatrixXd D = Eigen::MatrixXd::Zero(full.rows(), full.cols());
    for (std::int32_t i = 0; i < A.rows(); ++i) D.block<3, 3>(3 * i, 3 * i) = A.diagonal_block(i);
    const double largest = test::eigenvalues(full, D).maxCoeff();
    // The smoother's polynomial is at most 1 up to 1.155 times what is found.
    EXPECT_GE(smoother.largest(), 0.95 * largest);
    EXPECT_LE(smoother.largest(), 1.15 * largest);
  }
}

TEST(Multigrid, SolvesWithInertiaAlone) {
  const Cube cube(6, true, 1e6);
  std::vector<double> x;
  const SolveReport report = cube.solve(Preconditioning::multigrid, x);
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.iterations, 20);
}

/// A matrix that is not a number: the solve says that it failed, and the next one is right.
TEST(Multigrid, RecoversFromAMatrixThatIsNotFinite) {
  const Cube cube(6);
  BlockMatrix matrix(cube.matrix().sparsity(), cube.matrix().isa(), Threads(1));
  const std::vector<double> b = test::Random(3).numbers(static_cast<std::size_t>(3 * matrix.rows()));
  std::vector<double> x(b.size(), 0.0);
  for (const Precision precision : {Precision::full, Precision::single}) {
    const auto solver = test::gradient_case("", Preconditioning::multigrid, precision).make(1e-8);
    for (std::int64_t k = 0; k < 9 * matrix.sparsity().blocks(); ++k) {
      matrix.values()[k] = std::numeric_limits<double>::quiet_NaN();
    }
    EXPECT_FALSE(solver->solve(matrix, b, x, 0.0).converged);
    std::memcpy(matrix.values(), cube.matrix().values(),
                static_cast<std::size_t>(9 * matrix.sparsity().blocks()) * sizeof(double));
    std::ranges::fill(x, 0.0);
    EXPECT_TRUE(solver->solve(matrix, b, x, 0.0).converged);
  }
}

TEST(Multigrid, GivesTheSameBitsOnAnyNumberOfThreads) {
  std::vector<double> one;
  for (const int threads : {1, 2, 5}) {
    std::vector<double> x;
    EXPECT_TRUE(Cube(9, true, 0.0, threads).solve(Preconditioning::multigrid, x).converged);
    if (threads == 1) one = x;
    EXPECT_EQ(std::memcmp(one.data(), x.data(), x.size() * sizeof(double)), 0) << threads;
  }
}

/// Where the rows are is not given: translations alone are carried, more iterations, the same answer.
TEST(Multigrid, ServesWithoutPlaces) {
  const Cube cube(8);
  BlockMatrix bare(cube.matrix().sparsity(), cube.matrix().isa(), Threads(1));
  std::memcpy(bare.values(), cube.matrix().values(),
              static_cast<std::size_t>(9 * bare.sparsity().blocks()) * sizeof(double));
  std::vector<double> b = test::Random(3).numbers(static_cast<std::size_t>(3 * bare.rows()));
  std::vector<double> x(b.size(), 0.0);
  std::vector<double> y(b.size(), 0.0);
  const auto solver = test::gradient_case("", Preconditioning::multigrid).make(1e-8);
  const SolveReport report = solver->solve(bare, b, x, 0.0);
  EXPECT_TRUE(report.converged);
  bare.multiply(x, y);
  EXPECT_LE((view(b) - view(y)).norm(), 1e-8 * view(b).norm());
}

/// A stiff tie between two far nodes.
TEST(Multigrid, ServesAMatrixWithTies) {
  const Cube cube(6);
  BlockMatrix tied(cube.matrix().sparsity(), cube.matrix().isa(), Threads(1));
  std::memcpy(tied.values(), cube.matrix().values(),
              static_cast<std::size_t>(9 * tied.sparsity().blocks()) * sizeof(double));
  Couplings ties;
  ties.add({{60, tied.rows() - 1, 0, 0}, {-1.0, 1.0, 0.0, 0.0}, 1e5 * Mat3::Identity()});
  ties.close(tied.rows(), nullptr);
  tied.set_couplings(&ties);
  const std::vector<double> b = test::Random(3).numbers(static_cast<std::size_t>(3 * tied.rows()));
  std::vector<double> x(b.size(), 0.0);
  std::vector<double> y(b.size(), 0.0);
  const SolveReport report =
      test::gradient_case("", Preconditioning::multigrid).make(1e-8)->solve(tied, b, x, 0.0);
  EXPECT_TRUE(report.converged);
  tied.multiply(x, y);
  EXPECT_LE((view(b) - view(y)).norm(), 1e-8 * view(b).norm());
}

}  // namespace
}  // namespace tissu
