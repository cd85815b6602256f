#include "tissu/contact/penalty_law.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nearest_pair.h"

namespace tissu {
namespace {

constexpr double kZeta = 0.2;
constexpr double kStop = 0.2;  ///< of the gap: the distance at which a spring is at its end
constexpr int kHalvings = 60;

const ContactPair& pair_of(const Contact& contact, const ContactNumbers& of) {
  return contact.description().pairs[static_cast<std::size_t>(of.pair)];
}

}  // namespace

SpringForce spring_force(PenaltyLaw law, double k, double depth, double range) {
  if (law == PenaltyLaw::linear) return {k * depth, k};
  const double s = std::max(range - depth, 0.5 * range);
  const double k1 = 0.25 * k * range * range;
  return {k1 * (1.0 / s - 1.0 / range) + k * (s - (range - depth)), k1 / (s * s)};
}

double spring_range(const Contact& contact, const ContactNumbers& of) {
  const ContactPair& pair = pair_of(contact, of);
  if (pair.a != pair.b) return pair.gap;
  std::array<Vec3, 4> p{};
  for (std::size_t k = 0; k < 4; ++k) {
    if (of.vertex[k] < 0.0) continue;
    p[k] = block(ConstReals(contact.surfaces().rest()), static_cast<std::int32_t>(of.vertex[k]));
  }
  const auto kind = static_cast<PairKind>(static_cast<int>(of.kind));
  return std::clamp(std::sqrt(nearest_of(kind, p).square) - of.apart, 0.0, pair.gap);
}

double spring_stop(const Contact& contact, const ContactNumbers& of) {
  return of.apart - (1.0 - kStop) * std::min(pair_of(contact, of).gap, of.apart);
}

double damping_of_restitution(double e) {
  double low = 0.0;
  double high = 0.5 * std::numbers::pi;
  for (int i = 0; i < kHalvings; ++i) {
    const double theta = 0.5 * (low + high);
    const double found = std::exp(-std::tan(theta) * (std::numbers::pi - 2.0 * theta));
    (found > e ? low : high) = theta;
  }
  return std::sin(low);
}

double damping_of(const ContactPair& pair) {
  return pair.restitution ? damping_of_restitution(*pair.restitution) : kZeta;
}

}  // namespace tissu
