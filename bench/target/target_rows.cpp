#include "target_rows.h"

#include <benchmark/benchmark.h>

#include <memory>
#include <string>
#include <utility>

#include "../beam.h"
#include "../kernels/time_row.h"
#include "../scale/window.h"
#include "mixed_body.h"

namespace tissu::bench {
namespace {

constexpr double kMinSeconds = 0.5;
constexpr int kBefore = 5;  ///< steps from rest

struct Solver {
  const char* name;
  Preconditioning kind;
  Precision precision;
};
constexpr Solver kSolvers[] = {
    {"block_jacobi", Preconditioning::block_jacobi, Precision::full},
    {"block_jacobi single", Preconditioning::block_jacobi, Precision::single},
    {"incomplete_cholesky", Preconditioning::incomplete_cholesky, Precision::full},
    {"incomplete_cholesky single", Preconditioning::incomplete_cholesky, Precision::single},
    {"multigrid", Preconditioning::multigrid, Precision::full},
    {"multigrid single", Preconditioning::multigrid, Precision::single}};

ConjugateGradient::Settings settings(const Solver& solver) {
  ConjugateGradient::Settings s;
  s.iterations = 5'000;
  s.preconditioning = solver.kind;
  s.precision = solver.precision;
  return s;
}

WorldDescription corotational(int threads) {
  Beam beam;
  beam.cells = {64, 12, 11};
  beam.law = "hooke";
  beam.model = CorotationalOptions{};
  beam.threads = threads;
  return describe(beam);
}

using Described = WorldDescription (*)(int threads);

void add(const std::string& name, Described described, int steps) {
  for (const Solver& solver : kSolvers) {
    for (const int threads : {1, 2}) {
      const auto row = [=](benchmark::State& run) {
        Window window(std::make_shared<const World>(described(threads)), settings(solver), kBefore, steps);
        window.measure(run);
      };
      const std::string title = "target/" + name + ", " + solver.name + "/" + std::to_string(threads);
      time_row(benchmark::RegisterBenchmark(title.c_str(), row), threads, kMinSeconds);
    }
  }
}

}  // namespace

void add_target_rows() {
  add("mixed body", &mixed_body, 20);
  add("corotational 50k", &corotational, 10);
}

}  // namespace tissu::bench
