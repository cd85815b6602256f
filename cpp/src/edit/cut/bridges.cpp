#include "edit/cut/bridges.h"

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <utility>

#include "edit/cut/side.h"
#include "tissu/base/crossing.h"
#include "tissu/base/index.h"
#include "tissu/base/sort_unique.h"

namespace tissu {
namespace {

constexpr int kRounds = 16;
constexpr std::size_t kMostGrowth = 8;  ///< times the tetrahedra before the rounds
constexpr double kRoundOff = 1e-12;
constexpr double kMargin = 0.05;   ///< of the diagonal of a box, on each side
constexpr double kBetween = 0.15;  ///< of the way between two places: its middle is so far off the blade

Vec3 normal_of(const std::array<Vec3, 3>& t) { return (t[1] - t[0]).cross(t[2] - t[0]).normalized(); }

using Numbers = std::span<const std::int32_t>;

/// Two places on one sheet lie on different sides of a bend if the middle between them lies far from the
/// blade.
bool is_near(const SweepPart& part, Numbers triangles, const Vec3& a, const Vec3& b) {
  const Vec3 middle = 0.5 * (a + b);
  const double slack = kRoundOff * middle.cwiseAbs().maxCoeff();
  return distance(part, triangles, middle) <= kBetween * (a - b).norm() + slack;
}

/// Where an edge passes triangles of the blade, without a settlement.
std::vector<BladeCrossing> all_crossings(const SweepPart& part, const Vec3& a, const Vec3& b,
                                         Numbers triangles) {
  std::vector<BladeCrossing> crossings;
  for (const std::int32_t t : triangles) {
    const auto& triangle = part.triangles[at(t)];
    const Vec3 normal = normal_of(triangle);
    const double of_a = normal.dot(a - triangle[0]);
    const double of_b = normal.dot(b - triangle[0]);
    if (!(of_a * of_b < 0.0) || !crosses(a, b, triangle)) continue;
    crossings.push_back({of_a / (of_a - of_b), of_a > 0.0 ? 1 : -1, t});
  }
  return crossings;
}

/// The blade near an edge, and near the places where it met the ends.
BladeSheets::Inside sheets_at(const Patch& patch, const BladeSheets& sheets, const OnCut& known,
                              std::int32_t p, std::int32_t q) {
  Eigen::AlignedBox3d box;
  for (const std::int32_t v : {p, q}) {
    box.extend(patch.vertex(v).place);
    known.each_meeting(v, [&](const OnCut::Meeting& meeting) {
      if (meeting.on) box.extend(meeting.place);
    });
  }
  const Vec3 margin = Vec3::Constant(kMargin * box.diagonal().norm());
  return sheets.in({box.min() - margin, box.max() + margin});
}

/// Where an edge passes sheets of the blade other than those on which its ends are.
std::vector<BladeCrossing> other_sheets(const Patch& patch, const Blade& blade, const OnCut& known,
                                        std::int32_t p, std::int32_t q, Numbers triangles) {
  const Vec3& a = patch.vertex(p).place;
  const Vec3& b = patch.vertex(q).place;
  std::vector<BladeCrossing> crossings = all_crossings(blade.part, a, b, triangles);
  if (crossings.empty()) return crossings;
  const BladeSheets::Inside inside = sheets_at(patch, blade.sheets, known, p, q);
  std::erase_if(crossings, [&](const BladeCrossing& crossing) {
    const Vec3 place = a + crossing.t * (b - a);
    const auto is_on = [&](std::int32_t v) {
      if (known[v].before || known[v].wall) return true;  // the blade now is not the one that it lies on
      bool on = false;
      known.each_meeting(v, [&](const OnCut::Meeting& meeting) {
        on = on || (meeting.on && inside.of(meeting.triangle) == inside.of(crossing.triangle) &&
                    is_near(blade.part, inside.triangles, place, meeting.place));
      });
      return on;
    };
    return is_on(p) || is_on(q);
  });
  return crossings;
}

constexpr std::array<std::array<std::uint8_t, 2>, 6> kEdges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// Edges of crowded cells, by their ends, and the triangles near them.
using Edges = std::map<std::pair<std::int32_t, std::int32_t>, Numbers>;

Edges edges_of(const Patch& patch, const CrowdedCells& crowded) {
  Edges edges;
  for (const Patch::Tetra& tetra : patch.tetrahedra) {
    const auto triangles = crowded.triangles(tetra.cell);
    if (triangles.empty()) continue;
    for (const auto& [i, j] : kEdges) {
      if (tetra.vertices[j] >= 0)
        edges.try_emplace(std::minmax(tetra.vertices[i], tetra.vertices[j]), triangles);
    }
  }
  return edges;
}

/// Takes out the crossings near an end that is on the cut, and puts the end on their sheets too.
void put_ends_on(const Patch& patch, CrossedEdge& edge, double t0, OnCut& known) {
  const double share = is_short(patch, edge.p, edge.q) ? 0.5 : t0;
  const Vec3& a = patch.vertex(edge.p).place;
  const Vec3& b = patch.vertex(edge.q).place;
  std::erase_if(edge.crossings, [&](const BladeCrossing& crossing) {
    const bool to_p = known.on(edge.p) && crossing.t <= share;
    if (!to_p && !(known.on(edge.q) && crossing.t >= 1.0 - share)) return false;
    known.put_on(to_p ? edge.p : edge.q, to_p ? a : b, a + crossing.t * (b - a), crossing.triangle);
    return true;
  });
}

/// The edges with an end on the cut that pass another sheet. A vertex near enough to one is put on it too.
/// Other ends get votes as those of edges that are crossed once.
std::vector<CrossedEdge> edges_to_other_sheets(const Patch& patch, const Blade& blade, double settled,
                                               double t0, OnCut& known) {
  std::vector<CrossedEdge> edges;
  for (const auto& [ends, triangles] : edges_of(patch, blade.crowded)) {
    const auto& [p, q] = ends;
    if (!known.on(p) && !known.on(q)) continue;
    CrossedEdge edge{p, q, other_sheets(patch, blade, known, p, q, triangles)};
    if (edge.crossings.empty()) continue;
    settle(edge.crossings, settled);
    put_ends_on(patch, edge, t0, known);
    if (edge.crossings.empty()) continue;
    cast_votes(patch, edge, known);
    edges.push_back(std::move(edge));
  }
  return edges;
}

/// Whether crossings of an edge are on different sheets, not on both sides of a ridge.
bool are_apart(const BladeSheets& sheets, Numbers triangles, const Vec3& a, const Vec3& b,
               const std::vector<BladeCrossing>& crossings) {
  const auto [low, high] = std::ranges::minmax_element(crossings, {}, &BladeCrossing::t);
  const Vec3 first = a + low->t * (b - a);
  const Vec3 last = a + high->t * (b - a);
  Eigen::AlignedBox3d box(first);
  box.extend(last);
  const Vec3 around = Vec3::Constant((last - first).norm());
  const auto inside = sheets.in({box.min() - around, box.max() + around}, triangles);
  return std::ranges::any_of(crossings, [&](const BladeCrossing& crossing) {
    return inside.of(crossing.triangle) != inside.of(low->triangle);
  });
}

/// A vertex put on an edge between two places of one sheet lies on that sheet too.
void keep_on_sheets(const Patch& patch, const Blade& blade, std::size_t first, OnCut& known) {
  for (std::size_t i = first; i < patch.divisions.size(); ++i) {
    const auto& [vertex, p, q] = patch.divisions[i];
    if (!known.on(p) || !known.on(q)) continue;
    const BladeSheets::Inside inside = sheets_at(patch, blade.sheets, known, p, q);
    std::vector<std::int32_t> shared;
    known.each_meeting(p, [&, q = q](const OnCut::Meeting& of_p) {
      known.each_meeting(q, [&](const OnCut::Meeting& of_q) {
        if (of_p.on && of_q.on && inside.of(of_p.triangle) == inside.of(of_q.triangle) &&
            is_near(blade.part, inside.triangles, of_p.place, of_q.place))
          shared.push_back(of_p.triangle);
      });
    });
    const Vec3 place = patch.vertex(vertex).place;
    for (const std::int32_t triangle : shared) known.put_on(vertex, place, place, triangle);
  }
}

/// Vertices on two sheets of the blade: the material between these ends there.
std::vector<std::int32_t> pinched_vertices(const Patch& patch, const Blade& blade, const OnCut& known) {
  std::vector<std::int32_t> vertices;
  for (std::size_t i = 0; i < patch.vertices.size(); ++i) {
    const auto v = static_cast<std::int32_t>(i);
    Eigen::AlignedBox3d box(patch.vertices[i].place);
    std::vector<std::int32_t> triangles;
    known.each_meeting(v, [&](const OnCut::Meeting& meeting) {
      if (!meeting.on) return;
      box.extend(meeting.place);
      triangles.push_back(meeting.triangle);
    });
    if (triangles.size() < 2) continue;
    const Vec3 around = Vec3::Constant(box.diagonal().norm());
    const BladeSheets::Inside inside = blade.sheets.in({box.min() - around, box.max() + around});
    const auto is_other = [&](std::int32_t t) { return inside.of(t) != inside.of(triangles.front()); };
    if (std::ranges::any_of(triangles, is_other)) vertices.push_back(v);
  }
  return vertices;
}

}  // namespace

LeftEdges divide_at_other_sheets(Patch& patch, const Blade& blade, double settled, double t0,
                                 const std::function<double(std::int32_t)>& share, OnCut& known) {
  const std::size_t most = kMostGrowth * patch.tetrahedra.size();
  LeftEdges left;
  for (int round = 0; round < kRounds && patch.tetrahedra.size() <= most; ++round) {
    std::vector<CrossedEdge> edges = edges_to_other_sheets(patch, blade, settled, t0, known);
    if (edges.empty()) break;
    const std::size_t before = patch.divisions.size();
    const LeftEdges now = divide_crossed(patch, std::move(edges), share, known, {}, 2);
    left.unsound.insert(left.unsound.end(), now.unsound.begin(), now.unsound.end());
    left.folded.insert(left.folded.end(), now.folded.begin(), now.folded.end());
    left.merged.insert(left.merged.end(), now.merged.begin(), now.merged.end());
    keep_on_sheets(patch, blade, before, known);
  }
  return left;
}

std::vector<std::int32_t> bridged_cells(const Patch& patch, const Blade& blade, double settled,
                                        const OnCut& known) {
  std::vector<std::int32_t> cells;
  for (const auto& [ends, triangles] : edges_of(patch, blade.crowded)) {
    const auto& [p, q] = ends;
    std::vector<BladeCrossing> crossings = other_sheets(patch, blade, known, p, q, triangles);
    if (crossings.empty()) continue;
    const bool apart =
        are_apart(blade.sheets, triangles, patch.vertex(p).place, patch.vertex(q).place, crossings);
    settle(crossings, settled);
    if (crossings.empty() && !apart) continue;
    for (const std::int32_t t : patch.around(p, q)) cells.push_back(patch.tetra(t).cell);
  }
  for (const std::int32_t v : pinched_vertices(patch, blade, known)) {
    for (const std::int32_t t : patch.tetrahedra_at(v)) {
      if (blade.crowded.has(patch.tetra(t).cell)) cells.push_back(patch.tetra(t).cell);
    }
  }
  sort_unique(cells);
  return cells;
}

}  // namespace tissu
