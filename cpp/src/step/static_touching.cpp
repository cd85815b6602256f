#include "tissu/step/static_touching.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tissu/base/error.h"
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
constexpr double kForce = 1e-3;         ///< of a body's contact forces: a smaller change needs no other look
constexpr double kDepth = 1e-3;         ///< of the gap
constexpr double kFarthest = 0.1;    ///< of the scene's size, which a body that nothing holds falls at once
constexpr double kLooseMass = 1e-6;  ///< of the stiffness of the node that is softest for its mass
constexpr int kHeldNodes = 3;        ///< hold a body, on all axes together
constexpr const char* kMovesOn =
    "a body moves on: neither supports nor contacts hold it, or its equilibrium is unstable; hold it with "
    "`fixed`, or by friction";
constexpr std::uint8_t kAllAxes = FixedDofs::kAllAxes;

/// Whether there are bodies, or separate parts, that supports do not hold.
bool any_loose(const World& world) {
  const Sparsity& sparsity = world.sparsity();
  const std::vector<std::uint8_t>& masks = world.fixed().masks();
  std::vector<std::uint8_t> seen(static_cast<std::size_t>(sparsity.rows()), 0);
  std::vector<std::uint8_t> turns(seen.size(), 0);
  for (const Frame& frame : world.frames()) turns[static_cast<std::size_t>(frame.rotation)] = 1;
  std::vector<std::int32_t> left;
  for (std::int32_t first = 0; first < sparsity.rows(); ++first) {
    if (seen[static_cast<std::size_t>(first)] != 0) continue;
    std::uint8_t axes = 0;
    int held = 0;
    bool carries = false;  // a row that stands alone is nothing
    left.assign(1, first);
    seen[static_cast<std::size_t>(first)] = 1;
    while (!left.empty()) {
      const std::int32_t row = left.back();
      left.pop_back();
      const auto at = static_cast<std::size_t>(row);
      if (turns[at] == 0) axes |= masks[at];
      if (turns[at] == 0 && masks[at] != 0) ++held;
      for (std::int64_t k = sparsity.begin_of(row); k < sparsity.end_of(row); ++k) {
        const std::int32_t other = sparsity.column[static_cast<std::size_t>(k)];
        carries = carries || other != row;
        if (std::exchange(seen[static_cast<std::size_t>(other)], std::uint8_t{1}) == 0) left.push_back(other);
      }
    }
    if (carries && (axes != kAllAxes || held < kHeldNodes)) return true;
  }
  return false;
}

}  // namespace

StaticTouching::StaticTouching(Equilibrium& equilibrium, Profile& profile)
    : equilibrium_(equilibrium),
      profile_(profile),
      contact_(equilibrium.system().make_contact(true)),
      start_(equilibrium.world().rest_state()),
      before_(start_),
      held_(start_),
      is_loose_(any_loose(equilibrium.world())),
      blocks_(3 * start_.positions.size()),
      way_(start_.positions.size()),
      detection_row_(profile.row("contact", "detection")),
      travel_row_(profile.row("contact", "travel")),
      response_row_(profile.row("contact", "response")) {}

bool StaticTouching::give_up(std::string why) {
  reason_ = std::move(why);
  return false;
}

double StaticTouching::largest_part(const LoadPath& path, const State& start) const {
  return 1.0 / std::max(1.0, contact_->run().half_edges_led(start, path.time(1.0)));
}

void StaticTouching::look(const State& at) {
  const Timed timed(profile_, detection_row_);
  other_ = contact_->look(at);
}

int StaticTouching::hold_back(State& to) {
  const Timed timed(profile_, travel_row_);
  return contact_->run().hold_back(to);
}

/// So much of the mass that no node feels it beside its own stiffness.
void StaticTouching::measure_mass() {
  const World& world = equilibrium_.world();
  const std::vector<double>& mass = world.mass().nodal();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < mass.size(); ++i) {
    const double trace = blocks_[9 * i] + blocks_[9 * i + 4] + blocks_[9 * i + 8];
    if (mass[i] > 0.0 && trace > 0.0) least = std::min(least, trace / (3.0 * mass[i]));
  }
  equilibrium_.steady(std::isfinite(least) ? kLooseMass * least : 0.0, kFarthest * world.extent());
}

/// What is led goes where it stands at the share `to`, pushes what is in its way, and is looked at there.
void StaticTouching::begin(const LoadPath& path, double from, double to, State& state) {
  const World& world = equilibrium_.world();
  start_ = state;
  start_touches_ = world.contact()->table(start_).size() > 0;
  start_.time = path.time(from);
  path.set_way(from, to, state, way_);
  held_ = state;
  move(state, world.frames(), way_, 1.0, held_);
  {
    const Timed timed(profile_, detection_row_);
    contact_->begin(start_, path.time(to), held_.positions, {});
  }
  world.contact()->numbers(state).clear();
  equilibrium_.system().assemble(state, 0.0, {-1.0, 0.0, true});
  equilibrium_.system().system_matrix().diagonal_blocks(blocks_);
  contact_->set_matrix(blocks_, 1.0, {});
  tangent_ = relaxed_ = 1.0;
  best_ = std::numeric_limits<double>::infinity();
  idle_ = 0;
  contact_->set_stiffer(kNormal, tangent_);
  if (is_loose_) measure_mass();
  is_falling_ = is_loose_;
  hold_back(held_);
  look(held_);
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
    look(state);
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
  const bool whole = relaxed_ == 1.0 || is_falling_ || other_ <= kForce;
  if (whole) {
    held_ = state;
  } else {
    for (std::size_t i = 0; i < held_.positions.size(); ++i) {
      held_.positions[i] += relaxed_ * (state.positions[i] - held_.positions[i]);
    }
  }
  held_back_ = hold_back(held_);
  look(held_);
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
  tangent_ *= 0.5;
  if (equilibrium_.world().frames().empty()) relaxed_ = std::max(kLeastRelaxed, 0.5 * relaxed_);
  idle_ = 0;
  best_ = other_;
  contact_->set_stiffer(kNormal, tangent_);
}

bool StaticTouching::find(const LoadPath& path, double from, double to, int most, State& state,
                          StepReport& report) {
  is_unstable_ = false;
  falls_ = 0;
  reason_.clear();
  try {
    begin(path, from, to, state);
    return look_until_it_stays(path, from, to, most, state, report);
  } catch (const Interrupted&) {
    throw;
  } catch (const Error& error) {  // of what is led too far, or of values that are not finite
    std::string why = error.what();
    if (why.ends_with('.')) why.pop_back();
    return give_up(why);
  }
}

bool StaticTouching::look_until_it_stays(const LoadPath& path, double before, double to, int most,
                                         State& state, StepReport& report) {
  const int first = report.newton_iterations;
  for (int i = 0; i < kMostLooks; ++i) {
    stop_if_asked();
    const int left = most - (report.newton_iterations - first);
    if (left <= 0) return give_up(falls_ > 0 ? kMovesOn : "all of Newton's iterations were used");
    if (!solve(path, before, to, left, state, report)) {
      if (!reason_.empty()) return false;
      return give_up(falls_ > 0 ? kMovesOn
                                : "Newton's iteration found no equilibrium with the contacts there");
    }
    before = to;
    falls_ += is_falling_ ? 1 : 0;
    if (falls_ > (start_touches_ ? kMostTouching : kMostFalls)) return give_up(kMovesOn);
    if (look_again(to, state, report)) {
      report.contacts = static_cast<int>(contact_->size());
      report.least_gap = contact_->least_gap();
      return true;
    }
  }
  return give_up("contact forces had not come to rest after " + std::to_string(kMostLooks) + " searches");
}

}  // namespace tissu
