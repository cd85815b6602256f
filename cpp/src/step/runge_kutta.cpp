#include "tissu/step/runge_kutta.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "tissu/base/error.h"

namespace tissu {
namespace {

/// A stage looks at the share `at` of the step, reached with the slope of the stage before, and counts by
/// `weight`.
struct Tableau {
  double at;
  double weight;
};
constexpr std::array<Tableau, 2> kSecond{{{0.0, 0.0}, {0.5, 1.0}}};
constexpr std::array<Tableau, 4> kFourth{
    {{0.0, 1.0 / 6.0}, {0.5, 1.0 / 3.0}, {0.5, 1.0 / 3.0}, {1.0, 1.0 / 6.0}}};

constexpr double kGrowth = 0.01;  ///< of the second order [1/s]

template <int Order>
double factor(double h, double omega, double damping) {
  double largest = 0.0;
  const auto [one, other] = eigenvalues(omega, damping);
  for (const std::complex<double> z : {h * one, h * other}) {
    std::complex<double> sum = 1.0;
    std::complex<double> term = 1.0;
    for (int k = 1; k <= Order; ++k) sum += term *= z / static_cast<double>(k);
    largest = std::max(largest, std::abs(sum));
  }
  return largest;
}

}  // namespace

RungeKutta::RungeKutta(int order) : order_(order) {
  if (order != 2 && order != 4) throw ParameterError("the order of Runge-Kutta must be 2 or 4.");
}

std::string_view RungeKutta::name() const { return order_ == 2 ? "Runge-Kutta 2" : "Runge-Kutta 4"; }

Amplification RungeKutta::amplification() const {
  if (order_ == 2) return {&factor<2>, kGrowth};
  return {&factor<4>, 0.0};
}

void RungeKutta::prepare(const World& world, LinearSolver* solver, Profile& profile) {
  ExplicitMethod::prepare(world, solver, profile);
  stage_ = start();
  for (auto* v : {&a_, &v_, &velocity_, &acceleration_}) v->assign(stage_.positions.size(), 0.0);
}

void RungeKutta::advance(State& state, double h) {
  const std::span<const Tableau> stages =
      order_ == 2 ? std::span<const Tableau>(kSecond) : std::span<const Tableau>(kFourth);
  std::ranges::fill(velocity_, 0.0);
  std::ranges::fill(acceleration_, 0.0);
  stage_ = start();
  for (const auto& [at, weight] : stages) {
    if (at > 0.0) {
      stage_.time = start().time + at * h;
      std::ranges::copy(stage_.velocities, v_.begin());
      move(start(), world().frames(), v_, at * h, stage_);
      for (std::size_t i = 0; i < a_.size(); ++i) {
        stage_.velocities[i] = start().velocities[i] + at * h * a_[i];
      }
      lead(stage_, at * h);
    }
    acceleration(stage_, weight, a_);
    for (std::size_t i = 0; i < a_.size(); ++i) {
      velocity_[i] += weight * stage_.velocities[i];
      acceleration_[i] += weight * a_[i];
    }
  }
  for (std::size_t i = 0; i < a_.size(); ++i) state.velocities[i] += h * acceleration_[i];
  go(velocity_, 0.5, h, state);
}

}  // namespace tissu
