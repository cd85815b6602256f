#include "tissu/contact/explicit_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tissu/contact/geometric.h"
#include "tissu/contact/impulse.h"
#include "tissu/contact/penalty.h"

namespace tissu {
namespace {

/// Of the least gap: two things that go no farther than half of this each were seen from the start of the
/// step, or are not too deep at its end. A look sees one gap beyond the distance at which they rest.
constexpr double kUnseen = 1.0 + ExplicitContact::kTooDeep;

}  // namespace

Vec3 on_disk(const Vec3& along, double bound) {
  const double size = along.norm();
  return size > bound ? Vec3(bound / size * along) : along;
}

std::unique_ptr<ExplicitContact> ExplicitContact::make(const Contact& contact, const FixedDofs& fixed,
                                                       const Mass& mass, double frequency) {
  if (contact.description().method == ContactMethod::impulse) {
    return std::make_unique<ImpulseContact>(contact, fixed, mass);
  }
  if (contact.description().method == ContactMethod::geometric) {
    return std::make_unique<GeometricContact>(contact, fixed, mass);
  }
  return std::make_unique<PenaltyContact>(contact, fixed, mass, frequency);
}

ExplicitContact::ExplicitContact(const Contact& contact, const FixedDofs& fixed, const Mass& mass)
    : contact_(contact), mass_(contact, fixed, mass), run_(contact, fixed) {
  const auto is_thick = [](const SurfaceVertex& vertex) { return vertex.radius > 0.0; };
  if (std::ranges::none_of(contact.surfaces().vertices(), is_thick)) return;
  for (const ContactPair& pair : contact.description().pairs) far_ = std::min(far_, kUnseen * pair.gap);
}

void ExplicitContact::begin(const State& start, double end, const State& led) {
  h_ = end - start.time;
  start_ = &start;
  goes_far_ = false;
  mass_.begin(start);
  run_.begin(start, end, led);
  begin_response();
}

void ExplicitContact::finish(State& end) {
  kept_.clear();
  keep(end, kept_);
  least_gap_ = std::numeric_limits<double>::infinity();
  double thick = 0.0;  // how deep things with a thickness are inside each other, as a share of their gap
  for (ContactNumbers& c : kept_) {
    const Vec3 r = contact_.reach(c, end);
    c.place = {r.x(), r.y(), r.z()};
    c.stiffness = {};
    const double along = vector_of(c.normal).dot(r);
    least_gap_ = std::min(least_gap_, along / c.apart);
    const double gap = pair_of(c).gap;
    if (c.apart > gap && along < c.apart - gap) thick = std::max(thick, (c.apart - along) / gap);
  }
  ContactTable::write(kept_, contact_.numbers(end));
  const bool looks = goes_far_ || !contact_.surfaces().carriers().empty();
  depth_ = looks ? std::max(thick, look_at_depth(end)) : thick;
}

double ExplicitContact::look_at_depth(const State& at) {
  run_.detect(at, nullptr);
  double most = 0.0;
  for (std::size_t i = 0; i < run_.looked().size(); ++i) {
    const ContactNumbers& c = run_.looked()[i];
    most = std::max(most, -run_.gap(i) / std::min(c.apart, pair_of(c).gap));
  }
  return most;
}

bool ExplicitContact::is_pressed_in(const State& end) {
  goes_far_ = goes_far_ || (std::isfinite(far_) && 2.0 * run_.longest_way(end) > far_);
  const bool looks = goes_far_ || (strikes_first() && !contact_.surfaces().carriers().empty());
  return looks && look_at_depth(end) > kTooDeep;
}

}  // namespace tissu
