#include "tissu/mesh/triangle_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "tissu/base/error.h"

namespace tissu {
namespace {

constexpr std::int32_t kLeaf = 4;          ///< triangles
constexpr std::size_t kDeepest = 64;       ///< boxes wait: halves of 2^31 triangles are 31 deep
constexpr double kRoundOff = 1.0 + 1e-12;  ///< of squares, so that none equally near is passed by

Vec3 closest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 edge = b - a;
  const double length = edge.squaredNorm();
  if (!(length > 0.0)) return a;
  return a + std::clamp((p - a).dot(edge) / length, 0.0, 1.0) * edge;
}

double square_to_box(const Vec3& p, const Vec3& low, const Vec3& high) {
  return (low - p).cwiseMax(p - high).cwiseMax(0.0).squaredNorm();
}

}  // namespace

Vec3 closest_on_triangle(const Vec3& p, const double* corners) {
  const Eigen::Map<const Vec3> a(corners);
  const Eigen::Map<const Vec3> b(corners + 3);
  const Eigen::Map<const Vec3> c(corners + 6);
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 ap = p - a;
  const double bb = ab.dot(ab);
  const double bc = ab.dot(ac);
  const double cc = ac.dot(ac);
  const double det = bb * cc - bc * bc;
  const double u = cc * ap.dot(ab) - bc * ap.dot(ac);
  const double v = bb * ap.dot(ac) - bc * ap.dot(ab);
  if (u > 0.0 && v > 0.0 && u + v < det) return a + (u / det) * ab + (v / det) * ac;
  // The nearest point of a convex shape lies on a side that p is beyond.
  Vec3 best = a;
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](const Vec3& from, const Vec3& to) {
    const Vec3 place = closest_on_segment(p, from, to);
    const double square = (place - p).squaredNorm();
    if (square >= least) return;
    best = place;
    least = square;
  };
  if (!(v > 0.0)) look(a, b);
  if (!(u > 0.0)) look(a, c);
  if (!(u + v < det)) look(b, c);
  return best;
}

TriangleTree::TriangleTree(std::span<const double> corners)
    : corners_(corners.size() / 9), number_(corners.size() / 9) {
  if (corners.empty() || corners.size() % 9 != 0) {
    throw MeshError("found " + std::to_string(corners.size()) +
                    " numbers of corners; nine for each of one or more triangles are accepted.");
  }
  std::vector<Vec3> centres(number_.size());
  for (std::size_t t = 0; t < centres.size(); ++t) {
    const Eigen::Map<const Mat3> of(corners.data() + 9 * t);
    centres[t] = of.rowwise().mean();
  }
  std::iota(number_.begin(), number_.end(), 0);
  for (std::size_t t = 0; t < corners_.size(); ++t) {
    std::copy_n(corners.data() + 9 * t, 9, corners_[t].begin());
  }
  const std::vector<std::array<double, 9>> given = corners_;
  boxes_.reserve(number_.size());
  boxes_.emplace_back();
  split(0, 0, static_cast<std::int32_t>(number_.size()), centres);
  for (std::size_t t = 0; t < corners_.size(); ++t) corners_[t] = given[static_cast<std::size_t>(number_[t])];
}

/// Fills a box with `count` triangles from `first` on: halves of them along the longest side of their
/// centres.
void TriangleTree::split(std::int32_t box, std::int32_t first, std::int32_t count,
                         const std::vector<Vec3>& centres) {
  const auto begin = number_.begin() + first;
  const auto end = begin + count;
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = -low;
  Vec3 middle_low = low;
  Vec3 middle_high = high;
  for (auto at = begin; at != end; ++at) {
    const auto t = static_cast<std::size_t>(*at);
    const Eigen::Map<const Mat3> of(corners_[t].data());
    low = low.cwiseMin(of.rowwise().minCoeff());
    high = high.cwiseMax(of.rowwise().maxCoeff());
    middle_low = middle_low.cwiseMin(centres[t]);
    middle_high = middle_high.cwiseMax(centres[t]);
  }
  boxes_[static_cast<std::size_t>(box)] = {low, high, first, count};
  if (count <= kLeaf) return;
  Eigen::Index axis = 0;
  (middle_high - middle_low).maxCoeff(&axis);
  const std::int32_t half = count / 2;
  std::nth_element(begin, begin + half, end, [&](std::int32_t a, std::int32_t b) {
    const double x = centres[static_cast<std::size_t>(a)][axis];
    const double y = centres[static_cast<std::size_t>(b)][axis];
    return x < y || (x == y && a < b);
  });
  const auto left = static_cast<std::int32_t>(boxes_.size());
  boxes_[static_cast<std::size_t>(box)].first = left;
  boxes_[static_cast<std::size_t>(box)].count = 0;
  boxes_.resize(boxes_.size() + 2);
  split(left, first, half, centres);
  split(left + 1, first + half, count - half, centres);
}

void TriangleTree::take(const Vec3& p, std::int32_t leaf, Nearest& best) const {
  const auto t = static_cast<std::size_t>(leaf);
  const Vec3 place = closest_on_triangle(p, corners_[t].data());
  const double square = (place - p).squaredNorm();
  if (square > best.square) return;
  if (square == best.square && best.leaf >= 0 && number_[t] >= number_[static_cast<std::size_t>(best.leaf)])
    return;
  best = {place, square, leaf};
}

TriangleTree::Nearest TriangleTree::nearest(const Vec3& p, double reach, std::int32_t hint) const {
  Nearest best{Vec3::Constant(std::numeric_limits<double>::quiet_NaN()), reach * reach, -1};
  if (hint >= 0) take(p, hint, best);
  std::array<std::pair<double, std::int32_t>, kDeepest> waiting;
  std::size_t count = 0;
  waiting[count++] = {square_to_box(p, boxes_[0].low, boxes_[0].high), 0};
  while (count > 0) {
    const auto [least, number] = waiting[--count];
    if (least > best.square * kRoundOff) continue;
    const Box& box = boxes_[static_cast<std::size_t>(number)];
    for (std::int32_t leaf = box.first; leaf < box.first + box.count; ++leaf) take(p, leaf, best);
    if (box.count > 0) continue;
    const Box& left = boxes_[static_cast<std::size_t>(box.first)];
    const Box& right = boxes_[static_cast<std::size_t>(box.first) + 1];
    std::pair<double, std::int32_t> near{square_to_box(p, left.low, left.high), box.first};
    std::pair<double, std::int32_t> far{square_to_box(p, right.low, right.high), box.first + 1};
    if (far.first < near.first) std::swap(near, far);
    waiting[count++] = far;
    waiting[count++] = near;
  }
  if (best.leaf < 0) best.square = std::numeric_limits<double>::infinity();
  return best;
}

}  // namespace tissu
