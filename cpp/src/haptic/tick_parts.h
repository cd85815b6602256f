#pragma once

/// The parts of a tick, in their order.

#include "tissu/haptic/tick.h"

namespace tissu::haptic {

/// What a sample says of the joints.
struct Motion {
  Joints dq = Joints::Zero();     ///< since the last good sample
  Joints speed = Joints::Zero();  ///< windowed
  bool fresh = false;             ///< this tick has a sample
  bool fast = false;              ///< faster than the limit
};

/// Counts to q: `memory.q`, windows, failed reads, homing.
Motion take_sample(const Kinematics& kinematics, const Settings& settings, const TickInput& input,
                   Memory& memory, TickReport& report) noexcept;
/// The state after this tick's sample. Force is dropped on the way out of `free` and `contact`.
void change_state(const Settings& settings, const TickInput& input, const Motion& motion,
                  Memory& memory) noexcept;
/// Torques of the tissue, the end stops and the dampers on the joints, through the tank; 0 where the state
/// gives none.
Joints model_torques(const Kinematics& kinematics, const Settings& settings, const TickInput& input,
                     const Motion& motion, Memory& memory, TickReport& report) noexcept;

inline bool gives_force(State state) noexcept { return state == State::free || state == State::contact; }
/// The model's age [s]; 0 where there is none, or the clock stepped back.
double model_age(const TickInput& input, const Memory& memory) noexcept;

}  // namespace tissu::haptic
