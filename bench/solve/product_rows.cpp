#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "../kernels/machine.h"
#include "../kernels/time_row.h"
#include "../scale/cube.h"
#include "solve/single_matrix.h"
#include "solve_rows.h"
#include "traffic.h"

namespace tissu::bench {
namespace {

void count(benchmark::State& run, const Cube& cube, double number, int threads) {
  using benchmark::Counter;
  const double bytes = product_bytes(cube.matrix().sparsity(), number);
  run.counters["elements"] = cube.elements();
  run.counters["rows"] = cube.matrix().rows();
  run.counters["bytes"] = bytes;
  run.counters["GB/s"] = Counter(bytes * 1e-9, Counter::kIsIterationInvariantRate);
  run.counters["of bandwidth"] =
      Counter(bytes / limits(threads).bandwidth(bytes), Counter::kIsIterationInvariantRate);
}

void product(benchmark::State& run, int size, int threads) {
  const Cube& cube = cube_of(size, threads);
  const std::vector<double>& p = cube.state().positions;
  std::vector<double> out(p.size(), 0.0);
  for (auto _ : run) {
    cube.matrix().multiply(p, out);
    benchmark::ClobberMemory();
  }
  count(run, cube, sizeof(double), threads);
}

void single_product(benchmark::State& run, int size, int threads) {
  const Cube& cube = cube_of(size, threads);
  SingleMatrix matrix;
  matrix.update(cube.matrix());
  const std::vector<float> p(cube.state().positions.begin(), cube.state().positions.end());
  std::vector<float> out(p.size(), 0.0F);
  for (auto _ : run) {
    matrix.multiply(p, out);
    benchmark::ClobberMemory();
  }
  count(run, cube, sizeof(float), threads);
}

}  // namespace

void add_product_rows(int size, int threads) {
  const std::string end = std::to_string(size) + "/" + std::to_string(threads);
  auto* row = benchmark::RegisterBenchmark(("solve/product/double/" + end).c_str(),
                                           [=](benchmark::State& run) { product(run, size, threads); });
  time_row(row, threads, kMinTime);
  row = benchmark::RegisterBenchmark(("solve/product/single/" + end).c_str(),
                                     [=](benchmark::State& run) { single_product(run, size, threads); });
  time_row(row, threads, kMinTime);
}

}  // namespace tissu::bench
