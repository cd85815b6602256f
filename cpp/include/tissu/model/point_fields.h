#pragma once

/// What a body's material is in at its integration points: F, P and W, from which every strain and stress
/// follows. Computed on request; a step neither computes nor keeps it.

#include <vector>

#include "tissu/base/isa.h"
#include "tissu/state/state.h"

namespace tissu {

struct CellFields;

/// What the points of a model are computed from.
struct PointQuery {
  ConstReals rest_positions;  ///< of the whole world [m]
  const State& state;
  Isa isa;
};

/// Points cell after cell, as many in each; tensors row by row in the axes of space. Sheets and lines have
/// the F of a volume: what lies across is the stretch that leaves no stress there, or 1 in plane strain.
struct PointFields {
  int points_per_cell = 0;         ///< 0: the model has no stress at points
  bool through_thickness = false;  ///< points lie above each other, so that a mean leaves bending out
  std::vector<double> positions;   ///< [cell][point][3], at rest [m]
  std::vector<double> volumes;     ///< [cell][point], at rest [m3]
  std::vector<double> F;       ///< [cell][point][9]; not a number where no stretch leaves no stress across
  std::vector<double> P;       ///< [cell][point][9], first Piola-Kirchhoff, f_a = -sum w P grad N_a [Pa]
  std::vector<double> W;       ///< [cell][point], per rest volume [J/m3]
  std::vector<double> cell_W;  ///< [cell], where the points do not have the whole of it; else empty

  /// Room for so many points, all zero.
  void resize(std::size_t points);
  [[nodiscard]] Mat3 gradient_at(std::size_t point) const { return tensor(F, point); }
  [[nodiscard]] Mat3 stress_at(std::size_t point) const { return tensor(P, point); }
  void set_gradient(std::size_t point, const Mat3& value) { set(F, point, value); }
  void set_stress(std::size_t point, const Mat3& value) { set(P, point, value); }

 private:
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  static Mat3 tensor(const std::vector<double>& values, std::size_t point) {
    return Eigen::Map<const RowMajor>(values.data() + 9 * point);
  }
  static void set(std::vector<double>& values, std::size_t point, const Mat3& value) {
    Eigen::Map<RowMajor>(values.data() + 9 * point) = value;
  }
};

/// sigma = sym(P F^T) / det F [Pa]: P F^T is symmetric but for laws that see rotations.
Mat3 cauchy_stress(const Mat3& F, const Mat3& P);
/// sqrt(3/2 s : s) with s the deviator.
double von_mises(const Mat3& sigma);
/// Means over each cell; von Mises' stress is that of the mean Cauchy stress.
CellFields cell_means(const PointFields& points);
/// The least of these volume ratios that are numbers, infinite where there is none.
double least(ConstReals ratios);

}  // namespace tissu
