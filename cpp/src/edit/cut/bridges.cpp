#include "edit/cut/bridges.h"

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <utility>

#include "edit/cut/bisect.h"
#include "edit/cut/side.h"
#include "tissu/base/crossing.h"
#include "tissu/base/sort_unique.h"

namespace tissu {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

constexpr int kRounds = 16;
constexpr std::size_t kMostGrowth = 8;  ///< times the tetrahedra before the rounds
constexpr double kTurned = 0.5;         ///< cosine between the normals of a blade that may pass a cell twice
constexpr double kBetween = 0.15;       ///< of the way between two places: its middle is so far off the blade

Vec3 normal_of(const std::array<Vec3, 3>& t) { return (t[1] - t[0]).cross(t[2] - t[0]).normalized(); }

bool turns(const SweepPart& part, std::span<const std::int32_t> triangles) {
  return std::ranges::any_of(triangles, [&](std::int32_t t) {
    return normal_of(part.triangles[at(t)]).dot(normal_of(part.triangles[at(triangles.front())])) < kTurned;
  });
}

/// The triangles near each cell where the blade turns; none near others.
class TurningCells {
 public:
  TurningCells(const Patch& patch, const SweepPart& part, const NearCells& near)
      : patch_(patch), part_(part), near_(near) {}

  [[nodiscard]] std::span<const std::int32_t> triangles(std::int32_t cell) {
    if (cell != cell_) {
      cell_ = cell;
      triangles_ = near_.triangles(patch_.cell(cell).number);
      if (!triangles_.empty() && !turns(part_, triangles_)) triangles_ = {};
    }
    return triangles_;
  }

 private:
  const Patch& patch_;
  const SweepPart& part_;
  const NearCells& near_;
  std::int32_t cell_ = -1;
  std::span<const std::int32_t> triangles_;
};

/// Where an edge with an end on the cut passes sheets of the blade other than those on which its ends are.
/// Two places on the blade lie on different sheets if the middle between them lies far from it.
std::vector<Crossing> other_sheets(const Patch& patch, const SweepPart& part, const OnCut& known,
                                   std::int32_t p, std::int32_t q, std::span<const std::int32_t> triangles) {
  std::vector<Crossing> crossings;
  const Vec3& a = patch.vertex(p).place;
  const Vec3& b = patch.vertex(q).place;
  for (const std::int32_t t : triangles) {
    const auto& triangle = part.triangles[at(t)];
    const Vec3 normal = normal_of(triangle);
    const double of_a = normal.dot(a - triangle[0]);
    const double of_b = normal.dot(b - triangle[0]);
    if (!(of_a * of_b < 0.0) || !crosses(a, b, triangle)) continue;
    const double share = of_a / (of_a - of_b);
    const Vec3 place = a + share * (b - a);
    const auto is_other = [&](std::int32_t v) {
      if (!known.on(v)) return true;
      if (known[v].before) return false;  // the blade now is not the one that it lies on
      const Vec3& met = known[v].met;
      return distance(part, triangles, 0.5 * (place + met)) > kBetween * (place - met).norm();
    };
    if (is_other(p) && is_other(q)) crossings.push_back({share, of_a > 0.0 ? 1 : -1});
  }
  return crossings;
}

constexpr std::array<std::array<std::uint8_t, 2>, 6> kEdges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// Their other ends get votes as those of edges that are crossed once.
std::vector<CrossedEdge> edges_to_other_sheets(const Patch& patch, const SweepPart& part,
                                               const NearCells& near, double t0, OnCut& known) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<Crossing>> found;
  TurningCells turning(patch, part, near);
  for (const Patch::Tetra& tetra : patch.tetrahedra) {
    const auto triangles = turning.triangles(tetra.cell);
    if (triangles.empty()) continue;
    for (const auto& [i, j] : kEdges) {
      if (tetra.vertices[j] < 0) continue;
      const auto [p, q] = std::minmax(tetra.vertices[i], tetra.vertices[j]);
      if (!known.on(p) && !known.on(q)) continue;
      const auto [place, is_new] = found.try_emplace({p, q});
      if (is_new) place->second = other_sheets(patch, part, known, p, q, triangles);
    }
  }
  std::vector<CrossedEdge> edges;
  for (auto& [ends, crossings] : found) {
    settle(crossings, t0);
    if (crossings.empty()) continue;
    const double share = is_short(patch, ends.first, ends.second) ? 0.5 : t0;
    const auto is_at_end = [&, ends = ends](const Crossing& crossing) {  // which is on both sheets
      return (known.on(ends.first) && crossing.t <= share) ||
             (known.on(ends.second) && crossing.t >= 1.0 - share);
    };
    std::erase_if(crossings, is_at_end);
    if (crossings.empty()) continue;
    known.vertices[at(ends.first)].votes += crossings.front().direction;
    known.vertices[at(ends.second)].votes -= crossings.back().direction;
    edges.push_back({ends.first, ends.second, std::move(crossings)});
  }
  return edges;
}

}  // namespace

void divide_at_other_sheets(Patch& patch, const SweepPart& part, const NearCells& near, double t0,
                            const std::function<double(std::int32_t)>& share, OnCut& known) {
  const std::size_t most = kMostGrowth * patch.tetrahedra.size();
  for (int round = 0; round < kRounds && patch.tetrahedra.size() <= most; ++round) {
    std::vector<CrossedEdge> edges = edges_to_other_sheets(patch, part, near, t0, known);
    if (edges.empty()) return;
    divide_crossed(patch, std::move(edges), share, known, {}, 2);
  }
}

std::vector<std::int32_t> bridged_cells(const Patch& patch, const SweepPart& part, const NearCells& near,
                                        double t0, const OnCut& known,
                                        const std::vector<std::int32_t>& uncovered) {
  std::vector<std::int32_t> cells;
  OnCut votes = known;
  for (const CrossedEdge& edge : edges_to_other_sheets(patch, part, near, t0, votes)) {
    for (const std::int32_t t : patch.around(edge.p, edge.q)) cells.push_back(patch.tetra(t).cell);
  }
  TurningCells turning(patch, part, near);
  for (const std::int32_t t : uncovered) {
    if (!turning.triangles(patch.tetra(t).cell).empty()) cells.push_back(patch.tetra(t).cell);
  }
  sort_unique(cells);
  return cells;
}

}  // namespace tissu
