#include "ablation.h"

#include <benchmark/benchmark.h>

#include <memory>
#include <string>
#include <utility>

#include "loops.h"
#include "meshes.h"
#include "tissu/base/array.h"
#include "tissu/base/isa.h"
#include "tissu/base/vec.h"
#include "tissu/law/law.h"

namespace tissu::bench {
namespace {

constexpr std::size_t kLanes = 8;

AblationKernels kernels() {
#if defined(__x86_64__)
  if (choose_isa() == Isa::avx512) return avx512::ablation_loops();
  if (choose_isa() == Isa::avx2) return avx2::ablation_loops();
#endif
  return baseline::ablation_loops();
}

/// Whole groups of the mesh, in its own order.
struct Data {
  explicit Data(int count) : mesh(element_mesh("tetra", count)), x(deformed(mesh)), f(x.size(), 0.0) {
    const std::size_t groups = mesh.cells.size() / 4 / kLanes;
    nodes.resize(groups * 4 * kLanes);
    rest.resize(groups * 10 * kLanes);
    for (std::size_t e = 0; e < groups * kLanes; ++e) {
      const std::size_t group = e / kLanes;
      const std::size_t lane = e % kLanes;
      Mat3 J;
      for (std::size_t a = 0; a < 4; ++a) {
        nodes[(group * 4 + a) * kLanes + lane] = mesh.cells[4 * e + a];
        if (a == 0) continue;
        J.col(static_cast<int>(a) - 1) = block(ConstReals(mesh.positions), mesh.cells[4 * e + a]) -
                                         block(ConstReals(mesh.positions), mesh.cells[4 * e]);
      }
      const Mat3 inverse = J.inverse();
      for (int k = 0; k < 9; ++k) {
        rest[(group * 10 + static_cast<std::size_t>(k)) * kLanes + lane] = inverse(k / 3, k % 3);
      }
      rest[(group * 10 + 9) * kLanes + lane] = J.determinant() / 6.0;
    }
    const Lame law = lame(3e3, 0.45);
    view = {nodes.data(), rest.data(), groups, law.lambda, law.mu};
  }
  ElementMesh mesh;
  std::vector<double> x;
  std::vector<double> f;
  AlignedVector<std::int32_t> nodes;
  AlignedVector<double> rest;
  AblationBlock view{};
};

}  // namespace

void add_ablation_rows(int count) {
  const auto data = std::make_shared<std::unique_ptr<Data>>();
  for (const AblationRow& row : kernels()) {
    benchmark::RegisterBenchmark((std::string("ablation/") + row.name).c_str(), [data, row, count](
                                                                                    benchmark::State& run) {
      if (*data == nullptr) *data = std::make_unique<Data>(count);
      Data& d = **data;
      double sink[8] = {};
      for (auto _ : run) {
        row.run(d.view, d.x.data(), d.f.data(), sink);
        benchmark::DoNotOptimize(sink);
        benchmark::ClobberMemory();
      }
      const auto elements = static_cast<double>(d.view.groups * kLanes);
      run.counters["elements"] = elements;
      run.counters["elements/s"] =
          benchmark::Counter(elements, benchmark::Counter::kIsIterationInvariantRate);
    })->MinTime(kMinTime);
  }
}

}  // namespace tissu::bench
