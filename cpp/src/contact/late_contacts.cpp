/// Contacts that begin late: pairs of one surface that are nearer than they rest before they are a contact.
///
/// Near a crease, the material itself holds the two layers nearer than their thickness. An edge of one and an
/// edge of the other do not form a contact there while a face of the fan lies between them. They form one
/// when that face turns a little. If such a contact pushed them apart to the thickness, it would do so in one
/// step, with an energy that grows with the inverse of the square of its length.

#include <algorithm>
#include <cmath>

#include "nearest_pair.h"
#include "tissu/contact/candidates.h"
#include "tissu/contact/contact_run.h"

namespace tissu {
namespace {

std::size_t at(double i) { return static_cast<std::size_t>(i); }

constexpr int kNearby = 3;          ///< edges
constexpr double kBesideCut = 1.5;  ///< of the distance at which they rest: edges of a cut begin so far apart
constexpr double kLate = 0.1;  ///< of the gap: what is deeper at the start of a step and no contact is late

}  // namespace

double ContactRun::distance_at_begin(const ContactNumbers& contact) const {
  if (contact.point > 0.0) return reach(contact, from_).norm();
  const auto kind = static_cast<PairKind>(static_cast<int>(contact.kind));
  std::array<Vec3, 4> p{};
  for (int k = 0; k < vertices_of(kind); ++k) {
    const auto i = static_cast<std::size_t>(k);
    p[i] = block(ConstReals(from_), static_cast<std::int32_t>(contact.vertex[i]));
  }
  return std::sqrt(nearest_of(kind, p).square);
}

/// The two features are at most three edges from each other along the surface, or across a cut.
bool ContactRun::is_in_crease(const ContactNumbers& contact) const {
  const SurfaceSet& surfaces = contact_.surfaces();
  const ConstReals rest(surfaces.rest());
  const auto is_other = [&](std::int32_t vertex) {
    for (std::size_t k = 0; k < 4; ++k) {
      if (contact.vertex[k] < 0.0 || contact.is_of_first(k)) continue;
      const auto own = static_cast<std::int32_t>(contact.vertex[k]);
      if ((block(rest, vertex) - block(rest, own)).norm() <= kBesideCut * contact.apart) return true;
    }
    return false;
  };
  const auto is_near = [&](const auto& self, std::int32_t vertex, int edges) -> bool {
    if (is_other(vertex)) return true;
    if (edges == 0) return false;
    return std::ranges::any_of(surfaces.neighbours(vertex),
                               [&](std::int32_t end) { return self(self, end, edges - 1); });
  };
  for (std::size_t i = 0; i < 4; ++i) {
    if (contact.vertex[i] < 0.0 || !contact.is_of_first(i)) continue;
    if (is_near(is_near, static_cast<std::int32_t>(contact.vertex[i]), kNearby)) return true;
  }
  return false;
}

void ContactRun::rest_where_begun() {
  const auto& pairs = contact_.description().pairs;
  for (std::size_t i = 0; i < looked_.size(); ++i) {
    ContactNumbers& c = looked_[i];
    const ContactPair& pair = pairs[at(c.pair)];
    if (pair.a != pair.b) continue;
    const ContactNumbers* before = acting(c);
    const bool late = before == nullptr && (gaps_[i] < 0.0 || predicted_[i] != 0);
    if (!late && !(before != nullptr && before->apart < c.apart)) continue;
    const double begun = distance_at_begin(c);
    const bool deep = begun < c.apart - kLate * std::min(pair.gap, c.apart);
    if (late && !(deep && is_in_crease(c))) continue;
    const double rests = std::min(c.apart, late ? begun : std::max(before->apart, begun));
    gaps_[i] += c.apart - rests;
    c.apart = rests;
    predicted_[i] = vector_of(c.normal).dot(reach(c, goal_)) < rests ? 1 : 0;
  }
}

}  // namespace tissu
