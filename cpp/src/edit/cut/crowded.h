#pragma once

/// Cells that a blade may pass more than once.

#include <cstdint>
#include <span>
#include <vector>

#include "edit/cut/near.h"
#include "edit/cut/patch.h"
#include "edit/cut/sheets.h"

namespace tissu {

/// Cells that the blade meets where it has several sheets or turns by more than 60 degrees, in their
/// neighbours at their vertices too.
class CrowdedCells {
 public:
  /// The patch as it is before the part cuts it; later tetrahedra lie inside its cells.
  CrowdedCells(const Patch& patch, const SweepPart& part, const NearCells& near, const BladeSheets& sheets);

  /// `cell`: its place in the patch.
  [[nodiscard]] bool has(std::int32_t cell) const { return crowded_[static_cast<std::size_t>(cell)] != 0; }
  /// The triangles near a crowded cell; none near others.
  [[nodiscard]] std::span<const std::int32_t> triangles(std::int32_t cell) const {
    if (!has(cell)) return {};
    return near_.triangles(patch_.cell(cell).number);
  }

 private:
  const Patch& patch_;
  const NearCells& near_;
  std::vector<char> crowded_;
};

/// A part of a sweep, its sheets, and the cells that it passes more than once.
struct Blade {
  const SweepPart& part;
  const BladeSheets& sheets;
  const CrowdedCells& crowded;
};

}  // namespace tissu
