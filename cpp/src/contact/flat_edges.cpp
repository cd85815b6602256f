#include "flat_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "tissu/base/index.h"

namespace tissu {
namespace {

constexpr double kFlat = 1e-6;  ///< sine of the angle between two faces, whatever the mesh
constexpr double kBent = 1e-3;  ///< the same where places are rounded to single precision or six digits, …
constexpr double kOff = 2e-6;   ///< … which moves them by this share of the largest coordinate, …
constexpr double kBeside = 1e-6;  ///< of the reach of a contact
/// A direction along no edge and no diagonal of what is made of round numbers.
constexpr std::array<double, 3> kAside = {0.4673, 0.7421, 0.4805};
constexpr double kPlane = 4e-6;  ///< … and the vertices of a whole plane by so much

/// The faces of a surface in groups that lie in one plane, as far as rounding goes.
class Planes {
 public:
  Planes(const std::vector<Primitive>& primitives, ConstReals rest, std::int32_t first)
      : primitives_(primitives), rest_(rest), first_(first), root_(primitives.size() - at(first)) {
    std::iota(root_.begin(), root_.end(), first);
  }

  [[nodiscard]] Vec3 normal(std::int32_t face) const {
    const auto& [a, b, c] = primitives_[at(face)].vertex;
    return (block(rest_, b) - block(rest_, a)).cross(block(rest_, c) - block(rest_, a));
  }
  std::int32_t root(std::int32_t face) {
    while (of(face) != face) face = of(face) = of(of(face));
    return face;
  }
  void join(std::int32_t face, std::int32_t other) {
    const std::int32_t first = root(face);
    const std::int32_t second = root(other);
    of(std::max(first, second)) = std::min(first, second);
  }
  /// Measures the groups: whether all vertices of one are within `off` of its plane.
  void measure(double off) {
    normals_.assign(root_.size(), Vec3::Zero());
    off_.assign(root_.size(), 0.0);
    for_faces([&](std::int32_t face) { normals_[at(root(face) - first_)] += normal(face); });
    for_faces([&](std::int32_t face) {
      const std::int32_t r = root(face);
      const Vec3 n = normals_[at(r - first_)].normalized();
      const Vec3 from = block(rest_, primitives_[at(r)].vertex[0]);
      for (const std::int32_t v : primitives_[at(face)].vertex) {
        double& most = off_[at(r - first_)];
        most = std::max(most, std::abs(n.dot(block(rest_, v) - from)));
      }
    });
    most_ = off;
  }
  [[nodiscard]] bool is_plane(std::int32_t face) { return off_[at(root(face) - first_)] <= most_; }

 private:
  std::int32_t& of(std::int32_t face) { return root_[at(face - first_)]; }
  template <class Function>
  void for_faces(Function&& f) {
    for (auto p = first_; p < static_cast<std::int32_t>(primitives_.size()); ++p) {
      if (primitives_[at(p)].corners == 3) f(p);
    }
  }

  const std::vector<Primitive>& primitives_;
  ConstReals rest_;
  std::int32_t first_;
  std::vector<std::int32_t> root_;
  std::vector<Vec3> normals_;
  std::vector<double> off_;
  double most_ = 0.0;
};

/// A plane that is folded onto itself along the edge is not one plane.
bool lies_on_both_sides(ConstReals rest, const SurfaceEdge& e) {
  const Vec3 from = block(rest, e.vertex[0]);
  const Vec3 along = (block(rest, e.vertex[1]) - from).normalized();
  std::array<Vec3, 2> into;
  for (std::size_t side = 0; side < 2; ++side) {
    into[side] = block(rest, e.across[side]) - from;
    into[side] -= along.dot(into[side]) * along;
  }
  return into[0].dot(into[1]) < 0.0;
}

}  // namespace

void SurfaceSet::mark_flat(std::int32_t first_primitive, std::int32_t first_edge) {
  const ConstReals rest(rest_);
  Planes planes(primitives_, rest, first_primitive);
  double size = 0.0;  // the largest coordinate
  for (auto p = at(first_primitive); p < primitives_.size(); ++p) {
    for (int i = 0; i < primitives_[p].corners; ++i) {
      size = std::max(size, block(rest, primitives_[p].vertex[at(i)]).cwiseAbs().maxCoeff());
    }
  }
  std::vector<std::size_t> bent;
  for (std::size_t e = at(first_edge); e < edges_.size(); ++e) {
    SurfaceEdge& edge = edges_[e];
    if (edge.face[1] < 0) continue;
    const Vec3 first = planes.normal(edge.face[0]);
    const Vec3 second = planes.normal(edge.face[1]);
    const double sizes = first.norm() * second.norm();
    const double sine = first.cross(second).norm() / sizes;
    if (!(sizes > 0.0) || !(sine <= kBent) || !lies_on_both_sides(rest, edge)) continue;
    const double height = std::min(first.norm(), second.norm()) / edge.length;
    edge.is_flat = sine <= kFlat;
    if (!edge.is_flat && sine * height > kOff * size) continue;
    planes.join(edge.face[0], edge.face[1]);
    if (!edge.is_flat) bent.push_back(e);
  }
  if (bent.empty()) return;
  planes.measure(kPlane * size);
  for (const std::size_t e : bent) edges_[e].is_flat = planes.is_plane(edges_[e].face[0]);
}

void SurfaceSet::mark_flat_vertices(std::int32_t first_vertex, std::int32_t first_edge) {
  for (auto v = at(first_vertex); v < vertices_.size(); ++v) vertices_[v].is_flat = vertices_[v].has_faces;
  for (auto e = at(first_edge); e < edges_.size(); ++e) {
    if (edges_[e].is_flat) continue;
    for (const std::int32_t v : edges_[e].vertex) vertices_[at(v)].is_flat = false;
  }
}

bool is_of_flat(const SurfaceSet& surfaces, const Candidate& candidate) {
  if (candidate.kind == PairKind::edge_edge) {
    return surfaces.edges()[at(candidate.a)].is_flat || surfaces.edges()[at(candidate.b)].is_flat;
  }
  return surfaces.vertices()[at(candidate.vertex[0])].is_flat;
}

bool is_before_neighbour(const SurfaceSet& surfaces, ConstReals places, const Candidate& candidate,
                         double reach) {
  if (surfaces.vertices()[at(candidate.vertex[1])].is_soft()) return false;
  const auto& edges = surfaces.triangle_edges(candidate.b);
  if (std::ranges::none_of(edges, [&](std::int32_t e) { return surfaces.edges()[at(e)].is_flat; }))
    return false;
  std::array<Vec3, 4> p;
  for (std::size_t i = 0; i < 4; ++i) p[i] = block(places, candidate.vertex[i]);
  p[0] += kBeside * reach * Vec3(kAside[0], kAside[1], kAside[2]);
  Part part{};
  const Closest closest = closest_point_triangle(p, part);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t across = 1 + (i + 2) % 3;
    if (closest.beta[across] != 0.0) continue;  // the nearest point is not on this edge
    if (!surfaces.edges()[at(edges[i])].is_flat) continue;
    const Vec3& from = p[1 + i];
    const Vec3 along = (p[1 + (i + 1) % 3] - from).normalized();
    Vec3 into = p[across] - from;
    into -= along.dot(into) * along;
    if (closest.r.dot(into) < 0.0) return true;
  }
  return false;
}

}  // namespace tissu
