#include "edit/cut/incisions.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "edit/cut/outward.h"
#include "edit/cut/side.h"
#include "tissu/base/index.h"
#include "tissu/base/sort_unique.h"

namespace tissu {
namespace {

using Numbers = std::vector<std::int32_t>;

/// Of a cell's longest edge: as far from the blade a cut of divided cells may go to a vertex.
constexpr double kGoesTo = 0.25;
constexpr double kLeastAlong = 0.5;  ///< cosine between the normals of a face of the cut and of the blade

/// Numbers of the vertices of an incision, and of those at its front.
struct Lists {
  Numbers vertices;
  Numbers front;

  /// A vertex that has these numbers now: of several, faces of the cut are open all around it.
  void add(const Numbers& now, bool at_front) {
    vertices.insert(vertices.end(), now.begin(), now.end());
    if (at_front && now.size() == 1) front.push_back(now.front());
  }
  [[nodiscard]] Incision incision(std::int32_t number) {
    sort_unique(vertices);
    sort_unique(front);
    return {number, std::move(vertices), std::move(front)};
  }
};

constexpr char kOn = 1;       ///< on an incision
constexpr char kAtFront = 2;  ///< and at its front

/// An edge between two vertices of an incision is one of its surface, so that a vertex which another blade
/// puts on the edge is on that incision too: else the faces there would never open. `on`: of the vertices of
/// the patch.
void add_divided(const Patch& patch, std::vector<char> on, const Fans& fans, Lists& lists) {
  for (const auto& [vertex, p, q] : patch.divisions) {
    if (on[at(p)] == 0 || on[at(q)] == 0 || on[at(vertex)] != 0) continue;
    on[at(vertex)] = std::max(on[at(p)], on[at(q)]);
    lists.add(fans.numbers(vertex), on[at(vertex)] == kAtFront);
  }
}

/// Vertices of tetrahedra at a face that another cut opened. There the cut may go on from a wall.
std::vector<char> beside_other_cuts(const Patch& patch, const OnCut& known) {
  std::vector<char> at_cut(patch.vertices.size(), 0);
  for (const Patch::Tetra& tetra : patch.tetrahedra) {
    for (std::size_t f = 0; f < tetra.corners(); ++f) {
      if ((tetra.cut >> f & 1U) == 0) continue;
      const auto is_before = [&](std::uint8_t i) {
        return tetra.vertices[i] < 0 || known[tetra.vertices[i]].before;
      };
      if (std::ranges::all_of(kOpposite[f], is_before)) continue;
      for (const std::uint8_t i : kOpposite[f]) {
        if (tetra.vertices[i] >= 0) at_cut[at(tetra.vertices[i])] = 1;
      }
    }
  }
  std::vector<char> beside(patch.vertices.size(), 0);
  for (const Patch::Tetra& tetra : patch.tetrahedra) {
    const auto is_at_cut = [&](std::int32_t v) { return v >= 0 && at_cut[at(v)] != 0; };
    if (std::ranges::none_of(tetra.vertices, is_at_cut)) continue;
    for (const std::int32_t v : tetra.vertices) {
      if (v >= 0) beside[at(v)] = 1;
    }
  }
  return beside;
}

/// Of a blade that cuts on, what stands beside it.
class Beside {
 public:
  Beside(const Patch& patch, const SweepPart& part, OnCut& known)
      : patch_(patch), part_(part), known_(known), all_(part.triangles.size()) {
    std::iota(all_.begin(), all_.end(), 0);
  }

  /// Marks vertices of walls to which faces of the cut may go on: near the front, near the blade, and not of
  /// another wall of the incision.
  void mark() {
    for (std::size_t v = 0; v < known_.vertices.size(); ++v) {
      if (!known_.vertices[v].wall) continue;
      double size = 0.0;
      bool at_front = false;
      const auto is_front = [&](std::int32_t w) { return w >= 0 && known_[w].before; };
      for (const std::int32_t t : patch_.tetrahedra_at(static_cast<std::int32_t>(v))) {
        size = std::max(size, patch_.cell(patch_.tetra(t).cell).size);
        at_front = at_front || std::ranges::any_of(patch_.tetra(t).vertices, is_front);
      }
      if (!at_front || distance(part_, all_, patch_.vertices[v].place) > kGoesTo * size) continue;
      int agree = 0;
      for (const std::int32_t t : patch_.tetrahedra_at(static_cast<std::int32_t>(v)))
        agree += agreement(patch_.tetra(t), static_cast<std::int32_t>(v));
      known_.vertices[v].beside = agree > 0;
    }
  }

 private:
  /// Of the open faces of a tetrahedron at a vertex: 1 where it lies on that side of the blade on which it
  /// would be if the blade had parted the face, -1 on the other.
  [[nodiscard]] int agreement(const Patch::Tetra& tetra, std::int32_t v) const {
    double height = 0.0;
    for (const std::int32_t w : tetra.vertices) {
      if (w < 0 || known_[w].wall || known_[w].before) continue;
      height += signed_height(part_, all_, patch_.vertex(w).place);
    }
    if (height == 0.0) return 0;
    int sum = 0;
    for (std::size_t f = 0; f < tetra.corners(); ++f) {
      if ((tetra.cut >> f & 1U) == 0 || tetra.vertices[f] == v) continue;
      const Vec3 out = outward(patch_, tetra, f, &Patch::Vertex::place).normalized();
      const double along = out.dot(nearest_place(part_, all_, patch_.vertex(v).place).normal);
      if (std::abs(along) > kLeastAlong) sum += (along < 0.0) == (height > 0.0) ? 1 : -1;
    }
    return sum;
  }

  const Patch& patch_;
  const SweepPart& part_;
  OnCut& known_;
  std::vector<std::int32_t> all_;
};

/// Of each vertex of the patch: 0, kOn or kAtFront.
std::vector<char> on_incision(const Patch& patch, const Incision& incision) {
  std::vector<char> on(patch.vertices.size(), 0);
  for (std::size_t v = 0; v < on.size(); ++v) {
    const std::int32_t number = patch.vertices[v].number;
    if (!std::ranges::binary_search(incision.vertices, number)) continue;
    on[v] = std::ranges::binary_search(incision.front, number) ? kAtFront : kOn;
  }
  return on;
}

}  // namespace

void remember_incisions(const Patch& patch, const Material& material, const OnIncisions& met, CutPlan& plan) {
  std::map<std::int32_t, Lists> lists;
  for (const auto& [number, known] : met) {
    for (std::size_t v = 0; v < known.vertices.size(); ++v) {
      if (known.vertices[v].on) lists[number].add({patch.vertices[v].number}, true);
    }
  }
  for (auto& [number, list] : lists) {
    const auto before = std::ranges::find(material.incisions, number, &Incision::number);
    const bool goes_on = before != material.incisions.end();
    if (goes_on) {
      list.vertices.insert(list.vertices.end(), before->vertices.begin(), before->vertices.end());
      list.front.insert(list.front.end(), before->front.begin(), before->front.end());
    }
    Incision now = list.incision(number);
    if (!goes_on || now.vertices != before->vertices || now.front != before->front)
      plan.material.incisions.push_back(std::move(now));
  }
}

OnCut known_before(const Patch& patch, const Material& material, const SweepPart& part, bool divide) {
  OnCut known(patch.vertices.size());
  if (part.incision < 0) return known;
  const auto incision = std::ranges::find(material.incisions, part.incision, &Incision::number);
  if (incision == material.incisions.end()) return known;
  std::vector<char> on = on_incision(patch, *incision);
  for (const auto& [vertex, p, q] : patch.divisions) {
    if (on[at(p)] != 0 && on[at(q)] != 0) on[at(vertex)] = std::max(on[at(p)], on[at(q)]);
  }
  if (std::ranges::all_of(on, [](char one) { return one == 0; })) return known;
  for (std::size_t v = 0; v < on.size(); ++v) known.vertices[v].before = on[v] != 0;
  const std::vector<char> others = beside_other_cuts(patch, known);
  for (std::size_t v = 0; v < on.size(); ++v) {
    OnCut::Vertex& vertex = known.vertices[v];
    vertex.wall = on[v] == kOn && others[v] == 0;
    vertex.before = vertex.before && !vertex.wall;
    const Vec3& place = patch.vertices[v].place;
    if (vertex.before) known.put_on(static_cast<std::int32_t>(v), place, place, -1);
    if (vertex.wall) vertex.met = place;
  }
  if (divide) Beside(patch, part, known).mark();
  return known;
}

void write_incisions(const Patch& patch, const Material& material, const OnIncisions& met, const Fans& fans,
                     CutPlan& plan) {
  std::map<std::int32_t, Lists> lists;
  for (const Incision& incision : material.incisions) {
    Lists& list = lists[incision.number];
    for (const std::int32_t vertex : incision.vertices) {
      const std::int32_t place = patch.place_of(vertex);
      list.add(place < 0 ? Numbers{vertex} : fans.numbers(place),
               std::ranges::binary_search(incision.front, vertex));
    }
    add_divided(patch, on_incision(patch, incision), fans, list);
  }
  for (const auto& [number, known] : met) {
    std::vector<char> on(patch.vertices.size(), 0);
    for (std::size_t v = 0; v < known.vertices.size(); ++v) {
      if (!known.vertices[v].on) continue;
      on[v] = kAtFront;
      lists[number].add(fans.numbers(static_cast<std::int32_t>(v)), true);
    }
    add_divided(patch, std::move(on), fans, lists[number]);
  }
  for (auto& [number, list] : lists) plan.material.incisions.push_back(list.incision(number));
}

}  // namespace tissu
