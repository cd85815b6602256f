#include "tissu/mesh/topology.h"

#include <algorithm>
#include <numeric>

namespace tissu {
namespace {

constexpr std::array<LocalFace, 4> kTetraFaces{
    {{3, {0, 2, 1, 0}}, {3, {0, 1, 3, 0}}, {3, {1, 2, 3, 0}}, {3, {0, 3, 2, 0}}}};

constexpr std::array<LocalFace, 6> kHexahedronFaces{{{4, {0, 3, 2, 1}},
                                                     {4, {4, 5, 6, 7}},
                                                     {4, {0, 1, 5, 4}},
                                                     {4, {1, 2, 6, 5}},
                                                     {4, {2, 3, 7, 6}},
                                                     {4, {3, 0, 4, 7}}}};

/// A face of the mesh: its nodes in ascending order (a triangle ends in -1) name it whatever cell it is seen
/// from.
struct Face {
  std::array<std::int32_t, 4> key;
  std::array<std::int32_t, 4> nodes;
  std::int32_t cell;
  int size;
};

Face make_face(const LocalFace& local, std::span<const std::int32_t> cell_nodes, std::int32_t cell) {
  Face face{{-1, -1, -1, -1}, {-1, -1, -1, -1}, cell, local.size};
  const auto size = static_cast<std::size_t>(local.size);
  for (std::size_t c = 0; c < size; ++c) face.nodes[c] = cell_nodes[local.corners[c]];
  face.key = face.nodes;
  std::sort(face.key.begin(), face.key.begin() + local.size);
  return face;
}

std::vector<Face> all_faces(const Mesh& mesh) {
  std::vector<Face> result;
  std::int32_t cell = 0;
  for (const CellBlock& block : mesh.blocks)
    for (std::int32_t i = 0; i < block.size(); ++i, ++cell)
      for (const LocalFace& local : faces(block.type))
        result.push_back(make_face(local, block.cell(i), cell));
  return result;
}

/// Calls `visit` with the numbers of the faces of `all` that are the same face.
template <class Visit>
void for_each_face(const std::vector<Face>& all, Visit visit) {
  std::vector<std::int32_t> order(all.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](std::int32_t f) -> const auto& { return all[static_cast<std::size_t>(f)].key; };
  std::ranges::stable_sort(order, {}, key);
  for (auto first = order.begin(); first != order.end();) {
    const auto last = std::find_if(first, order.end(), [&](std::int32_t f) { return key(f) != key(*first); });
    visit(std::span<const std::int32_t>(first, last));
    first = last;
  }
}

void append(const Face& face, Surface& surface) {
  const auto& n = face.nodes;
  if (face.size == 3) {
    surface.triangles.push_back({n[0], n[1], n[2]});
    surface.triangle_cell.push_back(face.cell);
  } else {
    surface.quads.push_back(n);
    surface.quad_cell.push_back(face.cell);
  }
}

/// Union of disjoint sets of nodes, with path halving.
class NodeSets {
 public:
  explicit NodeSets(std::int32_t count) : parent_(static_cast<std::size_t>(count)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  std::int32_t root(std::int32_t node) {
    while (parent(node) != node) node = parent(node) = parent(parent(node));
    return node;
  }

  void join(std::int32_t a, std::int32_t b) { parent(root(a)) = root(b); }

 private:
  std::int32_t& parent(std::int32_t node) { return parent_[static_cast<std::size_t>(node)]; }

  std::vector<std::int32_t> parent_;
};

}  // namespace

std::span<const LocalFace> faces(CellType type) {
  switch (type) {
    case CellType::tetra:
      return kTetraFaces;
    case CellType::hexahedron:
      return kHexahedronFaces;
  }
  return {};
}

Surface boundary_surface(const Mesh& mesh) {
  const std::vector<Face> all = all_faces(mesh);
  std::vector<std::int32_t> outer;
  for_each_face(all, [&](std::span<const std::int32_t> same) {
    if (same.size() == 1) outer.push_back(same[0]);
  });
  std::ranges::sort(outer);
  Surface surface;
  for (const std::int32_t f : outer) append(all[static_cast<std::size_t>(f)], surface);
  return surface;
}

std::int32_t overfull_face_count(const Mesh& mesh) {
  std::int32_t count = 0;
  for_each_face(all_faces(mesh),
                [&](std::span<const std::int32_t> same) { count += same.size() > 2 ? 1 : 0; });
  return count;
}

std::vector<std::int32_t> connected_parts(const Mesh& mesh) {
  NodeSets sets(mesh.node_count());
  for (const CellBlock& block : mesh.blocks)
    for (std::int32_t i = 0; i < block.size(); ++i)
      for (const std::int32_t node : block.cell(i)) sets.join(node, block.cell(i)[0]);

  std::vector<std::int32_t> number(static_cast<std::size_t>(mesh.node_count()), -1);
  std::vector<std::int32_t> parts;
  std::int32_t next = 0;
  for (const CellBlock& block : mesh.blocks)
    for (std::int32_t i = 0; i < block.size(); ++i) {
      std::int32_t& part = number[static_cast<std::size_t>(sets.root(block.cell(i)[0]))];
      if (part < 0) part = next++;
      parts.push_back(part);
    }
  return parts;
}

}  // namespace tissu
