#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "overlap.h"
#include "rigid_separation.h"
#include "tissu/base/error.h"
#include "tissu/base/index.h"
#include "tissu/base/number_text.h"
#include "tissu/contact/audit.h"
#include "tissu/contact/candidates.h"
#include "tissu/contact/closest.h"

namespace tissu {
namespace {

constexpr int kSweeps = 16;
constexpr double kEnough = 0.5;  ///< of the gap: what is nearer is moved apart, to the gap

/// One sweep of moving apart; true when something was too near.
class Separation {
 public:
  Separation(const Contact& contact, const FixedDofs& fixed, std::span<const RowRange> loose, State& start)
      : contact_(contact),
        fixed_(fixed),
        start_(start),
        candidates_(contact.description(), contact.surfaces()),
        whole_(contact, fixed, loose, start),
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
    if (whole_.has_any()) whole_.run(candidates_, places_, normals_);
    bool near = true;
    for (int i = 0; near && i < kSweeps; ++i) {
      near = sweep();
      if (near && whole_.has_any()) whole_.run(candidates_, places_, normals_);
    }
    whole_.move_rows(start_.positions);
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
    const SurfaceSet& surfaces = contact_.surfaces();
    for (const Candidate& c : candidates_.list()) {
      if (whole_.has(c)) continue;
      if (c.kind == PairKind::vertex_face) near = push_off_face(c) || near;
      if (c.kind == PairKind::vertex_edge) near = push_off_rim(c) || near;
    }
    for (const PlaneCandidate& c : candidates_.planes()) {
      if (!whole_.has(c)) near = push_off_plane(c) || near;
    }
    for (const auto& surface : surfaces.surfaces()) {
      if (surface.carrier >= 0) move_rigidly(surface);
    }
    if (contact_.surfaces().has_riders()) move_rows();
    for (std::size_t v = 0; v < counts_.size(); ++v) {
      if (counts_[v] == 0.0) continue;
      const auto number = static_cast<std::int32_t>(v);
      block(Reals(places_), number) += allowed(number, block(ConstReals(moves_), number) / counts_[v]);
    }
    if (contact_.surfaces().has_riders()) contact_.surfaces().place_riders(places_, start_.rotations);
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
  RigidSeparation whole_;
  std::vector<double> places_, moves_;
  std::vector<double> normals_;  ///< of vertices, of any length
  std::vector<double> counts_;   ///< of what was asked of each mover
};

/// How deep the deepest vertex of a surface lies behind a plane, and whether all of them do, in words.
std::string words_behind_plane(const Contact& contact, const State& state, std::int32_t body,
                               std::int32_t plane) {
  const SurfaceSet& surfaces = contact.surfaces();
  const auto obstacle = plane - static_cast<std::int32_t>(contact.description().bodies.size());
  const Vec3 origin =
      contact.place_of(obstacle, contact.description().obstacles[at(obstacle)].origin, state, state.time);
  const Vec3 normal = contact.normal_of(obstacle, state, state.time);
  const auto& of = surfaces.surfaces()[at(body)];
  double depth = 0.0;
  bool all = true;
  for (std::int32_t v = of.first_vertex; v < of.last_vertex; ++v) {
    const double behind = normal.dot(origin - contact.place(v, state));
    depth = std::max(depth, behind);
    all = all && behind >= 0.0;
  }
  std::string text = ", " + number_text(depth) + " m deep at most";
  if (all) {
    text += " (all of \"" + of.name + "\" is behind \"" + surfaces.surfaces()[at(plane)].name +
            "\", whose normal must point to the side on which bodies are)";
  }
  return text;
}

}  // namespace

void separate(const Contact& contact, const FixedDofs& fixed, std::span<const RowRange> loose, State& start) {
  if (!contact.description().travel) return;
  Separation separation(contact, fixed, loose, start);
  separation.run();
  std::map<std::pair<std::int32_t, std::int32_t>, int> counts;
  std::map<std::pair<std::int32_t, std::int32_t>, std::string> behind;  // of a surface and a plane
  for (const Crossing& crossing : crossings(contact, start)) {
    const auto pair = std::minmax(crossing.surface, crossing.other);
    if (++counts[pair] == 1 && crossing.triangle[0] < 0 && crossing.edge[1] < 0) {
      behind[pair] = words_behind_plane(contact, start, crossing.surface, crossing.other);
    }
  }
  const Depths depths = separation.depths();
  if (counts.empty() && depths.empty()) return;
  const auto& surfaces = contact.surfaces().surfaces();
  std::string text;
  bool has_obstacles_alone = false;
  const auto note = [&](const std::pair<std::int32_t, std::int32_t>& pair) {
    const auto& [a, b] = pair;
    has_obstacles_alone |= surfaces[at(a)].obstacle >= 0 && surfaces[at(b)].obstacle >= 0;
  };
  for (const auto& [pair, count] : counts) {
    note(pair);
    text += (text.empty() ? "\"" : "; \"") + surfaces[at(pair.first)].name + "\" and \"" +
            surfaces[at(pair.second)].name + "\" in " + std::to_string(count) +
            (count == 1 ? " place" : " places");
    if (const auto plane = behind.find(pair); plane != behind.end()) text += plane->second;
  }
  for (const auto& [pair, depth] : depths) {
    note(pair);
    text += (text.empty() ? "\"" : "; \"") + surfaces[at(pair.first)].name + "\" and \"" +
            surfaces[at(pair.second)].name + "\" by " + number_text(depth) + " m of their thickness";
  }
  const std::string found = "found surfaces that overlap at the start: " + text +
                            "; they must begin apart, or overlap by no more than their gap. Move one of them";
  if (has_obstacles_alone) throw ParameterError(found + ".");
  throw OverlapError(found + ", or ask for contact.overlap: separate.", text);
}

}  // namespace tissu
