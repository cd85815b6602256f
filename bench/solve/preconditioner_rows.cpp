#include <benchmark/benchmark.h>

#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "../kernels/machine.h"
#include "../kernels/time_row.h"
#include "../scale/cube.h"
#include "solve/make_preconditioner.h"
#include "solve/single_matrix.h"
#include "solve_rows.h"
#include "traffic.h"

namespace tissu::bench {
namespace {

struct Row {
  const char* name;
  Preconditioning kind;
  int most;  ///< tetrahedra
};
constexpr Row kRows[] = {{"jacobi", Preconditioning::jacobi, 1'000'000},
                         {"block_jacobi", Preconditioning::block_jacobi, 1'000'000},
                         {"incomplete_cholesky", Preconditioning::incomplete_cholesky, 1'000'000},
                         {"multigrid", Preconditioning::multigrid, 1'000'000},
                         {"stale_cholesky", Preconditioning::stale_cholesky, 20'000}};

/// What single precision multiplies the matrix with.
template <class T>
double scale_of(const BlockMatrix& matrix) {
  if constexpr (std::is_same_v<T, double>) return 1.0;
  SingleMatrix single;
  single.update(matrix);
  return single.scale();
}

void count(benchmark::State& run, const Cube& cube, double kept) {
  run.counters["elements"] = cube.elements();
  run.counters["rows"] = cube.matrix().rows();
  run.counters["bytes"] = kept;
}

template <class T>
void set_up(benchmark::State& run, const Row& row, int size, int threads) {
  const Cube& cube = cube_of(size, threads);
  const auto M = make_preconditioner<T>(row.kind);
  const double scale = scale_of<T>(cube.matrix());
  M->make(cube.matrix(), scale);
  for (auto _ : run) {
    M->make(cube.matrix(), scale);
    benchmark::ClobberMemory();
  }
  count(run, cube, static_cast<double>(M->bytes()));
}

/// As an iteration does it: what is local in pieces of rows, on all threads.
template <class T>
void apply(Preconditioner<T>& M, const Threads& threads, std::span<const T> r, std::span<T> z) {
  if (!M.is_local()) return M.apply(r, z);
  threads.for_pieces(static_cast<std::int32_t>(r.size() / 3), [&](std::int32_t begin, std::int32_t end) {
    M.apply_rows(begin, end, r.data(), z.data());
  });
}

template <class T>
void application(benchmark::State& run, const Row& row, int size, int threads) {
  using benchmark::Counter;
  const Cube& cube = cube_of(size, threads);
  const auto M = make_preconditioner<T>(row.kind);
  M->make(cube.matrix(), scale_of<T>(cube.matrix()));
  const std::vector<T> r(cube.state().positions.begin(), cube.state().positions.end());
  std::vector<T> z(r.size());
  for (auto _ : run) {
    apply<T>(*M, cube.matrix().threads(), r, z);
    benchmark::ClobberMemory();
  }
  count(run, cube, static_cast<double>(M->bytes()));
  if (!is_counted(row.kind)) return;
  const double bytes = apply_bytes(row.kind, cube.matrix().sparsity(), sizeof(T));
  run.counters["GB/s"] = Counter(bytes * 1e-9, Counter::kIsIterationInvariantRate);
  run.counters["of bandwidth"] =
      Counter(bytes / limits(threads).bandwidth(bytes), Counter::kIsIterationInvariantRate);
}

template <class T>
void add_rows(const Row& row, int size, int threads) {
  const std::string end = std::string(std::is_same_v<T, double> ? "/double/" : "/single/") +
                          std::to_string(size) + "/" + std::to_string(threads);
  const std::string name = "solve/" + std::string(row.name);
  auto* made = benchmark::RegisterBenchmark(
      (name + " set-up" + end).c_str(), [=](benchmark::State& run) { set_up<T>(run, row, size, threads); });
  time_row(made, threads, kMinTime);
  auto* applied =
      benchmark::RegisterBenchmark((name + " application" + end).c_str(),
                                   [=](benchmark::State& run) { application<T>(run, row, size, threads); });
  time_row(applied, threads, kMinTime);
}

}  // namespace

void add_preconditioner_rows(int size, int threads) {
  for (const Row& row : kRows) {
    if (size > row.most) continue;
    add_rows<double>(row, size, threads);
    add_rows<float>(row, size, threads);
  }
}

}  // namespace tissu::bench
