#include "matrix_shape.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "tissu/assembly/row_places.h"

namespace tissu {
namespace {

constexpr double kStiffest = 0.99;  ///< of the rows are not as stiff as those whose contrast counts
constexpr double kInside = 0.05;    ///< of the forces of neighbours, what is left inside a body

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

/// Of the traces of the diagonal blocks of points.
double contrast_of(const BlockMatrix& A, const std::vector<std::int32_t>& rows) {
  std::vector<double> traces;
  traces.reserve(rows.size());
  for (const std::int32_t i : rows) {
    if (is_point(A, i)) traces.push_back(A.diagonal_block(i).trace());
  }
  if (traces.empty()) return 1.0;
  const auto quantile = [&](double share) {
    const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(traces.size() - 1));
    std::ranges::nth_element(traces, traces.begin() + place);
    return traces[static_cast<std::size_t>(place)];
  };
  const double middle = quantile(0.5);
  return middle > 0.0 ? std::max(1.0, quantile(kStiffest) / middle) : 1.0;
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

}  // namespace

MatrixShape shape_of(const BlockMatrix& A, bool equilibrium) {
  MatrixShape shape;
  const std::vector<std::int32_t> rows = bound_rows(A);
  shape.rows = std::max(1.0, static_cast<double>(rows.size()));
  shape.bytes = static_cast<double>(A.bytes());
  if (rows.empty()) return shape;
  count_cells(A.places(), rows, shape);
  if (!equilibrium) shape.inertia = inertia_of(A, rows);
  shape.wave_ratio = wave_ratio_of(A, rows);
  shape.contrast = contrast_of(A, rows);
  return shape;
}

}  // namespace tissu
