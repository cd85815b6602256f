#include "scale_rows.h"

#include <benchmark/benchmark.h>

#include <functional>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "../kernels/machine.h"
#include "../kernels/time_row.h"
#include "cube.h"
#include "window.h"

namespace tissu::bench {
namespace {

/// Grids of 6, 12, 26 and 55 cells along an edge.
constexpr int kSizes[] = {1'000, 10'000, 100'000, 1'000'000};
/// A row on two threads is measured in short pieces [s]: some of them are left alone by the machine's other
/// work.
constexpr double kShort = 0.005;
constexpr int kBefore = 2;  ///< steps from rest, after which the cube moves
constexpr int kSteps = 3;
constexpr int kMoreSteps = 4;  ///< of a solver that keeps what it made for several; later ones are Newton's

struct Solver {
  const char* name;
  ConjugateGradient::Settings settings;
  int steps = kSteps;
};

ConjugateGradient::Settings settings(Preconditioning kind, Precision precision) {
  ConjugateGradient::Settings s;
  s.iterations = 20'000;
  s.preconditioning = kind;
  s.precision = precision;
  return s;
}

const std::vector<Solver>& solvers() {
  static const std::vector<Solver> all = {
      {"block_jacobi", settings(Preconditioning::block_jacobi, Precision::full)},
      {"block_jacobi single", settings(Preconditioning::block_jacobi, Precision::single)},
      {"incomplete_cholesky", settings(Preconditioning::incomplete_cholesky, Precision::full)},
      {"incomplete_cholesky single", settings(Preconditioning::incomplete_cholesky, Precision::single)},
      {"multigrid", settings(Preconditioning::multigrid, Precision::full), kMoreSteps},
      {"multigrid single", settings(Preconditioning::multigrid, Precision::single), kMoreSteps}};
  return all;
}

void count(benchmark::State& run, const Cube& cube, double bytes) {
  using benchmark::Counter;
  run.counters["elements"] = cube.elements();
  run.counters["ns/element"] =
      Counter(cube.elements() * 1e-9, Counter::kIsIterationInvariantRate | Counter::kInvert);
  run.counters["bytes/element"] = bytes / cube.elements();
}

void force(benchmark::State& run, Cube& cube) {
  Scratch scratch;
  std::vector<double> f(cube.state().positions.size(), 0.0);
  for (auto _ : run) {
    cube.model().add_force(cube.state(), scratch, f);
    benchmark::ClobberMemory();
  }
  count(run, cube, static_cast<double>(cube.model().bytes()));
}

void tangent_product(benchmark::State& run, Cube& cube) {
  Scratch scratch;
  std::vector<double> out(cube.state().positions.size(), 0.0);
  for (auto _ : run) {
    cube.model().add_product(cube.state(), scratch, {1.0, 0.0}, cube.state().positions, out);
    benchmark::ClobberMemory();
  }
  count(run, cube, static_cast<double>(cube.model().bytes()));
}

void assembly(benchmark::State& run, Cube& cube) {
  for (auto _ : run) {
    cube.assemble();
    benchmark::ClobberMemory();
  }
  count(run, cube, static_cast<double>(cube.model().bytes() + cube.matrix().bytes()));
}

void matrix_product(benchmark::State& run, Cube& cube) {
  std::vector<double> out(cube.state().positions.size(), 0.0);
  for (auto _ : run) {
    cube.matrix().multiply(cube.state().positions, out);
    benchmark::ClobberMemory();
  }
  count(run, cube, static_cast<double>(cube.matrix().bytes()));
}

/// The repetitions of a row share its simulation.
void step(benchmark::State& run, const Solver& solver, int size, int threads) {
  static std::unique_ptr<Window> kept;
  static std::tuple<std::string, int, int> key;
  const std::tuple<std::string, int, int> wanted{solver.name, size, threads};
  if (kept == nullptr || key != wanted) {
    kept.reset();
    kept = std::make_unique<Window>(cube_of(size, threads).world(), solver.settings, kBefore, solver.steps);
    key = wanted;
  }
  kept->measure(run);
  const Cube& cube = cube_of(size, threads);
  run.counters["resident bytes/element"] = (cube.resident() + kept->resident()) / cube.elements();
}

void add(const std::string& what, int size, int threads,
         const std::function<void(benchmark::State&)>& function) {
  const std::string title = "scale/" + what + "/" + std::to_string(size) + "/" + std::to_string(threads);
  time_row(benchmark::RegisterBenchmark(title.c_str(), function), threads, threads == 1 ? kMinTime : kShort);
}

}  // namespace

void add_scale_rows() {
  using Part = void (*)(benchmark::State&, Cube&);
  const std::pair<const char*, Part> parts[] = {{"force", &force},
                                                {"tangent product", &tangent_product},
                                                {"assembly", &assembly},
                                                {"matrix product", &matrix_product}};
  for (const int size : kSizes) {
    for (const int threads : {1, 2}) {
      for (const auto& [name, part] : parts) {
        add(name, size, threads,
            [=, part = part](benchmark::State& run) { part(run, cube_of(size, threads)); });
      }
      for (const Solver& solver : solvers()) {
        add("step, " + std::string(solver.name), size, threads,
            [=](benchmark::State& run) { step(run, solver, size, threads); });
      }
    }
  }
}

}  // namespace tissu::bench
