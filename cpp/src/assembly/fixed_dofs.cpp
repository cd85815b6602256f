#include "tissu/assembly/fixed_dofs.h"

#include <algorithm>

namespace tissu {
namespace {

/// Where `time` stands in a table: the entry before it and the share of the way to the next.
std::pair<std::size_t, double> locate(std::span<const double> times, double time) {
  if (time <= times.front()) return {0, 0.0};
  if (time >= times.back()) return {times.size() - 1, 0.0};
  const auto next = static_cast<std::size_t>(std::ranges::upper_bound(times, time) - times.begin());
  return {next - 1, (time - times[next - 1]) / (times[next] - times[next - 1])};
}

}  // namespace

double interpolate(std::span<const double> times, std::span<const double> values, double time,
                   double empty_value) {
  if (times.empty()) return empty_value;
  const auto [i, share] = locate(times, time);
  return share == 0.0 ? values[i] : values[i] + share * (values[i + 1] - values[i]);
}

Vec3 Motion::position(const Vec3& rest, double time) const {
  if (times.empty()) return rest;
  const auto [i, share] = locate(times, time);
  Vec3 displacement = displacements[i];
  if (share != 0.0) displacement += share * (displacements[i + 1] - displacements[i]);
  const double angle = interpolate(times, angles, time, 0.0);
  return center + Eigen::AngleAxisd(angle, axis) * (rest - center) + displacement;
}

void FixedDofs::add(std::span<const std::int32_t> nodes, ConstReals rest_positions, std::uint8_t mask,
                    const Motion& motion) {
  motions_.push_back(motion);
  const auto number = static_cast<std::int32_t>(motions_.size() - 1);
  for (const std::int32_t node : nodes) {
    led_.push_back({node, mask, number, block(rest_positions, node)});
    masks_[static_cast<std::size_t>(node)] |= mask;
    rows_.push_back(node);
  }
  std::ranges::sort(rows_);
  rows_.erase(std::ranges::unique(rows_).begin(), rows_.end());
}

void FixedDofs::set_velocities(ConstReals x, double time, double h, double share, Reals v) const {
  for (const Led& led : led_) {
    const Vec3 target = motions_[static_cast<std::size_t>(led.motion)].position(led.rest, time);
    for (int axis = 0; axis < 3; ++axis) {
      if (((led.mask >> axis) & 1) == 0) continue;
      const auto i = static_cast<std::size_t>(3 * led.node + axis);
      v[i] = share * (target[axis] - x[i]) / h;
    }
  }
}

void FixedDofs::copy(ConstReals from, Reals to) const {
  for (const std::int32_t row : rows_) {
    for (int axis = 0; axis < 3; ++axis) {
      if (((masks_[static_cast<std::size_t>(row)] >> axis) & 1) == 0) continue;
      const auto i = static_cast<std::size_t>(3 * row + axis);
      to[i] = from[i];
    }
  }
}

void FixedDofs::clear(Reals values) const {
  for (const std::int32_t row : rows_) {
    for (int axis = 0; axis < 3; ++axis) {
      if (((masks_[static_cast<std::size_t>(row)] >> axis) & 1) != 0) {
        values[static_cast<std::size_t>(3 * row + axis)] = 0.0;
      }
    }
  }
}

}  // namespace tissu
