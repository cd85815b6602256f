#include "kernel_rows.h"

#include <benchmark/benchmark.h>

#include <memory>
#include <string>

#include "machine.h"
#include "meshes.h"
#include "operations.h"
#include "tissu/law/law_info.h"
#include "tissu/model/fem/elastic.h"

namespace tissu::bench {
namespace {

constexpr double kBlockBytes = 9.0 * sizeof(double);  ///< of a pair of nodes, which an assembly adds once

/// A block of one element and law with all that its jobs need. One at a time is kept: the rows of an element
/// and law follow each other.
struct Block {
  Block(const ElementInfo& element, const LawInfo& law, int count)
      : mesh(element_mesh(element.name, count)), elastic(made(element, law)) {
    state.positions = deformed(mesh);
    state.velocities.assign(state.positions.size(), 0.0);
    out.assign(state.positions.size(), 0.0);
    bytes = static_cast<double>(elastic.bytes());  // before the slots, which only the assembly reads
  }
  Elastic made(const ElementInfo& element, const LawInfo& law) const {
    ElasticBlock block;
    block.body = element.name;
    block.element = element.name;
    block.law = law.name;
    block.cells = mesh.cells;
    for (const LawParameter& p : law.parameters) block.parameters[std::string(p.name)] = {p.typical};
    block.density = {1000.0};
    return {std::move(block), mesh.positions, choose_isa(), Threads(1)};
  }
  BlockMatrix& bound_matrix() {
    if (matrix == nullptr) {
      SparsityBuilder builder(mesh.node_count());
      elastic.couple(builder);
      pattern = builder.build();
      elastic.bind(pattern);
      matrix = std::make_unique<BlockMatrix>(pattern, choose_isa(), Threads(1));
      matrix->clear();
    }
    return *matrix;
  }
  ElementMesh mesh;
  Elastic elastic;
  State state;
  std::vector<double> out;
  double bytes = 0.0;
  Sparsity pattern;
  std::unique_ptr<BlockMatrix> matrix;
};

struct Row {
  const ElementInfo* element;
  const LawInfo* law;
  Job job;
  int count;
};

Block& block_of(const Row& row) {
  static std::unique_ptr<Block> kept;
  static const ElementInfo* element = nullptr;
  static const LawInfo* law = nullptr;
  if (element != row.element || law != row.law) {
    kept.reset();
    kept = std::make_unique<Block>(*row.element, *row.law, row.count);
    element = row.element;
    law = row.law;
  }
  return *kept;
}

/// Rates, and the shares of the machine's limits that they reach.
void count(benchmark::State& run, const Row& row, const Block& block) {
  using benchmark::Counter;
  const double elements = block.mesh.cell_count();
  const double bytes = row.job == Job::assembly ? static_cast<double>(block.elastic.bytes()) : block.bytes;
  constexpr auto kRate = Counter::kIsIterationInvariantRate;
  run.counters["elements"] = elements;
  run.counters["elements/s"] = Counter(elements, kRate);
  run.counters["bytes/element"] = bytes / elements;
  run.counters["of bandwidth"] = Counter(bytes / limits().bandwidth(bytes), kRate);
  const auto nodes = static_cast<double>(row.element->nodes);
  run.counters["nodes/element"] = nodes;
  if (row.job == Job::assembly) {
    const double written = elements * kBlockBytes * 0.5 * nodes * (nodes + 1.0);
    run.counters["of writing"] = Counter(written / limits().bandwidth(written), kRate);
  }
  const auto law = law_operations(row.law->name, row.element->dimension);
  if (!law) return;
  const double each =
      operations(reference_cell(row.element->name, "full"), row.element->affine, *law, row.job);
  run.counters["flop/element"] = each;
  run.counters["GFLOP/s"] = Counter(each * elements * 1e-9, kRate);
  run.counters["of peak"] = Counter(each * elements / limits().flops, kRate);
}

void kernel(benchmark::State& run, const Row& row) {
  Scratch scratch;
  Block& block = block_of(row);
  switch (row.job) {
    case Job::force:
      for (auto _ : run) {
        block.elastic.add_force(block.state, scratch, block.out);
        benchmark::ClobberMemory();
      }
      break;
    case Job::product:
      for (auto _ : run) {
        block.elastic.add_product(block.state, scratch, {1.0, 0.0}, block.mesh.positions, block.out);
        benchmark::ClobberMemory();
      }
      break;
    case Job::assembly: {
      BlockMatrix& matrix = block.bound_matrix();
      for (auto _ : run) {
        block.elastic.add_stiffness(block.state, scratch, {-1.0, 0.0}, matrix);
        benchmark::ClobberMemory();
      }
      break;
    }
  }
  count(run, row, block);
}

}  // namespace

void add_kernel_rows(int count) {
  for (const ElementInfo& element : elements()) {
    if (find_shape_kernels(choose_isa(), element.nodes, element.dimension) == nullptr) continue;
    for (const LawInfo& law : all_laws()) {
      if (find_law_kernels(choose_isa(), law.name, element.dimension) == nullptr) continue;
      for (const Job job : kJobs) {
        const Row row{&element, &law, job, count};
        const std::string title = "kernel/" + std::string(element.name) + "/" + std::string(law.name) + "/" +
                                  std::string(name(job));
        benchmark::RegisterBenchmark(title.c_str(), [row](benchmark::State& run) {
          kernel(run, row);
        })->MinTime(kMinTime);
      }
    }
  }
}

}  // namespace tissu::bench
