#include "tissu/contact/audit.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "overlap.h"
#include "tissu/base/crossing.h"
#include "tissu/base/error.h"
#include "tissu/base/exact.h"
#include "tissu/base/number_text.h"
#include "tissu/contact/candidates.h"
#include "tissu/contact/closest.h"

namespace tissu {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

constexpr int kSweeps = 16;
constexpr double kEnough = 0.5;  ///< of the gap: what is nearer is moved apart, to the gap

/// The number of a vertex: -1 is none.
std::int32_t numbered(std::int32_t node) { return node < 0 ? node - 1 : node; }

/// Whether two closed segments share a point and have one z. Exact; touching counts.
bool share_a_point_across_z(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  if (a.z() != b.z() || a.z() != c.z() || a.z() != d.z()) return false;
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

}  // namespace

std::vector<Crossing> crossings(const Contact& contact, const State& state) {
  const SurfaceSet& surfaces = contact.surfaces();
  std::vector<double> places(3 * surfaces.vertices().size());
  contact.place_vertices(state, state.time, places);
  SearchPlan plan;
  plan.first = surfaces.first_primitive();
  std::vector<Crossing> found;
  const auto bodies = static_cast<std::int32_t>(contact.description().bodies.size());
  for (const ContactPair& pair : contact.description().pairs) {
    plan.meetings.push_back({std::min(pair.a, pair.b), std::max(pair.a, pair.b)});
    for (const auto& [body, obstacle] : {std::pair(pair.a, pair.b), std::pair(pair.b, pair.a)}) {
      if (obstacle < bodies || !contact.description().obstacles[at(obstacle - bodies)].plane) continue;
      const Vec3 origin =
          contact.place_of(obstacle - bodies, contact.description().obstacles[at(obstacle - bodies)].origin,
                           state, state.time);
      const Vec3 normal = contact.normal_of(obstacle - bodies, state, state.time);
      const auto& of = surfaces.surfaces()[at(body)];
      for (std::int32_t v = of.first_vertex; v < of.last_vertex; ++v) {
        const std::int32_t node = surfaces.vertices()[at(v)].node;
        if (!pair.nodes.empty() && !surfaces.is_among(pair.nodes, v)) continue;
        if (normal.dot(block(ConstReals(places), v) - origin) > 0.0) continue;
        found.push_back({body, obstacle, {numbered(node), -1}, {-1, -1, -1}});
      }
    }
  }
  std::vector<Box> boxes;
  for (const Primitive& primitive : surfaces.primitives()) {
    Box box = Box::none();
    for (int i = 0; i < primitive.corners; ++i)
      box.add(Vec3(block(ConstReals(places), primitive.vertex[at(i)])));
    boxes.push_back(box);
  }
  std::vector<BoxPair> pairs;
  make_broad_phase(BroadPhaseKind::hierarchy, plan)->find(boxes, pairs);
  const Audit audit(contact, places);
  for (const BoxPair& pair : pairs) audit.add(pair, found);
  return found;
}

namespace {

/// One sweep of moving apart; true when something was too near.
class Separation {
 public:
  Separation(const Contact& contact, const FixedDofs& fixed, State& start)
      : contact_(contact),
        fixed_(fixed),
        start_(start),
        candidates_(contact.description(), contact.surfaces()),
        places_(3 * contact.surfaces().mover_count()) {
    const SurfaceSet& surfaces = contact.surfaces();
    contact.place_vertices(start, start.time, places_);
    for (std::size_t i = 0; i < surfaces.inner_rows().size(); ++i) {
      block(Reals(places_), static_cast<std::int32_t>(surfaces.vertices().size() + i)) =
          block(ConstReals(start.positions), surfaces.inner_rows()[i].row);
    }
    normals_.assign(places_.size(), 0.0);
    for (const Primitive& face : contact.surfaces().primitives()) {
      if (face.corners < 3) continue;
      const auto& [a, b, c] = face.vertex;
      const Vec3 normal = (place(b) - place(a)).cross(place(c) - place(a));
      for (const std::int32_t v : face.vertex) block(Reals(normals_), v) += normal;
    }
    for (const SurfaceEdge& edge : contact.surfaces().edges()) {
      if (!is_rim(edge)) continue;
      for (const std::int32_t v : edge.vertex) block(Reals(normals_), v) += outward(edge);
    }
  }

  /// Thick and round things that remain inside each other.
  [[nodiscard]] Depths depths() const { return deep_overlaps(contact_, candidates_, places_, start_, 1.0); }

  void run() {
    bool near = true;
    for (int i = 0; near && i < kSweeps; ++i) near = sweep();
    const auto& vertices = contact_.surfaces().vertices();
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      const auto number = static_cast<std::int32_t>(v);
      if (vertices[v].row >= 0) block(Reals(start_.positions), vertices[v].row) = place(number);
    }
    auto mover = static_cast<std::int32_t>(vertices.size());
    for (const auto& inner : contact_.surfaces().inner_rows()) {
      block(Reals(start_.positions), inner.row) = place(mover++);
    }
    for (const auto& surface : contact_.surfaces().surfaces()) {
      if (surface.carrier < 0) continue;
      const Vec3 moved = place(surface.first_vertex) - contact_.place(surface.first_vertex, start_);
      block(Reals(start_.positions), contact_.surfaces().carriers()[at(surface.carrier)].row) += moved;
    }
  }

 private:
  [[nodiscard]] bool is_free(std::int32_t v) const {
    const SurfaceVertex& vertex = contact_.surfaces().vertices()[at(v)];
    if (vertex.rider >= 0) {
      return std::ranges::any_of(contact_.surfaces().parts(vertex),
                                 [&](const RiderPart& part) { return is_row_free(part.row); });
    }
    return vertex.carrier >= 0 || (vertex.row >= 0 && is_row_free(vertex.row));
  }
  [[nodiscard]] bool is_row_free(std::int32_t row) const {
    return fixed_.masks()[at(row)] != FixedDofs::kAllAxes;
  }
  /// A move of a mover, along the axes on which its row is free.
  [[nodiscard]] Vec3 allowed(std::int32_t mover, Vec3 move) const {
    const auto& vertices = contact_.surfaces().vertices();
    const bool is_vertex = at(mover) < vertices.size();
    const std::int32_t row = is_vertex ? vertices[at(mover)].row
                                       : contact_.surfaces().inner_rows()[at(mover) - vertices.size()].row;
    if (row < 0) return move;
    for (int axis = 0; axis < 3; ++axis) {
      if (((fixed_.masks()[at(row)] >> axis) & 1) != 0) move(axis) = 0.0;
    }
    return move;
  }
  [[nodiscard]] Vec3 place(std::int32_t v) const { return block(ConstReals(places_), v); }
  /// Of a flat body, which lies on the left of it seen from +z.
  [[nodiscard]] bool is_rim(const SurfaceEdge& edge) const {
    const auto surface = contact_.surfaces().vertices()[at(edge.vertex[0])].surface;
    return edge.is_lone() && contact_.surfaces().surfaces()[at(surface)].closed;
  }
  [[nodiscard]] Vec3 outward(const SurfaceEdge& edge) const {
    return (place(edge.vertex[1]) - place(edge.vertex[0])).cross(Vec3::UnitZ()).normalized();
  }
  /// Whether surfaces whose middles are `s` apart are near, and overlap by no more than their gap.
  template <class Pair>
  [[nodiscard]] bool is_near(const Pair& c, double s) const {
    const double thick = std::max(0.0, c.apart - contact_.description().pairs[at(c.pair)].gap);
    const double gap = c.apart - thick;
    return s < thick + kEnough * gap && s >= thick - gap;
  }

  bool sweep() {
    moves_.assign(places_.size(), 0.0);
    counts_.assign(places_.size() / 3, 0.0);
    candidates_.cover(places_, places_);
    bool near = false;
    for (const Candidate& c : candidates_.list()) {
      if (c.kind == PairKind::vertex_face) near = push_off_face(c) || near;
      if (c.kind == PairKind::vertex_edge) near = push_off_rim(c) || near;
    }
    for (const PlaneCandidate& c : candidates_.planes()) near = push_off_plane(c) || near;
    for (const auto& surface : contact_.surfaces().surfaces()) {
      if (surface.carrier >= 0) move_rigidly(surface);
    }
    if (contact_.surfaces().has_riders()) move_rows();
    for (std::size_t v = 0; v < counts_.size(); ++v) {
      if (counts_[v] == 0.0) continue;
      const auto number = static_cast<std::int32_t>(v);
      block(Reals(places_), number) += allowed(number, block(ConstReals(moves_), number) / counts_[v]);
    }
    if (contact_.surfaces().has_riders()) contact_.surfaces().place_riders(places_);
    return near;
  }

  /// What rows carry goes by the least motion of its free rows, of which each takes the mean, by weight, of
  /// what is asked of it.
  void move_rows() {
    const auto& vertices = contact_.surfaces().vertices();
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      if (vertices[v].rider < 0 || counts_[v] == 0.0) continue;
      const Vec3 move = block(ConstReals(moves_), static_cast<std::int32_t>(v)) / counts_[v];
      counts_[v] = 0.0;
      double squares = 0.0;
      for (const RiderPart& part : contact_.surfaces().parts(vertices[v])) {
        if (is_row_free(part.row)) squares += part.weight * part.weight;
      }
      for (const RiderPart& part : contact_.surfaces().parts(vertices[v])) {
        if (!is_row_free(part.row) || part.weight == 0.0) continue;
        const double count = std::abs(part.weight);
        block(Reals(moves_), part.mover) += count * part.weight / squares * move;
        counts_[at(part.mover)] += count;
      }
    }
  }

  /// All vertices go by the mean of what any of them is asked to.
  void move_rigidly(const SurfaceSet::Surface& surface) {
    Vec3 sum = Vec3::Zero();
    double count = 0.0;
    for (std::int32_t v = surface.first_vertex; v < surface.last_vertex; ++v) {
      sum += block(ConstReals(moves_), v);
      count += counts_[at(v)];
    }
    for (std::int32_t v = surface.first_vertex; count > 0.0 && v < surface.last_vertex; ++v) {
      block(Reals(moves_), v) = sum;
      counts_[at(v)] = count;
    }
  }

  bool push_off_plane(const PlaneCandidate& c) {
    const Vec3 origin = contact_.place_of(c.obstacle, contact_.description().obstacles[at(c.obstacle)].origin,
                                          start_, start_.time);
    const Vec3 n = contact_.normal_of(c.obstacle, start_, start_.time);
    const double s = n.dot(place(c.vertex) - origin);
    if (!is_near(c, s) || !is_free(c.vertex)) return false;
    add(c.vertex, (c.apart - s) * n);
    return true;
  }

  bool push_off_face(const Candidate& c) {
    Part part{};
    const Closest closest = closest_point_triangle(
        {place(c.vertex[0]), place(c.vertex[1]), place(c.vertex[2]), place(c.vertex[3])}, part);
    const Vec3 n =
        (place(c.vertex[2]) - place(c.vertex[1])).cross(place(c.vertex[3]) - place(c.vertex[1])).normalized();
    return push_along(c, closest, n);
  }

  bool push_off_rim(const Candidate& c) {
    const SurfaceEdge& edge = contact_.surfaces().edges()[at(c.b)];
    if (!is_rim(edge)) return false;
    Part part{};
    const Closest closest =
        closest_point_edge({place(c.vertex[0]), place(c.vertex[1]), place(c.vertex[2])}, part);
    return push_along(c, closest, outward(edge));
  }

  /// Moves a vertex and what it touches apart along the outward normal of the latter.
  bool push_along(const Candidate& c, const Closest& closest, const Vec3& n) {
    const double s = n.dot(closest.r);
    if (!is_near(c, s) || !n.allFinite()) return false;
    // What it touches lies before it and not beside it, as the sides of two blocks that stand on each other.
    if (closest.square > c.apart * c.apart || !(n.dot(block(ConstReals(normals_), c.vertex[0])) < 0.0)) {
      return false;
    }
    double sum = 0.0;
    const auto count = static_cast<std::size_t>(vertices_of(c.kind));
    for (std::size_t k = 0; k < count; ++k) {
      sum += is_free(c.vertex[k]) ? closest.beta[k] * closest.beta[k] : 0.0;
    }
    if (sum == 0.0) return false;
    for (std::size_t k = 0; k < count; ++k) {
      if (is_free(c.vertex[k])) add(c.vertex[k], (c.apart - s) * closest.beta[k] / sum * n);
    }
    return true;
  }

  void add(std::int32_t v, const Vec3& move) {
    block(Reals(moves_), v) += move;
    counts_[at(v)] += 1.0;
  }

  const Contact& contact_;
  const FixedDofs& fixed_;
  State& start_;
  Candidates candidates_;
  std::vector<double> places_, moves_;
  std::vector<double> normals_;  ///< of vertices, of any length
  std::vector<double> counts_;   ///< of what was asked of each mover
};

}  // namespace

void separate(const Contact& contact, const FixedDofs& fixed, State& start) {
  if (!contact.description().travel) return;
  Separation separation(contact, fixed, start);
  separation.run();
  std::map<std::pair<std::int32_t, std::int32_t>, int> counts;
  for (const Crossing& crossing : crossings(contact, start)) {
    ++counts[std::minmax(crossing.surface, crossing.other)];
  }
  const Depths depths = separation.depths();
  if (counts.empty() && depths.empty()) return;
  const auto& surfaces = contact.surfaces().surfaces();
  std::string text;
  for (const auto& [pair, count] : counts) {
    text += (text.empty() ? "\"" : "; \"") + surfaces[at(pair.first)].name + "\" and \"" +
            surfaces[at(pair.second)].name + "\" in " + std::to_string(count) +
            (count == 1 ? " place" : " places");
  }
  for (const auto& [pair, depth] : depths) {
    text += (text.empty() ? "\"" : "; \"") + surfaces[at(pair.first)].name + "\" and \"" +
            surfaces[at(pair.second)].name + "\" by " + number_text(depth) + " m of their thickness";
  }
  throw ParameterError("found surfaces that overlap at the start: " + text +
                       "; they must begin apart, or overlap by no more than their gap. Move one of them.");
}

}  // namespace tissu
