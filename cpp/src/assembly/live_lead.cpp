#include "tissu/assembly/live_lead.h"

#include <algorithm>
#include <cmath>

#include "tissu/base/number_text.h"

namespace tissu {

Pose LivePlace::pose(const Vec3& turned_at_start) const {
  if (share == 1.0) return target;
  const Vec3 whole = nearest_turn(rotation, turned_at_start + turned);
  const double angle = whole.norm();
  return {target.center, origin - target.center, angle > 0.0 ? Vec3(whole / angle) : Vec3::UnitX(), angle};
}

std::size_t LiveLead::size(std::size_t nodes, std::size_t rotations) {
  return kHead + 6 * nodes + 3 * rotations;
}

std::string LiveLead::misfit(std::span<const double> numbers, std::size_t nodes, std::size_t rotations) {
  constexpr double kUnit = 1e-9;  // by which the square of an axis may differ from 1
  if (numbers.empty()) return {};
  if (numbers.size() != size(nodes, rotations)) {
    return "has " + std::to_string(numbers.size()) + " numbers; " + std::to_string(size(nodes, rotations)) +
           " are accepted, or none";
  }
  const bool is_finite = std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); });
  const bool has_mode = numbers[0] == kLed || numbers[0] == kReleased;
  const bool has_way = numbers[3] >= numbers[2] && (numbers[1] == 0.0 || numbers[1] == 1.0);
  const auto is_unit = [&](std::size_t i) {
    const std::size_t axis = i + 6;
    const double square = numbers[axis] * numbers[axis] + numbers[axis + 1] * numbers[axis + 1] +
                          numbers[axis + 2] * numbers[axis + 2];
    return std::abs(square - 1.0) < kUnit;
  };
  if (is_finite && has_mode && has_way && is_unit(kStart) && is_unit(kTarget)) return {};
  return "has numbers that are not those of a live target";
}

void LiveLeadNumbers::plan(bool released, double over) {
  numbers_[0] = released ? LiveLead::kReleased : LiveLead::kLed;
  numbers_[1] = 1.0;
  numbers_[2] = 0.0;
  numbers_[3] = over;
}

void LiveLeadNumbers::begin(double time, double h) {
  if (numbers_[1] == 0.0) return;
  const double over = numbers_[3];
  numbers_[1] = 0.0;
  numbers_[2] = time;
  numbers_[3] = time + (over > 0.0 ? over : h);
}

double LiveLead::share(double time) const {
  if (is_pending() || time <= numbers_[2]) return 0.0;
  return time >= numbers_[3] ? 1.0 : (time - numbers_[2]) / (numbers_[3] - numbers_[2]);
}

Pose LiveLead::pose(std::size_t i) const {
  return {vector(i), vector(i + 3), vector(i + 6), numbers_[i + 9]};
}

void LiveLeadNumbers::set_pose(std::size_t i, const Pose& pose) {
  set_vector(i, pose.center);
  set_vector(i + 3, pose.displacement);
  set_vector(i + 6, pose.axis);
  numbers_[i + 9] = pose.angle;
}

void LiveLeadNumbers::set_vector(std::size_t i, const Vec3& value) {
  for (std::size_t k = 0; k < 3; ++k) numbers_[i + k] = value[static_cast<Eigen::Index>(k)];
}

LivePlace LiveLead::at(double time, const Pose& target) const {
  const Pose first = start();
  const double s = share(time);
  const Quaternion from(first.rotation());
  const Quaternion to(target.rotation());
  // A way of half a turn, or of whole turns, is known by the angles only.
  const Vec3 arc = nearest_turn(to * from.conjugate(), target.angle * target.axis - first.angle * first.axis);
  const Vec3 begin = first.position(target.center);
  const Vec3 end = target.center + target.displacement;
  return {s, target, begin + s * (end - begin), turn_by(s * arc) * from, s * arc};
}

}  // namespace tissu
