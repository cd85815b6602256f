#include "tissu/assembly/fixed_dofs.h"

#include <algorithm>

#include "tissu/base/sort_unique.h"

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
  return center + Eigen::AngleAxisd(angle(time), axis) * (rest - center) + displacement(time);
}

Vec3 Motion::displacement(double time) const {
  if (times.empty()) return Vec3::Zero();
  const auto [i, share] = locate(times, time);
  if (share == 0.0) return displacements[i];
  return displacements[i] + share * (displacements[i + 1] - displacements[i]);
}

double Motion::angle(double time) const { return interpolate(times, angles, time, 0.0); }

void FixedDofs::add(std::span<const std::int32_t> nodes, ConstReals rest_positions, std::uint8_t mask,
                    const Motion& motion, std::string_view name) {
  motions_.push_back(motion);
  const auto number = static_cast<std::int32_t>(motions_.size() - 1);
  if (!name.empty()) {
    for (std::size_t i = 0; i < nodes.size(); ++i) support_named(name).nodes.push_back(led_.size() + i);
  }
  for (const std::int32_t node : nodes) led_.push_back({node, mask, number, block(rest_positions, node)});
  lead(nodes, mask);
}

void FixedDofs::free_rows(std::int32_t first, std::int32_t count) {
  const auto is_among = [&](std::int32_t row) { return row >= first && row < first + count; };
  std::erase_if(led_, [&](const Led& led) { return is_among(led.node); });
  std::erase_if(rows_, is_among);
  std::fill_n(masks_.begin() + first, count, std::uint8_t{0});
}

void FixedDofs::hold_at(std::span<const std::int32_t> rows, ConstReals places) {
  motions_.emplace_back();
  const auto motion = static_cast<std::int32_t>(motions_.size() - 1);
  for (std::size_t i = 0; i < rows.size(); ++i)
    led_.push_back({rows[i], kAllAxes, motion, block(places, static_cast<std::int32_t>(i))});
  lead(rows, kAllAxes);
}

void FixedDofs::add_rotations(std::span<const std::int32_t> blocks, std::span<const std::int32_t> frames,
                              std::span<const Quaternion> rest, const Motion& motion, std::string_view name) {
  motions_.push_back(motion);
  const auto number = static_cast<std::int32_t>(motions_.size() - 1);
  if (!name.empty()) {
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      support_named(name).rotations.push_back(led_rotations_.size() + i);
    }
  }
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    led_rotations_.push_back({blocks[i], frames[i], number, rest[static_cast<std::size_t>(frames[i])]});
  }
  lead(blocks, kAllAxes);
}

void FixedDofs::hold_turning(std::span<const std::int32_t> blocks, std::uint8_t mask) {
  for (const std::int32_t block : blocks) held_turnings_.push_back({block, mask});
  lead(blocks, mask);
}

void FixedDofs::lead(std::span<const std::int32_t> rows, std::uint8_t mask) {
  for (const std::int32_t row : rows) {
    masks_[static_cast<std::size_t>(row)] |= mask;
    rows_.push_back(row);
  }
  sort_unique(rows_);
}

void FixedDofs::set_velocities(const State& from, double time, double h, double share, Reals v) const {
  const ConstReals x = from.positions;
  for (const Led& led : led_) {
    const Vec3 target = motions_[static_cast<std::size_t>(led.motion)].position(led.rest, time);
    for (int axis = 0; axis < 3; ++axis) {
      if (((led.mask >> axis) & 1) == 0) continue;
      const auto i = static_cast<std::size_t>(3 * led.node + axis);
      v[i] = share * (target[axis] - x[i]) / h;
    }
  }
  for (const HeldTurning& held : held_turnings_) {
    for (int axis = 0; axis < 3; ++axis) {
      if (((held.mask >> axis) & 1) != 0) v[static_cast<std::size_t>(3 * held.block + axis)] = 0.0;
    }
  }
  for (const LedRotation& led : led_rotations_) {
    const Motion& motion = motions_[static_cast<std::size_t>(led.motion)];
    const double angle = motion.angle(time);
    const Quaternion target(Eigen::AngleAxisd(angle, motion.axis) * led.rest);
    const Quaternion way = target * from.rotations[static_cast<std::size_t>(led.frame)].conjugate();
    // A way of half a turn has two axes: that of the motion since a step before.
    const Vec3 expected = (angle - motion.angle(time - h)) * motion.axis;
    block(v, led.block) = share / h * nearest_turn(way, expected);
  }
  set_live_velocities(from, time, h, share, v);
}

void FixedDofs::place(const State& from, double h, ConstReals v, State& to) const {
  for (const Led& led : led_) {
    for (int axis = 0; axis < 3; ++axis) {
      if (((led.mask >> axis) & 1) == 0) continue;
      const auto i = static_cast<std::size_t>(3 * led.node + axis);
      to.positions[i] = from.positions[i] + h * v[i];
    }
  }
  for (const LedRotation& led : led_rotations_) {
    const auto k = static_cast<std::size_t>(led.frame);
    to.rotations[k] = (turn_by(h * block(v, led.block)) * from.rotations[k]).normalized();
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
