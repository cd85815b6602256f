#include "tissu/haptic/velocity.h"

#include <algorithm>
#include <cmath>

namespace tissu::haptic {

void PositionWindow::add(double position) noexcept {
  newest = (newest + 1) % kWindow;
  q[static_cast<std::size_t>(newest)] = position;
  count = std::min(count + 1, kWindow);
}

double PositionWindow::speed(double count_size, double period) const noexcept {
  const auto back = [&](int i) { return q[static_cast<std::size_t>((newest - i + kWindow) % kWindow)]; };
  const double noise = count_size * (1.0 + 1e-9);  // one count more or less, and round-off
  double best = 0.0;
  for (int n = 1; n < count; ++n) {
    const double slope = (back(0) - back(n)) / n;
    for (int j = 1; j < n; ++j) {
      if (std::abs(back(0) - slope * j - back(j)) > noise) return best / period;
    }
    best = slope;
  }
  return best / period;
}

void VelocityWindows::clear() noexcept {
  for (PositionWindow& window : joint) window.clear();
}

void VelocityWindows::add(const Joints& q) noexcept {
  for (std::size_t i = 0; i < joint.size(); ++i) joint[i].add(q[static_cast<int>(i)]);
}

Joints VelocityWindows::speeds(const Joints& count_size, double period) const noexcept {
  Joints v;
  for (int i = 0; i < kJoints; ++i) v[i] = joint[static_cast<std::size_t>(i)].speed(count_size[i], period);
  return v;
}

}  // namespace tissu::haptic
