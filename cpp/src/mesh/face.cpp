#include "face.h"

#include <algorithm>
#include <span>

namespace tissu {

std::vector<Face> all_faces(const Mesh& mesh) {
  std::vector<Face> result;
  std::int32_t cell = 0;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const CellBlock& block = mesh.blocks[b];
    const std::span<const LocalFace> local = faces(block.type);
    for (std::int32_t i = 0; i < block.size(); ++i, ++cell)
      for (std::size_t f = 0; f < local.size(); ++f) {
        Face face{{-1, -1, -1, -1},
                  cell,
                  static_cast<std::int32_t>(b),
                  static_cast<std::uint8_t>(f),
                  static_cast<std::uint8_t>(local[f].corners),
                  i};
        for (std::size_t c = 0; c < face.corners; ++c) face.key[c] = block.cell(i)[local[f].node[c]];
        std::ranges::sort(std::span(face.key).first(std::min<std::size_t>(face.corners, face.key.size())));
        result.push_back(face);
      }
  }
  return result;
}

std::array<std::int32_t, 9> face_nodes(const Mesh& mesh, const Face& face) {
  const CellBlock& block = mesh.blocks[static_cast<std::size_t>(face.block)];
  const LocalFace& local = faces(block.type)[face.local];
  std::array<std::int32_t, 9> nodes;
  nodes.fill(-1);
  for (std::size_t n = 0; n < static_cast<std::size_t>(local.nodes); ++n)
    nodes[n] = block.cell(face.in_block)[local.node[n]];
  return nodes;
}

std::vector<Face> boundary_faces(const Mesh& mesh) {
  const std::vector<Face> all = all_faces(mesh);
  std::vector<std::int32_t> outer;
  for_each_face(all, [&](std::span<const std::int32_t> same) {
    if (same.size() == 1) outer.push_back(same[0]);
  });
  std::ranges::sort(outer);
  std::vector<Face> result;
  result.reserve(outer.size());
  for (const std::int32_t f : outer) result.push_back(all[static_cast<std::size_t>(f)]);
  return result;
}

}  // namespace tissu
