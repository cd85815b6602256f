#include "edit/cut/patch.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "tissu/base/index.h"
#include "tissu/mesh/cell_shape.h"

namespace tissu {
namespace {

double longest_edge(const Hosts& hosts, std::int32_t cell) {
  const auto nodes = hosts.corners(cell);
  double square = 0.0;
  for (const auto& [a, b] : edges(hosts.type(cell))) {
    square = std::max(square, (block(hosts.rest(), nodes[a]) - block(hosts.rest(), nodes[b])).squaredNorm());
  }
  return std::sqrt(square);
}

}  // namespace

Rider between(const Rider& p, const Rider& q, double t) {
  Rider sum = p;
  for (std::size_t i = 0; i < at(p.count); ++i) sum.weight[i] *= 1.0 - t;
  for (std::size_t i = 0; i < at(q.count); ++i) {
    const auto end = sum.node.begin() + sum.count;
    const auto same =
        static_cast<std::size_t>(std::find(sum.node.begin(), end, q.node[i]) - sum.node.begin());
    assert(same < sum.node.size() && "an edge of the material lies in one corner tetrahedron");
    if (same == at(sum.count)) {
      sum.node[same] = q.node[i];
      sum.weight[same] = 0.0;
      ++sum.count;
    }
    sum.weight[same] += t * q.weight[i];
  }
  return sum;
}

Patch::Patch(const Hosts& hosts, const Material& material, ConstReals x,
             const std::vector<std::int32_t>& cells)
    : old_riders(static_cast<std::int32_t>(material.riders.size())) {
  places_.reserve(cells.size());
  cell_places_.reserve(cells.size());
  extend(hosts, material, x, cells);
}

void Patch::extend(const Hosts& hosts, const Material& material, ConstReals x,
                   const std::vector<std::int32_t>& cells) {
  for (const std::int32_t cell : cells) {
    if (cell_places_.try_emplace(cell, static_cast<std::int32_t>(this->cells.size())).second) {
      add_cell(hosts, material, x, cell);
    }
  }
}

std::int32_t Patch::cell_of(std::int32_t number) const {
  const auto entry = cell_places_.find(number);
  return entry == cell_places_.end() ? -1 : entry->second;
}

void Patch::add_cell(const Hosts& hosts, const Material& material, ConstReals x, std::int32_t number) {
  const auto place = static_cast<std::int32_t>(cells.size());
  const auto stored = material.cells.find(number);
  const bool has_list = stored != material.cells.end();
  cells.push_back({number, has_list, true, longest_edge(hosts, number), hosts.thickness(number)});
  const auto add = [&](const MaterialTetra& tetra) {
    Tetra& own = tetrahedra.emplace_back(Tetra{{-1, -1, -1, -1}, place, tetra.cut});
    dimensions_ |= 1U << tetra.corners();
    for (std::size_t i = 0; i < tetra.corners(); ++i) {
      own.vertices[i] = vertex_of(tetra.vertices[i], hosts, material, x);
      at_[at(own.vertices[i])].push_back(static_cast<std::int32_t>(tetrahedra.size()) - 1);
    }
    if (!(rest_volume(own) > 0.0)) cells.back().sound = false;
  };
  if (has_list) {
    for (const MaterialTetra& tetra : stored->second) add(tetra);
  } else {
    for (const MaterialTetra& tetra : whole_material(hosts, number)) add(tetra);
  }
}

std::int32_t Patch::vertex_of(std::int32_t number, const Hosts& hosts, const Material& material,
                              ConstReals x) {
  const auto [entry, is_new] = places_.try_emplace(number, static_cast<std::int32_t>(vertices.size()));
  if (is_new) {
    Rider rider{{number, -1, -1, -1}, {1.0, 0.0, 0.0, 0.0}, 1};
    if (number < 0) rider = material.riders[at(-1 - number)];
    vertices.push_back({number, rider, material.at(number, x), material.at(number, hosts.rest())});
    at_.emplace_back();
  }
  return entry->second;
}

std::int32_t Patch::place_of(std::int32_t number) const {
  const auto entry = places_.find(number);
  return entry == places_.end() ? -1 : entry->second;
}

std::vector<std::int32_t> Patch::around(std::int32_t p, std::int32_t q) const {
  std::vector<std::int32_t> found;
  for (const std::int32_t t : tetrahedra_at(p)) {
    const auto& v = tetra(t).vertices;
    if (std::ranges::find(v, q) != v.end()) found.push_back(t);
  }
  return found;
}

std::int32_t Patch::divide(std::int32_t p, std::int32_t q, double t) {
  const std::vector<std::int32_t> parents = around(p, q);
  const auto middle = static_cast<std::int32_t>(vertices.size());
  const Vertex a = vertex(p);
  const Vertex b = vertex(q);
  vertices.push_back({-1 - (old_riders + new_riders++), between(a.rider, b.rider, t),
                      (1.0 - t) * a.place + t * b.place, (1.0 - t) * a.rest + t * b.rest});
  at_.emplace_back();
  divisions.push_back({middle, p, q});
  for (const std::int32_t parent : parents) {
    const auto other = static_cast<std::int32_t>(tetrahedra.size());
    Tetra near = tetra(parent);  // keeps p
    Tetra far = near;            // keeps q
    const auto i = static_cast<unsigned>(std::ranges::find(near.vertices, p) - near.vertices.begin());
    const auto j = static_cast<unsigned>(std::ranges::find(near.vertices, q) - near.vertices.begin());
    near.vertices[j] = middle;
    far.vertices[i] = middle;
    near.cut &= static_cast<std::uint8_t>(~(1U << i));  // the face between the two
    far.cut &= static_cast<std::uint8_t>(~(1U << j));
    tetrahedra[at(parent)] = near;
    tetrahedra.push_back(far);
    cells[at(near.cell)].divided = true;
    std::ranges::replace(at_[at(q)], parent, other);
    at_.back().insert(at_.back().end(), {parent, other});
    for (const std::int32_t v : far.vertices) {
      if (v >= 0 && v != q && v != middle) at_[at(v)].push_back(other);
    }
  }
  return middle;
}

double Patch::rest_volume(const Tetra& tetra) const {
  const auto& v = tetra.vertices;
  const Vec3& a = vertex(v[0]).rest;
  if (tetra.corners() == 2) return (vertex(v[1]).rest - a).norm();
  const Vec3 twice = (vertex(v[1]).rest - a).cross(vertex(v[2]).rest - a);
  if (tetra.corners() == 3) return 0.5 * twice.norm();
  return twice.dot(vertex(v[3]).rest - a) / 6.0;
}

}  // namespace tissu
