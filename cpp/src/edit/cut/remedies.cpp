#include "edit/cut/remedies.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace tissu {
namespace {

constexpr double kLeastQuality = 0.05;
constexpr double kOfParent = 0.25;
constexpr int kLastRound = 4;
/// Plans after which a bad cell stays whole at once: neighbours may send each other through all rounds.
constexpr int kMostPlans = 8;

double quality(const Patch& patch, const Patch::Tetra& tetra) {
  const auto p = [&](std::size_t i) { return patch.vertex(tetra.vertices[i]).rest; };
  return tetra.corners() == 3 ? triangle_quality(p(0), p(1), p(2)) : tetra_quality(p(0), p(1), p(2), p(3));
}

double quality(const Hosts& hosts, std::int32_t cell) {
  const auto nodes = hosts.corners(cell);
  const auto p = [&](std::size_t i) -> Vec3 { return block(hosts.rest(), nodes[i]); };
  return nodes.size() == 3 ? triangle_quality(p(0), p(1), p(2)) : tetra_quality(p(0), p(1), p(2), p(3));
}

}  // namespace

double tetra_quality(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double volume = (b - a).cross(c - a).dot(d - a) / 6.0;
  const double squares = (b - a).squaredNorm() + (c - a).squaredNorm() + (d - a).squaredNorm() +
                         (c - b).squaredNorm() + (d - b).squaredNorm() + (d - c).squaredNorm();
  const double mean = std::sqrt(squares / 6.0);
  return 6.0 * std::sqrt(2.0) * volume / (mean * mean * mean);
}

double triangle_quality(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double squares = (b - a).squaredNorm() + (c - a).squaredNorm() + (c - b).squaredNorm();
  return 2.0 * std::sqrt(3.0) * (b - a).cross(c - a).norm() / squares;
}

int Remedies::round(std::int32_t cell) const {
  const auto found = cells_.find(cell);
  return found == cells_.end() ? 0 : found->second.round;
}

double Remedies::t0(std::int32_t cell, double otherwise) const {
  const auto found = cells_.find(cell);
  return found == cells_.end() ? otherwise : std::max(otherwise, found->second.t0);
}

std::vector<std::int32_t> Remedies::apply(const Patch& patch, double t0, std::vector<CrossedEdge>& edges) {
  std::set<std::int32_t> left;
  if (!any()) return {};
  const auto cells = [&](const CrossedEdge& edge) {
    std::vector<std::int32_t> numbers;
    for (const std::int32_t t : patch.around(edge.p, edge.q))
      numbers.push_back(patch.cell(patch.tetra(t).cell).number);
    return numbers;
  };
  std::erase_if(edges, [&](const CrossedEdge& edge) {
    bool stays = false;
    for (const std::int32_t cell : cells(edge)) {
      if (!whole(cell)) continue;
      left.insert(cell);
      stays = true;
    }
    return stays;
  });
  for (const CrossedEdge& edge : edges) {
    double share = 0.5;
    for (const BladeCrossing& crossing : edge.crossings)
      share = std::min({share, crossing.t, 1.0 - crossing.t});
    for (const std::int32_t cell : cells(edge)) {
      const auto found = cells_.find(cell);
      if (found == cells_.end() || share <= this->t0(cell, t0)) continue;
      found->second.nearest = std::min(found->second.nearest, share);
    }
  }
  return {left.begin(), left.end()};
}

bool Remedies::advance(const Hosts& hosts, const Patch& patch) {
  std::set<std::int32_t> bad;
  for (const Patch::Tetra& tetra : patch.tetrahedra) {
    const Patch::Cell& cell = patch.cell(tetra.cell);
    if (!cell.divided || whole(cell.number) || bad.contains(cell.number)) continue;
    const double least = std::min(kLeastQuality, kOfParent * quality(hosts, cell.number));
    if (!(quality(patch, tetra) >= least)) bad.insert(cell.number);
  }
  ++rounds_;
  for (const std::int32_t number : bad) {
    Cell& cell = cells_[number];
    cell.round = rounds_ > kMostPlans ? kLastRound : cell.round + 1;
    if (cell.round == 2) cell.t0 = cell.nearest;
    if (cell.round == 3) cell.t0 = 0.5;
  }
  for (auto& [number, cell] : cells_) cell.nearest = 0.5;
  return !bad.empty();
}

}  // namespace tissu
