#pragma once

/// H^T: unit forces on points in their directions, a column for each, as few numbers among zeros.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "tissu/simulation/compliance.h"

namespace tissu {

class PointLoads {
 public:
  struct Entry {
    std::int32_t row;
    Eigen::Index column;
    Vec3 load;
  };
  /// `given`: for each row the axes (bits) that are held.
  PointLoads(std::span<const CarriedPoint> points, const std::vector<std::uint8_t>& given);
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
  [[nodiscard]] Eigen::Index columns() const { return columns_; }
  /// H^T in full, of so many rows.
  [[nodiscard]] Eigen::MatrixXd right(std::int32_t rows) const;
  /// H X
  [[nodiscard]] Eigen::MatrixXd motions(const Eigen::MatrixXd& X) const;

 private:
  std::vector<Entry> entries_;
  Eigen::Index columns_;
};

}  // namespace tissu
