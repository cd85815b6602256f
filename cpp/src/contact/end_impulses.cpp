#include "tissu/contact/end_impulses.h"

#include <algorithm>
#include <cmath>

#include "tissu/contact/explicit_contact.h"

namespace tissu {
namespace {

constexpr int kSweeps = 50;
constexpr double kSettled = 1e-9;  ///< of the largest impulse: a smaller change ends the sweeps

}  // namespace

double EndImpulses::relax(const ContactRun& run, const ContactNumbers& contact, Blow& blow, Reals v) const {
  const Vec3 n = vector_of(contact.normal);
  const double rate = n.dot(run.rate(contact, v) + blow.led);
  const double normal = std::max(0.0, blow.normal - rate / blow.weight);
  const double more = normal - blow.normal;
  blow.normal = normal;
  mass_.give(contact, more * n, v);
  if (!(blow.friction > 0.0)) return std::abs(more);
  Vec3 sliding = run.rate(contact, v) + blow.led;
  sliding -= n.dot(sliding) * n;
  const Vec3 along = on_disk(blow.along - sliding / blow.tangent, blow.friction * normal);
  const Vec3 drag = along - blow.along;
  blow.along = along;
  mass_.give(contact, drag, v);
  return std::max(std::abs(more), drag.norm());
}

void EndImpulses::strike(const ContactRun& run, const State& start, double h,
                         std::span<ContactNumbers> contacts, Reals v) {
  blows_.clear();
  mass_.begin(start);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ContactNumbers& c = contacts[i];
    if (!(c.force > 0.0)) continue;
    const Mat3 W = mass_.mobility(c, {});
    const Vec3 n = vector_of(c.normal);
    const double weight = n.dot(W * n);
    if (!(weight > 0.0)) continue;
    const double friction = contact_.description().pairs[static_cast<std::size_t>(c.pair)].friction;
    blows_.push_back({i, friction, weight, largest_of(W), run.led(c) / h});
  }
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    double largest = 0.0;
    double changed = 0.0;
    for (Blow& blow : blows_) {
      changed = std::max(changed, relax(run, contacts[blow.contact], blow, v));
      largest = std::max(largest, blow.normal);
    }
    if (changed <= kSettled * largest) break;
  }
  for (const Blow& blow : blows_) {
    ContactNumbers& c = contacts[blow.contact];
    const Vec3 push = vector_of(c.push) + (blow.normal * vector_of(c.normal) + blow.along) / h;
    c.push = {push.x(), push.y(), push.z()};
  }
}

}  // namespace tissu
