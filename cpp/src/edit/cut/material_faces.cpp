#include "edit/cut/material_faces.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include "edit/cut/carriers.h"
#include "edit/cut/face_key.h"
#include "edit/cut/patch.h"
#include "tissu/base/index.h"
#include "tissu/mesh/cell_shape.h"

namespace tissu {
namespace {

void add_whole(const Hosts& hosts, std::int32_t cell, MaterialFaces& all) {
  const auto unit = static_cast<std::int32_t>(all.units.size());
  all.units.push_back({cell, -1});
  const auto nodes = hosts.corners(cell);
  if (nodes.size() == 2) {
    for (const std::int32_t node : nodes)
      all.faces.push_back({{node, kNoVertex, kNoVertex}, unit, false, -1});
    return;
  }
  if (info(hosts.type(cell)).dimension == 2) {
    for (std::size_t i = 0; i < nodes.size(); ++i)
      all.faces.push_back({{nodes[i], nodes[(i + 1) % nodes.size()], kNoVertex}, unit, false, -1});
    return;
  }
  for (const LocalFace& face : faces(hosts.type(cell))) {
    const auto size = at(face.corners);
    std::size_t low = 0;
    for (std::size_t c = 1; size == 4 && c < size; ++c) {
      if (hosts.root(nodes[face.node[c]]) < hosts.root(nodes[face.node[low]])) low = c;
    }
    for (std::size_t c = 1; c + 1 < size; ++c) {
      const auto corner = [&](std::size_t i) { return nodes[face.node[(low + i) % size]]; };
      all.faces.push_back({{corner(0), corner(c), corner(c + 1)}, unit, false, -1});
    }
  }
}

void add_list(std::int32_t cell, const std::vector<MaterialTetra>& list, MaterialFaces& all) {
  for (std::size_t t = 0; t < list.size(); ++t) {
    const auto unit = static_cast<std::int32_t>(all.units.size());
    all.units.push_back({cell, static_cast<std::int32_t>(t)});
    for (std::size_t f = 0; f < list[t].corners(); ++f) {
      const auto& v = list[t].vertices;
      const auto& [a, b, c] = kOpposite[f];
      all.faces.push_back({{v[a], v[b], v[c]}, unit, (list[t].cut >> f & 1U) != 0, -1});
    }
  }
}

void add(const Hosts& hosts, const Material& material, std::int32_t cell, MaterialFaces& all) {
  const auto stored = material.cells.find(cell);
  if (stored == material.cells.end()) {
    add_whole(hosts, cell, all);
  } else {
    add_list(cell, stored->second, all);
  }
}

/// The first and the latest face with the same vertices, in a table of open addresses.
class SameFaces {
 public:
  explicit SameFaces(std::size_t count) : slots_(std::bit_ceil(2 * count + 1)) {}
  struct Slot {
    FaceKey key{};
    std::int32_t first = -1;  ///< -1: it is free
    std::int32_t latest = -1;
  };
  Slot& at_key(const FaceKey& key) {
    std::size_t place = hash_of(key) & (slots_.size() - 1);
    while (slots_[place].first >= 0 && slots_[place].key != key) place = (place + 1) & (slots_.size() - 1);
    return slots_[place];
  }

 private:
  std::vector<Slot> slots_;
};

/// Faces with the same vertices that no cut opened are joined: each to the next one, the last to the first.
void join_faces(std::vector<MaterialFace>& faces) {
  SameFaces same(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (faces[f].cut) continue;
    FaceKey key = faces[f].vertices;
    std::ranges::sort(key);
    SameFaces::Slot& slot = same.at_key(key);
    const auto own = static_cast<std::int32_t>(f);
    if (slot.first < 0) {
      slot = {key, own, own};
      continue;
    }
    faces[at(slot.latest)].across = own;
    faces[f].across = slot.first;
    slot.latest = own;
  }
}

/// Which units of a body with cells of several dimensions hang together across them, by the rules of
/// carriers.h: the pieces of all of them are one patch.
void join_dimensions(const Hosts& hosts, const Material& material, MaterialFaces& all) {
  int dimension = 0;
  const bool mixed = std::ranges::any_of(all.units, [&](const MaterialUnit& unit) {
    const int own = info(hosts.type(unit.cell)).dimension;
    return std::exchange(dimension, own) != own && &unit != &all.units.front();
  });
  if (!mixed) return;
  const std::vector<std::int32_t> numbers = hosts.numbers();
  const Patch patch(hosts, material, hosts.rest(), numbers);
  std::vector<std::int32_t> unit_of;  // of each piece
  for (std::size_t u = 0; u < all.units.size(); ++u) {
    const MaterialUnit& unit = all.units[u];
    const std::size_t pieces = unit.tetra < 0 ? whole_material(hosts, unit.cell).size() : 1;
    unit_of.insert(unit_of.end(), pieces, static_cast<std::int32_t>(u));
  }
  const Carriers carriers(patch, std::vector<char>(patch.tetrahedra.size(), 1));
  for (const auto& [one, other] : carriers.pairs()) {
    if (one < other) all.carried.emplace_back(unit_of[at(one)], unit_of[at(other)]);
  }
}

}  // namespace

MaterialFaces material_faces(const Hosts& hosts, const Material& material, int dimension) {
  MaterialFaces all;
  for (const std::int32_t cell : hosts.numbers()) {
    if (dimension == 0 || info(hosts.type(cell)).dimension == dimension) add(hosts, material, cell, all);
  }
  join_faces(all.faces);
  join_dimensions(hosts, material, all);
  return all;
}

MaterialFaces faces_among(const Hosts& hosts, const Material& material, std::span<const std::int32_t> cells) {
  MaterialFaces all;
  for (const std::int32_t cell : cells) add(hosts, material, cell, all);
  join_faces(all.faces);
  return all;
}

}  // namespace tissu
