#include "soups.h"

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "../base/random.h"
#include "contact/nearest_pair.h"
#include "tissu/base/index.h"

namespace tissu::test {
namespace {

constexpr int kTriangles = 100;  ///< of each of the two bodies
constexpr int kLines = 20;
constexpr int kPoints = 10;
constexpr double kGap = 0.01;

/// A body that grows triangle by triangle.
class Heap {
 public:
  Heap(Random& random, const char* name, bool closed) : random_(random) {
    surface_.name = name;
    surface_.closed = closed;
  }

  void add_triangle(int number) {
    const Vec3 a = 0.5 * random_.vector();
    const double size = 0.3 * std::pow(10.0, -0.5 - 0.5 * random_.number());
    const Vec3 u = size * random_.vector();
    const Vec3 v = size * random_.vector();
    switch (number % 12) {
      case 0:  // in a line
        return add({a, a + u, a + random_.number() * u});
      case 1:  // two corners in one place
        return add({a, a + u, a + u});
      case 2:  // all in one place
        return add({a, a, a});
      case 3:  // a sliver with a short side
        return add({a, a + u, a + u + 1e-6 * v});
      case 4:  // a sliver with a wide angle
        return add({a, a + u, a + 0.5 * u + 1e-9 * v});
      case 5:  // in the place of another one
        return add_again(0.0);
      case 6:  // nearly so, as the layers of a fold
        return add_again(kGap);
      case 7:
      case 8:  // on the side of another one
        return add_beside(a + u);
      default:
        return add({a, a + u, a + v});
    }
  }
  void add_line() {
    const Vec3 a = 0.5 * random_.vector();
    surface_.edges.push_back({node(a), node(a + 0.3 * random_.vector())});
  }
  void add_point() { surface_.points.push_back(node(0.5 * random_.vector())); }

  [[nodiscard]] SurfaceDescription& surface() { return surface_; }
  [[nodiscard]] const std::vector<double>& places() const { return places_; }

 private:
  std::int32_t node(const Vec3& place) {
    places_.insert(places_.end(), place.begin(), place.end());
    return static_cast<std::int32_t>(places_.size() / 3) - 1;
  }
  void add(const std::array<Vec3, 3>& corners) {
    const std::int32_t a = node(corners[0]);
    const std::int32_t b = node(corners[1]);
    surface_.triangles.push_back({a, b, node(corners[2])});
  }
  [[nodiscard]] const std::array<std::int32_t, 3>& another() {
    const double share = 0.5 + 0.5 * random_.number();
    const auto count = static_cast<double>(surface_.triangles.size());
    return surface_.triangles[static_cast<std::size_t>(std::min(share * count, count - 1.0))];
  }
  void add_again(double beside) {
    const std::array<std::int32_t, 3> other = another();
    std::array<Vec3, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = block(ConstReals(places_), other[i]) + beside * random_.vector();
    }
    add(corners);
  }
  void add_beside(const Vec3& corner) {
    const std::array<std::int32_t, 3> other = another();
    surface_.triangles.push_back({other[1], other[0], node(corner)});
  }

  Random& random_;
  SurfaceDescription surface_;
  std::vector<double> places_;
};

struct Ball {
  Vec3 center;
  double radius;
};

Ball ball_of(std::span<const std::int32_t> vertices, ConstReals from, ConstReals to) {
  Ball ball{Vec3::Zero(), 0.0};
  for (const std::int32_t v : vertices) ball.center += 0.5 * (block(from, v) + block(to, v));
  ball.center /= static_cast<double>(vertices.size());
  for (const std::int32_t v : vertices) {
    ball.radius =
        std::max({ball.radius, (block(from, v) - ball.center).norm(), (block(to, v) - ball.center).norm()});
  }
  return ball;
}

struct Feature {
  std::int32_t number;
  std::vector<std::int32_t> vertices;
  Ball ball;
};

/// All features of a soup, and the pairs of them.
class EveryPair {
 public:
  EveryPair(const Soup& soup, const SurfaceSet& surfaces, ConstReals from, ConstReals to)
      : soup_(soup), surfaces_(surfaces), from_(from), to_(to) {
    for (std::int32_t v = 0; v < std::ssize(surfaces.vertices()); ++v) vertices_.push_back(feature(v, {v}));
    for (std::int32_t e = 0; e < std::ssize(surfaces.edges()); ++e) {
      const auto& [a, b] = surfaces.edges()[at(e)].vertex;
      edges_.push_back(feature(e, {a, b}));
    }
    for (std::int32_t p = 0; p < std::ssize(surfaces.primitives()); ++p) {
      const auto& [a, b, c] = surfaces.primitives()[at(p)].vertex;
      if (surfaces.primitives()[at(p)].corners == 3) triangles_.push_back(feature(p, {a, b, c}));
    }
  }

  std::vector<Candidate> list() {
    for (const Feature& v : vertices_) {
      for (const Feature& t : triangles_) add(PairKind::vertex_face, v, t);
      for (const Feature& e : edges_) {
        if (surfaces_.edges()[at(e.number)].is_lone()) add(PairKind::vertex_edge, v, e);
      }
      if (!surfaces_.vertices()[at(v.number)].is_lone) continue;
      for (const Feature& w : vertices_) {
        const SurfaceVertex& other = surfaces_.vertices()[at(w.number)];
        if (other.is_lone && w.number > v.number) add(PairKind::vertex_vertex, v, w);
        if (other.has_faces) add(PairKind::vertex_vertex, w, v);  // the lone one may be round
      }
    }
    for (const Feature& e : edges_) {
      for (std::int32_t f = e.number + 1; f < std::ssize(edges_); ++f) {
        add(PairKind::edge_edge, e, edges_[at(f)]);
      }
    }
    return std::move(list_);
  }

 private:
  [[nodiscard]] Feature feature(std::int32_t number, std::vector<std::int32_t> vertices) const {
    const Ball ball = ball_of(vertices, from_, to_);
    return {number, std::move(vertices), ball};
  }
  [[nodiscard]] double radius(const Feature& feature) const {
    double radius = 0.0;
    for (const std::int32_t v : feature.vertices) {
      radius = std::max(radius, surfaces_.vertices()[at(v)].radius);
    }
    return radius;
  }

  void add(PairKind kind, const Feature& one, const Feature& other) {
    const double reach = radius(one) + radius(other) + 2.0 * kGap;
    if ((one.ball.center - other.ball.center).norm() > one.ball.radius + other.ball.radius + reach) return;
    Candidate c{kind, one.number, other.number, 0, {-1, -1, -1, -1}, radius(one) + radius(other) + kGap};
    std::array<Vec3, 4> rest{};
    std::size_t count = 0;
    for (const std::vector<std::int32_t>* side : {&one.vertices, &other.vertices}) {
      for (const std::int32_t v : *side) {
        if (std::ranges::find(c.vertex, v) != c.vertex.end()) return;  // they share it
        rest[count] = block(ConstReals(surfaces_.rest()), v);
        c.vertex[count++] = v;
      }
    }
    const std::int32_t a = surfaces_.vertices()[at(one.vertices[0])].surface;
    const std::int32_t b = surfaces_.vertices()[at(other.vertices[0])].surface;
    c.pair = a + b;  // of the description below: 0-0, 0-1, 1-1
    if (a == b) c.apart = std::min(c.apart, 0.9 * std::sqrt(nearest_of(kind, rest).square));
    if (c.apart > 0.0) list_.push_back(c);
  }

  const Soup& soup_;
  const SurfaceSet& surfaces_;
  ConstReals from_;
  ConstReals to_;
  std::vector<Feature> vertices_, edges_, triangles_;
  std::vector<Candidate> list_;
};

/// Every vertex goes a little, and every tenth one far.
std::vector<double> stirred(Random& random, std::vector<double> places) {
  for (std::size_t i = 0; i < places.size(); i += 3) {
    const double way = i / 3 % 10 == 0 ? 0.2 : 0.02;
    block(Reals(places), static_cast<std::int32_t>(i / 3)) += way * random.vector();
  }
  return places;
}

}  // namespace

Soup soup(unsigned number) {
  Random random(20'000 + number);
  Heap first(random, "first", false);
  Heap second(random, "second", number % 2 == 1);
  for (int i = kTriangles; i-- > 0;) {
    first.add_triangle(i);
    second.add_triangle(i);
  }
  for (int i = 0; i < kLines; ++i) second.add_line();
  for (int i = 0; i < kPoints; ++i) second.add_point();
  second.surface().radius.assign(second.places().size() / 3, number % 3 == 0 ? kGap : 0.0);
  Soup soup;
  soup.description.bodies = {first.surface(), second.surface()};
  soup.description.pairs = {
      {.a = 0, .b = 0, .gap = kGap}, {.a = 1, .b = 0, .gap = kGap}, {.a = 1, .b = 1, .gap = kGap}};
  soup.first_row = {0, static_cast<std::int32_t>(first.places().size() / 3)};
  soup.places = {first.places()};
  soup.places[0].insert(soup.places[0].end(), second.places().begin(), second.places().end());
  for (int i = 1; i < Soup::kTimes; ++i) soup.places.push_back(stirred(random, soup.places.back()));
  return soup;
}

std::vector<Candidate> every_candidate(const Soup& soup, const SurfaceSet& surfaces, ConstReals from,
                                       ConstReals to) {
  return EveryPair(soup, surfaces, from, to).list();
}

bool same(const Found& one, const Found& other) {
  return one.kind == other.kind && one.a == other.a && one.b == other.b && one.vertex == other.vertex &&
         one.beta == other.beta && one.r == other.r && one.distance == other.distance &&
         one.weight == other.weight && one.area == other.area;
}

SoupRange::SoupRange(unsigned few) : first(0), end(few) {
  const char* given = std::getenv("TISSU_SOUPS");
  if (given == nullptr) return;
  std::istringstream text(given);
  char dash = 0;
  if (!(text >> first >> dash >> end) || dash != '-' || first >= end) {
    throw std::runtime_error("found TISSU_SOUPS=" + std::string(given) + "; 0-10000 is accepted");
  }
}

}  // namespace tissu::test
