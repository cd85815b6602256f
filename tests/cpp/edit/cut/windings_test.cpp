/// Blades of several windings, and walls near to each other, against a flood of the plane on which they
/// stand. Every failure prints its seed; TISSU_WINDINGS sets how many blades there are, TISSU_WINDINGS_SEED
/// the first.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "cut_body.h"

namespace tissu {
namespace {

using Random = std::mt19937_64;
using Point = Eigen::Vector2d;

constexpr std::array kCells{6, 4, 2};
constexpr double kEdge = 0.25;
constexpr double kStep = kEdge / 10.0;  ///< of the grid that is flooded
const Vec3 kSize(1.5, 1.0, 0.5);

double real(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

struct Line {
  std::vector<Point> points;
  bool closed = false;
};

/// The surface over a line of points in the x y plane, from below the body to above it.
Sweep walls(const Line& line) {
  std::vector<double> points;
  for (const Point& p : line.points) points.insert(points.end(), {p[0], p[1], -0.2, p[0], p[1], 0.8});
  std::vector<std::array<std::int32_t, 3>> triangles;
  const auto count = static_cast<std::int32_t>(line.points.size());
  for (std::int32_t i = 0; i + (line.closed ? 0 : 1) < count; ++i) {
    const std::int32_t a = 2 * i;
    const std::int32_t b = 2 * ((i + 1) % count);
    triangles.push_back({a, b, b + 1});
    triangles.push_back({a, b + 1, a + 1});
  }
  return triangle_sweep(points, triangles);
}

Line spiral(double turns, double pitch, double phase, const Point& center) {
  Line line;
  const int count = static_cast<int>(20 * turns);
  for (int i = 0; i <= count; ++i) {
    const double angle = 2.0 * std::numbers::pi * turns * i / count;
    const double radius = 0.1 * kEdge + pitch * angle / (2.0 * std::numbers::pi);
    line.points.emplace_back(center + radius * Point(std::cos(angle + phase), std::sin(angle + phase)));
  }
  return line;
}

/// A spiral, a U, a wedge, a hairpin or a cylinder.
Line random_line(Random& random) {
  const Point center(real(random, 0.5, 1.0), real(random, 0.35, 0.65));
  const double width = kEdge * real(random, 0.15, 1.3);
  switch (random() % 5) {
    case 0:
      return spiral(real(random, 1.0, 3.5), kEdge * real(random, 0.35, 1.4), real(random, 0.0, 6.0), center);
    case 1:
      return {{{center[0] - width / 2, 1.2},
               {center[0] - width / 2, center[1]},
               {center[0] + width / 2, center[1]},
               {center[0] + width / 2, 1.2}}};
    case 2:
      return {{{center[0] - width, 1.2}, center, {center[0] + width, 1.2}}};
    default:
      break;
  }
  const bool closed = random() % 2 == 0;
  const int sides = 5 + static_cast<int>(random() % 20);
  Line line{{}, closed};
  if (!closed) line.points.emplace_back(center[0] - width / 2, 1.2);
  for (int i = 0; i < sides; ++i) {
    const double angle = closed ? 2.0 * std::numbers::pi * i / sides
                                : std::numbers::pi * (1.0 + static_cast<double>(i) / (sides - 1));
    line.points.emplace_back(center + width / 2 * Point(std::cos(angle), std::sin(angle)));
  }
  if (!closed) line.points.emplace_back(center[0] + width / 2, 1.2);
  return line;
}

double turn(const Point& a, const Point& b, const Point& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Calls for each piece of a line with its two ends.
template <class Visit>
void each_piece(const Line& line, const Visit& visit) {
  for (std::size_t i = 0; i + (line.closed ? 0 : 1) < line.points.size(); ++i)
    visit(line.points[i], line.points[(i + 1) % line.points.size()]);
}

/// The deepest points of each part into which a line divides the body's rectangle, within a fifth of the
/// greatest depth. Parts that are thinner than the grid resolves are left out.
class Flood {
 public:
  explicit Flood(const Line& line) : line_(line), label_(kColumns * kRows, -1) {
    for (int first = 0; first < kColumns * kRows; ++first) {
      if (label_[static_cast<std::size_t>(first)] < 0) fill(first);
    }
  }
  std::vector<std::vector<Point>> cores;

 private:
  static constexpr int kColumns = 61;
  static constexpr int kRows = 41;

  /// The first and last points of rows and columns lie on the rim of the body.
  static Point point(int i) { return {kStep * (i % kColumns), kStep * static_cast<double>(i / kColumns)}; }

  [[nodiscard]] bool is_between(int i, int j) const {
    const Point a = point(i);
    const Point b = point(j);
    bool crossed = false;
    each_piece(line_, [&](const Point& p, const Point& q) {
      crossed = crossed || (turn(a, b, p) * turn(a, b, q) <= 0.0 && turn(p, q, a) * turn(p, q, b) <= 0.0);
    });
    return crossed;
  }

  [[nodiscard]] double depth(int i) const {
    const Point a = point(i);
    double least = std::numeric_limits<double>::infinity();
    each_piece(line_, [&](const Point& p, const Point& q) {
      const double t = std::clamp((a - p).dot(q - p) / (q - p).squaredNorm(), 0.0, 1.0);
      least = std::min(least, (a - p - t * (q - p)).norm());
    });
    return least;
  }

  void fill(int first) {
    std::vector<int> members{first};
    label_[static_cast<std::size_t>(first)] = first;
    for (std::size_t next = 0; next < members.size(); ++next) {
      const int i = members[next];
      for (const int step : {-1, 1, -kColumns, kColumns}) {
        const int j = i + step;
        if (j < 0 || j >= kColumns * kRows || (std::abs(step) == 1 && j / kColumns != i / kColumns)) continue;
        if (label_[static_cast<std::size_t>(j)] >= 0 || is_between(i, j)) continue;
        label_[static_cast<std::size_t>(j)] = first;
        members.push_back(j);
      }
    }
    double most = 0.0;
    for (const int i : members) most = std::max(most, depth(i));
    if (most <= 0.1 * kEdge || members.size() <= 20) return;
    std::vector<Point>& core = cores.emplace_back();
    for (const int i : members) {
      const Point p = point(i);  // inside the body, off the faces of its cells
      if (depth(i) >= 0.8 * most) core.push_back(p + 1e-3 * kStep * (Point(0.761, 0.513) - p));
    }
  }

  const Line& line_;
  std::vector<int> label_;
};

/// The material's tetrahedra, joined across faces that are not opened.
class Joined {
 public:
  explicit Joined(const test::CutBody& body) {
    std::map<std::array<std::int32_t, 3>, std::size_t> faces;
    for (const std::int32_t cell : body.hosts.numbers()) {
      for (const MaterialTetra& tetra : material_of(body.hosts, body.material, cell)) {
        const std::size_t own = places_.size();
        root_.push_back(own);
        auto& place = places_.emplace_back();
        for (std::size_t i = 0; i < 4; ++i) place[i] = body.material.at(tetra.vertices[i], body.x);
        for (std::size_t f = 0; f < 4; ++f) {
          if ((tetra.cut >> f & 1U) != 0) continue;
          std::array<std::int32_t, 3> key{};
          for (std::size_t i = 0; i < 3; ++i) key[i] = tetra.vertices[(f + 1 + i) % 4];
          std::ranges::sort(key);
          const auto [entry, is_new] = faces.try_emplace(key, own);
          if (!is_new) root_[first(own)] = first(entry->second);
        }
      }
    }
  }

  /// A number for the part in which most of some places lie, at three heights.
  std::size_t part_of(const std::vector<Point>& places) {
    std::map<std::size_t, int> counts;
    const std::size_t step = 1 + places.size() / 20;
    for (std::size_t i = 0; i < places.size(); i += step) {
      for (const double z : {0.11, 0.237, 0.41}) ++counts[part_at(Vec3(places[i][0], places[i][1], z))];
    }
    return std::ranges::max_element(counts, {}, [](const auto& one) { return one.second; })->first;
  }

 private:
  std::size_t part_at(const Vec3& p) {
    for (std::size_t t = 0; t < places_.size(); ++t) {
      const auto& [a, b, c, d] = places_[t];
      Mat3 edges;
      edges << b - a, c - a, d - a;
      const Vec3 w = edges.inverse() * (p - a);
      if (w.minCoeff() >= -1e-12 && w.sum() <= 1.0 + 1e-12) return first(t);
    }
    ADD_FAILURE() << "no material at a point";
    return 0;
  }

  std::size_t first(std::size_t i) const {
    while (root_[i] != i) i = root_[i];
    return i;
  }
  std::vector<std::array<Vec3, 4>> places_;
  std::vector<std::size_t> root_;
};

struct Carrier {
  CellType type;
  bool divide;
};
constexpr std::array<Carrier, 3> kCarriers{
    {{CellType::tetra, false}, {CellType::hexahedron, false}, {CellType::tetra, true}}};

struct Result {
  std::size_t parts;  ///< into which the line divides the body
  bool apart;         ///< no two of them are joined
  std::size_t unresolved;
  std::string fault;
};

Result cut(const Line& line, const Carrier& carrier) {
  test::CutBody body(
      test::typed_box(carrier.type, kSize, kCells, carrier.type == CellType::tetra ? 0.1 : 0.0, 5));
  const CutPlan plan = body.cut(walls(line), {.divide = carrier.divide});
  Joined joined(body);
  const Flood flood(line);
  std::vector<std::size_t> parts;
  for (const std::vector<Point>& core : flood.cores) parts.push_back(joined.part_of(core));
  std::ranges::sort(parts);
  return {parts.size(), std::ranges::adjacent_find(parts) == parts.end(), plan.unresolved.size(),
          body.fault()};
}

/// Windings 0.9 to 1.3 cells apart. A side taken from the nearest winding leaves them joined.
TEST(WindingsTest, ASpiralPartsWhatItSeparates) {
  for (const Carrier& carrier : kCarriers) {
    for (const double pitch : {0.9, 1.1, 1.3}) {
      const Result result = cut(spiral(3.3, pitch * kEdge, 0.4, Point(0.77, 0.52)), carrier);
      const std::string what = std::to_string(pitch) + (carrier.divide ? " divided" : "");
      EXPECT_GE(result.parts, 2U) << what;
      EXPECT_TRUE(result.apart) << what;
      EXPECT_EQ(result.fault, "") << what;
    }
  }
}

long from_environment(const char* name, long otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtol(text, nullptr, 10);
}

TEST(WindingsTest, RandomWallsPartOrThePlanNamesCells) {
  const long count = from_environment("TISSU_WINDINGS", 40);
  const long first = from_environment("TISSU_WINDINGS_SEED", 1);
  for (long seed = first; seed < first + count; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    const Line line = random_line(random);
    for (const Carrier& carrier : kCarriers) {
      const Result result = cut(line, carrier);
      EXPECT_TRUE(result.apart || result.unresolved > 0)
          << "seed " << seed << (carrier.divide ? ", divided" : "");
      EXPECT_TRUE(carrier.divide || result.fault.empty()) << result.fault << ", seed " << seed;
    }
  }
}

}  // namespace
}  // namespace tissu
