#include "tissu/step/static_touching.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tissu/base/interruption.h"

namespace tissu {
namespace {

constexpr int kMostLooks = 100;    ///< at one part of a load
constexpr double kShallow = 0.05;  ///< of the gap, …
constexpr double kDeeper = 0.2;    ///< of the gap, …
constexpr int kBisections = 12;    ///< … found by so many at most
constexpr int kMostFalls = 40;
constexpr int kMostTouching = 4;        ///< of what contacts held before
constexpr double kNormal = 10.0;        ///< times stiffer against coming nearer than in steps of time
constexpr double kFalls = 0.7;          ///< of the least change before: one that does not fall so far in …
constexpr int kPatience = 6;            ///< … so many looks goes round in a circle
constexpr double kLeastRelaxed = 0.25;  ///< of the way from look to look
constexpr double kLeastTangent = 0.5;   ///< of the springs against sliding: softer ones let bodies creep away
constexpr double kForce = 1e-3;         ///< of a body's contact forces: a smaller change needs no other look
constexpr double kDepth = 1e-3;         ///< of the gap
constexpr std::string_view kUsed = "all of Newton's iterations were used";

}  // namespace

StaticTouching::StaticTouching(Equilibrium& equilibrium, Profile& profile)
    : StaticContact(equilibrium, profile, equilibrium.world().contact()->description().method),
      before_(start_),
      response_row_(profile.row("contact", "response")) {}

/// What is led is looked at where it stands at the end of the part.
void StaticTouching::begin_part(const LoadPath& path, double from, double to, State& state) {
  begin(path, from, to, state);
  start_touches_ = world().contact()->table(start_).size() > 0;
  falls_ = 0;
  tangent_ = relaxed_ = 1.0;
  best_ = std::numeric_limits<double>::infinity();
  idle_ = 0;
  contact_->set_stiffer(kNormal, tangent_);
  is_falling_ = is_loose_;
  hold_back(held_);
  look_at(held_);
  depth_ = contact_->depth();
  contact_->run().go_on_from(held_);
  contact_->take();
  contact_->write(state);
}

bool StaticTouching::solve(const LoadPath& path, double before, double to, int most, State& state,
                           StepReport& report) {
  before_ = state;
  const int first = report.newton_iterations;
  for (const auto search : {Equilibrium::Search::none, Equilibrium::Search::energy}) {
    const int left = most - (report.newton_iterations - first);
    const auto end = equilibrium_.find(path, before, to, search, is_falling_ ? 1 : left, state, report);
    using End = Equilibrium::End;
    if (end == End::reached) {
      is_falling_ = false;
      return true;
    }
    if (end == End::flew || (is_falling_ && end == End::most)) {
      is_falling_ = end == End::flew;
      if (is_falling_) fall(state);
      return true;
    }
    state = before_;
    if (end == End::solver) give_up("the linear solver stopped before its tolerance");
  }
  return false;
}

/// What flies stops all together at the first thing that it meets, hardly inside the distance of rest:
/// springs that are pressed in deep would throw it back.
void StaticTouching::fall(State& state) {
  if (before_.positions != held_.positions) return;  // pushed, or held back: ways do not begin where it is
  held_ = state;
  hold_back(held_);
  double high = contact_->run().least_share();
  if (high == 1.0) return;
  // What touches already may go deeper, as where a body tips over it.
  const double most = depth_ > 0.0 ? depth_ + kDeeper : kShallow;
  double low = 0.0;
  double share = high;
  for (int i = 0; i < kBisections; ++i) {
    equilibrium_.shorten(share, state);
    look_at(state);
    const bool is_deep = contact_->depth() > most;
    if (!is_deep && (i == 0 || contact_->depth() > 0.0)) return;
    (is_deep ? high : low) = share;
    share = 0.5 * (low + high);
  }
}

bool StaticTouching::look_again(double share, State& state, StepReport& report) {
  if (!is_falling_) {
    const Timed timed(profile_, response_row_);
    contact_->update(state);
  }
  // A whole way changes forces by more than the part of it that was gone before.
  const bool whole = relaxed_ == 1.0 || is_falling_ || other_ <= relaxed_ * kForce;
  if (whole) {
    held_ = state;
  } else {
    for (std::size_t i = 0; i < held_.positions.size(); ++i) {
      held_.positions[i] += relaxed_ * (state.positions[i] - held_.positions[i]);
    }
  }
  held_back_ = hold_back(held_);
  look_at(held_);
  depth_ = contact_->depth();
  contact_->run().go_on_from(held_);
  const bool stays =
      whole && !is_falling_ && held_back_ == 0 && other_ <= kForce && contact_->depth() <= kDepth;
  if (stays) {
    is_unstable_ = equilibrium_.is_unstable(state);
    contact_->finish(state, state);
    if (equilibrium_.is_reached(share, state, equilibrium_.residual(state), 0.0, report)) return true;
  }
  soften();
  contact_->take();
  contact_->write(state);
  return false;
}

/// Looks may go round in a circle, between sticking and sliding or from face to face: softer springs and
/// looks at a part of the way end it.
void StaticTouching::soften() {
  if (is_falling_) return;
  ++idle_;
  if (other_ < kFalls * best_) {
    best_ = other_;
    idle_ = 0;
  }
  if (idle_ < kPatience) return;
  tangent_ = std::max(kLeastTangent, 0.5 * tangent_);
  if (world().frames().empty()) relaxed_ = std::max(kLeastRelaxed, 0.5 * relaxed_);
  idle_ = 0;
  best_ = other_;
  contact_->set_stiffer(kNormal, tangent_);
}

bool StaticTouching::seek(const LoadPath& path, double from, double to, int most, State& state,
                          StepReport& report) {
  begin_part(path, from, to, state);
  double before = from;
  const int first = report.newton_iterations;
  for (int i = 0; i < kMostLooks; ++i) {
    stop_if_asked();
    const int left = most - (report.newton_iterations - first);
    if (left <= 0) return give_up(falls_ > 0 ? moves_on() : kUsed, falls_ == 0);
    if (!solve(path, before, to, left, state, report)) {
      if (!reason().empty()) return false;
      return give_up(
          falls_ > 0 ? moves_on() : "Newton's iteration found no equilibrium with the contacts there",
          falls_ == 0);
    }
    before = to;
    falls_ += is_falling_ ? 1 : 0;
    if (falls_ > (start_touches_ ? kMostTouching : kMostFalls)) return give_up(moves_on());
    if (look_again(to, state, report)) return true;
  }
  return give_up("contact forces had not come to rest after " + std::to_string(kMostLooks) + " searches",
                 true);
}

}  // namespace tissu
