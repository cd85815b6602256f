#include "tissu/step/arc_length.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tissu/base/interruption.h"
#include "tissu/base/norm.h"

namespace tissu {
namespace {

constexpr double kDifference = 1e-6;  ///< of the share, for the rate of the forces
constexpr int kMost = 12;             ///< iterations of one step
constexpr double kEasy = 4.0;         ///< iterations after which a step keeps its length
constexpr double kShortest = 1e-6;    ///< of the first step
constexpr double kFarthest = 0.05;    ///< of the scene's size, a step in the mean of the nodes
constexpr double kShort = 0.5;        ///< of what the tangent promises, for a step that turned
constexpr double kReleased = -1.5;    ///< share of the load

double dot(ConstReals a, ConstReals b) { return std::inner_product(a.begin(), a.end(), b.begin(), 0.0); }

}  // namespace

ArcLength::ArcLength(Equilibrium& equilibrium, NewtonSettings newton)
    : equilibrium_(equilibrium), newton_(newton), trial_(equilibrium.world().rest_state()) {
  other_ = start_ = trial_;
  for (auto* v : {&tangent_, &rate_, &change_, &correction_, &right_, &way_}) {
    v->assign(trial_.positions.size(), 0.0);
  }
}

void ArcLength::go(const LoadPath& path, double before, double after, ConstReals change, State& state) {
  path.set_way(before, after, state, way_);
  for (std::size_t i = 0; i < way_.size(); ++i) way_[i] += change[i];
  trial_ = state;
  move(trial_, equilibrium_.world().frames(), way_, 1.0, state);
  path.load(after, state);
}

bool ArcLength::find_rate(const LoadPath& path, double share, const State& state, std::vector<double>& rate,
                          StepReport& report) {
  const FixedDofs& fixed = equilibrium_.world().fixed();
  const double step = share + kDifference > 1.0 ? -kDifference : kDifference;
  other_ = state;
  std::ranges::fill(change_, 0.0);
  go(path, share, share + step, change_, other_);
  equilibrium_.residual(other_);
  std::ranges::copy(equilibrium_.right(), right_.begin());
  equilibrium_.residual(state);
  for (std::size_t i = 0; i < right_.size(); ++i) right_[i] = (right_[i] - equilibrium_.right()[i]) / step;
  const SolveReport solved = equilibrium_.tangent().solve(state, right_, rate);
  report.solver_iterations += solved.iterations;
  path.set_way(share, share + step, state, way_);
  fixed.clear(rate);
  for (std::size_t i = 0; i < way_.size(); ++i) rate[i] += way_[i] / step;
  return std::isfinite(norm(rate));
}

bool ArcLength::find_tangent(const LoadPath& path, double share, const State& state, StepReport& report) {
  if (!find_rate(path, share, state, rate_, report)) return false;
  const double before = dot(tangent_, rate_) / (scale_ * scale_) + tangent_share_;
  tangent_share_ = std::copysign(1.0 / std::hypot(1.0, norm(rate_) / scale_), before);
  for (std::size_t i = 0; i < rate_.size(); ++i) tangent_[i] = tangent_share_ * rate_[i];
  return true;
}

bool ArcLength::advance(const LoadPath& path, double length, double& share, State& state,
                        StepReport& report) {
  start_ = state;
  const FixedDofs& fixed = equilibrium_.world().fixed();
  const double scale2 = scale_ * scale_;
  double at = share + length * tangent_share_;
  for (std::size_t i = 0; i < correction_.size(); ++i) correction_[i] = length * tangent_[i];
  fixed.clear(correction_);
  go(path, share, at, correction_, state);
  iterations_ = 0;
  double size = norm(correction_);
  while (iterations_ < kMost) {
    const double now = equilibrium_.residual(state);
    if (!std::isfinite(now)) break;
    if (equilibrium_.is_reached(at, state, now, size, report)) {
      share = at;
      return true;
    }
    ++iterations_;
    ++report.newton_iterations;
    stop_if_asked();
    if (!find_rate(path, at, state, rate_, report)) break;
    equilibrium_.residual(state);
    std::ranges::copy(equilibrium_.right(), right_.begin());
    const SolveReport solved = equilibrium_.tangent().solve(state, right_, correction_);
    report.solver_iterations += solved.iterations;
    report.indefinite += solved.positive_definite ? 0 : 1;
    fixed.clear(correction_);
    const double along = dot(tangent_, rate_) / scale2 + tangent_share_;
    const double by = -dot(tangent_, correction_) / scale2 / along;
    if (!std::isfinite(by)) break;
    fixed.clear(rate_);
    for (std::size_t i = 0; i < correction_.size(); ++i) correction_[i] += by * rate_[i];
    size = norm(correction_);
    go(path, at, at + by, correction_, state);
    at += by;
  }
  state = start_;
  return false;
}

ArcLength::End ArcLength::follow(const LoadPath& path, double& share, double part, int total, State& state,
                                 StepReport& report) {
  std::ranges::fill(tangent_, 0.0);
  tangent_share_ = 1.0;
  path.load(share, state);
  if (!find_rate(path, share, state, rate_, report)) return End::no_longer;
  scale_ = norm(rate_);
  if (!(scale_ > 0.0)) return End::no_longer;
  const double farthest = kFarthest * equilibrium_.world().extent() * std::sqrt(state.blocks());
  const double shortest = kShortest * part;
  double length = std::min(part * std::sqrt(2.0), farthest / scale_);
  while (report.newton_iterations < total) {
    if (!find_tangent(path, share, state, report)) return End::no_longer;
    const double from = share;
    bool taken = advance(path, length, share, state, report);
    // A step over the limit point may pass the whole load on its way up and be below it again.
    const double up = length * tangent_share_;
    if (taken && share < 1.0 && from + up >= 1.0 && share - from < kShort * up) {
      taken = false;
      state = start_;
      share = from;
    }
    if (taken && share >= 1.0) {
      const auto search = Equilibrium::Search::none;
      if (equilibrium_.find(path, share, 1.0, search, kMost, state, report) == Equilibrium::End::reached) {
        share = 1.0;
        return End::reached;
      }
      taken = false;
      state = start_;
      share = from;
    }
    if (taken && share < kReleased) return End::released;
    const double factor = taken ? std::clamp(std::sqrt(kEasy / std::max(iterations_, 1)), 0.5, 2.0) : 0.5;
    length = std::min(length * factor, farthest / scale_);
    if (length < shortest) return End::no_longer;
  }
  return End::most;
}

}  // namespace tissu
