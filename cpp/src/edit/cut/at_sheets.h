#pragma once

/// Faces of the material in cells that a blade passes more than once.

#include <cstdint>
#include <span>

#include "edit/cut/crossings.h"
#include "edit/cut/patch.h"
#include "edit/cut/sheets.h"

namespace tissu {

class FacesAtSheets {
 public:
  FacesAtSheets(const Patch& patch, const SweepPart& part, const BladeSheets& sheets, const OnCut& known)
      : patch_(patch), part_(part), sheets_(sheets), known_(known) {}

  /// Whether a sheet of the blade goes between two tetrahedra at their common face: all vertices of the face
  /// are on it, the tetrahedra lie on different sides of it, and the face not beyond its border.
  [[nodiscard]] bool parts(std::span<const std::int32_t> face, std::int32_t a, std::int32_t b) const;

 private:
  [[nodiscard]] Eigen::AlignedBox3d around(std::span<const std::int32_t> face, std::int32_t a,
                                           std::int32_t b) const;
  [[nodiscard]] bool is_on(std::int32_t v, const BladeSheets::Inside& inside, std::int32_t sheet) const;
  [[nodiscard]] bool above(std::int32_t tetra, const BladeSheets::Inside& inside, std::int32_t sheet,
                           std::span<const std::int32_t> triangles) const;
  [[nodiscard]] bool covers(std::span<const std::int32_t> face, const BladeSheets::Inside& inside,
                            std::int32_t sheet, std::span<const std::int32_t> triangles) const;

  const Patch& patch_;
  const SweepPart& part_;
  const BladeSheets& sheets_;
  const OnCut& known_;
};

}  // namespace tissu
