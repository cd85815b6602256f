#pragma once

/// One tick of the haptic loop: from a sample of the device and the newest model of the tissue to torques.
///
/// A tick is a function of its arguments alone: no clock, heap, lock or system call. The same samples, models
/// and settings give the same bits, stepped or in real time.

#include <cstdint>

#include "tissu/haptic/coupling.h"
#include "tissu/haptic/device.h"
#include "tissu/haptic/limits.h"
#include "tissu/haptic/local_model.h"
#include "tissu/haptic/tank.h"
#include "tissu/haptic/transmission.h"
#include "tissu/haptic/velocity.h"

namespace tissu::haptic {

/// What the trocar is doing. Only `free` and `contact` give force.
enum class State : std::uint8_t {
  off,      ///< no power
  homing,   ///< counts mean nothing yet: driven, or to be driven, to the end stops
  empty,    ///< no tool, or one that the settings do not name
  free,     ///< a tool, no force on it
  contact,  ///< a force on it
  held,     ///< force taken back for a reason that the settings have to acknowledge
  fault     ///< no power until it was off
};

/// Why a trocar is held or in fault.
enum class Reason : std::uint8_t {
  none,
  reads_failed,   ///< 5 in a row, or the device is gone
  writes_failed,  ///< 5 in a row, or the device is gone
  device_fault,   ///< the device says so
  not_finite,     ///< a model or a torque, three ticks in a row
  model_stalled,  ///< no new model for longer than `stall` and the fade; ends with the next model
  too_fast,       ///< the tip moved faster than the limit
  tag_changed,    ///< another tag without the tool having been taken out
  late,           ///< more than 5 ticks late in a row
  ends_not_found  ///< while homing: axes came to rest before both of their ends
};

/// What the controller decides; it changes between two ticks, rarely.
struct Settings {
  bool run = false;                ///< false: off
  std::uint32_t acknowledged = 0;  ///< counted up by the controller: leaves `held`
  std::uint64_t tag = 0;           ///< of the tool that the models are made for; 0: none
  double period = 1e-3;            ///< T [s]
  Joints count_size{1.7453292519943296e-4, 1.7453292519943296e-4, 8.7266462599716477e-4, 1e-4};  ///< Delta
  double grip_size = 8.7266462599716477e-4;   ///< Delta of the grip [rad]
  std::int32_t turn_counts = 0;               ///< as of DeviceInfo
  Joints stiffness{48.0, 48.0, 1.6, 1600.0};  ///< K_c
  Joints damping = Joints::Zero();            ///< virtual damper B; off: it may make a hand active
  JointFriction friction{};
  JointLimits joints{};
  TorqueLimits limits{};
  Transmission transmission{};
  TankSettings tank{};
  SweepLimits sweeps{};
  double tool_mass = 0.0;       ///< carried by the motors, 0: the device is balanced [kg]
  double tool_centre = 0.15;    ///< its centre above the tip [m]
  Vec3 gravity = Vec3::Zero();  ///< port's frame [m/s^2]
  double ramp = 0.3;            ///< K_c from 0 to its value on every entry [s]
  double stale = 0.1;           ///< a model older than max(2 h, 100 ms) is reported [s]
  double stall = 0.5;           ///< older: K_c fades [s]
  double fade = 0.5;            ///< in this time [s]
  JointLimits ends{
      {-0.87266462599716477, -0.87266462599716477, -1e300, 0.0},
      {0.87266462599716477, 0.87266462599716477, 1e300, 0.31}};  ///< where homing comes to a stop
  Joints homing_torque = Joints::Zero();  ///< its sign says to which end at last; 0: the hand drives
  double homing_still = 0.1;              ///< an axis that stood still so long under it is at its end [s]
};

/// Throws ParameterError, all problems in it, where a number is outside what the tick accepts: a rate below
/// 300 Hz or above 10 kHz, a stiffness above what is passive for `delay`, limits that are not above 0, …
void check(const Settings& settings, double delay);

/// What comes into a tick.
struct TickInput {
  DeviceStatus read = DeviceStatus::ok;     ///< of this tick; otherwise the last sample is kept
  DeviceStatus written = DeviceStatus::ok;  ///< of the tick before
  Sample sample{};
  std::int64_t now_ns = 0;            ///< for the age of the model only
  std::int32_t late = 0;              ///< ticks missed in a row before this one
  const LocalModel* model = nullptr;  ///< the newest; null or stamp 0: none
};

/// What a tick says beside its command.
struct TickReport {
  std::int64_t tick = 0;
  State state = State::off;
  Reason reason = Reason::none;
  Joints q = Joints::Zero();
  Joints speed = Joints::Zero();
  double grip = 0.0;  ///< [rad]
  Joints torque =
      Joints::Zero();         ///< that the joints should feel; the command has what the motors need for it
  Vec3 force = Vec3::Zero();  ///< of the tissue on the tool, port's frame [N]
  std::int32_t contacts = 0;  ///< with a force
  double stored = 0.0;        ///< S [J]
  double share = 1.0;         ///< of the newest model's force that is shown; 1 - share is the lag
  double stiffness = 0.0;     ///< share of K_c
  double tank = 0.0;          ///< E_t [J]
  double given_out = 0.0;     ///< W_out [J]
  std::int32_t sweeps = 0;
  double change = 0.0;     ///< of the last sweep
  double model_age = 0.0;  ///< [s]
  bool stale = false;
  bool limited = false;  ///< torque or force at its limit
  bool slewed = false;
  bool clock_back = false;    ///< the device's time stepped back; nothing is computed from it
  std::uint64_t stamp = 0;    ///< of the model in use
  double disagreement = 0.0;  ///< |mean force over the last slow step - the slow step's| [N]
  std::uint64_t tag = 0;
};

/// What a tick remembers. Filled by `start`, changed by `tick` only.
struct Memory {
  std::int64_t tick = 0;
  State state = State::off;
  Reason reason = Reason::none;
  std::uint32_t acknowledged = 0;
  // samples
  Sample sample{};
  bool has_sample = false;
  std::int32_t failed_reads = 0, failed_writes = 0, bad_models = 0, bad_torques = 0, other_tag = 0;
  std::uint64_t tag = 0;         ///< of the tool that is in
  std::int64_t turn = 0;         ///< counts of own rotation that go on where the device's start again
  Joints zero = Joints::Zero();  ///< q of count 0
  bool homed = false;
  bool device_homed = false;  ///< the device said so in the last sample
  std::array<std::int32_t, kJoints> still{};
  double homing_way = -1.0;           ///< times the torque of homing: -1 to the first end, 1 to the last
  Joints first_end = Joints::Zero();  ///< where the axes came to rest first, by their counts alone
  bool blocked = false;               ///< they have come to rest before their ends
  Joints q = Joints::Zero();
  VelocityWindows window{};
  // model and coupling
  LocalModel model{};
  ModelRows rows{};
  Rows lambda = Rows::Zero();
  Rows slip = Rows::Zero();   ///< added to b: contacts that slipped, and open ones, which go along
  Rows shift = Rows::Zero();  ///< added to b: slip, and what the tank has not paid
  std::uint64_t refused = 0;  ///< stamp of the newest model that was not finite
  double scale = 0.0;         ///< share of K_c in use
  double ramp = 0.0;          ///< from 0 to 1 after an entry
  double stored = 0.0;        ///< S after the last tick
  double share = 1.0;
  Tank tank{};
  // torques
  Joints torque = Joints::Zero();  ///< after all limits, without weight and compensation
  Joints paid = Joints::Zero();    ///< the same with compensation: what counts as work
  // agreement of fast and slow
  Vec3 force_sum = Vec3::Zero();
  std::int64_t force_ticks = 0;
  double disagreement = 0.0;
};

/// The memory before the first tick.
Memory start(const Settings& settings) noexcept;

/// One tick. `memory` goes from the last tick to this one.
Command tick(const Kinematics& kinematics, const Settings& settings, const TickInput& input, Memory& memory,
             TickReport& report) noexcept;

}  // namespace tissu::haptic
