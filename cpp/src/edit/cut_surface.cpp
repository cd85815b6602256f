#include "cut_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <string>

#include "edit/cut/kerf.h"
#include "edit/cut/quad_halves.h"
#include "edit/cut/riders.h"
#include "edit/cut/thin_drawn_in.h"
#include "flat_rim.h"
#include "mixed_surface.h"
#include "tissu/base/error.h"
#include "tissu/contact/candidates.h"
#include "tissu/edit/cut_state.h"
#include "tissu/element/reference_cell.h"
#include "tissu/mesh/topology.h"

namespace tissu {
namespace {

/// All triangles of a sheet's material. Quads that no blade met are cut along their shorter diagonal.
KerfSurface sheet_surface(const CutState& cut, ThinMaterial& thin) {
  KerfSurface surface;
  std::map<std::int32_t, Rider> carried;
  for (const std::int32_t cell : cut.hosts.numbers()) {
    const auto corners = cut.hosts.corners(cell);
    const std::vector<MaterialTetra> own = material_of(cut.hosts, cut.material, cell);
    thin.triangles.insert(thin.triangles.end(), own.begin(), own.end());
    if (corners.size() == 4 && !cut.material.cells.contains(cell)) {
      add_halves(
          cut.hosts.rest(), {corners[0], corners[1], corners[2], corners[3]},
          [&](std::int32_t node) { return cut.hosts.root(node); }, surface.triangles);
      continue;
    }
    for (const MaterialTetra& triangle : own) {
      const auto& [a, b, c, none] = triangle.vertices;
      surface.triangles.push_back({a, b, c});
      for (const std::int32_t v : {a, b, c}) {
        if (v < 0) carried[v] = rider_of(cut.material, v);
      }
    }
  }
  surface.carried.assign(carried.begin(), carried.end());
  return surface;
}

/// All pieces of the material of lines, and the vertices that ride.
KerfSurface line_surface(const CutState& cut, std::vector<std::array<std::int32_t, 2>>& edges,
                         ThinMaterial& thin) {
  KerfSurface surface;
  std::map<std::int32_t, Rider> carried;
  for (const std::int32_t cell : cut.hosts.numbers()) {
    for (const MaterialTetra& piece : material_of(cut.hosts, cut.material, cell)) {
      const auto [a, b] = std::minmax(piece.vertices[0], piece.vertices[1]);
      thin.lines.push_back(piece);
      edges.push_back({a, b});
      for (const std::int32_t v : {a, b}) {
        if (v < 0) carried[v] = rider_of(cut.material, v);
      }
    }
  }
  surface.carried.assign(carried.begin(), carried.end());
  return surface;
}

/// Of a flat body the rim alone is in contact.
void keep_rim(const BodyDescription& body, KerfSurface& surface, ThinSurface& thin) {
  surface.triangles.clear();
  thin.material.lines.clear();
  thin.radius.clear();
  thin.edges = rim_of(body.positions, body.cut->material, thin.material.triangles);
  std::set<std::int32_t> on_rim;
  for (const auto& ends : thin.edges) on_rim.insert(ends.begin(), ends.end());
  std::erase_if(surface.carried, [&](const auto& one) { return !on_rim.contains(one.first); });
}

/// Edges of cut sheets and ends of cut lines go inside their material by half of what they rest apart.
void draw_in(const CutState& cut, const ThinMaterial& thin, std::span<const double> radius, double depth,
             KerfSurface& surface) {
  const auto radius_of = [&](std::int32_t vertex) {
    const Rider rider = rider_of(cut.material, vertex);
    double largest = 0.0;
    for (std::size_t i = 0; !radius.empty() && i < static_cast<std::size_t>(rider.count); ++i) {
      largest = std::max(largest, radius[static_cast<std::size_t>(rider.node[i])]);
    }
    return largest;
  };
  std::map<std::int32_t, Rider> carried(surface.carried.begin(), surface.carried.end());
  for (const auto& [vertex, rider] : drawn_in(cut.hosts, cut.material, thin, [&](std::int32_t v) {
         return depth + radius_of(v) / Candidates::kOfWalls;
       })) {
    carried[vertex] = rider;
  }
  surface.carried.assign(carried.begin(), carried.end());
}

/// Half the thickness of the sheets at each node, or the radius of the lines.
std::vector<double> radii(const BodyDescription& body) {
  std::vector<double> radius(body.positions.size() / 3, 0.0);
  for (const ElasticBlock& block : body.elastic) {
    const ElementInfo& element = *find_element(block.element);
    for (std::size_t i = 0; i < block.cells.size(); ++i) {
      const double section = of_cell(block.cross_section, static_cast<std::int32_t>(i) / element.nodes);
      double& own = radius[static_cast<std::size_t>(block.cells[i])];
      own = std::max(own, element.dimension == 2 ? 0.5 * section : std::sqrt(section / std::numbers::pi));
    }
  }
  return radius;
}

int dimension_of(const ElasticBlock& block) {
  const std::optional<CellType> type = host_type(block);
  return type ? info(*type).dimension : 3;
}

/// The highest of the cells of a body.
int dimension_of(const BodyDescription& body) {
  int highest = body.elastic.empty() ? 3 : 1;
  for (const ElasticBlock& block : body.elastic) highest = std::max(highest, dimension_of(block));
  return highest;
}

bool is_mixed(const BodyDescription& body) {
  const int highest = dimension_of(body);
  return std::ranges::any_of(body.elastic,
                             [&](const ElasticBlock& block) { return dimension_of(block) < highest; });
}

/// Of the cells of the highest dimension; where sheets come with lines, `add_thin` adds both.
KerfSurface own_surface(const BodyDescription& body, double depth, ThinSurface& thin) {
  const int dimension = dimension_of(body);
  if (dimension == 3) return kerf_surface(body.cut->hosts, body.cut->material, depth);
  if (is_mixed(body)) return {};
  return dimension == 2 ? sheet_surface(*body.cut, thin.material)
                        : line_surface(*body.cut, thin.edges, thin.material);
}

SurfaceRiders riders_of(const KerfSurface& found) {
  SurfaceRiders riders;
  for (const auto& [vertex, rider] : found.carried) {
    riders.vertex.push_back(vertex);
    const auto count = static_cast<std::ptrdiff_t>(rider.count);
    riders.node.insert(riders.node.end(), rider.node.begin(), rider.node.begin() + count);
    riders.weight.insert(riders.weight.end(), rider.weight.begin(), rider.weight.begin() + count);
    riders.begin.push_back(static_cast<std::int32_t>(riders.node.size()));
  }
  return riders;
}

/// Of nodes on edges, the first one at each place.
std::vector<std::int32_t> roots_of(const Hosts& hosts) {
  std::vector<std::int32_t> roots;
  std::map<std::int32_t, std::int32_t> on_edges;
  for (std::int32_t node = 0; node < hosts.node_count(); ++node) {
    const std::int32_t root = hosts.root(node);
    roots.push_back(root >= 0 ? root : on_edges.try_emplace(root, node).first->second);
  }
  return roots;
}

}  // namespace

double kerf_depth(const std::string& body, const ContactDescription& contact) {
  for (const ContactPair& pair : contact.pairs) {
    const auto bodies = static_cast<std::int32_t>(contact.bodies.size());
    if (pair.a != pair.b || pair.a >= bodies) continue;
    if (contact.bodies[static_cast<std::size_t>(pair.a)].name != body) continue;
    return 0.5 * pair.gap / Candidates::kOfWalls;
  }
  return 0.0;
}

SurfaceDescription volume_surface(const std::string& body, const Hosts& hosts, KerfSurface found) {
  SurfaceDescription surface;
  surface.name = body;
  surface.riders = riders_of(found);
  surface.triangles = std::move(found.triangles);
  surface.closed = !surface.triangles.empty();
  surface.roots = roots_of(hosts);
  return surface;
}

SurfaceDescription cut_surface(const BodyDescription& body, const ContactDescription& contact) {
  const int dimension = dimension_of(body);
  const double depth = kerf_depth(body.name, contact);
  SurfaceDescription surface;
  ThinSurface thin;
  KerfSurface found = own_surface(body, depth, thin);
  const bool flat = is_flat(body);
  if (is_mixed(body)) {
    thin = add_thin(body, *body.cut, found);
  } else if (dimension < 3 && !flat) {
    thin.radius = radii(body);
  }
  if (flat) keep_rim(body, found, thin);
  if (depth > 0.0 && thin.has_pieces()) draw_in(*body.cut, thin.material, thin.radius, depth, found);
  surface.name = body.name;
  surface.triangles = std::move(found.triangles);
  surface.closed = flat || (dimension == 3 && !thin.open && !surface.triangles.empty());
  surface.edges = std::move(thin.edges);
  surface.radius = std::move(thin.radius);
  surface.riders = riders_of(found);
  surface.roots = roots_of(body.cut->hosts);
  return surface;
}

void part_pairs(ContactDescription& contact, const std::string& body, std::int32_t first,
                const std::vector<std::int32_t>& copied, const std::vector<FirstDayPoint>& points) {
  for (ContactPair& pair : contact.pairs) {
    if (pair.nodes.empty() || contact.bodies[static_cast<std::size_t>(pair.a)].name != body) continue;
    const auto meets = [&](std::int32_t node) { return std::ranges::binary_search(pair.nodes, node); };
    for (std::size_t k = 0; k < copied.size(); ++k) {
      const auto is_between_met = [&](const FirstDayPoint& point) {
        return point.node[0] >= 0 &&
               std::ranges::all_of(point.node, [&](std::int32_t node) { return node < 0 || meets(node); });
      };
      const bool met =
          copied[k] < 0 ? is_between_met(points[static_cast<std::size_t>(-1 - copied[k])]) : meets(copied[k]);
      if (met) pair.nodes.push_back(first + static_cast<std::int32_t>(k));
    }
  }
}

void refuse_curved(const BodyDescription& body) {
  for (const ElasticBlock& block : body.elastic) {
    const std::optional<CellType> type = host_type(block);
    if (!type || info(*type).nodes == info(*type).corners) continue;
    throw ParameterError("body \"" + body.name + "\" cannot be cut: it is in contact with cells of type " +
                         block.element +
                         ", whose curved faces a cut would make flat; cells of first order are accepted, or "
                         "leave it out of contacts.");
  }
}

}  // namespace tissu
