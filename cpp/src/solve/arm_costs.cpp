#include "arm_costs.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "preconditioner.h"
#include "sparse_factor.h"
#include "tissu/assembly/row_places.h"
#include "work.h"

namespace tissu {
namespace {

/// Of D^-1 A with the blocks D on the diagonal, for cells of four to eight nodes.
constexpr double kLargest = 3.0;
/// Iterations for each cell along a cube that one side holds, to 1e-6: docs/solvers.md.
constexpr double kForACell = 12.8;
constexpr double kOfTolerance = 14.5;  ///< ln(2 / 1e-6), at which the numbers here were found
/// Iterations of block-Jacobi for one of incomplete Cholesky.
constexpr double kSaved = 3.2;
constexpr double kCycles = 11.0;        ///< iterations of a multigrid
constexpr double kGuessed = 0.7;        ///< of them, where a motion goes on
constexpr double kGuesses = 1.0;        ///< what the products of a guess cost, in iterations of a multigrid
constexpr double kWaveRatio = 3.5;      ///< of the moduli of plane waves at Poisson's ratio 0.3
constexpr double kInside = 0.05;        ///< of the forces of neighbours, what is left inside a body
constexpr double kSheetCycles = 5.0;    ///< times as many at least for a body of one cell through
constexpr double kCycleProducts = 6.0;  ///< products, with those of the coarser levels, that a cycle costs
constexpr double kLevelsMade = 110.0;   ///< products that making all levels costs, …
constexpr double kFewRows = 300.0;  ///< … of a matrix of many more rows, whose inner ones have all neighbours
/// Products that an incomplete factor costs, for each byte of a row: it multiplies pairs of its blocks.
constexpr double kTriangleMade = 0.011;
constexpr double kStale = 4.0;  ///< iterations with the factor of an earlier matrix
/// Solves that a preconditioner serves while a body moves, and in Newton's iterations.
constexpr double kServesSteps = 20.0;
constexpr double kServesNewton = 2.0;

/// Rows that hang together with others: not those that are given, or eliminated.
std::vector<std::int32_t> bound_rows(const BlockMatrix& A) {
  std::vector<std::int32_t> rows;
  const Sparsity& pattern = A.sparsity();
  for (std::int32_t i = 0; i < A.rows(); ++i) {
    if (pattern.end_of(i) - pattern.begin_of(i) > 1) rows.push_back(i);
  }
  return rows;
}

/// Extents of the cloud of points, as those of a box with the same second moments.
Vec3 extents_of(const RowPlaces& places, const std::vector<std::int32_t>& rows) {
  const auto count = static_cast<double>(rows.size());
  Vec3 mean = Vec3::Zero();
  for (const std::int32_t i : rows) mean += block(ConstReals(places.positions), i);
  mean /= count;
  Mat3 moments = Mat3::Zero();
  for (const std::int32_t i : rows) {
    const Vec3 arm = block(ConstReals(places.positions), i) - mean;
    moments += arm * arm.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(moments / count, Eigen::EigenvaluesOnly);
  return (12.0 * eigen.eigenvalues().cwiseMax(0.0)).cwiseSqrt().reverse();
}

void count_cells(const RowPlaces* places, const std::vector<std::int32_t>& rows, MatrixShape& shape) {
  shape.along = shape.across = shape.through = std::cbrt(shape.rows);
  if (places == nullptr || places->point.empty()) return;
  const Vec3 extents = extents_of(*places, rows);
  if (!(extents[0] > 0.0) || !extents.allFinite()) return;
  double edge = std::cbrt(extents.prod() / shape.rows);  // of a cell: a box, a sheet or a line of them
  if (extents[2] < edge || !(edge > 0.0)) edge = std::sqrt(extents[0] * extents[1] / shape.rows);
  if (extents[1] < edge || !(edge > 0.0)) edge = extents[0] / shape.rows;
  shape.along = std::max(1.0, extents[0] / edge);
  shape.across = std::max(1.0, extents[1] / edge);
  shape.through = std::max(1.0, extents[2] / edge);
}

bool is_point(const BlockMatrix& A, std::int32_t row) {
  const bool turns = A.places() != nullptr && !A.places()->point.empty() && A.places()->is_rotation(row);
  return !turns && !A.is_given(row, 0) && !A.is_given(row, 1) && !A.is_given(row, 2);
}

double inertia_of(const BlockMatrix& A, const std::vector<std::int32_t>& rows) {
  std::vector<double> ratios;
  ratios.reserve(rows.size());
  const Sparsity& pattern = A.sparsity();
  const bool turns = A.places() != nullptr && !A.places()->point.empty();
  for (const std::int32_t i : rows) {
    if (!is_point(A, i)) continue;
    double sum = 0.0;
    for (std::int64_t b = pattern.begin_of(i); b < pattern.end_of(i); ++b) {
      if (turns && A.places()->is_rotation(pattern.column[static_cast<std::size_t>(b)])) continue;
      sum += A.values()[9 * b] + A.values()[9 * b + 4] + A.values()[9 * b + 8];
    }
    const double diagonal = A.diagonal_block(i).trace();
    if (diagonal > 0.0) ratios.push_back(std::clamp(sum / diagonal, 0.0, 1.0));
  }
  if (ratios.empty()) return 0.0;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::ranges::nth_element(ratios, middle);
  return *middle;
}

/// Moduli of plane waves, lambda + 2 mu and mu, times a volume: of a body inside, -1/2 sum_j A_ij d_k d_l
/// with d = x_j - x_i are the second moments of what a row does to its neighbours. Inside no force is left of
/// a motion that is affine.
struct WaveModuli {
  double longitudinal = 0.0;
  double transverse = 0.0;

  void add(const BlockMatrix& A, std::int32_t i) {
    const Sparsity& pattern = A.sparsity();
    const ConstReals places(A.places()->positions);
    double along = 0.0;
    double all = 0.0;
    Vec3 force = Vec3::Zero();
    double size = 0.0;
    for (std::int64_t b = pattern.begin_of(i); b < pattern.end_of(i); ++b) {
      const Vec3 d = block(places, pattern.column[static_cast<std::size_t>(b)]) - block(places, i);
      const double* value = A.values() + 9 * b;
      const Vec3 diagonal(value[0], value[4], value[8]);
      force += diagonal.cwiseProduct(d);
      size += diagonal.cwiseProduct(d).norm();
      along -= diagonal.dot(d.cwiseAbs2());
      all -= diagonal.sum() * d.squaredNorm();
    }
    if (force.norm() > kInside * size) return;
    longitudinal += along / 3.0;
    transverse += (all - along) / 6.0;
  }
};

double wave_ratio_of(const BlockMatrix& A, const std::vector<std::int32_t>& rows) {
  if (A.places() == nullptr || A.places()->point.empty()) return 1.0;
  WaveModuli sum;
  for (const std::int32_t i : rows) {
    if (is_point(A, i)) sum.add(A, i);
  }
  return sum.longitudinal > 0.0 && sum.transverse > 0.0 ? sum.longitudinal / sum.transverse : 1.0;
}

/// Of the condition number, over that of Poisson's ratio 0.3. Iterations of a multigrid grow with its root;
/// those of block-Jacobi, which in so many rows sees less of it, with its cubic root: five times as many at
/// 0.499.
double stiffer(const MatrixShape& shape) { return std::max(1.0, shape.wave_ratio / kWaveRatio); }

/// Unknowns of a separator of the matrix's graph.
double separator(const MatrixShape& shape) { return 3.0 * std::max(1.0, shape.across * shape.through); }

}  // namespace

std::string_view name_of(Arm arm) {
  constexpr ForArms<std::string_view> kNames = {"block_jacobi", "incomplete_cholesky", "multigrid",
                                                "stale_cholesky", "cholesky"};
  return kNames[number(arm)];
}

MatrixShape shape_of(const BlockMatrix& A, bool equilibrium) {
  MatrixShape shape;
  const std::vector<std::int32_t> rows = bound_rows(A);
  shape.rows = std::max(1.0, static_cast<double>(rows.size()));
  shape.bytes = static_cast<double>(A.bytes());
  if (rows.empty()) return shape;
  count_cells(A.places(), rows, shape);
  if (!equilibrium) shape.inertia = inertia_of(A, rows);
  shape.wave_ratio = wave_ratio_of(A, rows);
  return shape;
}

double plain_iterations(const MatrixShape& shape, double tolerance) {
  const double digits = std::log(2.0 / tolerance);
  const double bending = shape.along * std::max(1.0, shape.along / shape.through);
  const double still = kForACell * std::cbrt(stiffer(shape)) * bending * digits / kOfTolerance;
  const double moving = 0.5 * std::sqrt(kLargest / std::max(shape.inertia, 1e-12)) * digits;
  return std::max(1.0, std::min({still, moving, 3.0 * shape.rows}));
}

double factor_bytes(const MatrixShape& shape) {
  return sizeof(double) * 3.0 * shape.rows * (30.0 + 0.5 * separator(shape));
}

ForArms<Cost> predicted_costs(const MatrixShape& shape, double plain, double tolerance,
                              const Changes& changes, bool equilibrium) {
  const double digits = std::log(2.0 / tolerance) / kOfTolerance;
  const double product = 0.5 * shape.bytes;  // in single precision
  const double iteration = product + 0.5 * kVectorBytes * shape.rows;
  const double once = (kConversion + 1.0) * shape.bytes;  // the matrix in single precision, and a residual
  const double changing = changes.values;
  const double serves = 1.0 / (equilibrium ? kServesNewton : kServesSteps);
  const double kept = std::max(changes.pattern, std::min(changing, serves));
  const double width = separator(shape);
  const double blocks = 3.0 * shape.rows / std::max(1.0, std::pow(width, 1.5) / std::sqrt(3.0));
  const double operations = 3.0 * width * width * width * std::max(1.0, blocks);
  const double factor =
      operations / SparseFactor::operations_per_byte() + kFactorNumber * factor_bytes(shape) / sizeof(double);
  const double with_factor = 2.0 * kFactorSolve * factor_bytes(shape) + 2.0 * shape.bytes;
  const double sheet = equilibrium ? std::max(kSheetCycles, shape.along) : kSheetCycles;
  const double cycles = std::sqrt(stiffer(shape)) * (shape.through < 2.0 ? sheet : 1.0) * kCycles;
  const double saved = kSaved / std::pow(stiffer(shape), 1.0 / 6.0);
  const double levels = kLevelsMade * shape.rows / (shape.rows + kFewRows);
  // The guess from the latest answers (forecast.h) saves a share of the digits of a motion.
  const double guessed = equilibrium ? 1.0 : kGuessed;
  const double needed = guessed * std::min(cycles * digits, std::max(3.0, plain / 5.0));

  ForArms<Cost> costs;
  costs[number(Arm::block_jacobi)] = {0.1 * shape.bytes, changing, once + plain * iteration, 0.0};
  costs[number(Arm::incomplete_cholesky)] = {kTriangleMade * shape.bytes / shape.rows * shape.bytes, kept,
                                             once + plain / saved * (iteration + kSweep * product), 0.0};
  costs[number(Arm::multigrid)] = {levels * product, kept,
                                   once + (needed + kGuesses) * (iteration + kCycleProducts * product),
                                   kAggregation * shape.rows};
  const double ordering = kOrdering * shape.rows;
  costs[number(Arm::stale_cholesky)] = {factor, kept, std::max(1.0, changing * kStale * digits) * with_factor,
                                        ordering};
  costs[number(Arm::cholesky)] = {factor, changing, with_factor, ordering};
  for (Cost& cost : costs) cost.solving += changes.pattern * cost.once;
  return costs;
}

}  // namespace tissu
