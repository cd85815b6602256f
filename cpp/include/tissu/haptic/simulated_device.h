#pragma once

/// A trocar without hardware: a tool with mass and friction, its encoders, motors and line, and a hand on it.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "tissu/haptic/coupling.h"
#include "tissu/haptic/device.h"
#include "tissu/haptic/hand.h"
#include "tissu/haptic/random.h"
#include "tissu/haptic/tool_motion.h"

namespace tissu::haptic {

/// What the mechanism is made of. Masses and friction are assumptions, which a real device's data replace;
/// counts and limits are those of Chendeb 2007, table 5.4.5.
struct MechanismSettings {
  ToolInertia inertia{};
  JointFriction friction{};
  Joints presliding{9e-5, 9e-5, 4e-4,
                    5e-5};             ///< way in which Coulomb's friction builds up (Dahl) [rad, .., m]
  Joints efficiency = Joints::Ones();  ///< eta of each transmission
  Joints blend{1e-3, 1e-3, 1e-2,
               1e-3};             ///< below this speed losses of the transmission fade [rad/s, .., m/s]
  double roller_force = 1e300;    ///< mu N, what the rollers of depth can pass [N]
  bool encoder_on_motor = false;  ///< depth is measured on the motor, which does not see the rollers slip
  Joints low{-0.87266462599716477, -0.87266462599716477, -1e300, 0.0};  ///< mechanical ends
  Joints high{0.87266462599716477, 0.87266462599716477, 1e300, 0.31};
  Joints stop_stiffness{500.0, 500.0, 0.0, 5e4};  ///< of the ends
  Vec3 gravity = Vec3::Zero();                    ///< port's frame [m/s^2]; 0: the tool is balanced
};

/// What lies between the joints and what the loop sees.
struct LineSettings {
  double period = 1e-3;  ///< one `read` lets so much time pass [s]
  int substeps = 20;
  Channels count_size{1.7453292519943296e-4, 1.7453292519943296e-4, 8.7266462599716477e-4, 1e-4,
                      8.7266462599716477e-4};
  Channels torque_limit{6.0, 6.0, 0.2, 5.0, 0.0};
  int torque_bits = 12;       ///< steps of the torque over -limit .. limit; 0: not quantised
  double motor_lag = 0.5e-3;  ///< first order [s]
  double delay = 0.0;         ///< from `read` to the torque's arrival [s]
  double jitter = 0.0;        ///< more, uniform from 0 to this [s]
  double lost = 0.0;          ///< probability that a frame, either way, does not arrive
  double misread_tag = 0.0;   ///< probability that a sample's tag is wrong
  bool unknown_zero = false;  ///< counts start anywhere, and are not homed
  std::uint64_t seed = 1;
};

/// Work and energy since the start [J]: kinetic + potential - their start = motor + hand - friction.
struct DeviceEnergy {
  double kinetic = 0.0;
  double potential = 0.0;  ///< of weight and ends
  double motor = 0.0;      ///< work of the motors on the tool
  double hand = 0.0;       ///< work of the hand on the tool
  double friction = 0.0;   ///< lost, or stored in the bristles
};

/// From `time` on [s] this tool is in; tag 0: none.
struct ToolChange {
  double time = 0.0;
  std::uint64_t tag = 0;
};

class SimulatedDevice final : public Device {
 public:
  /// `q` is where the tool starts. Throws ParameterError where a number is outside what the mechanism can be.
  SimulatedDevice(const MechanismSettings& mechanism, const LineSettings& line, std::optional<Hand> hand,
                  const Joints& q);

  /// Lets one period pass, then answers. `none` where the frame is lost or the device is unplugged.
  DeviceStatus read(Sample& sample) noexcept override;
  DeviceStatus write(const Command& command) noexcept override;
  [[nodiscard]] DeviceInfo info() const noexcept override;

  [[nodiscard]] double time() const noexcept { return time_; }
  [[nodiscard]] const Joints& joints() const noexcept { return state_.q; }
  [[nodiscard]] Joints rates() const noexcept;
  [[nodiscard]] const Joints& motor_torque() const noexcept { return torque_; }
  [[nodiscard]] DeviceEnergy energy() const noexcept;
  /// The spring and the damper of the hand on the tip now [N]; without its inertia.
  [[nodiscard]] Vec3 hand_force() const noexcept;
  /// q of count 0, which the loop does not know where `unknown_zero`.
  [[nodiscard]] const Joints& zero() const noexcept { return zero_; }

  // What happens to a device, between two reads.
  void set_tool(std::uint64_t tag, bool in) noexcept;
  /// The same by script, from the device's own start on. Throws ParameterError where times do not grow.
  void plan_tools(std::vector<ToolChange> changes);
  void set_fault(bool fault) noexcept { fault_ = fault; }
  void unplug() noexcept { plugged_ = false; }
  void plug_in() noexcept;  ///< counts start again from 0, not homed
  void jump(std::size_t channel, std::int32_t counts) noexcept { jumped_[channel] += counts; }
  void step_clock(std::int64_t ns) noexcept { clock_ns_ += ns; }
  void push(const Joints& q, const Joints& v) noexcept;  ///< puts the tool there, at that rate
  /// The hand leaves its path for a place, which it reaches after `over` [s]; see `Hand::aim`. Throws
  /// ParameterError if the device has no hand, a number is not finite, or `over` is negative.
  void aim(const Vec3& tip, double psi, double over);
  void follow() noexcept;  ///< the hand goes on along its path

 private:
  struct Waiting {
    double time = 0.0;  ///< of its arrival
    Channels torque{};
    bool enable = false;
    double watchdog = 0.0;
  };
  static constexpr std::size_t kWaiting = 1024;

  void advance() noexcept;
  void substep(double h) noexcept;
  void take_commands() noexcept;
  void let_go() noexcept;
  [[nodiscard]] Joints motors(double h) noexcept;
  [[nodiscard]] Joints friction(const Joints& v, const Joints& motor, double h,
                                MotionForces* forces) const noexcept;
  [[nodiscard]] Joints ends(const Joints& q, MotionForces* forces) const noexcept;
  [[nodiscard]] Joints hand_torques(const Joints& q, const Joints& v, double time,
                                    MotionForces* forces) const noexcept;
  [[nodiscard]] std::int32_t count(std::size_t channel) const noexcept;

  MechanismSettings mechanism_;
  LineSettings line_;
  std::optional<Hand> hand_;
  Random random_;
  ToolState state_;
  ToolInertia inertia_;        // with the hand's mass while it holds
  Joints v_ = Joints::Zero();  // of the middle of the last substep
  Joints bristle_ = Joints::Zero();
  Joints target_ = Joints::Zero();
  Joints torque_ = Joints::Zero();
  DeviceEnergy work_;
  double time_ = 0.0;
  std::int64_t steps_ = 0;
  bool holding_ = false;
  double slip_ = 0.0;  // of the rollers: motor's depth less the tool's [m]
  double slip_rate_ = 0.0;
  Joints zero_ = Joints::Zero();
  Counts jumped_{};
  std::array<Waiting, kWaiting> waiting_{};
  std::size_t first_ = 0, waits_ = 0;
  double arrival_ = 0.0;  // of the latest command
  double cut_at_ = 0.0;   // the watchdog ends
  bool enabled_ = false, plugged_ = true, homed_ = true, fault_ = false, tool_in_ = true;
  std::uint64_t tag_ = 1;
  std::vector<ToolChange> changes_;
  std::size_t changed_ = 0;  // of them, so far
  std::uint32_t sequence_ = 0;
  std::int64_t clock_ns_ = 0;
};

}  // namespace tissu::haptic
