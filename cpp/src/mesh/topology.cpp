#include "tissu/mesh/topology.h"

#include <numeric>

#include "face.h"

namespace tissu {
namespace {

using Triangle = std::array<std::uint8_t, 3>;

/// Triangles between the nodes of a face: the corners, the middles of the edges, the middle.
constexpr std::array<Triangle, 1> kThree{{{0, 1, 2}}};
constexpr std::array<Triangle, 4> kSix{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}};
constexpr std::array<Triangle, 6> kEight{{{0, 4, 7}, {1, 5, 4}, {2, 6, 5}, {3, 7, 6}, {4, 5, 6}, {4, 6, 7}}};
constexpr std::array<Triangle, 8> kNine{
    {{0, 4, 8}, {4, 1, 8}, {1, 5, 8}, {5, 2, 8}, {2, 6, 8}, {6, 3, 8}, {3, 7, 8}, {7, 0, 8}}};

std::span<const Triangle> triangles(int nodes) {
  switch (nodes) {
    case 3:
      return kThree;
    case 6:
      return kSix;
    case 8:
      return kEight;
    default:
      return kNine;
  }
}

void append(const Mesh& mesh, const Face& face, Surface& surface) {
  const auto n = face_nodes(mesh, face);
  const int nodes = faces(mesh.blocks[static_cast<std::size_t>(face.block)].type)[face.local].nodes;
  if (nodes == 4) {
    surface.quads.push_back({n[0], n[1], n[2], n[3]});
    surface.quad_cell.push_back(face.cell);
    return;
  }
  for (const Triangle& t : triangles(nodes)) {
    surface.triangles.push_back({n[t[0]], n[t[1]], n[t[2]]});
    surface.triangle_cell.push_back(face.cell);
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

Surface boundary_surface(const Mesh& mesh) {
  Surface surface;
  for (const Face& face : boundary_faces(mesh)) append(mesh, face, surface);
  return surface;
}

std::vector<FaceBlock> boundary_face_blocks(const Mesh& mesh) {
  struct Kind {
    std::string_view type;
    std::size_t nodes;
  };
  constexpr std::array<Kind, 5> kinds{
      {{"triangle", 3}, {"quad", 4}, {"triangle6", 6}, {"quad8", 8}, {"quad9", 9}}};
  std::array<FaceBlock, 5> found;
  for (const Face& face : boundary_faces(mesh)) {
    const auto n = face_nodes(mesh, face);
    const auto count = static_cast<std::size_t>(std::ranges::find(n, -1) - n.begin());
    const auto* kind = std::ranges::find(kinds, count, &Kind::nodes);
    FaceBlock& block = found[static_cast<std::size_t>(kind - kinds.begin())];
    block.type = kind->type;
    block.nodes.insert(block.nodes.end(), n.begin(), n.begin() + static_cast<std::ptrdiff_t>(count));
    block.cells.push_back(face.cell);
  }
  std::vector<FaceBlock> blocks;
  for (FaceBlock& block : found) {
    if (!block.cells.empty()) blocks.push_back(std::move(block));
  }
  return blocks;
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
