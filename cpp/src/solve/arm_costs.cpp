#include "arm_costs.h"

#include <algorithm>
#include <cmath>

#include "preconditioner.h"
#include "sparse_factor.h"
#include "work.h"

namespace tissu {
namespace {

/// Of D^-1 A with the blocks D on the diagonal, for cells of four to eight nodes.
constexpr double kLargest = 3.0;
/// Iterations for each cell along a cube that one side holds, to 1e-6, where its weight pulls along the cells
/// (docs/measured/solvers.md); where it bends them 18 to 21 were counted, of which an equilibrium expects
/// less.
constexpr double kForACell = 12.8;
constexpr double kForACellBent = 17.0;
constexpr double kOfTolerance = 14.5;  ///< ln(2 / 1e-6), at which the numbers here were found
/// Iterations of block-Jacobi for one of incomplete Cholesky.
constexpr double kSaved = 3.2;
constexpr double kCycles = 11.0;      ///< iterations of a multigrid
constexpr double kGuessed = 0.7;      ///< of them, where a motion goes on
constexpr double kGuesses = 1.0;      ///< what the products of a guess cost, in iterations of a multigrid
constexpr double kWaveRatio = 3.5;    ///< of the moduli of plane waves at Poisson's ratio 0.3
constexpr double kSheetCycles = 5.0;  ///< times as many at least for a body of one cell through
/// Times as many for each length over thickness of a bar in equilibrium.
constexpr double kSlenderCycles = 0.24;
/// Power of what a stiff part does to the iterations of block-Jacobi: 9 to 58 iterations were counted, which
/// depend on how the aggregates meet the part.
constexpr double kHinderedCycles = 0.5;
constexpr double kCycleProducts = 6.0;  ///< products, with those of the coarser levels, that a cycle costs
constexpr double kLevelsMade = 110.0;   ///< products that making all levels costs, …
constexpr double kFewRows = 300.0;  ///< … of a matrix of many more rows, whose inner ones have all neighbours
/// Products that an incomplete factor costs, for each byte of a row: it multiplies pairs of its blocks.
constexpr double kTriangleMade = 0.011;
constexpr double kStale = 6.0;  ///< iterations with the factor of an earlier matrix, of a body in motion
constexpr double kStaleNewton = 10.0;  ///< … and in Newton's iterations, between which a body bends more
/// Solves that a preconditioner serves while a body moves, and in Newton's iterations.
constexpr double kServesSteps = 20.0;
constexpr double kServesNewton = 2.0;

/// Of the condition number, over that of Poisson's ratio 0.3. Iterations of a multigrid grow with its root;
/// those of block-Jacobi, which in so many rows sees less of it, with its cubic root: five times as many at
/// 0.499.
double stiffer(const MatrixShape& shape) { return std::max(1.0, shape.wave_ratio / kWaveRatio); }

/// Times as many iterations of bodies with a stiff part: 4 where it is 1e4 times as stiff as the rest, and 7
/// from 1e6 on, for block-Jacobi as for a multigrid. Up to a hundred times, which a graded mesh has too, few
/// are more.
double hindered(const MatrixShape& shape) {
  return std::clamp(1.0 + 1.5 * (std::log10(shape.contrast) - 2.0), 1.0, 7.0);
}

/// A factor as nested dissection makes it, of a body that is cut into blocks as long as wide: w unknowns of a
/// separator. Fitted to CHOLMOD's of bars, cubes, plates, shells and organs of 180 to 17,000 rows: within 1.4
/// but for a cylinder of 1.7 times the operations.
struct Factor {
  double numbers;
  double operations;
};

constexpr double kThin = 2.0;             ///< cells through: a sheet
constexpr double kSheetOperations = 3.0;  ///< w^3 of each block
constexpr double kFirstBlock = 2.6;       ///< w^3
/// w^3 of each further block: other separators stand on both of its sides.
constexpr double kFurtherBlock = 6.3;
constexpr double kNumbers = 3.6;  ///< of an unknown: kNumbers w^kNumbersPower, …
constexpr double kNumbersPower = 0.68;
constexpr double kNumbersLong = 0.6;  ///< … and so much more in a long body

Factor factor_of(const MatrixShape& shape) {
  const double unknowns = 3.0 * shape.rows;
  const double w = 3.0 * std::max(1.0, shape.across * shape.through);
  const double blocks = std::max(1.0, std::sqrt(3.0) * unknowns / std::pow(w, 1.5));
  const bool thin = shape.through < kThin;
  const double cubes = thin ? kSheetOperations * blocks : kFirstBlock + kFurtherBlock * (blocks - 1.0);
  const double more = thin ? 0.0 : kNumbersLong * (1.0 - 1.0 / blocks);
  return {kNumbers * std::pow(w, kNumbersPower) * (1.0 + more) * unknowns, cubes * w * w * w};
}

}  // namespace

std::string_view name_of(Arm arm) {
  constexpr ForArms<std::string_view> kNames = {"block_jacobi", "incomplete_cholesky", "multigrid",
                                                "stale_cholesky", "cholesky"};
  return kNames[number(arm)];
}

double plain_iterations(const MatrixShape& shape, double tolerance, bool equilibrium) {
  const double digits = std::log(2.0 / tolerance);
  const double bending = shape.along * std::max(1.0, shape.along / shape.through);
  const double still =
      (equilibrium ? kForACellBent : kForACell) * std::cbrt(stiffer(shape)) * bending * digits / kOfTolerance;
  const double moving = 0.5 * std::sqrt(kLargest / std::max(shape.inertia, 1e-12)) * digits;
  return std::max(1.0, std::min({hindered(shape) * still, hindered(shape) * moving, 3.0 * shape.rows}));
}

double factor_bytes(const MatrixShape& shape) { return sizeof(double) * factor_of(shape).numbers; }

ForArms<Cost> predicted_costs(const MatrixShape& shape, double plain, double tolerance,
                              const Changes& changes, bool equilibrium) {
  const double digits = std::log(2.0 / tolerance) / kOfTolerance;
  const double product = 0.5 * shape.bytes;  // in single precision
  const double iteration = product + 0.5 * kVectorBytes * shape.rows;
  const double once = (kConversion + 1.0) * shape.bytes;  // the matrix in single precision, and a residual
  const double cycle = shape.bytes + kVectorBytes * shape.rows + kCycleProducts * product;
  const double changing = changes.values;
  const double serves = 1.0 / (equilibrium ? kServesNewton : kServesSteps);
  const double kept = std::max(changes.pattern, std::min(changing, serves));
  const Factor size = factor_of(shape);
  const double factor = SparseFactor::making_work(size.operations, size.numbers, shape.rows);
  const double with_factor = 2.0 * kFactorSolve * factor_bytes(shape) + 2.0 * shape.bytes;
  const double sheet = equilibrium ? std::max(kSheetCycles, shape.along) : kSheetCycles;
  const double slender = equilibrium ? std::max(1.0, kSlenderCycles * shape.along / shape.through) : 1.0;
  const double thin = shape.through < 2.0 ? std::max(sheet, slender) : slender;
  const double cycles =
      std::pow(hindered(shape), kHinderedCycles) * std::sqrt(stiffer(shape)) * thin * kCycles;
  const double saved = kSaved / std::pow(stiffer(shape), 1.0 / 6.0);
  const double levels = kLevelsMade * shape.rows / (shape.rows + kFewRows);
  // The guess from the latest answers (forecast.h) saves a share of the digits of a motion.
  const double guessed = equilibrium ? 1.0 : kGuessed;
  const double needed = guessed * std::min(cycles * digits, std::max(3.0, plain / 5.0));

  ForArms<Cost> costs;
  costs[number(Arm::block_jacobi)] = {0.1 * shape.bytes, changing, once + plain * iteration, 0.0};
  costs[number(Arm::incomplete_cholesky)] = {kTriangleMade * shape.bytes / shape.rows * shape.bytes, kept,
                                             once + plain / saved * (iteration + kSweep * product), 0.0};
  costs[number(Arm::multigrid)] = {levels * product, kept, shape.bytes + (needed + kGuesses) * cycle,
                                   kAggregation * shape.rows};
  const double ordering = kOrdering * shape.rows;
  const double stale = equilibrium ? kStaleNewton * std::sqrt(hindered(shape)) : kStale;
  costs[number(Arm::stale_cholesky)] = {factor, kept, std::max(1.0, changing * stale * digits) * with_factor,
                                        ordering};
  costs[number(Arm::cholesky)] = {factor, changing, with_factor, ordering};
  for (Cost& cost : costs) cost.solving += changes.pattern * cost.once;
  return costs;
}

}  // namespace tissu
