#include "edit/cut/crumbs.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "edit/cut/side.h"
#include "tissu/base/crossing.h"
#include "tissu/base/disjoint_sets.h"
#include "tissu/base/index.h"
#include "tissu/base/sort_unique.h"

namespace tissu {
namespace {

using Numbers = std::vector<std::int32_t>;

/// Of a cell's longest edge: so near a wall a set between chord and blade lies.
constexpr double kAtWall = 0.07;

/// Tetrahedra that have only vertices on the cut, in sets that closed faces join, of those sets that no
/// closed face joins to others; by the lowest number. A piece of a line between two crossings is a part.
std::map<std::int32_t, Numbers> loose_sets(const Patch& patch, const OnCut& known,
                                           const std::vector<InnerFace>& faces) {
  const std::size_t count = patch.tetrahedra.size();
  std::vector<char> on_cut(count, 0);
  for (std::size_t t = 0; t < count; ++t) {
    const Patch::Tetra& tetra = patch.tetrahedra[t];
    const auto is_on = [&](std::int32_t v) { return v < 0 || known.may_end(v); };
    on_cut[t] = tetra.corners() > 2 && std::ranges::all_of(tetra.vertices, is_on) ? 1 : 0;
  }
  DisjointSets sets(count);
  std::vector<char> held(count, 0);
  for (const InnerFace& face : faces) {
    if (face.open || face.opens) continue;
    if (on_cut[at(face.a)] != 0 && on_cut[at(face.b)] != 0) sets.join(face.a, face.b);
    if (on_cut[at(face.a)] == 0) held[at(face.b)] = 1;
    if (on_cut[at(face.b)] == 0) held[at(face.a)] = 1;
  }
  for (std::size_t t = 0; t < count; ++t) {
    if (on_cut[t] != 0 && held[t] != 0) held[at(sets.first(static_cast<std::int32_t>(t)))] = 1;
  }
  std::map<std::int32_t, Numbers> loose;
  for (std::size_t t = 0; t < count; ++t) {
    if (on_cut[t] == 0) continue;
    const std::int32_t set = sets.first(static_cast<std::int32_t>(t));
    if (held[at(set)] == 0) loose[set].push_back(static_cast<std::int32_t>(t));
  }
  return loose;
}

/// All tetrahedra of the patch, in sets that closed faces join.
DisjointSets joined(const Patch& patch, const std::vector<InnerFace>& faces) {
  using Side = std::pair<std::array<std::int32_t, 3>, std::int32_t>;
  std::vector<Side> sides;
  for (std::size_t t = 0; t < patch.tetrahedra.size(); ++t) {
    const Patch::Tetra& tetra = patch.tetrahedra[t];
    for (std::size_t f = 0; f < tetra.corners(); ++f) {
      if ((tetra.cut >> f & 1U) != 0) continue;
      std::array<std::int32_t, 3> key{};
      for (std::size_t i = 0; i < 3; ++i) key[i] = tetra.vertices[kOpposite[f][i]];
      std::ranges::sort(key);
      sides.emplace_back(key, static_cast<std::int32_t>(t));
    }
  }
  std::ranges::sort(sides);
  std::vector<std::pair<std::int32_t, std::int32_t>> opening;
  for (const InnerFace& face : faces) {
    if (face.opens) opening.emplace_back(std::minmax(face.a, face.b));
  }
  std::ranges::sort(opening);
  DisjointSets sets(patch.tetrahedra.size());
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    const std::int32_t a = sides[i].second;
    const std::int32_t b = sides[i + 1].second;
    if (sides[i].first != sides[i + 1].first) continue;
    if (!std::ranges::binary_search(opening, std::pair(a, b))) sets.join(a, b);
  }
  return sets;
}

/// Whether some face of the set lies on the border of the body, or on an earlier cut.
bool is_at_border(const Patch& patch, const std::vector<InnerFace>& faces, const Numbers& members) {
  std::size_t all = 0;
  for (const std::int32_t t : members) all += patch.tetra(t).corners();
  std::size_t inner = 0;
  for (const InnerFace& face : faces) {
    if (face.open) continue;
    for (const std::int32_t t : {face.a, face.b}) inner += std::ranges::binary_search(members, t) ? 1 : 0;
  }
  return inner < all;
}

/// Vertices of the tetrahedra around that are not on the cut, ascending.
Numbers vertices_around(const Patch& patch, const OnCut& known, const Numbers& members) {
  Numbers around;
  for (const std::int32_t t : members) {
    for (std::size_t i = 0; i < patch.tetra(t).corners(); ++i) {
      for (const std::int32_t other : patch.tetrahedra_at(patch.tetra(t).vertices[i])) {
        for (const std::int32_t v : patch.tetra(other).vertices) {
          if (v >= 0 && !known.may_end(v)) around.push_back(v);
        }
      }
    }
  }
  sort_unique(around);
  return around;
}

Vec3 middle_of(const Patch& patch, std::int32_t t) {
  const Patch::Tetra& tetra = patch.tetra(t);
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < tetra.corners(); ++i) sum += patch.vertex(tetra.vertices[i]).place;
  return sum / static_cast<double>(tetra.corners());
}

/// Whether the set lies between walls of a blade that passes its cells more than once, not at one of them.
bool lies_between(const Patch& patch, const Blade& blade, const Numbers& members) {
  Numbers all(blade.part.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  return std::ranges::any_of(members, [&](std::int32_t t) {
    const std::int32_t cell = patch.tetra(t).cell;
    const double reach = kAtWall * patch.cell(cell).size;
    return blade.crowded.has(cell) && distance(blade.part, all, middle_of(patch, t)) > reach;
  });
}

/// Whether the blade leaves a way from the middle of one of the tetrahedra to a vertex around.
bool sees_a_vertex(const Patch& patch, const SweepPart& part, const OnCut& known, const Numbers& members) {
  const Numbers around = vertices_around(patch, known, members);
  return std::ranges::any_of(members, [&](std::int32_t t) {
    const Vec3 middle = middle_of(patch, t);
    return std::ranges::any_of(around, [&](std::int32_t v) {
      const Vec3& place = patch.vertex(v).place;
      return std::ranges::none_of(part.triangles, [&](const auto& t) { return crosses(middle, place, t); });
    });
  });
}

/// Crumbs join their neighbours, across the faces that would have opened.
class Keeper {
 public:
  Keeper(DisjointSets sets, std::vector<InnerFace>& faces) : sets_(std::move(sets)), faces_(faces) {}

  void add_crumb(std::int32_t tetra) { crumbs_.push_back(tetra); }

  void keep() {
    while (!crumbs_.empty()) {
      const std::int32_t crumb = crumbs_.back();
      const std::int32_t neighbour = greatest_neighbour(crumb);
      crumbs_.pop_back();
      // With another crumb it is one, which that one stands for.
      if (neighbour >= 0) close(sets_.first(crumb), neighbour);
    }
  }

 private:
  bool is_crumb(std::int32_t set) {
    return std::ranges::any_of(crumbs_, [&](std::int32_t crumb) { return sets_.first(crumb) == set; });
  }

  /// The set to which faces of the greatest area lead that would open, no crumb if possible; -1: none.
  std::int32_t greatest_neighbour(std::int32_t crumb) {
    const std::int32_t own = sets_.first(crumb);
    std::map<std::int32_t, double> areas;
    for (const InnerFace& face : faces_) {
      const std::int32_t a = sets_.first(face.a);
      const std::int32_t b = sets_.first(face.b);
      if (face.opens && a != b && (a == own || b == own)) areas[a == own ? b : a] += face.area;
    }
    std::tuple<bool, double, std::int32_t> best{false, -1.0, -1};
    for (const auto& [set, area] : areas) best = std::max(best, {!is_crumb(set), area, -1 - set});
    return std::get<1>(best) < 0.0 ? -1 : -1 - std::get<2>(best);
  }

  void close(std::int32_t own, std::int32_t other) {
    for (InnerFace& face : faces_) {
      const std::int32_t a = sets_.first(face.a);
      const std::int32_t b = sets_.first(face.b);
      if ((a == own && b == other) || (a == other && b == own)) face.opens = false;
    }
    sets_.join(own, other);
  }

  DisjointSets sets_;
  std::vector<InnerFace>& faces_;
  Numbers crumbs_;  ///< one tetrahedron of each
};

}  // namespace

void keep_crumbs(const Patch& patch, const Blade& blade, const OnCut& known, std::vector<InnerFace>& faces) {
  const std::map<std::int32_t, Numbers> loose = loose_sets(patch, known, faces);
  if (loose.empty()) return;
  Keeper keeper(joined(patch, faces), faces);
  for (const auto& [set, members] : loose) {
    if (lies_between(patch, blade, members)) continue;
    if (!is_at_border(patch, faces, members) || sees_a_vertex(patch, blade.part, known, members))
      keeper.add_crumb(set);
  }
  keeper.keep();
}

}  // namespace tissu
