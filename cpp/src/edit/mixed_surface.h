#pragma once

/// The surface in contact of a body with cells of several dimensions once blades have met it.

#include "edit/cut/kerf.h"
#include "edit/cut/thin_drawn_in.h"
#include "tissu/edit/cut_state.h"
#include "tissu/world/description.h"

namespace tissu {

/// What of sheets and lines joins the surface of the volumes.
struct ThinSurface {
  bool open = false;  ///< whether a sheet beside the volumes was added
  std::vector<std::array<std::int32_t, 2>> edges;
  std::vector<double> radius;  ///< of each node [m]
  ThinMaterial material;       ///< of which these consist
  [[nodiscard]] bool has_pieces() const { return !material.triangles.empty() || !material.lines.empty(); }
};

/// Adds to the surface of the volumes the triangles of sheets that lie in no volume cell, as the surface
/// of a body that no blade met has them. Sheets on outer faces thicken their nodes. Lines whose ends are not
/// both nodes of volumes are edges.
ThinSurface add_thin(const BodyDescription& body, const CutState& cut, KerfSurface& surface);

}  // namespace tissu
