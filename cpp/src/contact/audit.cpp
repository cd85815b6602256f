#include "tissu/contact/audit.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tissu/base/crossing.h"
#include "tissu/base/exact.h"
#include "tissu/base/index.h"

namespace tissu {
namespace {

/// The number of a vertex: -1 is none.
std::int32_t numbered(std::int32_t node) { return node < 0 ? node - 1 : node; }

/// Of z: what several nodes carry has theirs but for the round-off of weights, whose sum is 1.
constexpr double kSameZ = 1e-12;

/// Whether two closed segments share a point seen along z, and have one z. Exact but for that; touching
/// counts.
bool share_a_point_across_z(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  for (const Vec3& other : {b, c, d}) {
    if (!(std::abs(other.z() - a.z()) <= kSameZ * std::abs(a.z()))) return false;
  }
  // On which side of the line x y the point is, seen from +z.
  const auto side = [](const Vec3& x, const Vec3& y, const Vec3& point) {
    return orientation(x, y, point, Vec3(x.x(), x.y(), x.z() + 1.0));
  };
  const int c_is = side(a, b, c);
  const int d_is = side(a, b, d);
  if (c_is == 0 && d_is == 0) {  // on one line
    for (int axis = 0; axis < 2; ++axis) {
      const auto [low, high] = std::minmax(a(axis), b(axis));
      const auto [from, to] = std::minmax(c(axis), d(axis));
      if (to < low || high < from) return false;
    }
    return true;
  }
  return c_is * d_is <= 0 && side(c, d, a) * side(c, d, b) <= 0;
}

class Audit {
 public:
  Audit(const Contact& contact, ConstReals places) : surfaces_(contact.surfaces()), places_(places) {}

  void add(const BoxPair& pair, std::vector<Crossing>& found) const {
    for (const auto& [p, q] : {std::pair(pair.a, pair.b), std::pair(pair.b, pair.a)}) {
      const Primitive& face = surfaces_.primitives()[at(q)];
      if (face.corners == 2 && p == pair.a) add_edges(p, q, found);
      if (face.corners < 3) continue;
      for (const std::int32_t e : surfaces_.edges_of(p)) {
        const auto& [a, b] = surfaces_.edges()[at(e)].vertex;
        const auto is_corner = [&](std::int32_t v) {
          return std::ranges::find(face.vertex, v) != face.vertex.end();
        };
        if (is_corner(a) || is_corner(b)) continue;
        if (!crosses(place(a), place(b),
                     {place(face.vertex[0]), place(face.vertex[1]), place(face.vertex[2])})) {
          continue;
        }
        if (surfaces_.is_of_one_row(std::array{a, b}, face.vertex)) continue;
        const auto node = [&](std::int32_t v) { return numbered(surfaces_.vertices()[at(v)].node); };
        found.push_back({surfaces_.vertices()[at(a)].surface,
                         surfaces_.vertices()[at(face.vertex[0])].surface,
                         {node(a), node(b)},
                         {node(face.vertex[0]), node(face.vertex[1]), node(face.vertex[2])}});
      }
    }
  }

 private:
  [[nodiscard]] Vec3 place(std::int32_t v) const { return block(places_, v); }

  /// Two edges without triangles that share a point in a plane across z, as the rims of flat bodies do.
  void add_edges(std::int32_t p, std::int32_t q, std::vector<Crossing>& found) const {
    const Primitive& first = surfaces_.primitives()[at(p)];
    const Primitive& second = surfaces_.primitives()[at(q)];
    if (first.corners != 2) return;
    const auto& [a, b, none] = first.vertex;
    const auto& [c, d, other_none] = second.vertex;
    if (a == c || a == d || b == c || b == d) return;
    if (!share_a_point_across_z(place(a), place(b), place(c), place(d))) return;
    const auto node = [&](std::int32_t v) { return numbered(surfaces_.vertices()[at(v)].node); };
    found.push_back({surfaces_.vertices()[at(a)].surface,
                     surfaces_.vertices()[at(c)].surface,
                     {node(a), node(b)},
                     {node(c), node(d), -1}});
  }

  const SurfaceSet& surfaces_;
  ConstReals places_;
};

/// Adds the vertices behind planes, of those for which `is_wanted` holds.
template <class Wanted>
void add_behind_planes(const Contact& contact, const State& state, ConstReals places, Wanted&& is_wanted,
                       std::vector<Crossing>& found) {
  const SurfaceSet& surfaces = contact.surfaces();
  const auto bodies = static_cast<std::int32_t>(contact.description().bodies.size());
  for (const ContactPair& pair : contact.description().pairs) {
    for (const auto& [body, obstacle] : {std::pair(pair.a, pair.b), std::pair(pair.b, pair.a)}) {
      if (obstacle < bodies || !contact.description().obstacles[at(obstacle - bodies)].plane) continue;
      const Vec3 origin =
          contact.place_of(obstacle - bodies, contact.description().obstacles[at(obstacle - bodies)].origin,
                           state, state.time);
      const Vec3 normal = contact.normal_of(obstacle - bodies, state, state.time);
      const auto& of = surfaces.surfaces()[at(body)];
      for (std::int32_t v = of.first_vertex; v < of.last_vertex; ++v) {
        if (!is_wanted(v)) continue;
        const std::int32_t node = surfaces.vertices()[at(v)].node;
        if (!pair.nodes.empty() && !surfaces.is_among(pair.nodes, v)) continue;
        if (normal.dot(block(places, v) - origin) > 0.0) continue;
        found.push_back({body, obstacle, {numbered(node), -1}, {-1, -1, -1}});
      }
    }
  }
}

Box box_of(const Primitive& primitive, ConstReals places) {
  Box box = Box::none();
  for (int i = 0; i < primitive.corners; ++i) box.add(Vec3(block(places, primitive.vertex[at(i)])));
  return box;
}

/// Whether a plane across an axis parts a primitive from a box: what lies in the box does not meet it.
bool is_apart(const Primitive& primitive, ConstReals places, const Box& box) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto all = [&](auto&& is_beyond) {
      return std::ranges::all_of(primitive.vertex.begin(), primitive.vertex.begin() + primitive.corners,
                                 [&](std::int32_t v) { return is_beyond(places[3 * at(v) + k]); });
    };
    if (all([&](double x) { return x < static_cast<double>(box.low[k]); }) ||
        all([&](double x) { return x > static_cast<double>(box.high[k]); }))
      return true;
  }
  return false;
}

/// The boxes of some primitives, in the order of their low sides along the axis in which they spread most.
class NearBoxes {
 public:
  NearBoxes(const SurfaceSet& surfaces, ConstReals places, const std::vector<std::int32_t>& primitives) {
    Box all = Box::none();
    for (const std::int32_t p : primitives) {
      boxes_.emplace_back(box_of(surfaces.primitives()[at(p)], places), p);
      all.add(boxes_.back().first);
    }
    for (std::size_t k = 1; k < 3; ++k) {
      if (all.high[k] - all.low[k] > all.high[axis_] - all.low[axis_]) axis_ = k;
    }
    std::ranges::sort(boxes_, {}, [&](const auto& one) { return one.first.low[axis_]; });
    for (const auto& [box, p] : boxes_)
      longest_ =
          std::max(longest_, static_cast<double>(box.high[axis_]) - static_cast<double>(box.low[axis_]));
  }

  /// Calls f(p) for each of the primitives whose box overlaps one.
  template <class Function>
  void for_overlapping(const Box& box, Function&& f) const {
    const double from = static_cast<double>(box.low[axis_]) - longest_;
    auto next = std::ranges::lower_bound(
        boxes_, from, {}, [&](const auto& one) { return static_cast<double>(one.first.low[axis_]); });
    for (; next != boxes_.end() && next->first.low[axis_] <= box.high[axis_]; ++next) {
      if (next->first.overlaps(box)) f(next->second);
    }
  }

 private:
  std::vector<std::pair<Box, std::int32_t>> boxes_;
  std::size_t axis_ = 0;
  double longest_ = 0.0;  ///< of a box along it
};

std::vector<double> places_of(const Contact& contact, const State& state) {
  std::vector<double> places(3 * contact.surfaces().vertices().size());
  contact.place_vertices(state, state.time, places);
  return places;
}

}  // namespace

bool any_crosses(const Contact& contact, const State& state, std::span<const std::uint8_t> some) {
  const SurfaceSet& surfaces = contact.surfaces();
  const std::vector<double> places = places_of(contact, state);
  Box around = Box::none();
  std::vector<std::int32_t> looked_for;
  std::vector<std::uint8_t> wanted(surfaces.vertices().size(), 0);
  for (std::size_t p = 0; p < some.size(); ++p) {
    if (some[p] == 0) continue;
    const Primitive& primitive = surfaces.primitives()[p];
    looked_for.push_back(static_cast<std::int32_t>(p));
    for (int i = 0; i < primitive.corners; ++i) {
      wanted[at(primitive.vertex[at(i)])] = 1;
      around.add(Vec3(block(ConstReals(places), primitive.vertex[at(i)])));
    }
  }
  std::vector<Crossing> found;
  add_behind_planes(contact, state, places, [&](std::int32_t v) { return wanted[at(v)] != 0; }, found);
  const auto meets = [&](std::int32_t a, std::int32_t b) {
    return std::ranges::any_of(contact.description().pairs, [&](const ContactPair& pair) {
      return (pair.a == a && pair.b == b) || (pair.a == b && pair.b == a);
    });
  };
  const Audit audit(contact, places);
  const NearBoxes near(surfaces, places, looked_for);
  for (std::int32_t q = 0; q < static_cast<std::int32_t>(surfaces.primitives().size()) && found.empty();
       ++q) {
    if (is_apart(surfaces.primitives()[at(q)], places, around)) continue;
    near.for_overlapping(box_of(surfaces.primitives()[at(q)], places), [&](std::int32_t p) {
      if (p == q || (some[at(q)] != 0 && q < p)) return;
      if (!meets(surfaces.surface_of_primitive(p), surfaces.surface_of_primitive(q))) return;
      audit.add({std::min(p, q), std::max(p, q)}, found);
    });
  }
  return !found.empty();
}

std::vector<Crossing> crossings(const Contact& contact, const State& state) {
  const SurfaceSet& surfaces = contact.surfaces();
  const std::vector<double> places = places_of(contact, state);
  SearchPlan plan;
  plan.first = surfaces.first_primitive();
  for (const ContactPair& pair : contact.description().pairs)
    plan.meetings.push_back({std::min(pair.a, pair.b), std::max(pair.a, pair.b)});
  std::vector<Crossing> found;
  add_behind_planes(contact, state, places, [](std::int32_t) { return true; }, found);
  std::vector<Box> boxes;
  for (const Primitive& primitive : surfaces.primitives()) boxes.push_back(box_of(primitive, places));
  std::vector<BoxPair> pairs;
  make_broad_phase(BroadPhaseKind::hierarchy, plan)->find(boxes, pairs);
  const Audit audit(contact, places);
  for (const BoxPair& pair : pairs) audit.add(pair, found);
  return found;
}

}  // namespace tissu
