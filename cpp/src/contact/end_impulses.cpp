#include "tissu/contact/end_impulses.h"

#include <algorithm>
#include <cmath>

#include "tissu/contact/explicit_contact.h"

namespace tissu {
namespace {

constexpr int kSweeps = 50;
constexpr double kSettled = 1e-9;  ///< of the largest impulse: a smaller change ends the sweeps

}  // namespace

Vec3 EndImpulses::inverse_mass(std::int32_t row) const {
  const auto i = static_cast<std::size_t>(row);
  Vec3 inverse = Vec3::Constant(1.0 / mass_.nodal()[i]);
  for (int axis = 0; axis < 3; ++axis) {
    if (((fixed_.masks()[i] >> axis) & 1) != 0) inverse(axis) = 0.0;
  }
  return inverse;
}

void EndImpulses::give(const ContactRun& run, const ContactNumbers& contact, const Vec3& impulse,
                       Reals v) const {
  for (std::size_t k = 0; k < 4; ++k) {
    const std::int32_t row = run.row_of(contact.vertex[k]);
    if (row >= 0) block(v, row) += contact.beta[k] * inverse_mass(row).cwiseProduct(impulse);
  }
}

double EndImpulses::relax(const ContactRun& run, const ContactNumbers& contact, Blow& blow, Reals v) const {
  const Vec3 n = vector_of(contact.normal);
  const double rate = n.dot(run.rate(contact, v) + blow.led);
  const double normal = std::max(0.0, blow.normal - rate / blow.weight);
  const double more = normal - blow.normal;
  blow.normal = normal;
  give(run, contact, more * n, v);
  if (!(blow.friction > 0.0)) return std::abs(more);
  Vec3 sliding = run.rate(contact, v) + blow.led;
  sliding -= n.dot(sliding) * n;
  const Vec3 along = on_disk(blow.along - sliding / blow.tangent, blow.friction * normal);
  const Vec3 drag = along - blow.along;
  blow.along = along;
  give(run, contact, drag, v);
  return std::max(std::abs(more), drag.norm());
}

void EndImpulses::strike(const ContactRun& run, double h, std::span<ContactNumbers> contacts, Reals v) {
  blows_.clear();
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ContactNumbers& c = contacts[i];
    if (!(c.force > 0.0)) continue;
    Vec3 W = Vec3::Zero();
    for (std::size_t k = 0; k < 4; ++k) {
      const std::int32_t row = run.row_of(c.vertex[k]);
      if (row >= 0) W += c.beta[k] * c.beta[k] * inverse_mass(row);
    }
    const Vec3 n = vector_of(c.normal);
    const double weight = n.dot(W.cwiseProduct(n));
    if (!(weight > 0.0)) continue;
    const double friction = contact_.description().pairs[static_cast<std::size_t>(c.pair)].friction;
    blows_.push_back({i, friction, weight, W.maxCoeff(), run.led(c) / h});
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
