/// tissu-bench-models: linear tetrahedra of St-Venant–Kirchhoff in three forms, the continuum element,
/// mass-link and mass-tensor, on meshes of 1e3 to 1e6 of them. Rows "model/MODEL/JOB/COUNT/THREADS", and what
/// it costs to take a cell out of a mass-tensor, "edit/WAY/COUNT". bench/models.py runs it and writes
/// docs/measured/models-cost.md.

#include <benchmark/benchmark.h>

#include <memory>
#include <string>
#include <tuple>

#include "../baseline/expanded.h"
#include "../kernels/machine.h"
#include "../kernels/meshes.h"
#include "tissu/assembly/block_matrix.h"
#include "tissu/base/build.h"
#include "tissu/model/edges/mass_tensor.h"
#include "tissu/model/models.h"

namespace tissu::bench {
namespace {

/// A row on two threads is measured in short pieces [s]: some of them are left alone by the machine's other
/// work.
constexpr double kShort = 0.005;

/// Of soft tissue; every model has the same.
constexpr double kYoung = 3e3;
constexpr double kPoisson = 0.45;

const char* const kJobs[] = {"force", "product", "assembly"};
const char* const kModels[] = {"fem", "mass-link", "mass-tensor"};
constexpr int kCounts[] = {1'000, 10'000, 100'000, 1'000'000};

struct Made {
  Made(const std::string& name, int count, int threads)
      : mesh(element_mesh("tetra", count)), workers(threads), model(make(name)) {
    state.positions = deformed(mesh);
    state.velocities.assign(state.positions.size(), 0.0);
    out.assign(state.positions.size(), 0.0);
    bytes = static_cast<double>(model->bytes());
    SparsityBuilder builder(mesh.node_count());
    model->couple(builder);
    pattern = builder.build();
    model->bind(pattern);
    matrix = std::make_unique<BlockMatrix>(pattern, choose_isa(), workers);
    matrix->clear();
  }
  [[nodiscard]] std::unique_ptr<BodyModel> make(const std::string& name) const {
    ElasticBlock block;
    block.body = "bench";
    block.model = options_named(name);
    block.cells = mesh.cells;
    block.parameters = {{"young", {kYoung}}, {"poisson", {kPoisson}}};
    block.density = {1000.0};
    return make_model(std::move(block), mesh.positions, choose_isa(), workers);
  }
  ElementMesh mesh;
  Threads workers;
  std::unique_ptr<BodyModel> model;
  State state;
  std::vector<double> out;
  double bytes = 0.0;  ///< held by the model, but for places in the matrix
  Sparsity pattern;
  std::unique_ptr<BlockMatrix> matrix;
};

/// The model of a row; it is kept until a row asks for another.
Made& made_of(const std::string& name, int count, int threads) {
  static std::unique_ptr<Made> kept;
  static std::tuple<std::string, int, int> key;
  if (key != std::tuple(name, count, threads)) {
    kept.reset();
    kept = std::make_unique<Made>(name, count, threads);
    key = {name, count, threads};
  }
  return *kept;
}

void model_row(benchmark::State& run, const std::string& name, const std::string& job, int count,
               int threads) {
  Scratch scratch;
  Made& made = made_of(name, count, threads);
  for (auto _ : run) {
    if (job == "force") made.model->add_force(made.state, scratch, made.out);
    if (job == "product")
      made.model->add_product(made.state, scratch, {1.0, 0.0}, made.mesh.positions, made.out);
    if (job == "assembly") made.model->add_stiffness(made.state, scratch, {-1.0, 0.0}, *made.matrix);
    benchmark::ClobberMemory();
  }
  const double cells = made.mesh.cell_count();
  run.counters["elements"] = cells;
  run.counters["bytes/element"] =
      (job == "assembly" ? static_cast<double>(made.model->bytes()) : made.bytes) / cells;
  run.counters["published reals"] = static_cast<double>(made.model->reals_per_cell());
  const auto* tensor = dynamic_cast<const MassTensor*>(made.model.get());
  run.counters["reals/element"] = tensor != nullptr ? static_cast<double>(tensor->constants()) / cells
                                                    : static_cast<double>(made.model->reals_per_cell());
}

/// Picinbono's constants on every tetrahedron for itself, one element after another: the form that counts
/// 280.
void expanded_row(benchmark::State& run, int count) {
  const ElementMesh mesh = element_mesh("tetra", count);
  const Expanded expanded(mesh.cells, mesh.positions, lame(kYoung, kPoisson));
  const std::vector<double> x = deformed(mesh);
  std::vector<double> f(x.size(), 0.0);
  for (auto _ : run) {
    expanded.add_force(x.data(), f.data());
    benchmark::ClobberMemory();
  }
  run.counters["elements"] = mesh.cell_count();
  run.counters["bytes/element"] = sizeof(Expanded::Constants) + 4 * sizeof(std::int32_t);
  constexpr std::size_t kReals = sizeof(Expanded::Constants) / sizeof(double);
  run.counters["reals/element"] = static_cast<double>(kReals);
}

/// One cell goes: the constants of the others are taken over, or all are summed up.
void edit_row(benchmark::State& run, bool anew, int count) {
  const Made& made = made_of("mass-tensor", count, 1);
  const std::vector<std::int32_t> removed = {made.mesh.cell_count() / 2};
  std::vector<std::size_t> kept;
  for (std::int32_t e = 0; e < made.mesh.cell_count(); ++e) {
    if (e != removed[0]) kept.push_back(static_cast<std::size_t>(e));
  }
  const ElasticBlock left = part_of(made.model->block(), kept);
  std::unique_ptr<BodyModel> edited;
  for (auto _ : run) {
    edited = anew ? make_model(left, made.mesh.positions, choose_isa(), Threads(1))
                  : made.model->without(left, removed);
  }
  const auto& tensor = dynamic_cast<const MassTensor&>(*edited);
  run.counters["constants"] = static_cast<double>(tensor.constants());
  run.counters["computed"] = static_cast<double>(tensor.computed_constants());
}

void add_rows() {
  for (const int count : kCounts) {
    for (const std::string model : kModels) {
      for (const int threads : {1, 2}) {
        for (const std::string job : kJobs) {
          const std::string title =
              "model/" + model + "/" + job + "/" + std::to_string(count) + "/" + std::to_string(threads);
          benchmark::RegisterBenchmark(
              title.c_str(), [=](benchmark::State& run) { model_row(run, model, job, count, threads); })
              ->MinTime(threads == 1 ? kMinTime : kShort)
              ->UseRealTime();
        }
      }
    }
    if (count > 100'000) continue;  // 2.3 GB and more while they are made
    benchmark::RegisterBenchmark(("model/expanded/force/" + std::to_string(count) + "/1").c_str(),
                                 [=](benchmark::State& run) { expanded_row(run, count); })
        ->MinTime(kMinTime)
        ->UseRealTime();
    for (const bool anew : {false, true}) {
      benchmark::RegisterBenchmark(
          ("edit/" + std::string(anew ? "anew" : "edited") + "/" + std::to_string(count)).c_str(),
          [=](benchmark::State& run) { edit_row(run, anew, count); })
          ->MinTime(kMinTime)
          ->UseRealTime();
    }
  }
}

}  // namespace
}  // namespace tissu::bench

int main(int argc, char** argv) {
  benchmark::AddCustomContext("instruction set", std::string(tissu::name(tissu::choose_isa())));
  benchmark::AddCustomContext("compiler", tissu::build_info().compiler);
  tissu::bench::add_limit_rows();
  tissu::bench::add_rows();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
