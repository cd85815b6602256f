#include "tissu/step/bdf2_history.h"

#include <algorithm>

#include "tissu/state/free_turn.h"

namespace tissu {
namespace {

/// Of the step before: in longer steps a change of velocity would go on by more than it was, s > 1, and the
/// method is unstable (Grigorieff, Numer. Math. 42, 1983).
constexpr double kLongest = 2.414;
/// The same where surfaces meet: a step that contact took in parts ends with a blow, which must not go on.
constexpr double kLongestInContact = 1.5;

}  // namespace

void Bdf2History::prepare(const World& world) {
  before_ = world.rest_state();
  way_ = before_.velocities;
  extrapolated_ = before_;
  end_.forget();
}

void Bdf2History::begin(const State& start, double h, StageSolver& solver) {
  const std::vector<Frame>& frames = solver.world().frames();
  solver.begin(start, start.time + h, h);
  goes_on_ =
      end_.is(start) && h <= (solver.world().contact() != nullptr ? kLongestInContact : kLongest) * step_;
  if (goes_on_) {
    Stage& stage = solver.stage();
    const double r = h / step_;
    const double share = r * r / (1.0 + 2.0 * r);
    stage.move = stage.push = h * (1.0 + r) / (1.0 + 2.0 * r);
    stage.past = {.way = share, .since = step_};
    for (std::size_t i = 0; i < way_.size(); ++i) way_[i] = start.positions[i] - before_.positions[i];
    for (std::size_t k = 0; k < frames.size(); ++k) {
      const Eigen::AngleAxisd turn(start.rotations[k] * before_.rotations[k].conjugate());
      block(Reals(way_), frames[k].rotation) = turn.angle() * turn.axis();
    }
    move(start, frames, way_, share, stage.base);
    // Of frames the angular momenta, as angular velocities of the base.
    extrapolated_.velocities = before_.velocities;
    extrapolated_.rotations = stage.base.rotations;
    keep_angular_momentum(before_, frames, extrapolated_);
    keep_angular_momentum(start, frames, stage.base);
    for (std::size_t i = 0; i < way_.size(); ++i) {
      stage.base.velocities[i] += share * (stage.base.velocities[i] - extrapolated_.velocities[i]);
    }
    turn_inertia(solver.world(), stage);
  }
  solver.lead(start, start.time + h, h, 1.0);
}

/// A frame turns with the inertia that it has at the end, as far as the momentum leads there that it has
/// without the forces of the step: with the one of the base, slender frames that tumble would gain energy.
void Bdf2History::turn_inertia(const World& world, Stage& stage) {
  const std::vector<Frame>& frames = world.frames();
  shifts_.assign(frames.size(), Vec3::Zero());
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const Frame& frame = frames[k];
    const bool held = world.fixed().masks()[static_cast<std::size_t>(frame.rotation)] != 0;
    if (frame.alone || held || frame.inertia(0, 0) == 0.0) continue;
    auto omega = block(Reals(stage.base.velocities), frame.rotation);
    const Vec3 w = spin_at_end(frame, stage.base.rotations[k], omega, stage.move);
    shifts_[k] = omega - w;
    omega = w;
  }
}

void Bdf2History::keep_momenta(const StageSolver& solver, State& state) const {
  const std::vector<Frame>& frames = solver.world().frames();
  for (std::size_t k = 0; goes_on_ && k < frames.size(); ++k) {
    if (!shifts_[k].isZero(0.0)) block(Reals(state.velocities), frames[k].rotation) += shifts_[k];
  }
}

void Bdf2History::keep(const State& start, double h, const State& end) {
  before_ = start;
  step_ = h;
  end_.set(end);
}

void Bdf2History::append_memory(std::vector<double>& memory) const {
  if (end_.is_empty()) return;
  end_.append_to(memory);
  memory.push_back(step_);
  memory.insert(memory.end(), before_.positions.begin(), before_.positions.end());
  memory.insert(memory.end(), before_.velocities.begin(), before_.velocities.end());
  for (const Quaternion& q : before_.rotations)
    memory.insert(memory.end(), q.coeffs().begin(), q.coeffs().end());
}

void Bdf2History::restore(ConstReals memory) {
  end_.forget();
  if (memory.empty()) return;
  const std::size_t size = way_.size();
  require_memory(memory.size(), 2 + 4 * size + 4 * before_.rotations.size());
  ConstReals left = end_.take_from(memory, size);
  step_ = left.front();
  std::ranges::copy(left.subspan(1, size), before_.positions.begin());
  std::ranges::copy(left.subspan(1 + size, size), before_.velocities.begin());
  left = left.subspan(1 + 2 * size);
  for (std::size_t k = 0; k < before_.rotations.size(); ++k) {
    before_.rotations[k].coeffs() = Eigen::Map<const Eigen::Vector4d>(left.data() + 4 * k);
  }
}

void Bdf2History::copy_rows(std::span<const RowCopy> copies) {
  if (end_.is_empty()) return;
  end_.copy_rows(copies);
  tissu::copy_rows(copies, before_);
}

void Bdf2History::blend_rows(std::span<const RowBlend> blends) {
  if (end_.is_empty()) return;
  end_.blend_rows(blends);
  tissu::blend_rows(blends, before_.positions);
  tissu::blend_rows(blends, before_.velocities);
}

}  // namespace tissu
