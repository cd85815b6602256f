#include "tissu/step/frequency.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "tissu/base/norm.h"

namespace tissu {
namespace {

constexpr int kMostSteps = 400;
constexpr double kTolerance = 1e-6;

/// x -> M^-1/2 K M^-1/2 x for the free degrees of freedom, zero for the others.
class ScaledStiffness {
 public:
  ScaledStiffness(const World& world, const State& state) : world_(world), state_(state) {
    for (const double m : world.mass().nodal()) root_.push_back(m > 0.0 ? 1.0 / std::sqrt(m) : 0.0);
    for (std::size_t k = 0; k < world.frames().size(); ++k) {
      const Mat3 inertia = spatial_inertia(world.frames()[k], state.rotations[k]);
      root_[static_cast<std::size_t>(world.frames()[k].block) + 1] = 1.0;
      turning_.emplace_back(Eigen::SelfAdjointEigenSolver<Mat3>(inertia).operatorInverseSqrt());
    }
    scaled_.resize(state.positions.size());
  }
  void apply(ConstReals x, Reals out) {
    std::ranges::copy(x, scaled_.begin());
    divide(scaled_);
    std::ranges::fill(out, 0.0);
    for (const auto& model : world_.forces()) {
      if (model->has_stiffness()) model->add_product(state_, {-1.0, 0.0}, scaled_, out);
    }
    divide(out);
  }
  /// Zero where the motion is given.
  void free(Reals x) const { world_.fixed().clear(x); }

 private:
  void divide(Reals x) const {
    for (std::size_t i = 0; i < root_.size(); ++i) block(x, static_cast<std::int32_t>(i)) *= root_[i];
    for (std::size_t k = 0; k < turning_.size(); ++k) {
      const std::int32_t r = world_.frames()[k].block + 1;
      block(x, r) = turning_[k] * Vec3(block(ConstReals(x), r));
    }
    free(x);
  }
  const World& world_;
  const State& state_;
  std::vector<double> root_;
  std::vector<Mat3> turning_;
  std::vector<double> scaled_;
};

/// A start that no mode is orthogonal to: numbers without a pattern, the same on every machine.
void fill_start(Reals x) {
  std::uint64_t seed = 88172645463325252ULL;
  for (double& value : x) {
    seed ^= seed << 13U;
    seed ^= seed >> 7U;
    seed ^= seed << 17U;
    value = static_cast<double>(seed >> 11U) * 0x1.0p-53 - 0.5;
  }
}

}  // namespace

double largest_frequency(const World& world, const State& state) {
  ScaledStiffness stiffness(world, state);
  const std::size_t size = state.positions.size();
  std::vector<double> before(size, 0.0);
  std::vector<double> now(size);
  std::vector<double> next(size);
  std::vector<double> diagonal;
  std::vector<double> beside;
  fill_start(now);
  stiffness.free(now);
  double length = norm(now);
  double largest = 0.0;
  for (int step = 0; step < kMostSteps && length > 0.0; ++step) {
    for (double& x : now) x /= length;
    stiffness.apply(now, next);
    const double on = std::inner_product(now.begin(), now.end(), next.begin(), 0.0);
    const double off = step == 0 ? 0.0 : beside.back();
    for (std::size_t i = 0; i < size; ++i) next[i] -= on * now[i] + off * before[i];
    diagonal.push_back(on);
    const auto count = static_cast<Eigen::Index>(diagonal.size());
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
    ritz.computeFromTridiagonal(Eigen::Map<const Eigen::VectorXd>(diagonal.data(), count),
                                Eigen::Map<const Eigen::VectorXd>(beside.data(), count - 1),
                                Eigen::EigenvaluesOnly);
    const double found = ritz.eigenvalues().maxCoeff();
    if (step > 4 && std::abs(found - largest) <= kTolerance * found) return std::sqrt(std::max(0.0, found));
    largest = found;
    length = norm(next);
    if (!(length > 1e-12 * std::abs(on))) break;  // the space is exhausted
    beside.push_back(length);
    std::swap(before, now);
    std::swap(now, next);
  }
  return std::sqrt(std::max(0.0, largest));
}

}  // namespace tissu
