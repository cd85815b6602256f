#include "tissu/step/runge_kutta.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "tissu/base/error.h"
#include "tissu/state/free_turn.h"

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

constexpr double kSecondBernoulli = 1.0 / 12.0;  ///< of the slope of a rotation vector

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
      move(start(), world().frames(), v_, at * h, stage_);
      for (std::size_t i = 0; i < a_.size(); ++i) {
        stage_.velocities[i] = start().velocities[i] + at * h * a_[i];
      }
      lead(stage_, at * h);
    }
    find_slopes(at * h);
    acceleration(stage_, weight, a_);
    for (std::size_t i = 0; i < a_.size(); ++i) {
      velocity_[i] += weight * v_[i];
      acceleration_[i] += weight * a_[i];
    }
  }
  for (std::size_t i = 0; i < a_.size(); ++i) state.velocities[i] += h * acceleration_[i];
  go(velocity_, 0.5, h, state);
}

void RungeKutta::find_slopes(double since) {
  const std::vector<Frame>& frames = world().frames();
  const std::vector<std::uint8_t>& masks = world().fixed().masks();
  turns_.resize(frames.size());
  for (std::size_t k = 0; k < frames.size(); ++k)
    turns_[k] = since * block(ConstReals(v_), frames[k].rotation);
  std::ranges::copy(stage_.velocities, v_.begin());
  if (since == 0.0) return;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const Frame& frame = frames[k];
    const std::int32_t row = frame.rotation;
    const bool held = masks[static_cast<std::size_t>(row)] != 0 || frame.inertia(0, 0) == 0.0;
    if (held || frame.alone) continue;
    auto omega = block(Reals(stage_.velocities), row);
    omega = spin_after(frame, start().rotations[k], omega, stage_.rotations[k]);
    const Vec3& u = turns_[k];
    const Vec3 across = u.cross(Vec3(omega));
    block(Reals(v_), row) = Vec3(omega) - 0.5 * across + kSecondBernoulli * u.cross(across);
  }
}

}  // namespace tissu
