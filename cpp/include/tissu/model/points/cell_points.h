#pragma once

/// The quadrature points of a cell of any dimension m, at rest and now.

#include <span>

#include "tissu/element/reference_cell.h"
#include "tissu/model/elastic_block.h"
#include "tissu/model/point_fields.h"

namespace tissu {

struct CellPoint {
  Vec3 position;  ///< at rest [m]
  double volume;  ///< at rest [m3]
  Mat3 Q;         ///< axes of the piece at rest: m tangents, then what lies across; of volumes those of space
  Mat3 dx;        ///< dx/dX along the m tangents; the columns beyond are zero
};

/// Point g of a cell whose nodes stand at X at rest and at x now, in arrays of the whole world.
CellPoint cell_point(const ElasticBlock& block, const ReferenceCell& reference, ConstReals X, ConstReals x,
                     std::size_t cell, std::size_t g);

/// A block's cells and where their nodes are at rest and now.
struct PlacedCells {
  const ElasticBlock& block;
  ReferenceCell reference;
  ConstReals X;
  ConstReals x;

  PlacedCells(const ElasticBlock& of, std::string_view quadrature, const PointQuery& query);
  [[nodiscard]] std::size_t cells() const;
  /// Point g of a cell.
  [[nodiscard]] CellPoint point(std::size_t cell, std::size_t g) const {
    return cell_point(block, reference, X, x, cell, g);
  }
  /// The same of every cell: places and volumes, and F of volumes.
  [[nodiscard]] PointFields lay() const;
};

}  // namespace tissu
