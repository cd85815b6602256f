#include "tissu/step/discrete_gradient.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tissu/base/norm.h"

namespace tissu {
namespace {

constexpr double kRoundingsOfEnergy = 16.0;
constexpr double kSmallest = 1e3 * std::numeric_limits<double>::epsilon();
/// Shares of the size of the world: so far it is moved to see the round-off of its energy.
constexpr std::array<double, 3> kMoves{0.13, 0.37, 0.71};

/// Its work along a chord is not the change of its energy.
bool is_corrected(const ForceModel& model) {
  return model.kind() == ForceKind::elastic && !model.run_time().couples;
}

}  // namespace

void DiscreteGradient::prepare(System& system) {
  system_ = &system;
  const World& world = system.world();
  parts_ = parts_of(world);
  momentum_free_.prepare(world, parts_);
  part_of_.assign(static_cast<std::size_t>(world.blocks()), -1);
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    for (const std::int32_t node : parts_[p].nodes)
      part_of_[static_cast<std::size_t>(node)] = static_cast<std::int32_t>(p);
  }
  models_.clear();
  for (const Body& body : world.bodies()) {
    for (const BodyModel* model : body.models) models_.push_back(&dynamic_cast<const PartEnergies&>(*model));
  }
  are_tied_ = world.contact() != nullptr ||
              std::ranges::any_of(world.run_time().coupling, [](const ForceModel* model) {
                return model->kind() == ForceKind::elastic;
              });
  corrections_.assign(parts_.size(), {});
  active_ = 0;
  before_.assign(parts_.size(), 0.0);
  after_ = before_;
  for (auto* v : {&free_way_, &push_, &elastic_, &slope_, &answer_, &work_})
    v->assign(world.rest_positions().size(), 0.0);
  find_round_off();
}

/// A rigid motion stores nothing: what the energy changes by is the round-off of its terms, which are far
/// larger in a law that does not vanish at rest, and so is the force.
void DiscreteGradient::find_round_off() {
  State moved = system_->world().rest_state();
  const std::vector<double> rest = moved.positions;
  const auto [low, high] = std::ranges::minmax(rest);
  stored(moved, before_);
  for (const double share : kMoves) {
    for (std::size_t i = 0; i < rest.size(); ++i) moved.positions[i] = rest[i] + share * (high - low);
    stored(moved, after_);
    elastic_force(moved, elastic_);
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      Part& part = corrections_[p];
      part.energy_round_off =
          std::max(part.energy_round_off, kRoundingsOfEnergy * std::abs(after_[p] - before_[p]));
      part.force_round_off =
          std::max(part.force_round_off, kRoundingsOfEnergy * std::sqrt(dot(p, elastic_, elastic_)));
    }
  }
}

void DiscreteGradient::stored(const State& state, std::vector<double>& energies) {
  std::ranges::fill(energies, 0.0);
  if (parts_.size() > 1) {
    for (const PartEnergies* model : models_)
      model->add_part_energies(state, system_->scratch(), part_of_, energies);
  } else if (parts_.size() == 1) {
    for (const auto& model : system_->world().forces()) {
      if (is_corrected(*model)) energies[0] += model->energy(state, system_->scratch());
    }
  }
}

void DiscreteGradient::elastic_force(const State& state, std::vector<double>& f) {
  std::ranges::fill(f, 0.0);
  for (const auto& model : system_->world().forces()) {
    if (is_corrected(*model)) model->add_force(state, system_->scratch(), f);
  }
}

double DiscreteGradient::dot(std::size_t p, ConstReals a, ConstReals b) const {
  double sum = 0.0;
  for (const std::int32_t node : parts_[p].nodes) {
    const auto first = 3 * static_cast<std::size_t>(node);
    for (std::size_t i = first; i < first + 3; ++i) sum += a[i] * b[i];
  }
  return sum;
}

void DiscreteGradient::find(const State& from, const State& middle, const State& end, ConstReals way) {
  elastic_force(middle, elastic_);
  std::ranges::copy(way, free_way_.begin());
  // The way of led nodes stays in it: what they store beyond the work of their reactions in the first step
  // from rest cannot be given to free nodes, which have hardly moved.
  momentum_free_.project(middle.positions, free_way_);
  std::ranges::fill(push_, 0.0);
  system_->world().mass().add_product(middle, 1.0, free_way_, push_);
  for (std::size_t i = 0; i < part_of_.size(); ++i) {
    if (part_of_[i] < 0) block(Reals(push_), static_cast<std::int32_t>(i)).setZero();
  }
  stored(from, before_);
  stored(end, after_);
  active_ = 0;
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    Part& part = corrections_[p];
    part.square = dot(p, free_way_, push_);
    const double left = after_[p] - before_[p] + dot(p, elastic_, way);
    const double squared = dot(p, way, way);
    part.energy_floor = part.energy_round_off + part.force_round_off * std::sqrt(squared) +
                        kSmallest * (std::abs(after_[p]) + std::abs(before_[p]));
    const bool is_round_off = std::abs(left) <= part.energy_floor ||
                              part.square <= kSmallest * kSmallest * squared * parts_[p].mass;
    part.factor = is_round_off ? 0.0 : -left / part.square;
    if (part.factor != 0.0) ++active_;
  }
}

void DiscreteGradient::add_force(double scale, Reals f) const {
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const double factor = scale * corrections_[p].factor;
    if (factor == 0.0) continue;
    for (const std::int32_t node : parts_[p].nodes) block(f, node) += factor * block(ConstReals(push_), node);
  }
}

double DiscreteGradient::least_factor() const {
  double least = std::numeric_limits<double>::infinity();
  for (const Part& part : corrections_) least = std::min(least, part.factor);
  return corrections_.empty() ? 0.0 : least;
}

double DiscreteGradient::round_off(double time) const {
  double sum = 0.0;
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const Part& part = corrections_[p];
    if (part.factor != 0.0) sum += time * part.energy_floor / part.square * std::sqrt(dot(p, push_, push_));
  }
  return sum;
}

/// a_p changes by -(f_p(x) - f_p(x1) - K (x1 - x0) / 2 + 2 a_p M d_p) . dx / (d_p . M d_p), dx = h dv.
void DiscreteGradient::find_slopes(const State& middle, const State& end, ConstReals way, double h) {
  const FixedDofs& fixed = system_->world().fixed();
  elastic_force(end, slope_);
  std::ranges::fill(work_, 0.0);
  for (const auto& model : system_->world().forces()) {
    if (is_corrected(*model)) model->add_product(middle, system_->scratch(), {0.5, 0.0}, way, work_);
  }
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const Part& part = corrections_[p];
    for (const std::int32_t node : parts_[p].nodes) {
      const auto first = 3 * static_cast<std::size_t>(node);
      for (std::size_t i = first; i < first + 3; ++i) {
        if (part.factor == 0.0) {
          push_[i] = 0.0;
        } else {
          slope_[i] = -h * (elastic_[i] - slope_[i] + work_[i] + 2.0 * part.factor * push_[i]) / part.square;
        }
      }
    }
  }
  fixed.clear(slope_);
  fixed.clear(push_);
}

bool DiscreteGradient::find_shares(double h, ConstReals change) {
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    Part& part = corrections_[p];
    part.share = 0.0;
    if (part.factor == 0.0) continue;
    const double down = 1.0 - 0.5 * h * dot(p, slope_, answer_);
    part.share = 0.5 * h * dot(p, slope_, change) / down;
    if (!std::isfinite(part.share)) return false;
  }
  return true;
}

void DiscreteGradient::add_shares(ConstReals v, Reals out) const {
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const double share = corrections_[p].share;
    if (share == 0.0) continue;
    for (const std::int32_t node : parts_[p].nodes) block(out, node) += share * block(v, node);
  }
}

}  // namespace tissu
