#include "edit/cut/blade_sides.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "tissu/base/crossing.h"
#include "tissu/base/index.h"
#include "tissu/base/sort_unique.h"

namespace tissu {
namespace {

using Numbers = std::vector<std::int32_t>;

constexpr std::int32_t kNone = -1;

std::int32_t first(Numbers& root, std::int32_t i) {
  while (root[at(i)] != i) i = root[at(i)] = root[at(root[at(i)])];
  return i;
}

/// Two tetrahedra with a common face that is not open.
struct Link {
  std::int32_t a;
  std::int32_t b;
};

/// Those at whose common face every vertex is on the cut: at any other vertex all tetrahedra have its side.
std::vector<Link> links_on_cut(const Patch& patch, const Numbers& side) {
  struct Face {
    std::array<std::int32_t, 3> key;
    std::int32_t tetra;
  };
  std::vector<Face> faces;
  for (std::size_t t = 0; t < patch.tetrahedra.size(); ++t) {
    const Patch::Tetra& tetra = patch.tetrahedra[t];
    for (std::size_t f = 0; f < tetra.corners(); ++f) {
      if ((tetra.cut >> f & 1U) != 0) continue;
      const auto& v = tetra.vertices;
      std::array<std::int32_t, 3> key{v[kOpposite[f][0]], v[kOpposite[f][1]], v[kOpposite[f][2]]};
      if (!std::ranges::all_of(key, [&](std::int32_t i) { return i < 0 || side[at(i)] == kNone; })) continue;
      std::ranges::sort(key);
      faces.push_back({key, static_cast<std::int32_t>(t)});
    }
  }
  std::ranges::sort(
      faces, [](const Face& a, const Face& b) { return a.key != b.key ? a.key < b.key : a.tetra < b.tetra; });
  std::vector<Link> links;
  for (std::size_t i = 0; i + 1 < faces.size(); ++i) {
    if (faces[i].key != faces[i + 1].key) continue;
    links.push_back({faces[i].tetra, faces[i + 1].tetra});
    links.push_back({faces[i + 1].tetra, faces[i].tetra});
  }
  std::ranges::sort(links, [](const Link& x, const Link& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; });
  return links;
}

/// The sides of tetrahedra, and the cells in which two meet.
class Flood {
 public:
  Flood(const Patch& patch, Numbers of_vertices)
      : patch_(patch), of_vertices_(std::move(of_vertices)), side_(patch.tetrahedra.size(), kNone) {}

  Numbers run() {
    for (std::size_t t = 0; t < side_.size(); ++t) {
      if (patch_.is_mixed() && patch_.tetrahedra[t].corners() < 4) continue;  // it goes with its carrier
      for (const std::int32_t v : patch_.tetrahedra[t].vertices) {
        if (v >= 0 && of_vertices_[at(v)] != kNone) meet(static_cast<std::int32_t>(t), of_vertices_[at(v)]);
      }
    }
    spread(links_on_cut(patch_, of_vertices_));
    sort_unique(met_);
    return std::move(met_);
  }

 private:
  void meet(std::int32_t tetra, std::int32_t side) {
    if (side_[at(tetra)] == kNone) {
      side_[at(tetra)] = side;
      reached_.push_back(tetra);
    } else if (side_[at(tetra)] != side) {
      met_.push_back(patch_.tetra(tetra).cell);
    }
  }

  void spread(const std::vector<Link>& links) {
    for (std::size_t i = 0; i < reached_.size(); ++i) {
      const std::int32_t from = reached_[i];
      for (const Link& link : std::ranges::equal_range(links, from, {}, &Link::a)) {
        if (side_[at(link.b)] != kNone && side_[at(link.b)] != side_[at(from)])
          met_.push_back(patch_.tetra(from).cell);
        meet(link.b, side_[at(from)]);
      }
    }
  }

  const Patch& patch_;
  Numbers of_vertices_;
  Numbers side_;
  Numbers reached_;
  Numbers met_;
};

constexpr std::array<std::array<std::uint8_t, 2>, 6> kEdges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

}  // namespace

BladeSides::BladeSides(const Patch& patch, const Sweep& sweep, const std::vector<NearCells>& near)
    : side_(patch.vertices.size()) {
  std::iota(side_.begin(), side_.end(), 0);
  std::vector<std::array<Vec3, 3>> triangles;
  std::int32_t cell = -1;
  for (const Patch::Tetra& tetra : patch.tetrahedra) {
    if (tetra.cell != cell) {
      cell = tetra.cell;
      triangles.clear();
      for (std::size_t i = 0; i < near.size(); ++i) {
        for (const std::int32_t t : near[i].triangles(patch.cell(cell).number))
          triangles.push_back(sweep.parts[i].triangles[at(t)]);
      }
    }
    for (const auto& [i, j] : kEdges) {
      if (tetra.vertices[j] < 0) continue;
      const auto [low, high] =
          std::minmax({first(side_, tetra.vertices[i]), first(side_, tetra.vertices[j])});
      if (low == high) continue;
      const Vec3& a = patch.vertex(tetra.vertices[i]).place;
      const Vec3& b = patch.vertex(tetra.vertices[j]).place;
      if (std::ranges::any_of(triangles, [&](const auto& t) { return crosses(a, b, t); })) continue;
      side_[at(high)] = low;
    }
  }
  for (std::size_t v = 0; v < side_.size(); ++v) side_[v] = first(side_, static_cast<std::int32_t>(v));
}

std::vector<std::int32_t> BladeSides::joined(const Patch& patch, const std::vector<char>& on) const {
  Numbers of_vertices(patch.vertices.size(), kNone);
  for (std::size_t v = 0; v < side_.size(); ++v) {
    if (on[v] == 0) of_vertices[v] = side_[v];
  }
  return Flood(patch, std::move(of_vertices)).run();
}

}  // namespace tissu
