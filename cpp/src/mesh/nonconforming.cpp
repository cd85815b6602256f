#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "face.h"
#include "tissu/mesh/topology.h"

namespace tissu {
namespace {

using Key = std::array<std::int32_t, 4>;
using Edge = std::array<std::int32_t, 2>;

/// Four corners more tetrahedral than this are not a torn quad but the place of a missing cell.
constexpr double kFlat = 0.1;

/// Something that fills four corners from one side: a quad, or two triangles on both sides of a diagonal.
struct Filling {
  Key key;        ///< the four corners, ascending
  Edge diagonal;  ///< ascending; -1 -1 for a quad
  Edge cells;     ///< of the two triangles; the same one twice for a quad
};

Filling quad_filling(const Face& face) { return {face.key, {-1, -1}, {face.cell, face.cell}}; }

/// One edge of a triangle of the boundary.
struct Side {
  Edge edge;
  std::int32_t apex;
  std::int32_t cell;
};

std::vector<Side> sides(const std::vector<Face>& boundary) {
  std::vector<Side> result;
  for (const Face& face : boundary) {
    if (face.corners != 3) continue;
    const auto& k = face.key;
    result.push_back({{k[0], k[1]}, k[2], face.cell});
    result.push_back({{k[1], k[2]}, k[0], face.cell});
    result.push_back({{k[0], k[2]}, k[1], face.cell});
  }
  std::ranges::stable_sort(result, {}, &Side::edge);
  return result;
}

/// Quads, and every two triangles with a common edge.
std::vector<Filling> fillings(const std::vector<Face>& boundary) {
  std::vector<Filling> result;
  for (const Face& face : boundary)
    if (face.corners == 4) result.push_back(quad_filling(face));
  const std::vector<Side> all = sides(boundary);
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size() && all[j].edge == all[i].edge; ++j) {
      Key key{all[i].edge[0], all[i].edge[1], all[i].apex, all[j].apex};
      std::ranges::sort(key);
      result.push_back({key, all[i].edge, {all[i].cell, all[j].cell}});
    }
  std::ranges::stable_sort(result, {}, &Filling::key);
  return result;
}

/// Whether the four nodes lie in a plane, by the quality of the tetrahedron between them.
bool flat(const Mesh& mesh, const Key& key) {
  std::array<Vec3, 4> x;
  for (std::size_t a = 0; a < 4; ++a) x[a] = mesh.node(key[a]);
  double squares = 0.0;
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = a + 1; b < 4; ++b) squares += (x[a] - x[b]).squaredNorm();
  const double six_volumes = (x[1] - x[0]).dot((x[2] - x[0]).cross(x[3] - x[0]));
  return std::numbers::sqrt2 * std::abs(six_volumes) <= kFlat * std::pow(squares / 6.0, 1.5);
}

bool share(const Edge& a, const Edge& b) {
  return a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1];
}

/// Whether two fillings of the same corners face each other without matching.
bool torn(const Mesh& mesh, const Filling& a, const Filling& b) {
  if (a.diagonal == b.diagonal || share(a.cells, b.cells)) return false;
  if (a.diagonal[0] < 0 || b.diagonal[0] < 0) return true;
  return !share(a.diagonal, b.diagonal) && flat(mesh, a.key);
}

void add_torn_quads(const Mesh& mesh, NonconformingFaces& found) {
  const std::vector<Filling> all = fillings(boundary_faces(mesh));
  for (auto first = all.begin(); first != all.end();) {
    const auto last = std::find_if(first, all.end(), [&](const Filling& f) { return f.key != first->key; });
    bool counted = false;
    for (auto a = first; a != last; ++a)
      for (auto b = a + 1; b != last; ++b) {
        if (!torn(mesh, *a, *b)) continue;
        found.cells.insert(found.cells.end(), {a->cells[0], a->cells[1], b->cells[0], b->cells[1]});
        counted = true;
      }
    found.count += counted ? 1 : 0;
    first = last;
  }
}

/// A face's nodes beyond its corners, ascending.
std::array<std::int32_t, 9> middles(const Mesh& mesh, const Face& face) {
  std::array<std::int32_t, 9> nodes = face_nodes(mesh, face);
  std::fill(nodes.begin(), nodes.begin() + face.corners, -1);
  std::ranges::sort(nodes);
  return nodes;
}

void add_other_middles(const Mesh& mesh, NonconformingFaces& found) {
  const std::vector<Face> all = all_faces(mesh);
  for_each_face(all, [&](std::span<const std::int32_t> same) {
    if (same.size() != 2) return;
    const Face& a = all[static_cast<std::size_t>(same[0])];
    const Face& b = all[static_cast<std::size_t>(same[1])];
    if (middles(mesh, a) == middles(mesh, b)) return;
    ++found.count;
    found.cells.insert(found.cells.end(), {a.cell, b.cell});
  });
}

}  // namespace

NonconformingFaces nonconforming_faces(const Mesh& mesh) {
  NonconformingFaces found;
  add_torn_quads(mesh, found);
  const auto quadratic = [](const CellBlock& block) { return info(block.type).order > 1; };
  if (std::ranges::any_of(mesh.blocks, quadratic)) add_other_middles(mesh, found);
  std::ranges::sort(found.cells);
  const auto [first, last] = std::ranges::unique(found.cells);
  found.cells.erase(first, last);
  return found;
}

}  // namespace tissu
