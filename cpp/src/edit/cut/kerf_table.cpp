#include "edit/cut/kerf_table.h"

#include <algorithm>
#include <utility>

#include "edit/cut/drawn_in.h"
#include "edit/cut/material_faces.h"
#include "edit/cut/riders.h"
#include "edit/cut/shared_corners.h"
#include "tissu/base/index.h"
#include "tissu/base/sort_unique.h"
#include "tissu/mesh/cell_shape.h"

namespace tissu {
namespace {

bool is_volume(const Hosts& hosts, std::int32_t cell) {
  return hosts.has(cell) && info(hosts.type(cell)).dimension == 3;
}

/// Adds the volumes that share three corners with one of some cells, which are those that a face may join.
void add_beside(const Hosts& hosts, std::vector<std::int32_t>& cells) {
  constexpr std::size_t kOfFace = 3;
  const std::size_t count = cells.size();
  for (std::size_t i = 0; i < count; ++i) {
    for_cells_at_corners(hosts, cells[i], [&](std::int32_t other, std::size_t shared) {
      if (shared >= kOfFace && is_volume(hosts, other)) cells.push_back(other);
    });
  }
  sort_unique(cells);
}

/// Adds the cells that have all nodes of a rider: the material of no other has it as a vertex.
void add_cells_around(const Hosts& hosts, const Rider& rider, std::vector<std::int32_t>& cells) {
  std::size_t fewest = 0;
  for (std::size_t i = 1; i < at(rider.count); ++i) {
    if (hosts.cells_at(rider.node[i]).size() < hosts.cells_at(rider.node[fewest]).size()) fewest = i;
  }
  for (const std::int32_t cell : hosts.cells_at(rider.node[fewest])) {
    bool has_all = true;
    for (std::size_t i = 0; i < at(rider.count) && has_all; ++i)
      has_all = i == fewest || std::ranges::binary_search(hosts.cells_at(rider.node[i]), cell);
    if (has_all) cells.push_back(cell);
  }
}

/// Adds the vertices of the material of some cells.
void add_vertices(const Hosts& hosts, const Material& material, std::span<const std::int32_t> cells,
                  std::vector<std::int32_t>& vertices) {
  for (const std::int32_t cell : cells) {
    const auto corners = hosts.corners(cell);
    vertices.insert(vertices.end(), corners.begin(), corners.end());
    const auto stored = material.cells.find(cell);
    if (stored == material.cells.end()) continue;
    for (const MaterialTetra& tetra : stored->second)
      vertices.insert(vertices.end(), tetra.vertices.begin(), tetra.vertices.end());
  }
}

}  // namespace

KerfTable::KerfTable(const Hosts& hosts, const Material& material, double depth) : depth_(depth) {
  cells_ = hosts.numbers();
  std::erase_if(cells_, [&](std::int32_t cell) { return !is_volume(hosts, cell); });
  look(hosts, material, cells_);
}

void KerfTable::begin(const Hosts& hosts, const Material& material, const CutPlan& plan) {
  cells_ = plan.gone;
  for (const ChangedCell& cell : plan.changed) cells_.push_back(cell.number);
  for (const auto& [cell, list] : plan.material.cells) cells_.push_back(cell);
  std::erase_if(cells_, [&](std::int32_t cell) { return !is_volume(hosts, cell); });
  vertices_.clear();
  add_vertices(hosts, material, cells_, vertices_);
  add_beside(hosts, cells_);
}

void KerfTable::end(const Hosts& hosts, const Material& material, const CutPlan& plan) {
  std::vector<std::int32_t> touched;
  touched.reserve(plan.born.size() + plan.changed.size() + plan.material.cells.size());
  for (const BornCell& cell : plan.born) touched.push_back(cell.number);
  for (const ChangedCell& cell : plan.changed) touched.push_back(cell.number);
  for (const auto& [cell, list] : plan.material.cells) touched.push_back(cell);
  std::erase_if(touched, [&](std::int32_t cell) { return !is_volume(hosts, cell); });
  add_vertices(hosts, material, touched, vertices_);
  for (const auto& [rider, now] : plan.material.riders_changed) vertices_.push_back(-1 - rider);
  add_beside(hosts, touched);
  cells_.insert(cells_.end(), touched.begin(), touched.end());
  sort_unique(cells_);
  std::vector<std::int32_t> around = cells_;
  std::erase_if(around, [&](std::int32_t cell) { return !hosts.has(cell); });
  add_beside(hosts, around);
  look(hosts, material, around);
}

void KerfTable::take(const OuterTriangle& triangle, std::int32_t sign) {
  for (const std::int32_t v : triangle.vertices) {
    Use& use = uses_[v];
    use.corners += sign;
    if (triangle.cut) use.walls += sign;
    vertices_.push_back(v);
  }
}

/// The outer triangles of the cells, and what carries the vertices, as they are now. `around`: all cells that
/// a face may join to one of them, themselves included.
void KerfTable::look(const Hosts& hosts, const Material& material, std::span<const std::int32_t> around) {
  for (const std::int32_t cell : cells_) {
    const auto known = triangles_.find(cell);
    if (known == triangles_.end()) continue;
    for (const OuterTriangle& triangle : known->second) take(triangle, -1);
    triangles_.erase(known);
  }
  for (OuterTriangles& own : outer_triangles(hosts, faces_among(hosts, material, around))) {
    if (!std::ranges::binary_search(cells_, own.cell)) continue;
    for (const OuterTriangle& triangle : own.triangles) take(triangle, 1);
    triangles_.insert_or_assign(own.cell, std::move(own.triangles));
  }
  sort_unique(vertices_);
  if (depth_ > 0.0) place(hosts, material);
  for (const std::int32_t v : vertices_) {
    carried_.erase(v);
    const auto use = uses_.find(v);
    if (use == uses_.end()) continue;
    if (use->second.corners == 0) {
      uses_.erase(use);
    } else if (v < 0) {
      carried_[v] = rider_of(material, v);
    }
  }
  if (depth_ > 0.0) draw(hosts, material);
}

/// Which vertices stand in one place. Those that stand beside one of the vertices join them.
void KerfTable::place(const Hosts& hosts, const Material& material) {
  std::vector<std::int32_t> beside;
  for (const std::int32_t v : vertices_) {
    const auto known = places_.find(v);
    if (known == places_.end()) continue;
    std::vector<std::int32_t>& here = twins_[known->second];
    std::erase(here, v);
    beside.insert(beside.end(), here.begin(), here.end());
    if (here.empty()) twins_.erase(known->second);
    places_.erase(known);
  }
  for (const std::int32_t v : vertices_) {
    const auto use = uses_.find(v);
    if (use == uses_.end() || use->second.corners == 0) continue;
    const Rider own = rider_of(material, v);
    Place place;
    place.fill({-1, 0.0});
    for (std::size_t i = 0; i < at(own.count); ++i) place[i] = {hosts.root(own.node[i]), own.weight[i]};
    std::sort(place.begin(), place.begin() + own.count);
    std::vector<std::int32_t>& here = twins_[place];
    beside.insert(beside.end(), here.begin(), here.end());
    here.push_back(v);
    places_.emplace(v, place);
  }
  vertices_.insert(vertices_.end(), beside.begin(), beside.end());
  sort_unique(vertices_);
}

void KerfTable::draw(const Hosts& hosts, const Material& material) {
  TwinFlags wanted;
  std::vector<std::int32_t> cells;
  for (const std::int32_t v : vertices_) {
    const auto use = uses_.find(v);
    if (use == uses_.end()) continue;
    const bool has_twin = twins_.at(places_.at(v)).size() > 1;
    if (use->second.walls == 0 && !has_twin) continue;
    wanted.emplace(v, has_twin);
    add_cells_around(hosts, rider_of(material, v), cells);
  }
  if (wanted.empty()) return;
  sort_unique(cells);
  std::erase_if(cells, [&](std::int32_t cell) { return !is_volume(hosts, cell); });
  const MaterialFaces all = faces_among(hosts, material, cells);
  for (const auto& [vertex, rider] : drawn_in(hosts, material, all, wanted, depth_)) carried_[vertex] = rider;
}

KerfSurface KerfTable::surface() const {
  KerfSurface surface;
  for (const auto& [cell, own] : triangles_) {
    for (const OuterTriangle& triangle : own) surface.triangles.push_back(triangle.vertices);
  }
  surface.carried.assign(carried_.begin(), carried_.end());
  return surface;
}

std::vector<std::uint8_t> KerfTable::changed() const {
  const std::int32_t low = vertices_.empty() ? 0 : vertices_.front();
  std::vector<std::uint8_t> listed(vertices_.empty() ? 0 : at(vertices_.back() - low) + 1, 0);
  for (const std::int32_t v : vertices_) listed[at(v - low)] = 1;
  const auto is_listed = [&](std::int32_t v) {
    return v >= low && at(v - low) < listed.size() && listed[at(v - low)] != 0;
  };
  std::vector<std::uint8_t> changed;
  auto looked_at = cells_.begin();  // they ascend, as those of the triangles do
  for (const auto& [cell, own] : triangles_) {
    while (looked_at != cells_.end() && *looked_at < cell) ++looked_at;
    const bool is_one = looked_at != cells_.end() && *looked_at == cell;
    for (const OuterTriangle& triangle : own)
      changed.push_back(is_one || std::ranges::any_of(triangle.vertices, is_listed) ? 1 : 0);
  }
  return changed;
}

KerfSurface kerf_surface(const Hosts& hosts, const Material& material, double depth) {
  return KerfTable(hosts, material, depth).surface();
}

}  // namespace tissu
