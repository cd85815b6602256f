#include "tissu/contact/bent_ways.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tissu/base/index.h"

namespace tissu {
namespace {

constexpr double kLed = 1.0;        ///< turn in a step [rad] of what is led, beyond which it is divided, …
constexpr double kFree = 1.0;       ///< … of what is free, whose arcs the test of ways knows, …
constexpr double kFreeRound = 2.0;  ///< … and of a free sphere, which sweeps over nothing when it turns
constexpr double kLooked = 0.3;     ///< turn below which the way is taken for straight
constexpr double kInside = 1e-6;    ///< of a step: knots nearer to its ends are there
constexpr double kBetween = 0.25;   ///< turn between two places that are looked at [rad]

/// Where something is in a step, with all that it may reach.
struct Room {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = Vec3::Constant(-std::numeric_limits<double>::infinity());
  void add(const Vec3& place, double reach) {
    low = low.cwiseMin(place - Vec3::Constant(reach));
    high = high.cwiseMax(place + Vec3::Constant(reach));
  }
  [[nodiscard]] bool meets(const Room& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
};

class Ways {
 public:
  Ways(const Contact& contact, const State& state, double h)
      : contact_(contact), surfaces_(contact.surfaces()), state_(state), h_(h) {}

  [[nodiscard]] bool is_bent(std::int32_t obstacle) const {
    const SurfaceCarrier* carrier = contact_.carrier_of(obstacle);
    double angle = 0.0;
    const std::vector<double> times = times_of(obstacle, carrier, angle);
    if (times.empty()) return false;
    const std::int32_t surface = surface_of(obstacle);
    Room room;
    const double excess = walk(obstacle, carrier, times, room);
    if (!meets_something(surface, room)) return false;
    if (carrier != nullptr) return angle > (excess == 0.0 ? kFreeRound : kFree);
    return (angle > kLed && (excess > 0.0 || is_plane(obstacle))) || excess > gap_of(surface);
  }

 private:
  [[nodiscard]] std::int32_t surface_of(std::int32_t obstacle) const {
    return static_cast<std::int32_t>(contact_.description().bodies.size()) + obstacle;
  }
  [[nodiscard]] bool is_plane(std::int32_t obstacle) const {
    return contact_.description().obstacles[at(obstacle)].plane;
  }

  [[nodiscard]] double turn(std::int32_t obstacle, const SurfaceCarrier* carrier, double from,
                            double to) const {
    if (carrier != nullptr)
      return (to - from) * block(ConstReals(state_.velocities), carrier->rotation).norm();
    return contact_.turn_of(obstacle, state_, from, to).norm();
  }

  /// At which its places are looked at, and by which angle it turns in all, to and fro; none: its way is
  /// straight.
  [[nodiscard]] std::vector<double> times_of(std::int32_t obstacle, const SurfaceCarrier* carrier,
                                             double& angle) const {
    const double end = state_.time + h_;
    const std::vector<double>& all = contact_.description().obstacles[at(obstacle)].motion.times;
    const auto first = std::ranges::upper_bound(all, state_.time + kInside * h_);
    const auto last = std::ranges::lower_bound(all, end - kInside * h_);
    const bool knots = carrier == nullptr && first < last;
    if (!knots && turn(obstacle, carrier, state_.time, end) <= kLooked) return {};
    std::vector<double> ends = {state_.time};
    if (knots) ends.insert(ends.end(), first, last);
    ends.push_back(end);
    std::vector<double> times = {state_.time};
    for (std::size_t i = 1; i < ends.size(); ++i) {
      const double turned = turn(obstacle, carrier, ends[i - 1], ends[i]);
      const int parts = std::max(1, static_cast<int>(std::min(std::ceil(turned / kBetween), 64.0)));
      angle += turned;
      for (int k = 1; k < parts; ++k) times.push_back(ends[i - 1] + (ends[i] - ends[i - 1]) * k / parts);
      times.push_back(ends[i]);
    }
    return times;
  }

  [[nodiscard]] Vec3 place(std::int32_t obstacle, const SurfaceCarrier* carrier, const Vec3& rest,
                           double time) const {
    if (carrier == nullptr) return contact_.place_of(obstacle, rest, state_, time);
    const double gone = time - state_.time;
    const Vec3 origin = block(ConstReals(state_.positions), carrier->row);
    const Vec3 velocity = block(ConstReals(state_.velocities), carrier->row);
    const Vec3 spin = block(ConstReals(state_.velocities), carrier->rotation);
    const Vec3 arm = contact_.place_of(obstacle, rest, state_, state_.time) - origin;
    return origin + gone * velocity + turn_by(gone * spin) * arm;
  }

  /// By how much the longest way of its points is longer than straight [m]; `room` is where they come.
  double walk(std::int32_t obstacle, const SurfaceCarrier* carrier, const std::vector<double>& times,
              Room& room) const {
    double longest = 0.0;
    const auto go = [&](const Vec3& rest, double reach) {
      const Vec3 first = place(obstacle, carrier, rest, times.front());
      Vec3 last = first;
      double way = 0.0;
      room.add(first, reach);
      for (const double time : times) {
        const Vec3 now = place(obstacle, carrier, rest, time);
        way += (now - last).norm();
        room.add(now, reach);
        last = now;
      }
      const double straight = (last - first).norm();
      if (way - straight > 1e-9 * (way + straight)) longest = std::max(longest, way - straight);
    };
    if (is_plane(obstacle)) {
      go(contact_.description().obstacles[at(obstacle)].origin, 0.0);
      room.add(Vec3::Zero(), std::numeric_limits<double>::infinity());
      return longest;
    }
    const SurfaceSet::Surface& of = surfaces_.surfaces()[at(surface_of(obstacle))];
    const double gap = gap_of(surface_of(obstacle));
    for (std::int32_t v = of.first_vertex; v < of.last_vertex; ++v) {
      go(block(ConstReals(surfaces_.rest()), v), surfaces_.vertices()[at(v)].radius + gap);
    }
    return longest;
  }

  /// The least one of its pairs.
  [[nodiscard]] double gap_of(std::int32_t surface) const {
    double gap = std::numeric_limits<double>::infinity();
    for (const ContactPair& pair : contact_.description().pairs) {
      if (pair.a == surface || pair.b == surface) gap = std::min(gap, pair.gap);
    }
    return gap;
  }

  [[nodiscard]] bool meets_something(std::int32_t surface, const Room& room) const {
    return std::ranges::any_of(contact_.description().pairs, [&](const ContactPair& pair) {
      if (pair.a != surface && pair.b != surface) return false;
      return room_of(pair.a == surface ? pair.b : pair.a).meets(room);
    });
  }

  /// Of anything else: where it is, and as far around as its fastest point goes.
  [[nodiscard]] Room room_of(std::int32_t surface) const {
    Room room;
    const auto obstacle = surface - static_cast<std::int32_t>(contact_.description().bodies.size());
    if (obstacle >= 0 && is_plane(obstacle)) {
      room.add(Vec3::Zero(), std::numeric_limits<double>::infinity());
      return room;
    }
    double speed = 0.0;
    for (std::size_t i = 0; i < state_.velocities.size(); i += 3) {
      speed = std::max(speed, block(ConstReals(state_.velocities), static_cast<std::int32_t>(i / 3)).norm());
    }
    const SurfaceSet::Surface& of = surfaces_.surfaces()[at(surface)];
    for (std::int32_t v = of.first_vertex; v < of.last_vertex; ++v) {
      const double reach = surfaces_.vertices()[at(v)].radius;
      if (surfaces_.vertices()[at(v)].is_free()) {
        room.add(contact_.place(v, state_), reach + h_ * speed);
        continue;
      }
      const Vec3 rest = block(ConstReals(surfaces_.rest()), v);
      for (const double time : {state_.time, state_.time + h_}) {
        room.add(contact_.place_of(obstacle, rest, state_, time), reach);
      }
    }
    return room;
  }

  const Contact& contact_;
  const SurfaceSet& surfaces_;
  const State& state_;
  double h_;
};

}  // namespace

bool are_ways_bent(const Contact& contact, const State& state, double h) {
  const Ways ways(contact, state, h);
  const auto count = static_cast<std::int32_t>(contact.description().obstacles.size());
  for (std::int32_t obstacle = 0; obstacle < count; ++obstacle) {
    if (ways.is_bent(obstacle)) return true;
  }
  return false;
}

}  // namespace tissu
