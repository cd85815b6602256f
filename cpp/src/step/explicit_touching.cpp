/// Explicit steps of a world with contact.

#include <algorithm>

#include "tissu/base/error.h"
#include "tissu/base/number_text.h"
#include "tissu/state/free_turn.h"
#include "tissu/step/explicit_method.h"

namespace tissu {
namespace {

constexpr double kSame = 1e-9;
/// Impulses that the stages of a step do not see act on later ones as stiffness: sqrt(2) of the bodies'
/// largest frequency, measured with Runge-Kutta's fourth order, which needs a little less.
constexpr double kUnseen = 1.4142135623730951;

/// Of a whole way that was cut, the share that was gone.
double share_of(const Vec3& gone, const Vec3& whole) {
  const double square = whole.squaredNorm();
  return square > 0.0 ? std::clamp(gone.dot(whole) / square, 0.0, 1.0) : 0.0;
}

}  // namespace

void ExplicitMethod::prepare_touching(const World& world, Profile& profile) {
  const double frequency = fastest_vibration(world, world.shape_state()).frequency;
  contact_ = ExplicitContact::make(*world.contact(), world.fixed(), world.mass(), frequency);
  const ContactRates rates = contact_->rates();
  const bool long_stages = has_stages() && amplification().growth == 0.0;
  const double unseen = contact_->stays() && long_stages ? kUnseen * frequency : 0.0;
  stable_.stiffen(std::max(rates.frequency, unseen), rates.damping);
  profile_ = &profile;
  detection_row_ = profile.row("contact", "detection");
  travel_row_ = profile.row("contact", "travel");
  response_row_ = profile.row("contact", "response");
  led_ = start_;
  for (auto* v : {&free_way_, &free_ends_, &change_, &way_, &placed_}) {
    v->assign(start_.positions.size(), 0.0);
  }
}

/// What is led goes ahead; forces of contact are those of the looks from now on.
void ExplicitMethod::begin_touching(double h) {
  const Timed timed(*profile_, detection_row_);
  led_ = start_;
  led_.time = start_.time + h;
  lead(led_, h);
  contact_->begin(start_, led_.time, led_);
  world().contact()->numbers(start_).clear();
  looked_ = false;
}

void ExplicitMethod::push(const State& state, double share, Reals f) {
  if (!looked_ || !contact_->stays()) look(state, &state);
  looked_ = true;
  const Timed timed(*profile_, response_row_);
  contact_->add_force(state, share, f);
}

void ExplicitMethod::touch(ConstReals way, double pushed, double h, State& state) {
  const int looks = world().contact()->description().iterations;
  std::ranges::copy(way, free_way_.begin());
  std::ranges::copy(state.velocities, free_ends_.begin());
  world().fixed().copy(led_.velocities, free_way_);
  world().fixed().copy(led_.velocities, free_ends_);
  place(free_way_, h, state);
  lifted_ = false;
  if (contact_->strikes_first()) {
    if (!contact_->stays()) look(start_, &state);
    strike(pushed, h, state);
  }
  held_back_ = hold_back(h, state);
  for (int i = 1; i < looks; ++i) {
    if (held_back_ == 0 && !contact_->is_pressed_in(state)) break;
    contact_->take_back(pushed, free_way_, free_ends_);
    look(state, nullptr);
    strike(pushed, h, state);
    held_back_ = hold_back(h, state);
  }
  const Timed timed(*profile_, response_row_);
  contact_->finish(state);
}

void ExplicitMethod::look(const State& at, const State* goal) {
  const Timed timed(*profile_, detection_row_);
  contact_->look(at, goal);
}

/// Impulses of the contacts that were looked at.
void ExplicitMethod::strike(double pushed, double h, State& state) {
  const Timed timed(*profile_, response_row_);
  contact_->find_blows(pushed);
  contact_->strike_way(free_way_, change_);
  for (std::size_t i = 0; i < way_.size(); ++i) way_[i] = free_way_[i] + change_[i];
  place(way_, h, state);
  unlifted_ = state.positions;
  unlifted_rotations_ = state.rotations;
  lifted_ = true;
  contact_->lift(state);
  contact_->strike_end(free_ends_, state, change_);
  for (std::size_t i = 0; i < way_.size(); ++i) state.velocities[i] = free_ends_[i] + change_[i];
}

/// Rows whose way was cut have the velocity of the way that they went. What lifted them out of each other is
/// not gone, and in a short step it would be very fast.
int ExplicitMethod::hold_back(double h, State& state) {
  const Timed timed(*profile_, travel_row_);
  placed_ = state.positions;
  placed_rotations_ = state.rotations;
  const int rows = contact_->hold_back(state);
  if (rows == 0) return 0;
  change_ = state.velocities;
  for (std::size_t i = 0; i < placed_.size(); i += 3) {
    const auto row = static_cast<std::int32_t>(i / 3);
    const Vec3 placed = block(ConstReals(placed_), row);
    if (placed == block(ConstReals(state.positions), row)) continue;
    Vec3 way = block(ConstReals(state.positions), row) - block(ConstReals(start_.positions), row);
    if (lifted_) {
      const Vec3 whole = placed - block(ConstReals(start_.positions), row);
      way -= share_of(way, whole) * (placed - block(ConstReals(unlifted_), row));
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (placed_[i + k] != state.positions[i + k]) state.velocities[i + k] = way[static_cast<int>(k)] / h;
    }
  }
  const std::vector<Frame>& frames = world().frames();
  for (std::size_t k = 0; k < frames.size(); ++k) {
    if (placed_rotations_[k].coeffs() == state.rotations[k].coeffs()) continue;
    const Quaternion turn = state.rotations[k] * start_.rotations[k].conjugate();
    Vec3 way = nearest_turn(turn, Vec3::Zero());
    if (lifted_) {
      const Quaternion whole = placed_rotations_[k] * start_.rotations[k].conjugate();
      const Quaternion lift = placed_rotations_[k] * unlifted_rotations_[k].conjugate();
      way -= share_of(way, nearest_turn(whole, Vec3::Zero())) * nearest_turn(lift, Vec3::Zero());
    }
    const bool free = turns_freely() && !frames[k].alone;
    block(Reals(state.velocities), frames[k].rotation) =
        free ? spin_of_free_turn(frames[k], start_.rotations[k], way, h) : Vec3(way / h);
  }
  contact_->keep_momentum(world().mass(), world().fixed(), change_, state.velocities);
  return rows;
}

/// Where what is led leaves no room, impulses find no answer.
void ExplicitMethod::tell_depth(StepReport& report) const {
  if (contact_->depth() <= ExplicitContact::kTooDeep) return;
  report.converged = false;
  report.message = "surfaces are deeper inside each other than " +
                   number_text(100.0 * ExplicitContact::kTooDeep) +
                   " % of their gap at the end of the step; lead things so that they leave room for what is "
                   "between them, or take a smaller dt";
}

/// A stiffness of the user's may come to more than was seen at rest: where many contacts meet at a node.
void ExplicitMethod::require_bearable(double h, double limit) const {
  const double expected = contact_->rates().frequency;
  const double found = contact_->stiffest();
  if (!(found > expected * (1.0 + kSame)) || h <= limit * expected / found) return;
  throw Diverged("the contacts in the step from t = " + number_text(start_.time) +
                     " s have a stiffness that bears steps up to " + number_text(limit * expected / found) +
                     " s, and dt is " + number_text(h) +
                     " s; take a smaller dt, a smaller stiffness, or leave the stiffness out.",
                 "", -1, start_.time);
}

}  // namespace tissu
