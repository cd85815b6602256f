#include "window.h"

#include <algorithm>
#include <ctime>
#include <string_view>
#include <utility>

#include "../kernels/machine.h"
#include "../solve/traffic.h"
#include "cube.h"
#include "resident.h"
#include "tissu/step/implicit_euler.h"

namespace tissu::bench {
namespace {

double elements_of(const World& world) {
  double elements = 0.0;
  for (const Body& body : world.bodies()) {
    for (const BodyModel* model : body.models) elements += model->cell_count();
  }
  return elements;
}

/// Of the stages with this name, in seconds.
double seconds_in(const Profile& profile, std::string_view stage) {
  double seconds = 0.0;
  for (const Profile::Row& row : profile.rows()) {
    if (row.stage == stage) seconds += row.seconds;
  }
  return seconds;
}

}  // namespace

Window::Window(std::shared_ptr<const World> world, const ConjugateGradient::Settings& solver, int before,
               int steps)
    : solver_(solver),
      steps_(steps),
      resident_(-resident_bytes()),
      simulation_(std::move(world), std::make_unique<ImplicitEuler>(),
                  std::make_unique<ConjugateGradient>(solver)) {
  for (int i = 0; i < before; ++i) simulation_.step(kStepSeconds);
  resident_ += resident_bytes();
  start_ = simulation_.snapshot();
}

void Window::measure(benchmark::State& run) {
  simulation_.profile().clear();
  StepReport last;
  std::clock_t used = 0;
  for (auto _ : run) {
    run.PauseTiming();
    simulation_.restore(start_);
    used -= std::clock();
    run.ResumeTiming();
    for (int i = 0; i < steps_; ++i) last = simulation_.step(kStepSeconds);
    used += std::clock();
  }
  processor_seconds_ = static_cast<double>(used) / CLOCKS_PER_SEC;
  run.counters["residual"] = last.residual;
  count_time(run);
  count_memory(run);
}

void Window::count_time(benchmark::State& run) {
  using benchmark::Counter;
  const World& world = simulation_.world();
  const Profile& profile = simulation_.profile();
  const double elements = elements_of(world);
  const auto steps = static_cast<double>(profile.steps());
  const auto iterations = static_cast<double>(profile.solves().iterations);
  constexpr auto kRate = Counter::kIsIterationInvariantRate;
  run.counters["elements"] = elements;
  run.counters["nodes"] = world.blocks();
  run.counters["steps"] = steps_;
  run.counters["steps/s"] = Counter(steps_, kRate);
  run.counters["ns/element"] = Counter(elements * steps_ * 1e-9, kRate | Counter::kInvert);
  run.counters["CG iterations"] = iterations / steps;
  run.counters["failed"] = static_cast<double>(profile.solves().failures);

  double seconds = 0.0;
  for (const double step : profile.step_seconds()) seconds += step;
  const double kept = std::min(steps, static_cast<double>(Profile::kKept));
  const double whole = seconds / kept * steps;
  const double solve = seconds_in(profile, "solve");
  run.counters["force share"] = seconds_in(profile, "force") / whole;
  run.counters["matrix share"] = seconds_in(profile, "matrix") / whole;
  run.counters["preconditioner share"] = seconds_in(profile, "preconditioner") / whole;
  run.counters["solve share"] = solve / whole;
  if (!is_counted(solver_.preconditioning)) return;
  // One thread that others keep waiting is judged by the time that it had.
  const int threads = world.threads().count();
  const double had = threads == 1 ? std::min(1.0, processor_seconds_ / whole) : 1.0;
  const double bytes = iteration_bytes(solver_, world.sparsity());
  run.counters["solve of bandwidth"] = iterations * bytes / (solve * had) / limits(threads).bandwidth(bytes);
}

void Window::count_memory(benchmark::State& run) const {
  const World& world = simulation_.world();
  double bytes = static_cast<double>(simulation_.solver()->bytes()) + matrix_bytes(world.sparsity(), 8.0);
  for (const Body& body : world.bodies()) {
    for (const BodyModel* model : body.models) bytes += static_cast<double>(model->bytes());
  }
  run.counters["bytes/element"] = bytes / elements_of(world);
}

}  // namespace tissu::bench
