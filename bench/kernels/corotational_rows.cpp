#include <benchmark/benchmark.h>

#include <memory>
#include <string>

#include "kernel_rows.h"
#include "machine.h"
#include "meshes.h"
#include "tissu/model/corotational/corotational.h"

namespace tissu::bench {
namespace {

enum class Work { force, product, assembly };
constexpr const char* kWork[] = {"force", "product", "assembly"};

struct Row {
  std::string element;
  CorotationalOptions model;
  Work work;
};

void corotational(benchmark::State& run, const Row& row, int count) {
  const ElementMesh mesh = element_mesh(row.element, count);
  ElasticBlock block;
  block.body = row.element;
  block.element = row.element;
  block.law = "hooke";
  block.cells = mesh.cells;
  block.parameters = {{"young", {3e3}}, {"poisson", {0.45}}};
  block.density = {1000.0};
  block.model = row.model;
  Corotational model(std::move(block), mesh.positions, choose_isa(), Threads(1));
  SparsityBuilder builder(mesh.node_count());
  model.couple(builder);
  const Sparsity pattern = builder.build();
  model.bind(pattern);
  BlockMatrix matrix(pattern, choose_isa(), Threads(1));
  matrix.clear();
  State state;
  state.positions = deformed(mesh);
  std::vector<double> out(state.positions.size(), 0.0);
  Scratch scratch;
  for (auto _ : run) {
    if (row.work == Work::force) model.add_force(state, scratch, out);
    if (row.work == Work::product) model.add_product(state, scratch, {1.0, 0.0}, mesh.positions, out);
    if (row.work == Work::assembly) model.add_stiffness(state, scratch, {-1.0, 0.0}, matrix);
    benchmark::ClobberMemory();
  }
  const double elements = mesh.cell_count();
  run.counters["elements"] = elements;
  run.counters["elements/s"] = benchmark::Counter(elements, benchmark::Counter::kIsIterationInvariantRate);
  run.counters["bytes/element"] = static_cast<double>(model.bytes()) / elements;
}

}  // namespace

void add_corotational_rows(int count) {
  for (const char* element : {"tetra", "hexahedron", "wedge", "pyramid"}) {
    for (const char* rotation : {"frame", "polar"}) {
      for (const char* tangent : {"approximate", "exact"}) {
        for (const Work work : {Work::force, Work::product, Work::assembly}) {
          const Row row{element, {.rotation = rotation, .tangent = tangent}, work};
          const std::string title = std::string("corotational/") + element + "/" + rotation + "/" + tangent +
                                    "/" + kWork[static_cast<int>(work)];
          benchmark::RegisterBenchmark(title.c_str(), [row, count](benchmark::State& run) {
            corotational(run, row, count);
          })->MinTime(kMinTime);
        }
      }
    }
  }
}

}  // namespace tissu::bench
