#include "ablation.h"

#include <benchmark/benchmark.h>

#include <memory>
#include <string>
#include <utility>

#include "base/kernel_choice.h"
#include "loops.h"
#include "meshes.h"
#include "tissu/base/array.h"
#include "tissu/base/isa.h"
#include "tissu/base/vec.h"
#include "tissu/cell/element_order.h"
#include "tissu/law/law.h"

namespace tissu::bench {
namespace {

constexpr std::size_t kLanes = 8;

AblationKernels kernels() { return TISSU_KERNELS_OF(choose_isa(), ablation_loops()); }

struct Data {
  explicit Data(int count)
      : mesh(element_mesh("tetra", count)),
        x(deformed(mesh)),
        f(x.size(), 0.0),
        order(order_elements(mesh.cells, 4, mesh.positions)) {
    rest.resize(order.element.size() * 10);
    for (std::size_t i = 0; i < order.element.size(); ++i) {
      const std::int32_t* cell = mesh.cells.data() + 4 * static_cast<std::size_t>(order.element[i]);
      Mat3 J;
      for (int a = 1; a < 4; ++a) {
        J.col(a - 1) =
            block(ConstReals(mesh.positions), cell[a]) - block(ConstReals(mesh.positions), cell[0]);
      }
      const Mat3 inverse = J.inverse();
      double* to = rest.data() + i / kLanes * 10 * kLanes + i % kLanes;
      for (std::size_t k = 0; k < 9; ++k)
        to[k * kLanes] = inverse(static_cast<int>(k / 3), static_cast<int>(k % 3));
      to[9 * kLanes] = order.real[i] != 0 ? J.determinant() / 6.0 : 0.0;
    }
    const Lame law = lame(3e3, 0.45);
    view = {order.places.data(),
            order.chunks.data(),
            order.chunks.size(),
            rest.data(),
            static_cast<std::size_t>(order.groups()),
            law.lambda,
            law.mu};
  }
  ElementMesh mesh;
  std::vector<double> x;
  std::vector<double> f;
  ElementOrder order;
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
