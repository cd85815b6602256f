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
constexpr double kBelow = 2e-3;   ///< of what rows have: less than that is not below
constexpr int kProbes = 4;
constexpr double kRough = 0.02;  ///< of how far below …
constexpr double kLeast = 0.05;  ///< … and of what rows have: half of kBelow
constexpr int kEvery = 8;        ///< steps

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
  /// From now on x -> W (A - offset) W x, of the same A, with a number of W for each unknown.
  void weigh(std::vector<double> weights, double offset) {
    weights_ = std::move(weights);
    offset_ = offset;
  }
  void apply(ConstReals x, Reals out) {
    std::ranges::copy(x, scaled_.begin());
    times_weights(scaled_);
    if (!weights_.empty()) weighted_ = scaled_;
    divide(scaled_);
    std::ranges::fill(out, 0.0);
    for (const auto& model : world_.forces()) {
      if (model->has_stiffness()) model->add_product(state_, scratch_, scale_, scaled_, out);
    }
    divide(out);
    for (std::size_t i = 0; i < weights_.size(); ++i) out[i] -= offset_ * weighted_[i];
    times_weights(out);
  }
  /// Zero where the motion is given.
  void free(Reals x) const { world_.fixed().clear(x); }
  /// x -> W x
  void times_weights(Reals x) const {
    for (std::size_t i = 0; i < weights_.size(); ++i) x[i] *= weights_[i];
  }

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
  std::vector<double> weights_;  ///< empty: all one
  std::vector<double> weighted_;
  double offset_ = 0.0;
  Scratch scratch_;
};

/// A start that no mode is orthogonal to: numbers without a pattern, the same on every machine.
void fill_start(Reals x, std::uint64_t other = 0) {
  std::uint64_t seed = 88172645463325252ULL + other * 0x9e3779b97f4a7c15ULL;
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
  /// Until it changes by less than a share of it, or of `least`, in so many steps.
  double largest(double tolerance, double least = 0.0, int every = 1);
  /// After `largest`, which found something.
  std::vector<double> shape();
  /// After `largest`: whether the matrix does the same to every shape, as damping by the mass alone does.
  [[nodiscard]] bool is_multiple() const { return diagonal_.size() == 1 && beside_.empty(); }

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

double Lanczos::largest(double tolerance, double least, int every) {
  start();
  double largest = 0.0;
  for (int step = 0; step < kMostSteps; ++step) {
    stop_if_asked();
    matrix_.apply(now_, next_);
    const double on = std::inner_product(now_.begin(), now_.end(), next_.begin(), 0.0);
    if (!std::isfinite(on)) return std::numeric_limits<double>::quiet_NaN();
    diagonal_.push_back(on);
    if (step % every == 0) {
      const double found = ritz(Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
      const bool same = std::abs(found - largest) <= tolerance * std::max(found, least);
      if (step > 4 * every && same) return std::max(0.0, found);
      largest = found;
    }
    const double length = advance(on, step == 0 ? 0.0 : beside_.back());
    if (!(length > 1e-12 * std::abs(on))) break;  // the space is exhausted
    beside_.push_back(length);
  }
  return std::max(0.0, ritz(Eigen::EigenvaluesOnly).eigenvalues().maxCoeff());
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

/// The frequency and the damping of a shape.
Vibration vibration_of(const World& world, const State& state, const std::vector<double>& shape) {
  ScaledMatrix stiffness(world, state, {-1.0, 0.0});
  ScaledMatrix damping(world, state, {0.0, -1.0});
  Vibration result;
  result.frequency = std::sqrt(std::max(0.0, quotient(stiffness, shape)));
  result.damping = result.largest_damping = std::max(0.0, quotient(damping, shape));
  return result;
}

/// Root mean squares of the rows of A, each over the three of a block: of products with numbers by chance.
std::vector<double> sizes_of_rows(ScaledMatrix A, std::size_t size) {
  std::vector<double> x(size);
  std::vector<double> product(size);
  std::vector<double> squares(size, 0.0);
  for (int probe = 1; probe <= kProbes; ++probe) {
    fill_start(x, static_cast<std::uint64_t>(probe));
    A.free(x);
    A.apply(x, product);
    for (std::size_t i = 0; i < size; ++i) squares[i] += 12.0 / kProbes * product[i] * product[i];
  }
  for (std::size_t i = 0; i < size; i += 3) {
    const double mean = (squares[i] + squares[i + 1] + squares[i + 2]) / 3.0;
    squares[i] = squares[i + 1] = squares[i + 2] = std::sqrt(mean);
  }
  return squares;
}

}  // namespace

DampingRange::DampingRange(const World& world, const State& state)
    : world_(world),
      state_(state),
      stiffness_(sizes_of_rows({world, state, {-1.0, 0.0}}, state.positions.size())),
      damping_(sizes_of_rows({world, state, {0.0, -1.0}}, state.positions.size())) {}

std::optional<Vibration> DampingRange::below(double ratio, double offset) const {
  std::vector<double> weights(stiffness_.size());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double sum = ratio * stiffness_[i] + damping_[i] + offset;
    weights[i] = sum > 0.0 ? 1.0 / std::sqrt(sum) : 0.0;
  }
  ScaledMatrix less(world_, state_, {-ratio, 1.0});
  less.weigh(std::move(weights), offset);
  Lanczos lanczos(less, stiffness_.size());
  if (!(lanczos.largest(kRough, kLeast, kEvery) > kBelow)) return std::nullopt;
  std::vector<double> shape = lanczos.shape();
  less.times_weights(shape);
  return vibration_of(world_, state_, shape);
}

Vibration stiffest_vibration(const World& world, const State& state, double h) {
  ScaledMatrix both(world, state, {-h * h, -2.0 * h});
  Lanczos lanczos(both, state.positions.size());
  if (!(lanczos.largest(kCoarse) > 0.0)) return {};
  return vibration_of(world, state, lanczos.shape());
}

Vibration fastest_vibration(const World& world, const State& state) {
  const std::size_t size = state.positions.size();
  Vibration result;
  ScaledMatrix stiffness(world, state, {-1.0, 0.0});
  ScaledMatrix damping(world, state, {0.0, -1.0});
  Lanczos elastic(stiffness, size);
  result.frequency = std::sqrt(elastic.largest(kCoarse));
  Lanczos viscous(damping, size);
  result.largest_damping = viscous.largest(kCoarse);
  if (result.largest_damping > 0.0 && result.frequency > 0.0) {
    result.damping = viscous.is_multiple() ? result.largest_damping : quotient(damping, elastic.shape());
  }
  return result;
}

}  // namespace tissu
