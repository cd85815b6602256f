#include <benchmark/benchmark.h>

#include <string>

#include "kernel_rows.h"
#include "machine.h"
#include "meshes.h"
#include "tissu/law/law_info.h"
#include "tissu/model/models.h"

namespace tissu::bench {
namespace {

struct Row {
  std::string model;
  std::string element;
  std::string law;
  std::string addition = {};
};

LawParameters typical(const std::string& law) {
  LawParameters parameters;
  for (const LawParameter& p : find_law(law)->parameters) parameters[std::string(p.name)] = {p.typical};
  return parameters;
}

/// The mesh squeezed to 0.6 of its height, at which every cell is projected, or as its kernels' rows have it.
void definite(benchmark::State& run, const Row& row, StiffnessScale scale, int count) {
  const ElementMesh mesh = element_mesh(row.element, count);
  ElasticBlock block;
  block.body = row.element;
  block.element = row.element;
  block.law = row.law;
  block.parameters = typical(row.law);
  if (!row.addition.empty()) block.reinforcements = {{row.addition, typical(row.addition)}};
  block.cells = mesh.cells;
  block.density = {1000.0};
  block.model = options_named(row.model);
  if (auto* corotational = std::get_if<CorotationalOptions>(&block.model)) corotational->tangent = "exact";
  const auto model = make_model(std::move(block), mesh.positions, choose_isa(), Threads(1));
  SparsityBuilder builder(mesh.node_count());
  model->couple(builder);
  const Sparsity pattern = builder.build();
  model->bind(pattern);
  BlockMatrix matrix(pattern, choose_isa(), Threads(1));
  matrix.clear();
  State state;
  state.positions = deformed(mesh);
  for (std::size_t i = 2; i < state.positions.size(); i += 3) state.positions[i] *= 0.6;
  Scratch scratch;
  for (auto _ : run) {
    model->add_stiffness(state, scratch, scale, matrix);
    benchmark::ClobberMemory();
  }
  const double elements = mesh.cell_count();
  run.counters["elements"] = elements;
  run.counters["elements/s"] = benchmark::Counter(elements, benchmark::Counter::kIsIterationInvariantRate);
}

}  // namespace

void add_definite_rows(int count) {
  const Row rows[] = {{"fem", "tetra", "stvk"},           {"fem", "hexahedron", "stvk"},
                      {"fem", "tetra", "neo_hooke"},      {"fem", "tetra10", "neo_hooke"},
                      {"fem", "hexahedron", "neo_hooke"}, {"fem", "tetra", "stvk", "fibre"},
                      {"fem", "triangle", "stvk"},        {"mass-link", "tetra", "stvk"},
                      {"mass-tensor", "tetra", "stvk"},   {"mass-spring", "tetra", "stvk"},
                      {"corotational", "tetra", "hooke"}, {"corotational", "hexahedron", "hooke"}};
  for (const Row& row : rows) {
    for (const bool wanted : {false, true}) {
      const std::string law = row.addition.empty() ? row.law : row.law + "+" + row.addition;
      const std::string title =
          "definite/" + row.model + "/" + row.element + "/" + law + "/" + (wanted ? "definite" : "exact");
      benchmark::RegisterBenchmark(title.c_str(), [row, wanted, count](benchmark::State& run) {
        definite(run, row, {-1.0, 0.0, wanted}, count);
      })->MinTime(kMinTime);
    }
  }
}

}  // namespace tissu::bench
