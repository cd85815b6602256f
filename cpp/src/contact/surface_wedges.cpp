/// Edges along which a closed surface touches itself, as where cells are left that share an edge alone. Each
/// of the wedges that meet there gets an edge of its own, with the two triangles beside it: so a contact
/// before the edge asks the wedge that it is before.

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tissu/base/index.h"
#include "tissu/contact/surface_set.h"

namespace tissu {
namespace {

/// A triangle beside an edge: where it goes round the edge, and whether its corners run along the edge. Then
/// the inside is at smaller angles, else at larger ones.
struct Beside {
  double angle;
  bool along;
  std::int32_t triangle;
  std::int32_t across;
};

/// Whether inside and outside alternate round the edge.
bool alternate(const std::vector<Beside>& round) {
  for (std::size_t i = 0; i < round.size(); ++i) {
    const Beside& next = round[(i + 1) % round.size()];
    if (round[i].along == next.along || round[i].angle == next.angle) return false;
  }
  return round.size() % 2 == 0;
}

/// The two triangles of each wedge, the lower one first, in the order of the angles.
std::vector<std::array<Beside, 2>> wedges_of(const std::vector<Beside>& round) {
  std::vector<std::array<Beside, 2>> wedges;
  if (!alternate(round)) return wedges;
  for (std::size_t i = 0; i < round.size(); ++i) {
    const Beside& high = round[(i + 1) % round.size()];
    if (!high.along) continue;
    wedges.push_back({round[i], high});
    auto& [lower, higher] = wedges.back();
    if (lower.triangle > higher.triangle) std::swap(lower, higher);
  }
  return wedges;
}

}  // namespace

/// `crowded`: the edges that have more than two triangles, ascending.
void SurfaceSet::part_wedges(const std::vector<std::int32_t>& crowded, std::int32_t first_primitive,
                             std::int32_t first_edge) {
  std::vector<std::vector<Beside>> rounds(crowded.size());
  for (auto p = first_primitive; p < static_cast<std::int32_t>(primitives_.size()); ++p) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t e = triangle_edges_[at(p)][i];
      const auto found = std::ranges::lower_bound(crowded, e);
      if (found == crowded.end() || *found != e) continue;
      const auto& [a, b] = edges_[at(e)].vertex;
      const Vec3 from = block(ConstReals(rest_), a);
      const Vec3 along = (block(ConstReals(rest_), b) - from).normalized();
      const Vec3 first = along.unitOrthogonal();
      const auto& corners = primitives_[at(p)].vertex;
      const std::int32_t across = corners[(i + 2) % 3];
      const Vec3 into = block(ConstReals(rest_), across) - from;
      const double angle = std::atan2(into.dot(along.cross(first)), into.dot(first));
      rounds[static_cast<std::size_t>(found - crowded.begin())].push_back(
          {std::isfinite(angle) ? angle : 0.0, corners[i] == a, p, across});
    }
  }
  for (std::size_t k = 0; k < crowded.size(); ++k) {
    std::ranges::sort(rounds[k], {}, &Beside::angle);
    std::int32_t number = crowded[k];
    const std::array<std::int32_t, 2> ends = edges_[at(number)].vertex;
    for (const std::array<Beside, 2>& wedge : wedges_of(rounds[k])) {
      // As every edge, it runs along the corners of its first triangle.
      edges_[at(number)].vertex = wedge[0].along ? ends : std::array{ends[1], ends[0]};
      for (std::size_t side = 0; side < 2; ++side) {
        edges_[at(number)].face[side] = wedge[side].triangle;
        edges_[at(number)].across[side] = wedge[side].across;
        std::ranges::replace(triangle_edges_[at(wedge[side].triangle)], crowded[k], number);
      }
      number = static_cast<std::int32_t>(edges_.size());
      edges_.push_back({ends});
    }
    if (number != crowded[k]) edges_.pop_back();
  }
  if (!crowded.empty()) number_edges(first_primitive, first_edge);
}

/// Edges stand in the order of their first primitives.
void SurfaceSet::number_edges(std::int32_t first_primitive, std::int32_t first_edge) {
  std::vector<std::int32_t> numbers(edges_.size(), -1);
  std::vector<SurfaceEdge> ordered;
  for (auto p = first_primitive; p < static_cast<std::int32_t>(primitives_.size()); ++p) {
    for (std::int32_t& e : triangle_edges_[at(p)]) {
      if (e < 0) continue;
      if (numbers[at(e)] < 0) {
        numbers[at(e)] = first_edge + static_cast<std::int32_t>(ordered.size());
        ordered.push_back(edges_[at(e)]);
      }
      e = numbers[at(e)];
    }
  }
  std::ranges::copy(ordered, edges_.begin() + first_edge);
}

}  // namespace tissu
