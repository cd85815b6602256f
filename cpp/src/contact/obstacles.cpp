/// Where obstacles are: on their own path, or on a live lead that stands in the memory of a state.

#include <algorithm>
#include <cmath>

#include "tissu/base/error.h"
#include "tissu/base/index.h"
#include "tissu/base/number_text.h"
#include "tissu/contact/contact.h"

namespace tissu {

LivePlace Contact::live_place(std::int32_t obstacle, const State& state, double time) const {
  const LiveLead lead(state.memory[leads_[at(obstacle)]], 0);
  return lead.at(time,
                 lead.is_released() ? description_.obstacles[at(obstacle)].motion.pose(time) : lead.target());
}

const SurfaceCarrier* Contact::carrier_of(std::int32_t obstacle) const {
  const std::int32_t number = surfaces_.surfaces()[description_.bodies.size() + at(obstacle)].carrier;
  return number < 0 ? nullptr : &surfaces_.carriers()[at(number)];
}

Vec3 Contact::place_of(std::int32_t obstacle, const Vec3& rest, const State& state, double time) const {
  if (const SurfaceCarrier* carrier = carrier_of(obstacle); carrier != nullptr) {
    const Vec3 arm = rest - description_.obstacles[at(obstacle)].origin;
    return block(ConstReals(state.positions), carrier->row) + state.rotations[at(carrier->frame)] * arm;
  }
  if (state.memory[leads_[at(obstacle)]].empty()) {
    return description_.obstacles[at(obstacle)].motion.position(rest, time);
  }
  return live_place(obstacle, state, time).position(rest, Vec3::Zero(), Vec3::Zero());
}

Vec3 Contact::normal_of(std::int32_t obstacle, const State& state, double time) const {
  const ObstacleDescription& of = description_.obstacles[at(obstacle)];
  return (place_of(obstacle, of.origin + of.normal, state, time) - place_of(obstacle, of.origin, state, time))
      .normalized();
}

Vec3 Contact::turn_of(std::int32_t obstacle, const State& state, double from, double to) const {
  if (state.memory[leads_[at(obstacle)]].empty()) {
    const Motion& motion = description_.obstacles[at(obstacle)].motion;
    return (motion.angle(to) - motion.angle(from)) * motion.axis;
  }
  const LivePlace before = live_place(obstacle, state, from);
  const LivePlace after = live_place(obstacle, state, to);
  if (before.rotation.coeffs() == after.rotation.coeffs()) return Vec3::Zero();
  return nearest_turn(after.rotation * before.rotation.conjugate(), after.turned - before.turned);
}

Vec3 Contact::carried(std::int32_t obstacle, const Vec3& place, const State& state, double from,
                      double to) const {
  const Vec3 zero = Vec3::Zero();
  Mat3 R;
  const Vec3 then = place_of(obstacle, zero, state, from);
  for (int k = 0; k < 3; ++k) R.col(k) = place_of(obstacle, Vec3::Unit(k), state, from) - then;
  return place_of(obstacle, R.transpose() * (place - then), state, to);
}

Pose Contact::pose_of(std::int32_t obstacle, const State& state, double time) const {
  if (const SurfaceCarrier* carrier = carrier_of(obstacle); carrier != nullptr) {
    const Vec3 origin = description_.obstacles[at(obstacle)].origin;
    const Eigen::AngleAxisd turn(state.rotations[at(carrier->frame)]);
    return {origin, block(ConstReals(state.positions), carrier->row) - origin, turn.axis(), turn.angle()};
  }
  if (state.memory[leads_[at(obstacle)]].empty()) {
    return description_.obstacles[at(obstacle)].motion.pose(time);
  }
  const LiveLead lead(state.memory[leads_[at(obstacle)]], 0);
  const Pose start = lead.start();
  return live_place(obstacle, state, time).pose(start.angle * start.axis);
}

std::int32_t Contact::obstacle_named(std::string_view name) const {
  const auto found = std::ranges::find_if(description_.obstacles, [&](const ObstacleDescription& obstacle) {
    return obstacle.surface.name == name;
  });
  if (found == description_.obstacles.end()) return -1;
  return static_cast<std::int32_t>(found - description_.obstacles.begin());
}

std::int32_t Contact::required(std::string_view name) const {
  const std::int32_t obstacle = obstacle_named(name);
  if (obstacle >= 0) return obstacle;
  throw ParameterError(
      "found obstacle \"" + std::string(name) +
      "\", which this world has not; the name of an obstacle of its description is accepted.");
}

void Contact::begin_way(std::int32_t obstacle, bool released, const Pose& target, double over,
                        State& state) const {
  if (carrier_of(obstacle) != nullptr) {
    throw ParameterError("found obstacle \"" + description_.obstacles[at(obstacle)].surface.name +
                         "\", which has a mass and moves freely; one without a mass is led.");
  }
  if (!(over >= 0.0) || !std::isfinite(over)) {
    throw ParameterError("the way to a live target takes " + number_text(over) +
                         " s; it must be finite and not negative.");
  }
  const Pose start = pose_of(obstacle, state, state.time);
  std::vector<double>& numbers = state.memory[leads_[at(obstacle)]];
  numbers.assign(LiveLead::size(0, 0), 0.0);
  LiveLeadNumbers lead(numbers, 0);
  lead.plan(released, over);
  lead.set_start(start);
  lead.set_target(target);
}

void Contact::lead_to(std::string_view name, const Pose& pose, double over, State& state) const {
  begin_way(required(name), false, pose, over, state);
}

void Contact::release(std::string_view name, double over, State& state) const {
  const std::int32_t obstacle = required(name);
  if (state.memory[leads_[at(obstacle)]].empty()) return;
  begin_way(obstacle, true, description_.obstacles[at(obstacle)].motion.pose(state.time), over, state);
}

bool Contact::is_led_live(std::string_view name, const State& state) const {
  const std::vector<double>& numbers = state.memory[leads_[at(required(name))]];
  return !numbers.empty() && !LiveLead(numbers, 0).is_released();
}

bool Contact::is_any_led_live(const State& state) const {
  return std::ranges::any_of(leads_, [&](std::size_t place) { return !state.memory[place].empty(); });
}

bool Contact::may_add_energy() const {
  const auto is_led = [](const ObstacleDescription& obstacle) { return !obstacle.motion.times.empty(); };
  return description_.method == ContactMethod::penalty || description_.method == ContactMethod::barrier ||
         std::ranges::any_of(description_.obstacles, is_led);
}

void Contact::begin_step(State& state, Scratch& /*scratch*/, double h) const {
  state.memory[parts_].clear();
  for (const std::size_t place : leads_) {
    std::vector<double>& numbers = state.memory[place];
    if (numbers.empty()) continue;
    const LiveLead lead(numbers, 0);
    if (lead.is_released() && lead.is_over(state.time)) {
      numbers.clear();  // on its own path again
    } else {
      LiveLeadNumbers(numbers, 0).begin(state.time, h);
    }
  }
}

void Contact::place_vertices(const State& state, double time, Reals places) const {
  const auto& vertices = surfaces_.vertices();
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const auto number = static_cast<std::int32_t>(v);
    if (vertices[v].is_free()) {
      block(places, number) = place(number, state);
    } else {
      const std::int32_t obstacle = surfaces_.surfaces()[at(vertices[v].surface)].obstacle;
      block(places, number) = place_of(obstacle, block(ConstReals(surfaces_.rest()), number), state, time);
    }
  }
}

}  // namespace tissu
