#pragma once

/// Speeds from counts by first-order adaptive windowing (Janabi-Sharifi, Hayward and Chen, IEEE Trans.
/// Control Systems Technology 8(6), 2000): the longest window over which a straight line through its ends
/// misses no sample by more than one count. Count / T alone has a step of one count in a tick, 0.1 m/s for
/// 0.1 mm at 1 kHz.

#include <array>

#include "tissu/haptic/kinematics.h"

namespace tissu::haptic {

inline constexpr int kWindow = 32;  ///< samples

/// The latest positions of one joint, as a ring.
struct PositionWindow {
  std::array<double, kWindow> q{};
  int newest = 0;
  int count = 0;

  void clear() noexcept { count = 0; }
  void add(double position) noexcept;
  /// The speed [units of q / s]; `count_size` is Delta, `period` T [s]. 0 before there are two samples.
  [[nodiscard]] double speed(double count_size, double period) const noexcept;
};

struct VelocityWindows {
  std::array<PositionWindow, kJoints> joint{};

  void clear() noexcept;
  void add(const Joints& q) noexcept;
  [[nodiscard]] Joints speeds(const Joints& count_size, double period) const noexcept;
};

}  // namespace tissu::haptic
