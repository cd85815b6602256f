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

ConjugateGradient::Settings settings(Preconditioning kind) {
  ConjugateGradient::Settings s;
  s.iterations = 5'000;
  s.preconditioning = kind;
  return s;
}

WorldDescription corotational(int threads) {
  Beam beam;
  beam.cells = {64, 12, 11};
  beam.law = "hooke";
  beam.model.name = "corotational";
  beam.threads = threads;
  return describe(beam);
}

using Described = WorldDescription (*)(int threads);

void add(const std::string& name, Described described, Preconditioning kind, int steps) {
  for (const int threads : {1, 2}) {
    const auto row = [=](benchmark::State& run) {
      Window window(std::make_shared<const World>(described(threads)), settings(kind), kBefore, steps);
      window.measure(run);
    };
    const std::string title = "target/" + name + "/" + std::to_string(threads);
    time_row(benchmark::RegisterBenchmark(title.c_str(), row), threads, kMinSeconds);
  }
}

}  // namespace

void add_target_rows() {
  add("mixed body, block_jacobi", &mixed_body, Preconditioning::block_jacobi, 20);
  add("mixed body, incomplete_cholesky", &mixed_body, Preconditioning::incomplete_cholesky, 20);
  add("corotational 50k, block_jacobi", &corotational, Preconditioning::block_jacobi, 5);
  add("corotational 50k, incomplete_cholesky", &corotational, Preconditioning::incomplete_cholesky, 5);
}

}  // namespace tissu::bench
