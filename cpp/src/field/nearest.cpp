#include "nearest.h"

#include <algorithm>

namespace tissu {
namespace {

constexpr std::size_t kLeaf = 8;  ///< points of a range that is not split

}  // namespace

Nearest::Nearest(ConstReals positions) {
  const auto count = static_cast<std::int32_t>(positions.size() / 3);
  points_.reserve(static_cast<std::size_t>(count));
  for (std::int32_t i = 0; i < count; ++i) points_.push_back({block(positions, i), i, 0});
  split(0, points_.size());
}

void Nearest::split(std::size_t begin, std::size_t end) {
  if (end - begin <= kLeaf) return;
  Vec3 low = points_[begin].position;
  Vec3 high = low;
  for (std::size_t i = begin; i < end; ++i) {
    low = low.cwiseMin(points_[i].position);
    high = high.cwiseMax(points_[i].position);
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [this](std::size_t i) { return points_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [axis](const Point& a, const Point& b) {
    return a.position[axis] != b.position[axis] ? a.position[axis] < b.position[axis] : a.number < b.number;
  });
  points_[middle].axis = axis;
  split(begin, middle);
  split(middle + 1, end);
}

void Nearest::Query::offer(const Point& point) const {
  const Found candidate{(point.position - x).squaredNorm(), point.number};
  if (found->size() == count) {
    if (!(candidate < found->back())) return;
    found->pop_back();
  }
  found->insert(std::ranges::upper_bound(*found, candidate), candidate);
}

// Equal distances are looked at too: the lower number may be there.
bool Nearest::Query::reaches(double distance) const {
  return found->size() < count || distance * distance <= found->back().squared;
}

void Nearest::visit(const Query& query, std::size_t begin, std::size_t end) const {
  if (end - begin <= kLeaf) {
    for (std::size_t i = begin; i < end; ++i) query.offer(points_[i]);
    return;
  }
  const std::size_t middle = begin + (end - begin) / 2;
  const Point& splitting = points_[middle];
  const double beyond = query.x[splitting.axis] - splitting.position[splitting.axis];
  query.offer(splitting);
  if (beyond < 0.0) {
    visit(query, begin, middle);
    if (query.reaches(beyond)) visit(query, middle + 1, end);
  } else {
    visit(query, middle + 1, end);
    if (query.reaches(beyond)) visit(query, begin, middle);
  }
}

void Nearest::find(const Vec3& x, int count, std::vector<Found>& found) const {
  found.clear();
  if (count <= 0) return;
  visit({x, static_cast<std::size_t>(count), &found}, 0, points_.size());
}

}  // namespace tissu
