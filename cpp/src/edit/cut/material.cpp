#include "tissu/edit/cut/material.h"

#include <algorithm>
#include <cstddef>

#include "tissu/base/index.h"
#include "tissu/edit/cut/cut_plan.h"
#include "tissu/mesh/cell_shape.h"

namespace tissu {

Vec3 Rider::at(ConstReals x) const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
    sum += weight[i] * tissu::block(x, node[i]);
  return sum;
}

Vec3 Material::at(std::int32_t vertex, ConstReals x) const {
  if (vertex >= 0) return block(x, vertex);
  return riders[static_cast<std::size_t>(-1 - vertex)].at(x);
}

void Material::apply(const CutPlan& plan) {
  const MaterialChange& change = plan.material;
  for (const auto& [place, rider] : change.riders_changed) riders[tissu::at(place)] = rider;
  riders.insert(riders.end(), change.riders_born.begin(), change.riders_born.end());
  remove(plan.gone);
  for (const auto& [cell, list] : change.cells) cells[cell] = list;
  for (const Incision& incision : change.incisions) {
    const auto same = std::ranges::lower_bound(incisions, incision.number, {}, &Incision::number);
    if (same != incisions.end() && same->number == incision.number) {
      *same = incision;
    } else {
      incisions.insert(same, incision);
    }
  }
}

void Material::remove(std::span<const std::int32_t> hosts) {
  for (const std::int32_t host : hosts) cells.erase(host);
}

std::vector<MaterialTetra> whole_material(const Hosts& hosts, std::int32_t cell) {
  const auto nodes = hosts.corners(cell);
  if (nodes.size() == 2) return {{{nodes[0], nodes[1], kNoVertex, kNoVertex}, 0}};
  if (nodes.size() == 3) return {{{nodes[0], nodes[1], nodes[2], kNoVertex}, 0}};
  const auto root = [&](std::int32_t node) { return hosts.root(node); };
  const auto lowest = std::ranges::min_element(nodes, {}, root);
  if (nodes.size() == 4 && info(hosts.type(cell)).dimension == 2) {
    const auto i = static_cast<std::size_t>(lowest - nodes.begin());
    const auto node = [&](std::size_t k) { return nodes[(i + k) % 4]; };
    return {{{node(0), node(1), node(2), kNoVertex}, 0}, {{node(0), node(2), node(3), kNoVertex}, 0}};
  }
  if (nodes.size() == 4) return {{{nodes[0], nodes[1], nodes[2], nodes[3]}, 0}};
  const std::int32_t apex = *lowest;
  std::vector<MaterialTetra> tetrahedra;
  for (const LocalFace& face : faces(hosts.type(cell))) {
    const auto size = at(face.corners);
    std::array<std::int32_t, 4> corner{-1, -1, -1, -1};
    for (std::size_t c = 0; c < size; ++c) corner[c] = nodes[face.node[c]];
    const auto end = corner.begin() + face.corners;
    if (std::find(corner.begin(), end, apex) != end) continue;
    const auto low =
        static_cast<std::size_t>(std::ranges::min_element(corner.begin(), end, {}, root) - corner.begin());
    for (std::size_t c = 1; c + 1 < size; ++c) {  // outward: seen from the apex, clockwise
      tetrahedra.push_back({{corner[low], corner[(low + c + 1) % size], corner[(low + c) % size], apex}, 0});
    }
  }
  return tetrahedra;
}

std::vector<MaterialTetra> material_of(const Hosts& hosts, const Material& material, std::int32_t cell) {
  const auto stored = material.cells.find(cell);
  return stored == material.cells.end() ? whole_material(hosts, cell) : stored->second;
}

double rest_volume(const Hosts& hosts, const Material& material, std::int32_t cell,
                   const MaterialTetra& tetra) {
  const auto p = [&](std::size_t i) { return material.at(tetra.vertices[i], hosts.rest()); };
  if (tetra.corners() == 2) return (p(1) - p(0)).norm() * hosts.thickness(cell);
  const Vec3 twice = (p(1) - p(0)).cross(p(2) - p(0));
  if (tetra.corners() == 3) return 0.5 * twice.norm() * hosts.thickness(cell);
  return twice.dot(p(3) - p(0)) / 6.0;
}

}  // namespace tissu
