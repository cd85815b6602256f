#include <benchmark/benchmark.h>

#include <functional>
#include <string>

#include "../baseline/expanded.h"
#include "../baseline/textbook.h"
#include "kernel_rows.h"
#include "machine.h"
#include "meshes.h"
#include "tissu/assembly/block_matrix.h"

namespace tissu::bench {
namespace {

/// The same law as that of the kernels' rows, whatever its numbers.
constexpr double kYoung = 3e3;
constexpr double kPoisson = 0.45;

void repeat(benchmark::State& run, const ElementMesh& mesh, double bytes, const std::function<void()>& once) {
  for (auto _ : run) {
    once();
    benchmark::ClobberMemory();
  }
  const double elements = mesh.cell_count();
  run.counters["elements"] = elements;
  run.counters["elements/s"] = benchmark::Counter(elements, benchmark::Counter::kIsIterationInvariantRate);
  run.counters["bytes/element"] = bytes;
}

template <int kNodes>
void textbook(benchmark::State& run, const std::string& element, const std::string& job, int count) {
  const ElementMesh mesh = element_mesh(element, count);
  const ReferenceCell reference = reference_cell(element, "full");
  Textbook<kNodes> made(reference, mesh.cells, mesh.positions, lame(kYoung, kPoisson));
  const std::vector<double> x = deformed(mesh);
  std::vector<double> out(x.size(), 0.0);
  const double each = static_cast<double>(reference.points.size()) * (3.0 * kNodes + 1.0) * sizeof(double) +
                      kNodes * sizeof(std::int32_t);
  if (job == "force") repeat(run, mesh, each, [&] { made.add_force(x.data(), out.data()); });
  if (job == "product") {
    repeat(run, mesh, each, [&] { made.add_product(x.data(), 1.0, mesh.positions.data(), out.data()); });
  }
  if (job != "assembly") return;
  SparsityBuilder builder(mesh.node_count());
  builder.add_cells(mesh.cells, kNodes);
  const Sparsity pattern = builder.build();
  made.bind(pattern);
  BlockMatrix matrix(pattern, Isa::baseline, Threads(1));
  matrix.clear();
  repeat(run, mesh, each + kNodes * kNodes * sizeof(std::int32_t),
         [&] { made.add_stiffness(x.data(), -1.0, matrix.values()); });
}

void expanded(benchmark::State& run, int count) {
  const ElementMesh mesh = element_mesh("tetra", count);
  const Expanded made(mesh.cells, mesh.positions, lame(kYoung, kPoisson));
  const std::vector<double> x = deformed(mesh);
  std::vector<double> f(x.size(), 0.0);
  repeat(run, mesh, sizeof(Expanded::Constants) + 4 * sizeof(std::int32_t),
         [&] { made.add_force(x.data(), f.data()); });
}

}  // namespace

void add_baseline_rows(int count) {
  for (const std::string job : {"force", "product", "assembly"}) {
    benchmark::RegisterBenchmark(("baseline/textbook/tetra/stvk/" + job).c_str(), [=](benchmark::State& run) {
      textbook<4>(run, "tetra", job, count);
    })->MinTime(kMinTime);
    benchmark::RegisterBenchmark(("baseline/textbook/hexahedron/stvk/" + job).c_str(),
                                 [=](benchmark::State& run) { textbook<8>(run, "hexahedron", job, count); })
        ->MinTime(kMinTime);
  }
  benchmark::RegisterBenchmark("baseline/expanded/tetra/stvk/force", [=](benchmark::State& run) {
    expanded(run, count);
  })->MinTime(kMinTime);
}

}  // namespace tissu::bench
