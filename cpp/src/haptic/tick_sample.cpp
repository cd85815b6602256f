#include <algorithm>
#include <cmath>

#include "haptic/tick_parts.h"

namespace tissu::haptic {
namespace {

/// The channel of each joint: a, b, psi, r.
double position(const Settings& settings, const Memory& m, int joint) noexcept {
  const auto channel = static_cast<std::size_t>(joint);
  const double count =
      joint == 2 ? static_cast<double>(m.turn) : static_cast<double>(m.sample.counts[channel]);
  return m.zero[joint] + count * settings.count_size[joint];
}

/// Counts of own rotation since the last sample; they wrap as 32-bit numbers do, or after a turn.
std::int64_t turned(const Settings& settings, std::int32_t now, std::int32_t before) noexcept {
  const auto wrapped =
      static_cast<std::int32_t>(static_cast<std::uint32_t>(now) - static_cast<std::uint32_t>(before));
  if (settings.turn_counts <= 0) return wrapped;
  const double turns = std::round(static_cast<double>(wrapped) / settings.turn_counts);
  return wrapped - static_cast<std::int64_t>(turns) * settings.turn_counts;
}

constexpr double kTravel = 0.02;  ///< of the travel between its ends: an axis that went less was held

/// Driven axes that do not move any more stand at their ends, unless something holds them. So they go from
/// one end to the other, and the way between has to be that between the ends.
void watch_homing(const Settings& settings, const Counts& before, Memory& m) noexcept {
  const auto wanted = static_cast<std::int32_t>(settings.homing_still / settings.period);
  bool all = true;
  for (const int joint : {0, 1, 3}) {
    const auto i = static_cast<std::size_t>(joint);
    if (settings.homing_torque[joint] == 0.0) return;  // the hand drives: the device says when
    m.still[i] = std::abs(m.sample.counts[i] - before[i]) > 1 ? 0 : m.still[i] + 1;
    all = all && m.still[i] >= wanted;
  }
  if (!all) return;
  m.still = {};
  const bool first = m.homing_way < 0.0;
  m.homing_way = -m.homing_way;
  bool whole = true;
  for (const int joint : {0, 1, 3}) {
    const double place = m.sample.counts[static_cast<std::size_t>(joint)] * settings.count_size[joint];
    if (first) {
      m.first_end[joint] = place;
      continue;
    }
    const bool high = settings.homing_torque[joint] > 0.0;
    const double travel = settings.ends.high[joint] - settings.ends.low[joint];
    const double gone = (high ? 1.0 : -1.0) * (place - m.first_end[joint]);
    whole = whole && std::abs(gone - travel) <= kTravel * travel;
    m.zero[joint] = (high ? settings.ends.high[joint] : settings.ends.low[joint]) - place;
  }
  if (first) return;
  m.blocked = !whole;
  if (!whole) return;
  m.zero[2] = -static_cast<double>(m.turn) * settings.count_size[2];  // own rotation has no end
  m.homed = true;
}

}  // namespace

Motion take_sample(const Kinematics& kinematics, const Settings& settings, const TickInput& input, Memory& m,
                   TickReport& report) noexcept {
  Motion motion;
  m.failed_writes = input.written == DeviceStatus::ok ? 0 : m.failed_writes + 1;
  if (input.read != DeviceStatus::ok) {
    ++m.failed_reads;
    return motion;
  }
  motion.fresh = true;
  report.clock_back = m.has_sample && input.sample.time_ns < m.sample.time_ns;
  const Counts before = m.has_sample ? m.sample.counts : input.sample.counts;
  m.turn =
      m.has_sample ? m.turn + turned(settings, input.sample.counts[2], before[2]) : input.sample.counts[2];
  m.sample = input.sample;
  const bool was_homed = m.homed;
  // A device that knew its zero and does not any more has lost it: it was switched off and on, say.
  if (m.sample.has(Flag::homed) || m.device_homed) m.homed = m.sample.has(Flag::homed);
  m.device_homed = m.sample.has(Flag::homed);
  if (m.state == State::homing && !m.homed) watch_homing(settings, before, m);
  Joints q;
  for (int i = 0; i < kJoints; ++i) q[i] = position(settings, m, i);
  const int gap = m.failed_reads + std::max(0, input.late);  // periods without a sample before this one
  m.failed_reads = 0;
  if (!m.has_sample || m.homed != was_homed) {
    m.window.clear();
  } else {
    motion.dq = q - m.q;
    if (gap > 0) m.window.clear();  // its samples stand one period apart
    const double speed =
        least_tip_speed(kinematics, q, motion.dq, settings.count_size, settings.period * (1 + gap));
    motion.fast = m.homed && speed > settings.limits.speed;
  }
  m.q = q;
  m.has_sample = true;
  m.window.add(q);
  motion.speed = m.window.speeds(settings.count_size, settings.period);
  return motion;
}

}  // namespace tissu::haptic
