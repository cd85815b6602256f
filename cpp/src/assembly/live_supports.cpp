/// Supports that a run leads in place of their own path: see LiveLead.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tissu/assembly/fixed_dofs.h"
#include "tissu/base/error.h"
#include "tissu/base/number_text.h"

namespace tissu {

LiveSupport& FixedDofs::support_named(std::string_view name) {
  const auto found = std::ranges::find(live_, name, &LiveSupport::name);
  if (found != live_.end()) return *found;
  live_.push_back({std::string(name), 0, {}, {}});
  return live_.back();
}

const LiveSupport& FixedDofs::support(std::string_view name) const {
  const auto found = std::ranges::find(live_, name, &LiveSupport::name);
  if (found != live_.end()) return *found;
  throw ParameterError("found support \"" + std::string(name) +
                       "\", which this world has not; the name of a support of its description is accepted.");
}

const Motion& FixedDofs::own_motion(const LiveSupport& support) const {
  const std::int32_t motion = support.nodes.empty() ? led_rotations_[support.rotations.front()].motion
                                                    : led_[support.nodes.front()].motion;
  return motions_[static_cast<std::size_t>(motion)];
}

LiveLead FixedDofs::lead_of(const LiveSupport& support, const State& state) const {
  return {state.memory[support.place], support.nodes.size()};
}

LivePlace FixedDofs::place_of(const LiveSupport& support, const LiveLead& lead, double time) const {
  return lead.at(time, lead.is_released() ? own_motion(support).pose(time) : lead.target());
}

/// Of node i of a support. On the way back each goes to where its own motion is by then.
Vec3 FixedDofs::position(const LiveSupport& support, const LiveLead& lead, const LivePlace& place,
                         std::size_t i, double time) const {
  const Led& led = led_[support.nodes[i]];
  if (!lead.is_released()) return place.position(led.rest, lead.before(i), lead.after(i));
  Vec3 own = motions_[static_cast<std::size_t>(led.motion)].position(led.rest, time);
  if (place.share == 1.0) return own;
  return place.position(led.rest, lead.before(i), own - place.target.position(led.rest));
}

void FixedDofs::set_live_velocities(const State& from, double time, double h, double share, Reals v) const {
  for (const LiveSupport& support : live_) {
    if (from.memory[support.place].empty()) continue;
    const LiveLead lead = lead_of(support, from);
    const LivePlace place = place_of(support, lead, time);
    for (std::size_t k = 0; k < support.nodes.size(); ++k) {
      const Led& led = led_[support.nodes[k]];
      const Vec3 target = position(support, lead, place, k, time);
      for (int axis = 0; axis < 3; ++axis) {
        if (((led.mask >> axis) & 1) == 0) continue;
        const auto i = static_cast<std::size_t>(3 * led.node + axis);
        v[i] = share * (target[axis] - from.positions[i]) / h;
      }
    }
    if (support.rotations.empty()) continue;
    const Vec3 expected = place.turned - place_of(support, lead, time - h).turned;
    for (std::size_t k = 0; k < support.rotations.size(); ++k) {
      const LedRotation& led = led_rotations_[support.rotations[k]];
      const Quaternion target = place.turn(led.rest, lead.before_turn(k));
      const Quaternion way = target * from.rotations[static_cast<std::size_t>(led.frame)].conjugate();
      block(v, led.block) = share / h * nearest_turn(way, expected);
    }
  }
}

void FixedDofs::set_live_way(const LedWay& way, const State& start, double before, double share,
                             const State& now, Reals change) const {
  const double time = way.time(share);
  for (const LiveSupport& support : live_) {
    if (start.memory[support.place].empty()) continue;
    const LiveLead lead = lead_of(support, start);
    const LivePlace first = place_of(support, lead, way.from);
    const LivePlace place = place_of(support, lead, time);
    for (std::size_t k = 0; k < support.nodes.size(); ++k) {
      const Led& led = led_[support.nodes[k]];
      const Vec3 off =
          block(ConstReals(start.positions), led.node) - position(support, lead, first, k, way.from);
      const Vec3 target = position(support, lead, place, k, time) + (1.0 - share) * off;
      for (int axis = 0; axis < 3; ++axis) {
        if (((led.mask >> axis) & 1) == 0) continue;
        const auto i = static_cast<std::size_t>(3 * led.node + axis);
        change[i] = target[axis] - now.positions[i];
      }
    }
    const Vec3 expected = place.turned - place_of(support, lead, way.time(before)).turned;
    for (std::size_t k = 0; k < support.rotations.size(); ++k) {
      const LedRotation& led = led_rotations_[support.rotations[k]];
      const auto frame = static_cast<std::size_t>(led.frame);
      const Quaternion was = first.turn(led.rest, lead.before_turn(k));
      const Vec3 left = (1.0 - share) * nearest_turn(start.rotations[frame] * was.conjugate(), Vec3::Zero());
      const Quaternion target = turn_by(left) * place.turn(led.rest, lead.before_turn(k));
      block(change, led.block) = nearest_turn(target * now.rotations[frame].conjugate(), expected);
    }
  }
}

double FixedDofs::largest_live_turn(const LedWay& way, const State& start) const {
  double largest = 0.0;
  for (const LiveSupport& support : live_) {
    if (start.memory[support.place].empty()) continue;
    const LiveLead lead = lead_of(support, start);
    const Vec3 turned = place_of(support, lead, way.to).turned - place_of(support, lead, way.from).turned;
    largest = std::max(largest, turned.norm());
  }
  return largest;
}

bool FixedDofs::is_led_live(const State& state) const {
  return std::ranges::any_of(
      live_, [&](const LiveSupport& support) { return !state.memory[support.place].empty(); });
}

bool FixedDofs::is_led_live(std::string_view name, const State& state) const {
  const LiveSupport& found = support(name);
  return !state.memory[found.place].empty() && !lead_of(found, state).is_released();
}

std::vector<std::int32_t> FixedDofs::nodes_of(std::string_view name) const {
  std::vector<std::int32_t> nodes;
  for (const std::size_t i : support(name).nodes) nodes.push_back(led_[i].node);
  return nodes;
}

/// Numbers of a way that begins where the support is, its target still to be written.
LiveLeadNumbers FixedDofs::begin_way(const LiveSupport& support, bool released, double over,
                                     State& state) const {
  if (!(over >= 0.0) || !std::isfinite(over)) {
    throw ParameterError("the way to a live target takes " + number_text(over) +
                         " s; it must be finite and not negative.");
  }
  std::vector<double>& numbers = state.memory[support.place];
  Pose pose = own_motion(support).pose(state.time);
  if (!numbers.empty()) {
    const LiveLead lead = lead_of(support, state);
    const Pose start = lead.start();
    pose = place_of(support, lead, state.time).pose(start.angle * start.axis);
  }
  numbers.assign(LiveLead::size(support.nodes.size(), support.rotations.size()), 0.0);
  LiveLeadNumbers lead(numbers, support.nodes.size());
  lead.plan(released, over);
  lead.set_start(pose);
  lead.set_target(pose);
  for (std::size_t i = 0; i < support.nodes.size(); ++i) {
    const Led& led = led_[support.nodes[i]];
    lead.set_before(i, block(ConstReals(state.positions), led.node) - pose.position(led.rest));
  }
  for (std::size_t k = 0; k < support.rotations.size(); ++k) {
    const LedRotation& led = led_rotations_[support.rotations[k]];
    const Quaternion posed(pose.rotation() * led.rest);
    const Quaternion off = state.rotations[static_cast<std::size_t>(led.frame)] * posed.conjugate();
    lead.set_before_turn(k, nearest_turn(off, Vec3::Zero()));
  }
  return lead;
}

void FixedDofs::lead_to(std::string_view name, const Pose& pose, double over, State& state) const {
  begin_way(support(name), false, over, state).set_target(pose);
}

void FixedDofs::lead_to(std::string_view name, ConstReals positions, double over, State& state) const {
  const LiveSupport& found = support(name);
  if (positions.size() != 3 * found.nodes.size()) {
    throw ParameterError("found " + std::to_string(positions.size() / 3) + " positions for support \"" +
                         found.name + "\"; one for each of its " + std::to_string(found.nodes.size()) +
                         " nodes is accepted.");
  }
  LiveLeadNumbers numbers = begin_way(found, false, over, state);
  const Pose pose = lead_of(found, state).target();
  for (std::size_t i = 0; i < found.nodes.size(); ++i) {
    const Vec3 target = block(positions, static_cast<std::int32_t>(i));
    numbers.set_after(i, target - pose.position(led_[found.nodes[i]].rest));
  }
}

void FixedDofs::release(std::string_view name, double over, State& state) const {
  if (is_led_live(name, state)) begin_way(support(name), true, over, state);
}

std::vector<double> FixedDofs::target_of(std::string_view name, const State& state) const {
  const LiveSupport& found = support(name);
  std::vector<double> result(3 * found.nodes.size());
  for (std::size_t i = 0; i < found.nodes.size(); ++i) {
    const Led& led = led_[found.nodes[i]];
    Vec3 target = motions_[static_cast<std::size_t>(led.motion)].position(led.rest, state.time);
    if (is_led_live(name, state)) {
      const LiveLead lead = lead_of(found, state);
      target = lead.target().position(led.rest) + lead.after(i);
    }
    block(Reals(result), static_cast<std::int32_t>(i)) = target;
  }
  return result;
}

void FixedDofs::claim_memory(MemoryPlaces& places) {
  for (LiveSupport& support : live_) support.place = places.claim("lead of " + support.name, 0);
}

void FixedDofs::keep_places(const FixedDofs& before) {
  for (LiveSupport& support : live_) support.place = before.support(support.name).place;
}

void FixedDofs::begin_step(State& state, double h) const {
  for (const LiveSupport& support : live_) {
    std::vector<double>& numbers = state.memory[support.place];
    if (numbers.empty()) continue;
    const LiveLead lead = lead_of(support, state);
    if (lead.is_released() && lead.is_over(state.time)) {
      numbers.clear();  // on its own path again
    } else {
      LiveLeadNumbers(numbers, support.nodes.size()).begin(state.time, h);
    }
  }
}

void FixedDofs::carry_memory(const FixedDofs& before, const Memory& then, Memory& now) const {
  for (const LiveSupport& support : live_) {
    const auto was = std::ranges::find(before.live_, support.name, &LiveSupport::name);
    if (was != before.live_.end()) now[support.place] = then[was->place];
  }
}

void FixedDofs::check_memory(const State& state) const {
  for (const LiveSupport& support : live_) {
    const std::string text =
        LiveLead::misfit(state.memory[support.place], support.nodes.size(), support.rotations.size());
    if (!text.empty())
      throw ParameterError("the live lead of support \"" + support.name + "\" " + text + ".");
  }
}

}  // namespace tissu
