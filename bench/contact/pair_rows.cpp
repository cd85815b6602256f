#include "pair_rows.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "tissu/contact/closest.h"
#include "tissu/contact/travel.h"

namespace tissu::bench {
namespace {

constexpr std::size_t kPairs = 4096;
constexpr double kLeast = 0.002;       ///< edges: a tenth of a gap of 2 % of an edge
constexpr double kNear = 0.05;         ///< edges between the sides of a pair that is near
constexpr double kWay = 0.01;          ///< edges that vertices go: less than what is between the sides
constexpr double kThrough = 0.2;       ///< edges that the first side goes towards the second where it is hit
constexpr std::size_t kOneInHit = 20;  ///< of so many pairs one is hit: 5 %

double between(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Vec3 any(std::mt19937& random, double size) {
  const double x = between(random, -size, size);
  const double y = between(random, -size, size);
  return {x, y, between(random, -size, size)};
}

/// A vertex above a triangle of edges of length 1, or an edge across another, kNear apart.
std::array<Vec3, 4> near_pair(PairKind kind, std::mt19937& random) {
  const Vec3 up(0.0, 0.0, kNear);
  std::array<Vec3, 4> p;
  if (kind == PairKind::vertex_face) {
    p = {Vec3(between(random, 0.2, 0.6), between(random, 0.1, 0.4), 0.0) + up, Vec3::Zero(), Vec3(1, 0, 0),
         Vec3(0.5, 0.87, 0)};
  } else {
    const double across = between(random, -0.3, 0.3);
    p = {Vec3(across, -0.5, 0.0) + up, Vec3(-across, 0.5, 0.0) + up, Vec3(-0.5, across, 0),
         Vec3(0.5, -across, 0)};
  }
  for (Vec3& x : p) x += any(random, 0.2 * kNear);
  return p;
}

std::vector<PairWay> ways(PairKind kind, bool hits) {
  std::mt19937 random(1);
  std::vector<PairWay> made(kPairs);
  for (std::size_t i = 0; i < kPairs; ++i) {
    PairWay& pair = made[i];
    pair.kind = kind;
    pair.from = near_pair(kind, random);
    for (Vec3& way : pair.way) way = any(random, kWay);
    if (!hits || i % kOneInHit != 0) continue;
    pair.way[0].z() -= kThrough;
    if (kind == PairKind::edge_edge) pair.way[1].z() -= kThrough;
  }
  return made;
}

std::string_view word(PairKind kind) { return kind == PairKind::vertex_face ? "vertex-face" : "edge-edge"; }

void count(benchmark::State& run) {
  run.counters["ns/pair"] = benchmark::Counter(
      1e-9 * kPairs, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void nearest(benchmark::State& run, PairKind kind) {
  const std::vector<PairWay> pairs = ways(kind, false);
  double sum = 0.0;
  for (auto _ : run) {
    for (const PairWay& pair : pairs) {
      Part part{};
      Part other{};
      sum += kind == PairKind::vertex_face ? closest_point_triangle(pair.from, part).square
                                           : closest_edge_edge(pair.from, part, other).square;
    }
    benchmark::DoNotOptimize(sum);
  }
  count(run);
}

void plane(benchmark::State& run, PairKind kind) {
  const std::vector<PairWay> pairs = ways(kind, false);
  std::size_t apart = 0;
  for (auto _ : run) {
    for (const PairWay& pair : pairs) apart += is_kept_apart(pair, kLeast) ? 1 : 0;
    benchmark::DoNotOptimize(apart);
  }
  if (apart != static_cast<std::size_t>(run.iterations()) * kPairs)
    run.SkipWithError("pairs that nothing hits were not kept apart");
  count(run);
}

/// As a step asks: the plane first, and the share of those that it does not decide.
double share_of(const PairWay& pair) {
  const Vec3 start = shortest_line(pair);
  return is_kept_apart(pair, start, kLeast) ? 1.0 : free_share(pair, start, kLeast);
}

void travel(benchmark::State& run, PairKind kind) {
  const std::vector<PairWay> pairs = ways(kind, true);
  double sum = 0.0;
  for (auto _ : run) {
    for (const PairWay& pair : pairs) sum += share_of(pair);
    benchmark::DoNotOptimize(sum);
  }
  count(run);
  double worst = 0.0;
  for (std::size_t i = 0; i < kPairs; i += kOneInHit) {
    constexpr int kTimes = 100;  // the least of several: interruptions are not counted
    double least = 1.0;
    for (int k = 0; k < kTimes; ++k) {
      const auto begin = std::chrono::steady_clock::now();
      sum += share_of(pairs[i]);
      benchmark::DoNotOptimize(sum);
      least =
          std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    worst = std::max(worst, least);
  }
  run.counters["worst us"] = 1e6 * worst;
}

}  // namespace

void add_pair_rows() {
  for (const PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
    const std::string of(word(kind));
    benchmark::RegisterBenchmark(("pair/nearest points/" + of).c_str(), nearest, kind);
    benchmark::RegisterBenchmark(("pair/way that nothing meets/" + of).c_str(), plane, kind);
    benchmark::RegisterBenchmark(("pair/way, 5 % hit/" + of).c_str(), travel, kind);
  }
}

}  // namespace tissu::bench
