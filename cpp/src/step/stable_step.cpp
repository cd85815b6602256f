#include "tissu/step/stable_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace tissu {
namespace {

constexpr double kLookEvery = 8.0;  ///< steps
constexpr double kDeformed = 0.02;  ///< share of an edge's length
constexpr double kRoundOff = 1e-12;
constexpr int kHalvings = 60;
constexpr int kMostLooks = 8;       ///< for the shape that limits the step by stiffness and damping together
constexpr double kSettled = 0.999;  ///< of the limit before: the shape of the limit is found

/// The places of the cells of a block by ascending numbers: edits in place leave them in another order than a
/// world that is built anew has.
std::vector<std::size_t> by_number(const ElasticBlock& block, std::size_t count) {
  std::vector<std::size_t> places(count);
  std::iota(places.begin(), places.end(), std::size_t{0});
  const std::vector<std::int32_t>& numbers = block.cell_numbers;
  if (numbers.size() == count && !std::ranges::is_sorted(numbers))
    std::ranges::sort(places, {}, [&](std::size_t place) { return numbers[place]; });
  return places;
}

}  // namespace

std::pair<std::complex<double>, std::complex<double>> eigenvalues(double omega, double damping) {
  const std::complex<double> root = std::sqrt(std::complex<double>(0.25 * damping * damping - omega * omega));
  return {-0.5 * damping + root, -0.5 * damping - root};
}

double largest_stable_step(const Amplification& method, const Vibration& vibration) {
  const double rate = std::max(vibration.frequency, vibration.largest_damping);
  if (std::isnan(rate)) return rate;
  if (!(rate > 0.0)) return std::numeric_limits<double>::infinity();
  const auto is_stable = [&](double h) {
    const double most = std::exp(method.growth * h) + kRoundOff;
    return method.factor(h, vibration.frequency, vibration.damping) <= most &&
           method.factor(h, 0.0, vibration.largest_damping) <= most;
  };
  // The stable steps reach from zero to a limit: bisection on their logarithm.
  double high = 8.0 / rate;
  double low = high;
  for (int i = 0; i < kHalvings && !is_stable(low); ++i) {
    high = low;
    low *= 0.5;
  }
  if (!is_stable(low)) return 0.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = std::sqrt(low * high);
    (is_stable(middle) ? low : high) = middle;
  }
  return low;
}

void StableStep::prepare(const World& world) {
  world_ = &world;
  limit_ = 0.0;
  more_frequency_ = 0.0;
  more_damping_ = 0.0;
  edges_.clear();
  for (const Body& body : world.bodies()) {
    for (const BodyModel* model : body.models) {
      const auto& cells = model->block().cells;
      const auto size = static_cast<std::size_t>(model->nodes_per_cell());
      for (const std::size_t cell : by_number(model->block(), cells.size() / size)) {
        for (std::size_t k = 0; k < size; ++k) {
          edges_.push_back(cells[cell * size + k]);
          edges_.push_back(cells[cell * size + (k + 1) % size]);
        }
      }
    }
  }
  lengths_.assign(edges_.size() / 2, 0.0);
}

void StableStep::stiffen(double frequency, double damping) {
  more_frequency_ = frequency;
  more_damping_ = damping;
}

double StableStep::limit(const Amplification& method, const State& state) {
  if (!world_->run_time().coupling.empty() && limit_ != 0.0 && coupled(state) != coupled_) limit_ = 0.0;
  if (limit_ != 0.0 && state.time == time_) return limit_;
  time_ = state.time;
  age_ += 1.0;
  if (limit_ == 0.0) {
    measure(method, state);
  } else if (age_ >= kLookEvery) {
    age_ = 0.0;
    if (has_deformed(state)) measure(method, state);
  }
  return limit_;
}

bool StableStep::has_deformed(const State& state) const {
  const ConstReals x(state.positions);
  for (std::size_t e = 0; e < lengths_.size(); ++e) {
    const double now = (block(x, edges_[2 * e]) - block(x, edges_[2 * e + 1])).norm();
    if (!(std::abs(now - lengths_[e]) <= kDeformed * lengths_[e])) return true;
  }
  return false;
}

double StableStep::coupled(const State& state) {
  couplings_.clear();
  for (const ForceModel* model : world_->run_time().coupling) {
    model->add_couplings(state, {-1.0, 0.0}, couplings_);
  }
  double sum = 0.0;
  double number = 0.0;
  for (const Coupling& one : couplings_.list()) {
    number += 1.0;
    for (std::size_t v = 0; v < one.vertex.size(); ++v) {
      const auto add = [&](std::int32_t row, double share) {
        sum += number * (row + 1.0) * share * share * one.H.trace();
      };
      if (one.beta[v] == 0.0) continue;
      if (one.vertex[v] > Couplings::kCarried) {
        add(one.vertex[v], one.beta[v]);
        continue;
      }
      for (const CarriedPart& part : couplings_.parts(one.vertex[v])) add(part.row, part.weight);
    }
  }
  return sum;
}

void StableStep::measure(const Amplification& method, const State& state) {
  if (!world_->run_time().coupling.empty()) coupled_ = coupled(state);
  const Vibration fastest = fastest_vibration(*world_, state);
  limit_ = bearable(method, fastest);
  const bool both = fastest.frequency > 0.0 && fastest.largest_damping > 0.0;
  for (int look = 0; both && look < kMostLooks && limit_ > 0.0; ++look) {
    const double before = limit_;
    limit_ = std::min(limit_, bearable(method, stiffest_vibration(*world_, state, limit_)));
    if (limit_ > kSettled * before) break;
  }
  age_ = std::isnan(limit_) ? kLookEvery : 0.0;  // such a state has to be looked at again
  const ConstReals x(state.positions);
  for (std::size_t e = 0; e < lengths_.size(); ++e) {
    lengths_[e] = (block(x, edges_[2 * e]) - block(x, edges_[2 * e + 1])).norm();
  }
}

double StableStep::bearable(const Amplification& method, Vibration vibration) const {
  const double alone = largest_stable_step(method, vibration);
  // What does not touch stays as it is; what does may be damped by it too.
  vibration.frequency = std::hypot(vibration.frequency, more_frequency_);
  vibration.damping += more_damping_;
  vibration.largest_damping += more_damping_;
  return std::min(alone, largest_stable_step(method, vibration));
}

void StableStep::append_memory(std::vector<double>& memory) const {
  memory.insert(memory.end(), {limit_, age_, time_, coupled_});
  memory.insert(memory.end(), lengths_.begin(), lengths_.end());
}

void StableStep::restore(ConstReals memory) {
  limit_ = 0.0;
  // Cells were removed since: what was measured is not of this world.
  if (memory.size() != lengths_.size() + 4) return;
  limit_ = memory[0];
  age_ = memory[1];
  time_ = memory[2];
  coupled_ = memory[3];
  std::ranges::copy(memory.subspan(4), lengths_.begin());
}

}  // namespace tissu
