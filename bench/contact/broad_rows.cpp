#include "broad_rows.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <string>

#include "folded_sheet.h"
#include "tissu/base/error.h"
#include "tissu/contact/broad_phase.h"

namespace tissu::bench {
namespace {

constexpr int kLayerWidth = 20;  ///< cells, so that contacts are in proportion to triangles
constexpr double kApart = 0.4;   ///< edges between layers
constexpr double kFarApart = 5.0;
constexpr int kAnewCells = 224;  ///< a side: 100,352 triangles
constexpr double kGrown = 0.3;   ///< edges that boxes are grown by
constexpr int kTimes = 4;

struct Least {
  double triangles;
  double seconds;
};

/// Of each broad phase, its time on the fewest triangles that were run.
std::map<BroadPhaseKind, Least>& least() {
  static std::map<BroadPhaseKind, Least> of;
  return of;
}

void search(benchmark::State& run, BroadPhaseKind kind, int cells) {
  const int triangles = 2 * cells * cells;
  const auto broad = make_broad_phase(kind, {{0, triangles}, {{0, 0}}});
  std::vector<std::vector<Box>> boxes;
  boxes.reserve(kTimes);
  for (int t = 0; t < kTimes; ++t) {
    boxes.push_back(folded_sheet(cells, std::max(2, cells / kLayerWidth), kApart, kGrown, 0.2 * t));
  }
  std::vector<BoxPair> pairs;
  for (const std::vector<Box>& at : boxes) broad->find(at, pairs);
  std::size_t now = kTimes - 1;
  const std::clock_t begin = std::clock();
  for (auto _ : run) {
    now = now == 0 ? 2 * kTimes - 3 : now - 1;  // there and back again
    broad->find(boxes[now < kTimes ? now : 2 * kTimes - 2 - now], pairs);
    benchmark::ClobberMemory();
  }
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC /
                         static_cast<double>(std::max<benchmark::IterationCount>(1, run.iterations()));
  const auto first = least().try_emplace(kind, Least{static_cast<double>(triangles), seconds}).first;
  if (triangles == first->second.triangles) first->second.seconds = seconds;
  run.counters["pairs/triangle"] = static_cast<double>(pairs.size()) / triangles;
  run.counters["bytes/triangle"] = static_cast<double>(broad->bytes()) / triangles;
  run.counters["ns/pair"] = 1e9 * seconds / static_cast<double>(pairs.size());
  if (triangles > first->second.triangles) {
    run.counters["growth"] =
        std::log(seconds / first->second.seconds) / std::log(triangles / first->second.triangles);
  }
}

/// With lists and trees that are made anew for each search.
void search_anew(benchmark::State& run, BroadPhaseKind kind, int cells, double apart) {
  const int triangles = 2 * cells * cells;
  const std::vector<Box> boxes = folded_sheet(cells, std::max(2, cells / kLayerWidth), apart, kGrown, 0.0);
  std::vector<BoxPair> pairs;
  for (auto _ : run) {
    make_broad_phase(kind, {{0, triangles}, {{0, 0}}})->find(boxes, pairs);
    benchmark::ClobberMemory();
  }
  run.counters["pairs/triangle"] = static_cast<double>(pairs.size()) / triangles;
}

bool is_built(BroadPhaseKind kind) {
  try {
    make_broad_phase(kind, {{0, 0}, {}});
  } catch (const ParameterError&) {
    return false;
  }
  return true;
}

}  // namespace

void add_broad_rows() {
  for (const BroadPhaseKind kind : {BroadPhaseKind::hierarchy, BroadPhaseKind::sweep_and_prune,
                                    BroadPhaseKind::grid, BroadPhaseKind::octree, BroadPhaseKind::fcl}) {
    if (!is_built(kind)) continue;
    for (const double apart : {kApart, kFarApart}) {
      const std::string name(make_broad_phase(kind, {})->name());
      const std::string how = apart == kApart ? "layers near" : "layers far apart";
      benchmark::RegisterBenchmark(("broad phase anew/" + name + "/" + how).c_str(), search_anew, kind,
                                   kAnewCells, apart)
          ->Unit(benchmark::kMillisecond);
    }
    for (const int cells : {22, 71, 224, 707}) {
      const std::string name(make_broad_phase(kind, {})->name());
      benchmark::RegisterBenchmark(("broad phase/" + name + "/" + std::to_string(2 * cells * cells)).c_str(),
                                   search, kind, cells)
          ->Unit(benchmark::kMillisecond);
    }
  }
}

}  // namespace tissu::bench
