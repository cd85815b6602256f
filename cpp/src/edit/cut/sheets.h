#pragma once

/// Sheets of a blade: what hangs together of it near a place. Walls of a U and windings of a spiral are one
/// blade, and different sheets in a cell which they pass side by side.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tissu/edit/cut/sweep.h"

namespace tissu {

class BladeSheets {
 public:
  explicit BladeSheets(const SweepPart& part);

  /// Triangles of the blade that meet a box, ascending, and the sheet of each: those have the same number
  /// that hang together inside the box, across common edges that meet it.
  struct Inside {
    std::vector<std::int32_t> triangles;
    std::vector<std::int32_t> sheet;  ///< from 0 on
    std::int32_t count = 0;           ///< of sheets

    /// Of a triangle, -1 where it does not meet the box.
    [[nodiscard]] std::int32_t of(std::int32_t triangle) const;
    [[nodiscard]] std::vector<std::int32_t> members(std::int32_t number) const;
  };
  [[nodiscard]] Inside in(const Eigen::AlignedBox3d& box) const;
  /// Of the named triangles, ascending.
  [[nodiscard]] Inside in(const Eigen::AlignedBox3d& box, std::span<const std::int32_t> triangles) const;

 private:
  struct Seam {
    std::int32_t triangle;
    std::int32_t other;
    std::int32_t side;  ///< of the triangle: from this corner on
  };
  const SweepPart& part_;
  std::vector<Eigen::AlignedBox3d> boxes_;
  std::vector<Seam> seams_;  ///< by ascending triangle
};

}  // namespace tissu
