#pragma once

/// What every haptic device answers: the counts of its encoders are read, torques are written.

#include <array>
#include <cstddef>
#include <cstdint>

namespace tissu::haptic {

/// Channels of a device, in this order: pitch a, roll b, own rotation psi, depth r, grip c.
inline constexpr std::size_t kChannels = 5;
using Counts = std::array<std::int32_t, kChannels>;
/// One number for each channel: [N m, N m, N m, N, N m] of torques, [rad, rad, rad, m, rad] of positions.
using Channels = std::array<double, kChannels>;

/// Bits of `Sample::flags`.
enum class Flag : std::uint16_t {
  homed = 1,    ///< the zero of the encoders is known; before, counts mean nothing
  enabled = 2,  ///< the motors have power
  tool_in = 4,  ///< a tool is in the sleeve; `tag` says which
  fault = 8     ///< the device reports a fault of its own
};

/// What a device says at one time.
struct Sample {
  Counts counts{};
  std::int64_t time_ns = 0;    ///< by the device's clock [ns]; may stand still or step back
  std::uint32_t sequence = 0;  ///< of the frame; wraps
  std::uint16_t flags = 0;     ///< of `Flag`
  std::uint64_t tag = 0;       ///< of the tool; 0 where there is none

  [[nodiscard]] bool has(Flag flag) const noexcept { return (flags & static_cast<std::uint16_t>(flag)) != 0; }
};

/// What the motors are to do until the next command, or until the watchdog ends.
struct Command {
  Channels torque{};               ///< on the joints, from the motors [N m, N m, N m, N, N m]
  std::uint32_t sequence = 0;      ///< of the sample that is answered
  std::uint16_t watchdog_ms = 20;  ///< the device cuts its motors this long after the last command [ms]
  bool enable = false;             ///< false: no power, whatever `torque` says
};

enum class DeviceStatus : std::uint8_t {
  ok,
  none,    ///< no new sample within the device's bound, or the command was not taken; the sample is unchanged
  broken,  ///< something came that is not a frame: its magic, length or checksum is wrong
  gone     ///< the device is not there any more; it has to be opened again
};

/// What a device is. Constant while it is open.
struct DeviceInfo {
  int axes = 4;                   ///< channels that have a motor: the first `axes`
  Channels count_size{};          ///< position of one count, Delta [rad, rad, rad, m, rad]; above 0
  Channels torque_limit{};        ///< largest torque of each motor [N m, N m, N m, N, N m]; 0: no motor
  std::int32_t turn_counts = 0;   ///< own rotation starts again after so many counts; 0: its counts go on
  double rate = 1000.0;           ///< samples a second that it gives [Hz]
  double delay = 0.0;             ///< from `read` to the torque on the joint, as measured [s]
  bool torque_confirmed = false;  ///< true: samples say that the last command was taken
};

/// A device. `read` and `write` are called by one thread, at the rate of the ticks: they allocate nothing,
/// throw nothing, and return within the time that the device is opened with.
class Device {
 public:
  Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  Device(Device&&) = delete;
  Device& operator=(Device&&) = delete;
  virtual ~Device() = default;

  /// The newest sample. `sample` is written only where `ok` is returned.
  virtual DeviceStatus read(Sample& sample) noexcept = 0;
  virtual DeviceStatus write(const Command& command) noexcept = 0;
  [[nodiscard]] virtual DeviceInfo info() const noexcept = 0;
};

}  // namespace tissu::haptic
