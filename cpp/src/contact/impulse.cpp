#include "tissu/contact/impulse.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tissu/base/index.h"

namespace tissu {
namespace {

constexpr int kSweeps = 50;
constexpr double kSettled = 1e-6;  ///< of the largest impulse: a smaller change ends the sweeps
constexpr int kLifts = 4;
constexpr double kShallow = 1e-6;  ///< of xi: smaller depths remain, and nearer surfaces count as shut
constexpr double kBounce = 2.0;    ///< times what the step's forces change the rate
constexpr double kSlides = 1.0 - 1e-9;
constexpr double kNever = -std::numeric_limits<double>::infinity();

}  // namespace

ImpulseContact::ImpulseContact(const Contact& contact, const FixedDofs& fixed, const Mass& mass)
    : ExplicitContact(contact, fixed, mass) {
  counts_.assign(fixed.masks().size(), 0);
  moves_.assign(3 * fixed.masks().size(), 0.0);
}

void ImpulseContact::begin_response() {
  blows_.clear();
  given_ = true;
}

void ImpulseContact::add_force(const State& /*at*/, double /*share*/, Reals f) {
  for (const ContactNumbers& c : run_.looked()) {
    const Vec3 force = c.force * vector_of(c.normal) + vector_of(c.drag);
    run_.for_parts(c, [&](const CarriedPart& part) { block(f, part.row) += part.load(force); });
  }
}

void ImpulseContact::begin_blow(Blow& blow, double pushed) const {
  const ContactNumbers& c = blow.contact;
  blow.way.normal = pushed * h_ * c.force;
  blow.way.along = pushed * h_ * vector_of(c.drag);
  blow.end.normal = h_ * c.force;
  blow.end.along = h_ * vector_of(c.drag);
}

void ImpulseContact::find_blows(double pushed) {
  std::vector<Blow> before;
  if (goes_far()) before.swap(blows_);
  blows_.clear();
  for (const ContactNumbers& c : run_.looked()) {
    const ContactPair& pair = pair_of(c);
    const Mat3 W = mass_.mobility(c, {});
    const Vec3 n = vector_of(c.normal);
    const double weight = n.dot(W * n);
    if (!(weight > 0.0)) continue;
    Blow blow{c, c.apart, pair.restitution.value_or(0.0), pair.friction, weight, largest_of(W), {}, {}};
    begin_blow(blow, pushed);
    blows_.push_back(blow);
  }
  const auto key = [](const Blow& blow) { return blow.contact.key(); };
  std::ranges::sort(blows_, {}, key);
  const auto found = static_cast<std::ptrdiff_t>(blows_.size());
  for (Blow& blow : before) {
    if (std::ranges::binary_search(blows_.begin(), blows_.begin() + found, key(blow), {}, key)) continue;
    blow.way = blow.end = {};
    begin_blow(blow, pushed);
    blows_.push_back(blow);
  }
  std::ranges::inplace_merge(blows_, blows_.begin() + found, {}, key);
}

void ImpulseContact::take_back(double pushed, Reals way, Reals end) {
  if (!given_) return;
  given_ = false;
  for (Blow& blow : blows_) {
    const Vec3 n = vector_of(blow.contact.normal);
    blow.way = blow.end = {};
    begin_blow(blow, pushed);
    mass_.give(blow.contact, -blow.way.sum(n), way);
    mass_.give(blow.contact, -blow.end.sum(n), end);
  }
}

double ImpulseContact::relax(const Blow& blow, Impulse& impulse, Reals change) const {
  const ContactNumbers& c = blow.contact;
  const Vec3 n = vector_of(c.normal);
  const double rate = n.dot(run_.rate(c, change));
  const double normal = std::max(0.0, impulse.normal + (impulse.missing - rate) / blow.weight);
  const double more = normal - impulse.normal;
  impulse.normal = normal;
  mass_.give(c, more * n, change);
  if (!(blow.friction > 0.0)) return std::abs(more);
  Vec3 sliding = run_.rate(c, change);
  sliding = impulse.sliding + sliding - n.dot(sliding) * n;
  const Vec3 along = on_disk(impulse.along - sliding / blow.tangent, blow.friction * normal);
  const Vec3 drag = along - impulse.along;
  impulse.along = along;
  mass_.give(c, drag, change);
  return std::max(std::abs(more), drag.norm());
}

void ImpulseContact::solve(Impulse Blow::*of, Reals change) {
  std::ranges::fill(change, 0.0);
  for (Blow& blow : blows_) {
    Impulse& impulse = blow.*of;
    const bool never = impulse.missing == kNever;
    const Vec3 begun = impulse.sum(vector_of(blow.contact.normal));
    if (!given_ && !never) mass_.give(blow.contact, begun, change);
    if (!never) continue;
    if (given_) mass_.give(blow.contact, -begun, change);
    impulse.normal = 0.0;
    impulse.along.setZero();
  }
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    double largest = 0.0;
    double changed = 0.0;
    for (Blow& blow : blows_) {
      Impulse& impulse = blow.*of;
      if (impulse.missing == kNever) continue;
      changed = std::max(changed, relax(blow, impulse, change));
      largest = std::max(largest, impulse.normal);
    }
    if (changed <= kSettled * largest) break;
  }
}

void ImpulseContact::strike_way(ConstReals way, Reals change) {
  for (Blow& blow : blows_) {
    const ContactNumbers& c = blow.contact;
    const Vec3 n = vector_of(c.normal);
    const Vec3 rate = run_.rate(c, way) + run_.led(c) / h_;
    // Where a way was cut the contact is looked at there: its gap at the start is that along the same normal.
    const double gap = n.dot(contact_.reach(c, start()) - run_.led(c)) - blow.apart;
    blow.way.missing = -std::max(gap, 0.0) / h_ - n.dot(rate);
    blow.way.sliding = rate - n.dot(rate) * n;
  }
  solve(&Blow::way, change);
}

/// u* at the end: a bounce, where the contact closed faster than the step's forces alone change its rate.
double ImpulseContact::least_end_rate(const Blow& blow, double after) const {
  if (!(blow.restitution > 0.0)) return 0.0;
  const ContactNumbers& c = blow.contact;
  const double before = vector_of(c.normal).dot(run_.rate(c, start().velocities) + run_.led(c) / h_);
  return -before > kBounce * std::abs(after - before) ? -blow.restitution * before : 0.0;
}

bool ImpulseContact::is_shut(const Blow& blow, const State& end) const {
  const double d = vector_of(blow.contact.normal).dot(contact_.reach(blow.contact, end));
  return d - blow.apart <= kShallow * blow.apart;
}

void ImpulseContact::strike_end(ConstReals velocities, const State& end, Reals change) {
  for (Blow& blow : blows_) {
    const ContactNumbers& c = blow.contact;
    const Vec3 n = vector_of(c.normal);
    blow.end.missing = kNever;
    if (!(blow.way.normal > 0.0 || is_shut(blow, end))) continue;
    const Vec3 rate = run_.rate(c, velocities) + run_.led(c) / h_;
    blow.end.missing = least_end_rate(blow, n.dot(rate)) - n.dot(rate);
    blow.end.sliding = rate - n.dot(rate) * n;
  }
  solve(&Blow::end, change);
}

void ImpulseContact::lift(State& end) {
  for (int i = 0; i < kLifts && lift_once(end); ++i) {
  }
}

/// Every row takes the mean of what its contacts ask for. False where none is deep.
bool ImpulseContact::lift_once(State& end) {
  rows_.clear();
  for (const Blow& blow : blows_) {
    const ContactNumbers& c = blow.contact;
    const Vec3 n = vector_of(c.normal);
    const double depth = blow.apart - n.dot(contact_.reach(c, end));
    if (!(depth > kShallow * blow.apart)) continue;
    run_.for_parts(c, [&](const CarriedPart& part) {
      if (counts_[at(part.row)]++ == 0) {
        rows_.push_back(part.row);
        block(Reals(moves_), part.row).setZero();
      }
      block(Reals(moves_), part.row) += mass_.change(part, depth / blow.weight * n);
    });
  }
  for (const SurfaceRotation& of : contact_.surfaces().rotations()) {
    const int count = counts_[at(of.row)];
    if (count == 0) continue;
    Quaternion& rotation = end.rotations[at(of.frame)];
    rotation = (turn_by(block(ConstReals(moves_), of.row) / count) * rotation).normalized();
    block(Reals(moves_), of.row).setZero();
  }
  for (const std::int32_t row : rows_) {
    block(Reals(end.positions), row) += block(ConstReals(moves_), row) / counts_[at(row)];
    counts_[at(row)] = 0;
  }
  return !rows_.empty();
}

void ImpulseContact::keep(const State& /*end*/, std::vector<ContactNumbers>& kept) {
  for (const Blow& blow : blows_) {
    const Impulse& impulse = blow.end;
    if (!(impulse.normal > 0.0)) continue;
    ContactNumbers c = blow.contact;
    c.force = impulse.normal / h_;
    c.drag = numbers_of(impulse.along / h_);
    c.push = numbers_of(impulse.sum(vector_of(c.normal)) / h_);
    const double bound = blow.friction * impulse.normal;
    c.sliding = bound > 0.0 && impulse.along.norm() >= kSlides * bound ? 1.0 : 0.0;
    kept.push_back(c);
  }
}

}  // namespace tissu
