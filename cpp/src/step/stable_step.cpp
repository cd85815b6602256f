#include "tissu/step/stable_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

namespace tissu {
namespace {

constexpr double kLookEvery = 8.0;   ///< steps
constexpr double kLasting = 1000.0;  ///< steps: more than a body of a hundred cells takes for a vibration
constexpr double kDeformed = 0.02;   ///< share of an edge's length, at least …
constexpr double kMuch = 0.05;       ///< … and at most, after which the limit is measured again
constexpr double kLeft = 0.5;        ///< of what a step leaves of the limit, which may be gone by then
constexpr double kForgets = 0.9;     ///< of a sensitivity, from one measurement to the next
constexpr double kFar = 0.05;        ///< of the shortest edge, or of the mean distance of frames
constexpr double kTurned = 0.9997;   ///< cosine of half a turn by 0.05
constexpr std::size_t kNumbers = 9;  ///< of the memory, before the lengths
constexpr double kRoundOff = 1e-12;
constexpr int kHalvings = 60;
constexpr int kMostLooks = 8;       ///< for the shape that limits the step by stiffness and damping together
constexpr double kSettled = 0.999;  ///< of the limit before: the shape of the limit is found
constexpr int kMostBelow = 16;      ///< looks for shapes that are damped less
constexpr double kNearly = 0.98;    ///< of the limit: what may lie below an edge bears that
constexpr double kFinest = 1e-3;    ///< of a damping

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

double square(double x) { return x * x; }

/// Edges below shapes that were found, in the plane of squared frequency and damping: from no motion to the
/// fastest shape, each steeper than the one before. An edge is closed when no shape is known to lie below it.
class LowerEdges {
 public:
  explicit LowerEdges(const Vibration& fastest) : corners_{{}, fastest}, closed_{0} {}

  [[nodiscard]] std::size_t size() const { return closed_.size(); }
  [[nodiscard]] const Vibration& low(std::size_t edge) const { return corners_[edge]; }
  [[nodiscard]] const Vibration& high(std::size_t edge) const { return corners_[edge + 1]; }
  [[nodiscard]] bool is_closed(std::size_t edge) const { return closed_[edge] != 0; }
  void close(std::size_t edge) { closed_[edge] = 1; }
  /// damping = ratio frequency^2 - offset
  [[nodiscard]] double ratio(std::size_t edge) const {
    const double wide = square(high(edge).frequency) - square(low(edge).frequency);
    return wide > 0.0 ? std::max(0.0, high(edge).damping - low(edge).damping) / wide : 0.0;
  }
  [[nodiscard]] double offset(std::size_t edge) const {
    return std::max(0.0, ratio(edge) * square(low(edge).frequency) - low(edge).damping);
  }
  void add(const Vibration& shape);

 private:
  /// A corner that is not below the line between those beside it.
  [[nodiscard]] bool is_idle(std::size_t corner) const {
    const auto [a, b, c] = std::tie(corners_[corner - 1], corners_[corner], corners_[corner + 1]);
    const double from = square(a.frequency);
    return (b.damping - a.damping) * (square(c.frequency) - from) >=
           (c.damping - a.damping) * (square(b.frequency) - from);
  }
  void remove(std::size_t corner) {
    corners_.erase(corners_.begin() + static_cast<std::ptrdiff_t>(corner));
    closed_.erase(closed_.begin() + static_cast<std::ptrdiff_t>(corner));
    closed_[corner - 1] = 0;
  }

  std::vector<Vibration> corners_;
  std::vector<std::uint8_t> closed_;
};

void LowerEdges::add(const Vibration& shape) {
  const auto place = std::ranges::upper_bound(corners_.begin() + 1, corners_.end(), shape.frequency, {},
                                              &Vibration::frequency);
  auto corner = static_cast<std::size_t>(place - corners_.begin());
  corners_.insert(place, shape);
  closed_.insert(closed_.begin() + static_cast<std::ptrdiff_t>(corner - 1), 0);
  if (corner < closed_.size()) closed_[corner] = 0;
  while (corner + 2 < corners_.size() && is_idle(corner + 1)) remove(corner + 1);
  while (corner > 1 && is_idle(corner - 1)) remove(--corner);
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

void StableStep::prepare(const World& world, Profile& profile) {
  world_ = &world;
  profile_ = &profile;
  row_ = profile.row("stable step", "measurement");
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
    steps_ = 0.0;
    least_ = least_before_ = limit_;
  } else if (age_ >= kLookEvery) {
    age_ = 0.0;
    look(method, state);
  }
  steps_ += 1.0;
  if (steps_ > kLasting) {
    steps_ = 0.0;
    least_before_ = least_;
    least_ = limit_;
  }
  least_ = std::min(least_, limit_);
  return limit_;
}

double StableStep::lasting() const { return std::isnan(limit_) ? limit_ : std::min(least_, least_before_); }

/// A twentieth is the most: the sensitivity that was found is one of small changes.
void StableStep::look(const Amplification& method, const State& state) {
  const double left = share_ > 0.0 ? 1.0 / share_ - 1.0 : kMuch;
  const double enough = std::clamp(kLeft * left / sensitivity_, kDeformed, kMuch);
  if (deformed(state, enough) <= enough) return;
  const double by = deformed(state, std::numeric_limits<double>::infinity());
  const double before = limit_;
  measure(method, state);
  const double found = std::abs(limit_ - before) / (before * by);
  sensitivity_ = std::max({1.0, kForgets * sensitivity_, std::isfinite(found) ? found : 0.0});
}

double StableStep::deformed(const State& state, double enough) const {
  const ConstReals x(state.positions);
  double most = 0.0;
  for (std::size_t e = 0; e < lengths_.size(); ++e) {
    const double now = (block(x, edges_[2 * e]) - block(x, edges_[2 * e + 1])).norm();
    const double change = std::abs(now - lengths_[e]);
    if (change <= most * lengths_[e]) continue;
    most = lengths_[e] > 0.0 && std::isfinite(change) ? change / lengths_[e]
                                                      : std::numeric_limits<double>::infinity();
    if (most > enough) break;
  }
  return most;
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
  const Timed timed(*profile_, row_);
  if (!world_->run_time().coupling.empty()) coupled_ = coupled(state);
  const Vibration fastest = fastest_vibration(*world_, state);
  limit_ = bearable(method, fastest);
  const bool both = fastest.frequency > 0.0 && fastest.largest_damping > 0.0;
  if (both && method.growth > 0.0) heed_less_damped(method, state, fastest);
  for (int look = 0; both && method.growth == 0.0 && look < kMostLooks && limit_ > 0.0; ++look) {
    const double before = limit_;
    limit_ = std::min(limit_, bearable(method, stiffest_vibration(*world_, state, limit_)));
    if (limit_ > kSettled * before) break;
  }
  age_ = std::isnan(limit_) ? kLookEvery : 0.0;  // such a state has to be looked at again
  const ConstReals x(state.positions);
  for (std::size_t e = 0; e < lengths_.size(); ++e) {
    lengths_[e] = (block(x, edges_[2 * e]) - block(x, edges_[2 * e + 1])).norm();
  }
  find_shortest();
}

void StableStep::find_shortest() {
  shortest_ = std::numeric_limits<double>::infinity();
  for (const double length : lengths_) {  // 0: a frame that fills up a list of frames
    if (length > 0.0) shortest_ = std::min(shortest_, length);
  }
  const std::size_t frames = world_->frames().size();
  if (frames > 0) shortest_ = std::min(shortest_, world_->extent() / std::cbrt(static_cast<double>(frames)));
}

/// Tissue rides on several bodies: these are taken together.
bool StableStep::may_invert(const State& from, const State& to) const {
  for (std::size_t i = 0; i < from.rotations.size(); ++i) {
    if (!(std::abs(from.rotations[i].dot(to.rotations[i])) >= kTurned)) return true;
  }
  const bool together = !world_->frames().empty();
  Vec3 least = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 most = -least;
  for (const Body& body : world_->bodies()) {
    for (std::int32_t row = body.first_node; row < body.first_node + body.node_count; ++row) {
      const Vec3 way = block(ConstReals(to.positions), row) - block(ConstReals(from.positions), row);
      least = least.cwiseMin(way);
      most = most.cwiseMax(way);
    }
    if (body.node_count > 0 && !((most - least).norm() <= kFar * shortest_)) return true;
    if (together) continue;
    least = Vec3::Constant(std::numeric_limits<double>::infinity());
    most = -least;
  }
  return false;
}

/// Methods that make undamped vibrations grow: the limit of what is damped says nothing of what is not. What
/// they bear in a step h is convex in the plane of squared frequency and damping, where h times the largest
/// damping is at most two: a triangle of explicit Euler, h omega^2 <= damping, and an ellipse of
/// Runge-Kutta's second order, (s - q)^2 + (q - 2)^2 <= 4 with s = h^2 omega^2 and q = h damping. So all
/// shapes are stable with the corners of a convex set that they lie in.
void StableStep::heed_less_damped(const Amplification& method, const State& state, const Vibration& fastest) {
  const DampingRange range(*world_, state);
  LowerEdges edges(fastest);
  const auto with = [&](double frequency, double damping) {
    return bearable(method, {frequency, damping, fastest.largest_damping});
  };
  double sure = std::numeric_limits<double>::infinity();  // of what may lie below closed edges
  for (int look = 0; limit_ > 0.0; ++look) {
    // Of what may lie below an edge, the worst is as fast as its one end and as little damped as the other.
    double worst = limit_;
    std::size_t at = edges.size();
    for (std::size_t i = 0; i < edges.size(); ++i) {
      if (edges.is_closed(i)) continue;
      const double h = with(edges.high(i).frequency, edges.low(i).damping);
      if (!(h < worst)) continue;
      worst = h;
      at = i;
    }
    if (look == kMostBelow || at == edges.size() || worst >= kNearly * limit_) {
      limit_ = std::min({limit_, worst, sure});
      return;
    }
    // After the first look the line is put lower by what takes a fiftieth of the limit at most.
    const Vibration low = edges.low(at);
    const Vibration high = edges.high(at);
    const double ratio = edges.ratio(at);
    const auto bears = [&](double lower) {
      const double right = ratio > 0.0 ? lower / ratio : 0.0;
      return std::min(with(high.frequency, high.damping - lower),
                      with(std::sqrt(square(low.frequency) + right), low.damping));
    };
    double lower = 0.0;
    for (double more = 0.5 * (high.damping - low.damping); look > 0 && more > kFinest * high.damping;
         more *= 0.5) {
      if (bears(lower + more) >= kNearly * limit_) lower += more;
    }
    const double offset = edges.offset(at) + lower;
    const std::optional<Vibration> found = range.below(ratio, offset);
    if (found && found->damping < ratio * square(found->frequency) - offset) {
      limit_ = std::min(limit_, with(found->frequency, found->damping));
      edges.add(*found);
    } else {
      sure = std::min(sure, bears(lower));
      edges.close(at);
    }
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
  memory.insert(memory.end(),
                {limit_, age_, time_, coupled_, steps_, least_, least_before_, share_, sensitivity_});
  memory.insert(memory.end(), lengths_.begin(), lengths_.end());
}

void StableStep::restore(ConstReals memory) {
  limit_ = 0.0;
  // Cells were removed since: what was measured is not of this world.
  if (memory.size() != lengths_.size() + kNumbers) return;
  limit_ = memory[0];
  age_ = memory[1];
  time_ = memory[2];
  coupled_ = memory[3];
  steps_ = memory[4];
  least_ = memory[5];
  least_before_ = memory[6];
  share_ = memory[7];
  sensitivity_ = memory[8];
  std::ranges::copy(memory.subspan(kNumbers), lengths_.begin());
  find_shortest();
}

}  // namespace tissu
