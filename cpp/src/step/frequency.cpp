#include "tissu/step/frequency.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "tissu/base/interruption.h"
#include "tissu/base/norm.h"

namespace tissu {
namespace {

constexpr int kMostSteps = 400;
constexpr double kFine = 1e-6;
constexpr double kCoarse = 1e-4;  ///< of the squared frequency: the frequency itself is known far better

/// x -> M^-1/2 A M^-1/2 x for the free degrees of freedom, zero for the others; A is scale of df/dx and
/// df/dv.
class ScaledMatrix {
 public:
  ScaledMatrix(const World& world, const State& state, StiffnessScale scale)
      : world_(world), state_(state), scale_(scale) {
    for (const double m : world.mass().nodal()) root_.push_back(m > 0.0 ? 1.0 / std::sqrt(m) : 0.0);
    for (std::size_t k = 0; k < world.frames().size(); ++k) {
      const Mat3 inertia = spatial_inertia(world.frames()[k], state.rotations[k]);
      root_[static_cast<std::size_t>(world.frames()[k].rotation)] = 1.0;
      turning_.emplace_back(Eigen::SelfAdjointEigenSolver<Mat3>(inertia).operatorInverseSqrt());
    }
    scaled_.resize(state.positions.size());
  }
  void apply(ConstReals x, Reals out) {
    std::ranges::copy(x, scaled_.begin());
    divide(scaled_);
    std::ranges::fill(out, 0.0);
    for (const auto& model : world_.forces()) {
      if (model->has_stiffness()) model->add_product(state_, scratch_, scale_, scaled_, out);
    }
    divide(out);
  }
  /// Zero where the motion is given.
  void free(Reals x) const { world_.fixed().clear(x); }

 private:
  void divide(Reals x) const {
    for (std::size_t i = 0; i < root_.size(); ++i) block(x, static_cast<std::int32_t>(i)) *= root_[i];
    for (std::size_t k = 0; k < turning_.size(); ++k) {
      const std::int32_t r = world_.frames()[k].rotation;
      block(x, r) = turning_[k] * Vec3(block(ConstReals(x), r));
    }
    free(x);
  }
  const World& world_;
  const State& state_;
  StiffnessScale scale_;
  std::vector<double> root_;
  std::vector<Mat3> turning_;
  std::vector<double> scaled_;
  Scratch scratch_;
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

/// The largest eigenvalue of `matrix` by Lanczos' method, and, where `shape` is asked for, its eigenvector:
/// the same steps are taken again then, since the basis is not kept.
class Lanczos {
 public:
  Lanczos(ScaledMatrix& matrix, std::size_t size) : matrix_(matrix), before_(size), now_(size), next_(size) {}
  double largest(double tolerance);
  /// After `largest`, which found something.
  std::vector<double> shape();

 private:
  void start();
  /// The next vector of the basis; its length beside the one before.
  double advance(double on, double off);
  [[nodiscard]] Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(Eigen::DecompositionOptions what) const;

  ScaledMatrix& matrix_;
  std::vector<double> before_;
  std::vector<double> now_;
  std::vector<double> next_;
  std::vector<double> diagonal_;
  std::vector<double> beside_;
};

void Lanczos::start() {
  std::ranges::fill(before_, 0.0);
  fill_start(now_);
  matrix_.free(now_);
  const double length = norm(now_);
  for (double& x : now_) x /= length > 0.0 ? length : 1.0;
}

double Lanczos::advance(double on, double off) {
  for (std::size_t i = 0; i < now_.size(); ++i) next_[i] -= on * now_[i] + off * before_[i];
  const double length = norm(next_);
  std::swap(before_, now_);
  std::swap(now_, next_);
  if (length > 0.0) {
    for (double& x : now_) x /= length;
  }
  return length;
}

Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> Lanczos::ritz(Eigen::DecompositionOptions what) const {
  const auto count = static_cast<Eigen::Index>(diagonal_.size());
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(Eigen::Map<const Eigen::VectorXd>(diagonal_.data(), count),
                                Eigen::Map<const Eigen::VectorXd>(beside_.data(), count - 1), what);
  return solver;
}

double Lanczos::largest(double tolerance) {
  start();
  double largest = 0.0;
  for (int step = 0; step < kMostSteps; ++step) {
    stop_if_asked();
    matrix_.apply(now_, next_);
    const double on = std::inner_product(now_.begin(), now_.end(), next_.begin(), 0.0);
    if (!std::isfinite(on)) return std::numeric_limits<double>::quiet_NaN();
    diagonal_.push_back(on);
    const double found = ritz(Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
    if (step > 4 && std::abs(found - largest) <= tolerance * found) return std::max(0.0, found);
    largest = found;
    const double length = advance(on, step == 0 ? 0.0 : beside_.back());
    if (!(length > 1e-12 * std::abs(on))) break;  // the space is exhausted
    beside_.push_back(length);
  }
  return std::max(0.0, largest);
}

std::vector<double> Lanczos::shape() {
  Eigen::Index at = 0;
  const auto solver = ritz(Eigen::ComputeEigenvectors);
  solver.eigenvalues().maxCoeff(&at);
  const Eigen::VectorXd shares = solver.eigenvectors().col(at);
  std::vector<double> sum(now_.size(), 0.0);
  start();
  for (std::size_t step = 0; step < diagonal_.size(); ++step) {
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += shares(static_cast<Eigen::Index>(step)) * now_[i];
    matrix_.apply(now_, next_);
    advance(diagonal_[step], step == 0 ? 0.0 : beside_[step - 1]);
  }
  return sum;
}

}  // namespace

double largest_frequency(const World& world, const State& state) {
  ScaledMatrix stiffness(world, state, {-1.0, 0.0});
  return std::sqrt(Lanczos(stiffness, state.positions.size()).largest(kFine));
}

namespace {

/// x . A x / x . x
double quotient(ScaledMatrix& A, const std::vector<double>& x) {
  std::vector<double> product(x.size());
  A.apply(x, product);
  return std::inner_product(x.begin(), x.end(), product.begin(), 0.0) /
         std::inner_product(x.begin(), x.end(), x.begin(), 0.0);
}

}  // namespace

Vibration stiffest_vibration(const World& world, const State& state, double h) {
  ScaledMatrix both(world, state, {-h * h, -2.0 * h});
  Lanczos lanczos(both, state.positions.size());
  if (!(lanczos.largest(kCoarse) > 0.0)) return {};
  const std::vector<double> shape = lanczos.shape();
  ScaledMatrix stiffness(world, state, {-1.0, 0.0});
  ScaledMatrix damping(world, state, {0.0, -1.0});
  Vibration result;
  result.frequency = std::sqrt(std::max(0.0, quotient(stiffness, shape)));
  result.damping = result.largest_damping = std::max(0.0, quotient(damping, shape));
  return result;
}

Vibration fastest_vibration(const World& world, const State& state) {
  const std::size_t size = state.positions.size();
  Vibration result;
  ScaledMatrix stiffness(world, state, {-1.0, 0.0});
  ScaledMatrix damping(world, state, {0.0, -1.0});
  Lanczos elastic(stiffness, size);
  result.frequency = std::sqrt(elastic.largest(kCoarse));
  result.largest_damping = Lanczos(damping, size).largest(kCoarse);
  if (result.largest_damping > 0.0 && result.frequency > 0.0) {
    result.damping = quotient(damping, elastic.shape());
  }
  return result;
}

}  // namespace tissu
