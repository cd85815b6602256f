#include <algorithm>

#include "haptic/tick_parts.h"

namespace tissu::haptic {
namespace {

constexpr int kFailures = 5;       // reads or writes in a row
constexpr int kNotFinite = 3;      // models or torques in a row
constexpr int kOtherTag = 20;      // samples in a row: one misread tag is noise
constexpr int kLate = 5;           // ticks in a row that a loop may miss
constexpr double kReturn = 0.002;  // [m]: a tool is in again so far below where it was out

/// What ends in `fault`, in the order of what is named first.
Reason fault_of(const TickInput& input, const Memory& m) noexcept {
  if (m.failed_reads >= kFailures || input.read == DeviceStatus::gone) return Reason::reads_failed;
  if (m.failed_writes >= kFailures || input.written == DeviceStatus::gone) return Reason::writes_failed;
  if (m.has_sample && m.sample.has(Flag::fault)) return Reason::device_fault;
  if (m.bad_models >= kNotFinite || m.bad_torques >= kNotFinite) return Reason::not_finite;
  return Reason::none;
}

/// What ends in `held`.
Reason hold_of(const Settings& settings, const TickInput& input, const Motion& motion,
               const Memory& m) noexcept {
  if (motion.fast) return Reason::too_fast;
  if (m.other_tag >= kOtherTag) return Reason::tag_changed;
  if (input.late > kLate) return Reason::late;
  if (model_age(input, m) > settings.stall + settings.fade) return Reason::model_stalled;
  return Reason::none;
}

bool has_tool(const Settings& settings, const Memory& m, double depth) noexcept {
  return m.sample.has(Flag::tool_in) && m.sample.has(Flag::enabled) &&
         m.q[3] >= settings.joints.low[3] + depth;
}

void watch_tag(const Motion& motion, Memory& m) noexcept {
  if (!motion.fresh) return;
  m.other_tag = m.sample.tag == m.tag || !m.sample.has(Flag::tool_in) ? 0 : m.other_tag + 1;
}

/// The newest model is taken whatever was there before; K_c begins at 0 with the proxy at the device.
void enter_free(Memory& m) noexcept {
  m.model = LocalModel{};
  m.rows = ModelRows{};
  m.tag = m.sample.tag;
  m.other_tag = 0;
  m.ramp = 0.0;
  m.reason = Reason::none;
  m.state = State::free;
}

void go_on(const Settings& settings, const TickInput& input, const Motion& motion, Memory& m) noexcept {
  switch (m.state) {
    case State::off:
    case State::homing:
      m.state = m.homed ? State::empty : State::homing;
      m.reason = Reason::none;
      return;
    case State::empty:
      if (motion.fresh && settings.tag != 0 && m.sample.tag == settings.tag &&
          has_tool(settings, m, kReturn)) {
        enter_free(m);
      }
      return;
    case State::free:
    case State::contact:
      watch_tag(motion, m);
      if (!has_tool(settings, m, 0.0) || settings.tag != m.tag) {
        m.state = State::empty;
      } else if (const Reason reason = hold_of(settings, input, motion, m); reason != Reason::none) {
        m.state = State::held;
        m.reason = reason;
      }
      return;
    case State::held:
      if (m.acknowledged != settings.acknowledged ||
          (m.reason == Reason::model_stalled && model_age(input, m) <= settings.stall) ||
          (m.reason == Reason::tag_changed && !m.sample.has(Flag::tool_in))) {
        m.state = State::empty;
        m.reason = Reason::none;
      }
      return;
    case State::fault:
      return;
  }
}

}  // namespace

double model_age(const TickInput& input, const Memory& m) noexcept {
  const bool newer = input.model != nullptr && input.model->stamp != 0;
  if (!newer && m.model.stamp == 0) return 0.0;
  const std::int64_t made = newer ? input.model->time_ns : m.model.time_ns;
  return std::max(0.0, static_cast<double>(input.now_ns - made) * 1e-9);
}

void change_state(const Settings& settings, const TickInput& input, const Motion& motion,
                  Memory& m) noexcept {
  if (!settings.run) {
    m.state = State::off;
    m.reason = Reason::none;
    m.failed_reads = m.failed_writes = m.bad_models = m.bad_torques = 0;
    m.homing_way = -1.0;
    m.blocked = false;
    m.still = {};
  } else if (const Reason reason = fault_of(input, m); m.state != State::fault && reason != Reason::none) {
    m.state = State::fault;
    m.reason = reason;
    m.homed = false;  // what is plugged in again has to say where it is
  } else if (!m.homed && m.state != State::fault) {
    m.state = State::homing;
    m.reason = m.blocked ? Reason::ends_not_found : Reason::none;
  } else {
    go_on(settings, input, motion, m);
  }
  m.acknowledged = settings.acknowledged;
}

}  // namespace tissu::haptic
