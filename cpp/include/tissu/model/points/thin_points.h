#pragma once

/// What a block of sheets or lines asks of F at its points: how it goes on across the piece.

#include "tissu/model/points/cell_points.h"

namespace tissu {

struct ThinPoints {
  int m;              ///< 2: a sheet, 1: a line
  bool small_strain;  ///< the law sees the symmetric part of F alone
  Plane plane;

  /// `m` is the dimension of the block's cells.
  ThinPoints(const ElasticBlock& block, int m);

  /// F in the axes of the piece, unstrained across: there the fibres of a sheet stay normal to it, those of a
  /// line turn with it. A flat body keeps its sides, so that a mirrored cell has det F < 0. A law of small
  /// strain sees no shear between along and across.
  [[nodiscard]] Mat3 unstrained_across(const CellPoint& at) const;
  /// It is free to thin.
  [[nodiscard]] bool thins() const { return plane != Plane::strain; }
  /// What the law sees of F.
  [[nodiscard]] Mat3 seen(const Mat3& F) const { return small_strain ? Mat3(0.5 * (F + F.transpose())) : F; }
  /// F stretched across; `free` is the stretched F that the law saw. Not a number where no material is left.
  [[nodiscard]] Mat3 stretched(Mat3 F, const Mat3& free) const;
};

}  // namespace tissu
