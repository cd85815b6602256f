#include "tissu/edit/cut/material_mesh.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "edit/cut/joins.h"
#include "edit/cut/material_faces.h"
#include "tissu/base/disjoint_sets.h"
#include "tissu/base/index.h"

namespace tissu {
namespace {

/// Numbers vertices in the order in which they are first named.
class VertexList {
 public:
  VertexList(const Hosts& hosts, const Material& material)
      : material_(material), node_(at(hosts.node_count()), -1), rider_(material.riders.size(), -1) {}

  std::int32_t place(std::int32_t vertex) {
    std::int32_t& place = vertex >= 0 ? node_[at(vertex)] : rider_[at(-1 - vertex)];
    if (place < 0) {
      place = static_cast<std::int32_t>(riders.size());
      riders.push_back(vertex < 0 ? material_.riders[at(-1 - vertex)]
                                  : Rider{{vertex, -1, -1, -1}, {1.0, 0.0, 0.0, 0.0}, 1});
      numbers.push_back(vertex);
    }
    return place;
  }

  std::vector<Rider> riders;
  std::vector<std::int32_t> numbers;  ///< in the material

 private:
  const Material& material_;
  std::vector<std::int32_t> node_;
  std::vector<std::int32_t> rider_;
};

std::array<std::int32_t, 3> sorted(std::array<std::int32_t, 3> vertices) {
  std::ranges::sort(vertices);
  return vertices;
}

/// The faces of volumes by their vertices, ascending: sheets that lie on them are not seen beside them.
std::set<std::array<std::int32_t, 3>> faces_of_volumes(const MaterialFaces& all, const Hosts& hosts) {
  std::set<std::array<std::int32_t, 3>> found;
  for (const MaterialFace& face : all.faces) {
    if (info(hosts.type(all.units[at(face.unit)].cell)).dimension == 3) found.insert(sorted(face.vertices));
  }
  return found;
}

double volume(const Hosts& hosts, const Material& material, const MaterialUnit& unit) {
  if (unit.tetra >= 0)
    return rest_volume(hosts, material, unit.cell, material.cells.at(unit.cell)[at(unit.tetra)]);
  double sum = 0.0;
  for (const MaterialTetra& tetra : whole_material(hosts, unit.cell))
    sum += rest_volume(hosts, material, unit.cell, tetra);
  return sum;
}

}  // namespace

MaterialSurface material_surface(const Hosts& hosts, const Material& material) {
  MaterialSurface surface;
  VertexList vertices(hosts, material);
  const MaterialFaces all = material_faces(hosts, material);
  const auto solid = [&](const MaterialFace& face) {
    return info(hosts.type(all.units[at(face.unit)].cell)).dimension == 3;
  };
  std::set<std::array<std::int32_t, 3>> below;
  if (!all.carried.empty()) below = faces_of_volumes(all, hosts);
  for (const std::int32_t cell : hosts.numbers()) {
    if (info(hosts.type(cell)).dimension == 3) continue;
    for (const MaterialTetra& triangle : material_of(hosts, material, cell)) {
      if (triangle.corners() == 2) {
        surface.lines.push_back({vertices.place(triangle.vertices[0]), vertices.place(triangle.vertices[1])});
        surface.line_cell.push_back(cell);
        continue;
      }
      const auto& [a, b, c, none] = triangle.vertices;
      if (below.contains(sorted({a, b, c}))) continue;
      surface.triangles.push_back({vertices.place(a), vertices.place(b), vertices.place(c)});
      surface.cell.push_back(cell);
      surface.cut.push_back(0);
    }
  }
  for (const MaterialFace& face : all.faces) {
    if (face.across >= 0 || !solid(face)) continue;
    const auto& [a, b, c] = face.vertices;
    surface.triangles.push_back({vertices.place(a), vertices.place(b), vertices.place(c)});
    surface.cell.push_back(all.units[at(face.unit)].cell);
    surface.cut.push_back(face.cut ? 1 : 0);
  }
  surface.vertices = std::move(vertices.riders);
  surface.vertex_node = std::move(vertices.numbers);
  return surface;
}

MaterialMesh material_mesh(const Hosts& hosts, const Material& material) {
  MaterialMesh mesh;
  VertexList vertices(hosts, material);
  std::map<CellType, std::pair<CellBlock, std::vector<std::int32_t>>> blocks;
  for (const std::int32_t cell : hosts.numbers()) {
    if (material.cells.contains(cell)) continue;
    auto& [block, numbers] = blocks[hosts.type(cell)];
    block.type = hosts.type(cell);
    for (const std::int32_t node : hosts.nodes(cell)) block.nodes.push_back(vertices.place(node));
    numbers.push_back(cell);
  }
  std::array<std::pair<CellBlock, std::vector<std::int32_t>>, 3> parts;
  for (const auto& [cell, list] : material.cells) {
    for (const MaterialTetra& tetra : list) {
      auto& [block, numbers] = parts[4 - tetra.corners()];
      for (std::size_t i = 0; i < tetra.corners(); ++i)
        block.nodes.push_back(vertices.place(tetra.vertices[i]));
      numbers.push_back(cell);
    }
  }
  const auto add = [&](std::pair<CellBlock, std::vector<std::int32_t>>& entry) {
    if (entry.second.empty()) return;
    mesh.blocks.push_back(std::move(entry.first));
    mesh.cell.insert(mesh.cell.end(), entry.second.begin(), entry.second.end());
  };
  constexpr std::array kTypes{CellType::tetra, CellType::triangle, CellType::line};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    parts[i].first.type = kTypes[i];
    for (auto& [type, entry] : blocks) {
      if (info(type).dimension == info(kTypes[i]).dimension) add(entry);
    }
    add(parts[i]);
  }
  mesh.vertices = std::move(vertices.riders);
  mesh.vertex_node = std::move(vertices.numbers);
  return mesh;
}

std::vector<Piece> pieces(const Hosts& hosts, const Material& material) {
  const MaterialFaces all = material_faces(hosts, material);
  DisjointSets sets(all.units.size());
  for (const MaterialFace& face : all.faces) {
    if (face.across >= 0) sets.join(face.unit, all.faces[at(face.across)].unit);
  }
  for (const auto& [one, other] : all.carried) sets.join(one, other);
  std::vector<std::int32_t> number(all.units.size(), -1);
  std::vector<Piece> found;
  for (std::size_t u = 0; u < all.units.size(); ++u) {
    std::int32_t& own = number[at(sets.first(static_cast<std::int32_t>(u)))];
    if (own < 0) {
      own = static_cast<std::int32_t>(found.size());
      found.push_back({{}, 0.0});
    }
    Piece& piece = found[at(own)];
    const std::int32_t cell = all.units[u].cell;
    if (piece.cells.empty() || piece.cells.back() != cell) piece.cells.push_back(cell);
    piece.volume += volume(hosts, material, all.units[u]);
  }
  return found;
}

}  // namespace tissu
