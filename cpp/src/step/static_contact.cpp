#include "tissu/step/static_contact.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "tissu/base/error.h"
#include "tissu/base/interruption.h"
#include "tissu/step/static_barrier.h"
#include "tissu/step/static_touching.h"

namespace tissu {
namespace {

constexpr double kFarthest = 0.1;    ///< of the scene's size, which a body that nothing holds falls at once
constexpr double kLooseMass = 1e-6;  ///< of the stiffness of the node that is softest for its mass
constexpr int kHeldNodes = 3;        ///< hold a body, on all axes together
constexpr std::uint8_t kAllAxes = FixedDofs::kAllAxes;

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

std::unique_ptr<StaticContact> StaticContact::make(Equilibrium& equilibrium, Profile& profile) {
  if (equilibrium.world().contact()->description().method == ContactMethod::barrier) {
    return std::make_unique<StaticBarrier>(equilibrium, profile);
  }
  return std::make_unique<StaticTouching>(equilibrium, profile);
}

StaticContact::StaticContact(Equilibrium& equilibrium, Profile& profile, ContactMethod method)
    : equilibrium_(equilibrium),
      profile_(profile),
      contact_(equilibrium.system().make_contact(true, method)),
      start_(equilibrium.world().rest_state()),
      held_(start_),
      is_loose_(any_loose(equilibrium.world())),
      blocks_(3 * start_.positions.size()),
      way_(start_.positions.size()),
      detection_row_(profile.row("contact", "detection")),
      travel_row_(profile.row("contact", "travel")) {}

std::string_view StaticContact::moves_on() {
  return "a body moves on: neither supports nor contacts hold it, or its equilibrium is unstable; hold it "
         "with `fixed`, or by friction";
}

bool StaticContact::give_up(std::string_view why, bool no_end) {
  reason_ = why;
  found_no_end_ = no_end;
  return false;
}

double StaticContact::largest_part(const LoadPath& path, const State& start) const {
  return 1.0 / std::max(1.0, contact_->run().half_edges_led(start, path.time(1.0)));
}

double StaticContact::look(const State& at) {
  const Timed timed(profile_, detection_row_);
  return contact_->look(at);
}

int StaticContact::hold_back(State& to) {
  const Timed timed(profile_, travel_row_);
  return contact_->run().hold_back(to);
}

void StaticContact::measure_mass() {
  const std::vector<double>& mass = world().mass().nodal();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < mass.size(); ++i) {
    const double trace = blocks_[9 * i] + blocks_[9 * i + 4] + blocks_[9 * i + 8];
    if (mass[i] > 0.0 && trace > 0.0) least = std::min(least, trace / (3.0 * mass[i]));
  }
  farthest_ = kFarthest * world().extent();
  equilibrium_.steady(std::isfinite(least) ? kLooseMass * least : 0.0, farthest_);
}

void StaticContact::begin(const LoadPath& path, double from, double to, State& state) {
  start_ = state;
  start_.time = path.time(from);
  path.set_way(from, to, state, way_);
  held_ = state;
  move(state, world().frames(), way_, 1.0, held_);
  {
    const Timed timed(profile_, detection_row_);
    contact_->begin(start_, path.time(to), held_, {});
  }
  world().contact()->numbers(state).clear();
  equilibrium_.system().assemble(state, 0.0, {-1.0, 0.0, true});
  equilibrium_.system().system_matrix().diagonal_blocks(blocks_);
  contact_->set_matrix(blocks_, 1.0, {});
  if (is_loose_) measure_mass();
}

bool StaticContact::find(const LoadPath& path, double from, double to, int most, State& state,
                         StepReport& report) {
  is_unstable_ = found_no_end_ = false;
  reason_.clear();
  try {
    if (!seek(path, from, to, most, state, report)) return false;
    report.contacts = static_cast<int>(contact_->size());
    report.least_gap = contact_->least_gap();
    return true;
  } catch (const Interrupted&) {
    throw;
  } catch (const Error& error) {  // of what is led too far, or of values that are not finite
    std::string why = error.what();
    if (why.ends_with('.')) why.pop_back();
    return give_up(why);
  }
}

}  // namespace tissu
