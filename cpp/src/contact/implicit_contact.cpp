#include "tissu/contact/implicit_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tissu/contact/augmented.h"
#include "tissu/contact/barrier.h"
#include "tissu/contact/implicit_penalty.h"

namespace tissu {
namespace {

constexpr double kAlternates = 1e-2;  ///< share of the forces that is inadmissible, or changes …
constexpr double kAgain = 1e-2;       ///< … as two looks before, but for this share, …
constexpr int kRounds = 3;            ///< … which counts as so many
constexpr double kBlow = 0.1;         ///< of the gap: what would go deeper in a step is struck

}  // namespace

std::unique_ptr<ImplicitContact> ImplicitContact::make(const Contact& contact, const FixedDofs& fixed,
                                                       const Mass* mass, std::vector<double> rest,
                                                       double extent, ContactMethod method) {
  if (method == ContactMethod::penalty) {
    return std::make_unique<ImplicitPenalty>(contact, fixed, mass, std::move(rest));
  }
  if (method == ContactMethod::barrier) {
    return std::make_unique<BarrierContact>(contact, fixed, extent);
  }
  auto augmented = std::make_unique<AugmentedContact>(contact, fixed);
  if (mass != nullptr) {
    augmented->run().begin_late();
    augmented->step_in_time();
    augmented->run().open_by_shares();
  }
  return augmented;
}

ImplicitContact::ImplicitContact(const Contact& contact, const FixedDofs& fixed)
    : contact_(contact), run_(contact, fixed), fixed_(fixed), bodies_(contact, fixed.masks().size()) {
  counts_.assign(fixed.masks().size(), 0.0);
  run_.hand_over_to_all();
}

void ImplicitContact::begin(const State& start, double end, const State& led, ConstReals load) {
  start_ = &start;
  h_ = end - start.time;
  alternations_ = 0;
  changes_.fill(std::numeric_limits<double>::infinity());
  systems_ = 0;
  whole_ = 1.0;
  bodies_.begin(start, load);
  run_.begin(start, end, led);
}

void ImplicitContact::set_matrix(std::span<const double> blocks, double scale, const ContactStage& stage) {
  blocks_ = blocks;
  stage_ = stage;
  scale_ = scale * stage.stretch * stage.times;
}

void ImplicitContact::set_stiffer(double normal, double tangent) {
  normal_ = normal;
  tangent_ = tangent;
}

double ImplicitContact::look(const State& at) {
  run_.look(at, holds_on());
  shares_.assign(run_.looked().size(), 0.0);
  for (std::size_t i = 0; i < shares_.size(); ++i) shares_[i] = may_press(i) ? 1.0 : 0.0;
  if (has_own_stiffness()) {
    stiffnesses_ = shares_;
  } else {
    find_stiffnesses(blocks_, scale_, shares_, stiffnesses_);
  }
  begin_press();
  press_all();
  change_ = bodies_.change(run_.acting(), pressing_);
  return change_;
}

void ImplicitContact::note_depth(const ContactNumbers& contact, double depth) {
  depth_ = std::max(depth_, depth / std::min(contact.apart, pair_of(contact).gap));
}

void ImplicitContact::update(const State& end) {
  ++systems_;
  changes_ = {change_, changes_[0], changes_[1]};
  bodies_.clear();
  for (ContactNumbers& c : run_.acting()) {
    const Vec3 r = contact_.reach(c, end);
    const Vec3 f = vector_of(c.push) - stiffness_of(c) * (r - vector_of(c.place));
    const Vec3 n = vector_of(c.normal);
    const double normal = n.dot(f);
    c.force = std::max(0.0, normal);
    Vec3 drag = f - normal * n;
    const double bound = pair_of(c).friction * c.force;
    if (drag.norm() > bound) drag *= bound > 0.0 ? bound / drag.norm() : 0.0;
    c.drag = numbers_of(drag);
    const Vec3 left = c.force * n + drag;
    const Vec3 taken = f - left;
    bodies_.add(c, left, taken.norm() > bodies_.round_off(c) ? taken : Vec3::Zero());
  }
  inadmissible_ = bodies_.taken_off();
  if (changes_[0] > kAlternates && std::abs(changes_[0] - changes_[2]) < kAgain * changes_[0]) {
    alternations_ += kRounds;
  } else {
    alternations_ = std::max(0, alternations_ + (inadmissible() > kAlternates ? 1 : -1));
  }
}

/// Where forces are taken r is fixed + J x, and at the end fixed + J x0 + stretch J (x - x0).
void ImplicitContact::write(State& state) const {
  std::vector<double>& numbers = contact_.numbers(state);
  ContactTable::write(run_.acting(), numbers);
  if (stage_.stretch == 1.0 && stage_.times == 1.0) return;
  std::size_t place = 0;
  for (ContactNumbers c : run_.acting()) {
    const Vec3 from = contact_.reach(c, *start_);
    c.place = numbers_of(from + (vector_of(c.place) - from) / stage_.stretch);
    c.push = numbers_of(stage_.times * vector_of(c.push));
    for (double& h : c.stiffness) h *= stage_.times * stage_.stretch;
    ContactTable::write(c, place++, numbers);
  }
}

void ImplicitContact::finish(const State& end, State& into) {
  least_gap_ = std::numeric_limits<double>::infinity();
  deepest_ = 0.0;
  for (ContactNumbers& c : run_.acting()) {
    const Vec3 n = vector_of(c.normal);
    const Vec3 r = contact_.reach(c, end);
    c.push = numbers_of(c.force * n + vector_of(c.drag));
    c.place = numbers_of(r);
    c.stiffness = {};
    least_gap_ = std::min(least_gap_, n.dot(r) / c.apart);
    deepest_ = std::max(deepest_, (c.apart - n.dot(r)) / std::min(c.apart, pair_of(c).gap));
  }
  ContactTable::write(run_.acting(), contact_.numbers(into));
}

bool ImplicitContact::struck() const {
  if (!(h_ > 0.0)) return false;
  return std::ranges::any_of(run_.acting(), [&](const ContactNumbers& c) {
    if (!(c.force > 0.0) || !stops_whole(c)) return false;
    const double way = vector_of(c.normal).dot(h_ * run_.rate(c, start_->velocities) + run_.led(c));
    return -way > kBlow * std::min(c.apart, pair_of(c).gap);
  });
}

void ImplicitContact::strike(EndImpulses& impulses, double h, Reals v, State& into) {
  impulses.strike(run_, *start_, h, run_.acting(), v);
  ContactTable::write(run_.acting(), contact_.numbers(into));
}

void ImplicitContact::add_forces(Reals f) const {
  for (const ContactNumbers& c : run_.acting()) {
    run_.for_parts(c, [&](const CarriedPart& part) { block(f, part.row) += part.load(vector_of(c.push)); });
  }
}

}  // namespace tissu
