#include "cut_surface.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "edit/cut/kerf.h"
#include "tissu/base/error.h"
#include "tissu/contact/candidates.h"
#include "tissu/edit/cut_state.h"
#include "tissu/element/reference_cell.h"
#include "tissu/mesh/topology.h"

namespace tissu {
namespace {

/// Of walls inside their material: so far apart they rest a gap apart.
double kerf_depth(const BodyDescription& body, const ContactDescription& contact) {
  for (const ContactPair& pair : contact.pairs) {
    const auto bodies = static_cast<std::int32_t>(contact.bodies.size());
    if (pair.a != pair.b || pair.a >= bodies) continue;
    if (contact.bodies[static_cast<std::size_t>(pair.a)].name != body.name) continue;
    return 0.5 * pair.gap / Candidates::kOfWalls;
  }
  return 0.0;
}

}  // namespace

SurfaceDescription cut_surface(const BodyDescription& body, const ContactDescription& contact) {
  KerfSurface found = kerf_surface(body.cut->hosts, body.cut->material, kerf_depth(body, contact));
  SurfaceDescription surface;
  surface.name = body.name;
  surface.triangles = std::move(found.triangles);
  surface.closed = !surface.triangles.empty();
  SurfaceRiders& riders = surface.riders;
  for (const auto& [vertex, rider] : found.carried) {
    riders.vertex.push_back(vertex);
    const auto count = static_cast<std::ptrdiff_t>(rider.count);
    riders.node.insert(riders.node.end(), rider.node.begin(), rider.node.begin() + count);
    riders.weight.insert(riders.weight.end(), rider.weight.begin(), rider.weight.begin() + count);
    riders.begin.push_back(static_cast<std::int32_t>(riders.node.size()));
  }
  surface.roots.resize(body.positions.size() / 3 - body.copies_of.size());
  std::iota(surface.roots.begin(), surface.roots.end(), 0);
  surface.roots.insert(surface.roots.end(), body.copies_of.begin(), body.copies_of.end());
  return surface;
}

void part_pairs(ContactDescription& contact, const BodyDescription& body,
                const std::vector<std::int32_t>& copied) {
  const auto first = static_cast<std::int32_t>(body.positions.size() / 3 - copied.size());
  for (ContactPair& pair : contact.pairs) {
    if (pair.nodes.empty() || contact.bodies[static_cast<std::size_t>(pair.a)].name != body.name) continue;
    for (std::size_t k = 0; k < copied.size(); ++k) {
      if (std::ranges::binary_search(pair.nodes, copied[k]))
        pair.nodes.push_back(first + static_cast<std::int32_t>(k));
    }
  }
}

void refuse_curved(const BodyDescription& body) {
  for (const ElasticBlock& block : body.elastic) {
    const std::optional<CellType> type = cell_type(block.element);
    if (!type || info(*type).nodes == info(*type).corners) continue;
    throw ParameterError("body \"" + body.name + "\" cannot be cut: it is in contact with cells of type " +
                         block.element +
                         ", whose curved faces a cut would make flat; cells of first order are accepted, or "
                         "leave it out of contacts.");
  }
}

}  // namespace tissu
