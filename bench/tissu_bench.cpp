/// tissu-bench: what the parts of a step cost on the published beam (beam.h), and whole steps of it; the
/// machine's limits, the kernels of every element and law, what bounds them, and two baselines; products and
/// preconditioners (solve/…), sizes from a thousand to a million elements (scale/…), what was set as a target
/// (target/…), the search for near triangles, and pairs of them (contact/…).
///   tissu-bench --benchmark_filter=step --benchmark_format=json
///   tissu-bench --benchmark_filter=kernel/tetra

#include <benchmark/benchmark.h>

#include "beam.h"
#include "contact/broad_rows.h"
#include "contact/pair_rows.h"
#include "kernels/ablation.h"
#include "kernels/kernel_rows.h"
#include "kernels/machine.h"
#include "kernels/rotation_rows.h"
#include "scale/scale_rows.h"
#include "solve/solve_rows.h"
#include "target/target_rows.h"
#include "tissu/base/build.h"
#include "tissu/simulation/simulation.h"
#include "tissu/solve/cholesky.h"
#include "tissu/solve/conjugate_gradient.h"
#include "tissu/step/implicit_euler.h"

namespace tissu::bench {
namespace {

/// The beam, a little bent, so that no number is trivially zero.
struct Bent {
  explicit Bent(const Beam& beam) : world(describe(beam)), state(world.rest_state()) {
    for (std::int32_t i = 0; i < world.blocks(); ++i) {
      auto x = block(Reals(state.positions), i);
      x.y() -= 0.001 * x.x() * x.x();
    }
  }
  World world;
  State state;
};

Beam beam_of(const benchmark::State& run) {
  Beam beam;
  beam.threads = static_cast<int>(run.range(0));
  return beam;
}

void count_elements(benchmark::State& run, const World& world) {
  double elements = 0.0;
  for (const Body& body : world.bodies()) {
    for (const BodyModel* elastic : body.models) elements += elastic->cell_count();
  }
  run.counters["elements"] = elements;
  run.counters["ns/element"] = benchmark::Counter(
      elements * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void force(benchmark::State& run) {
  Scratch scratch;
  Beam beam = beam_of(run);
  const Bent bent(beam);
  const BodyModel& elastic = *bent.world.bodies().front().models.front();
  std::vector<double> f(bent.state.positions.size(), 0.0);
  for (auto _ : run) {
    elastic.add_force(bent.state, scratch, f);
    benchmark::ClobberMemory();
  }
  count_elements(run, bent.world);
}

void product_of_elements(benchmark::State& run) {
  Scratch scratch;
  const Bent bent(beam_of(run));
  const BodyModel& elastic = *bent.world.bodies().front().models.front();
  std::vector<double> out(bent.state.positions.size(), 0.0);
  for (auto _ : run) {
    elastic.add_product(bent.state, scratch, {1.0, 0.0}, bent.state.positions, out);
    benchmark::ClobberMemory();
  }
  count_elements(run, bent.world);
}

void assembly(benchmark::State& run) {
  Scratch scratch;
  const Bent bent(beam_of(run));
  const BodyModel& elastic = *bent.world.bodies().front().models.front();
  BlockMatrix matrix(bent.world.sparsity(), bent.world.isa(), bent.world.threads());
  for (auto _ : run) {
    matrix.clear();
    elastic.add_stiffness(bent.state, scratch, {-1.0, 0.0}, matrix);
    benchmark::ClobberMemory();
  }
  count_elements(run, bent.world);
}

void product(benchmark::State& run) {
  Scratch scratch;
  const Bent bent(beam_of(run));
  BlockMatrix matrix(bent.world.sparsity(), bent.world.isa(), bent.world.threads());
  bent.world.bodies().front().models.front()->add_stiffness(bent.state, scratch, {-1.0, 0.0}, matrix);
  std::vector<double> out(bent.state.positions.size(), 0.0);
  for (auto _ : run) {
    matrix.multiply(bent.state.positions, out);
    benchmark::ClobberMemory();
  }
  run.counters["GB/s"] = benchmark::Counter(static_cast<double>(matrix.bytes()) * 1e-9,
                                            benchmark::Counter::kIsIterationInvariantRate);
}

/// 20 iterations of conjugate gradient whatever the residual, as the published figure has it; then the rest
/// of the fall is simulated, so the steps are those of a moving beam.
void step(benchmark::State& run) {
  const auto world = std::make_shared<const World>(describe(beam_of(run)));
  constexpr double kNever = 1e-300;
  Simulation simulation(world, std::make_unique<ImplicitEuler>(),
                        std::make_unique<ConjugateGradient>(ConjugateGradient::Settings{kNever, 20}));
  StepReport report;
  for (int i = 0; i < 20; ++i) report = simulation.step(0.01);
  for (auto _ : run) report = simulation.step(0.01);
  run.counters["steps/s"] = benchmark::Counter(1.0, benchmark::Counter::kIsIterationInvariantRate);
  run.counters["residual"] = report.residual;
}

/// The corotational model on a beam of 50,688 tetrahedra, 20 iterations as above.
void step_corotational(benchmark::State& run) {
  Beam beam = beam_of(run);
  beam.cells = {64, 12, 11};
  beam.law = "hooke";
  beam.model = CorotationalOptions{};
  const auto world = std::make_shared<const World>(describe(beam));
  Simulation simulation(world, std::make_unique<ImplicitEuler>(),
                        std::make_unique<ConjugateGradient>(ConjugateGradient::Settings{1e-300, 20}));
  StepReport report;
  for (int i = 0; i < 20; ++i) report = simulation.step(0.01);
  for (auto _ : run) report = simulation.step(0.01);
  run.counters["steps/s"] = benchmark::Counter(1.0, benchmark::Counter::kIsIterationInvariantRate);
  run.counters["residual"] = report.residual;
}

void step_cholesky(benchmark::State& run) {
  const auto world = std::make_shared<const World>(describe(beam_of(run)));
  Simulation simulation(world, std::make_unique<ImplicitEuler>(), std::make_unique<Cholesky>());
  for (int i = 0; i < 2; ++i) simulation.step(0.01);
  for (auto _ : run) simulation.step(0.01);
  run.counters["steps/s"] = benchmark::Counter(1.0, benchmark::Counter::kIsIterationInvariantRate);
}

BENCHMARK(force)->Name("StVK force")->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMicrosecond);
BENCHMARK(product_of_elements)
    ->Name("StVK product, no matrix")
    ->Arg(1)
    ->Arg(2)
    ->UseRealTime()
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(assembly)->Name("StVK assembly")->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMicrosecond);
BENCHMARK(product)->Name("matrix product")->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMicrosecond);
BENCHMARK(step)->Name("step, 20 CG")->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(step_corotational)
    ->Name("corotational step, 20 CG")
    ->Arg(1)
    ->Arg(2)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(step_cholesky)->Name("step, Cholesky")->Arg(1)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tissu::bench

int main(int argc, char** argv) {
  benchmark::AddCustomContext("instruction set", std::string(tissu::name(tissu::choose_isa())));
  benchmark::AddCustomContext("compiler", tissu::build_info().compiler);
  benchmark::AddCustomContext("argument", "threads");
  constexpr int kElements = 20'000;
  tissu::bench::add_limit_rows();
  tissu::bench::add_kernel_rows(kElements);
  tissu::bench::add_corotational_rows(kElements);
  tissu::bench::add_definite_rows(kElements);
  tissu::bench::add_ablation_rows(kElements);
  tissu::bench::add_rotation_rows(kElements);
  tissu::bench::add_baseline_rows(kElements);
  tissu::bench::add_solve_rows();
  tissu::bench::add_scale_rows();
  tissu::bench::add_target_rows();
  tissu::bench::add_broad_rows();
  tissu::bench::add_pair_rows();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
