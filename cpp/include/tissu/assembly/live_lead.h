#pragma once

/// Live targets of supports: where a run leads a support in place of its own path. The numbers stand in the
/// memory of a state, none where a support follows its own path.

#include <Eigen/Geometry>
#include <span>
#include <string>
#include <vector>

#include "tissu/state/state.h"

namespace tissu {

/// A rigid displacement from rest: rotation by `angle` about `axis` through `center`, then displacement.
struct Pose {
  Vec3 center = Vec3::Zero();        ///< [m]
  Vec3 displacement = Vec3::Zero();  ///< [m]
  Vec3 axis = Vec3::UnitX();         ///< of length 1
  double angle = 0.0;                ///< [rad]

  [[nodiscard]] Eigen::AngleAxisd rotation() const { return Eigen::AngleAxisd(angle, axis); }
  [[nodiscard]] Vec3 position(const Vec3& rest) const {
    return center + rotation() * (rest - center) + displacement;
  }
};

/// A support that may be led live: its name, its place in the memory, and its entries of FixedDofs.
struct LiveSupport {
  std::string name;
  std::size_t place = 0;               ///< in State::memory
  std::vector<std::size_t> nodes;      ///< entries of led nodes
  std::vector<std::size_t> rotations;  ///< entries of led rotations
};

/// Where a support that is led live stands at one time: a share of the way from where it was to its target,
/// with its rotation along the arc between the two and the centre of the target's rotation along a line.
struct LivePlace {
  double share;         ///< of the way; 1 at the target
  Pose target;          ///< at that time
  Vec3 origin;          ///< where the centre of the target's rotation is
  Quaternion rotation;  ///< from rest
  Vec3 turned;          ///< since the way began: a rotation vector that counts whole turns

  /// `before` and `after`: displacements beside those of the poses, at the start and at the target.
  [[nodiscard]] Vec3 position(const Vec3& rest, const Vec3& before, const Vec3& after) const {
    if (share == 1.0) return target.position(rest) + after;
    return origin + rotation * (rest - target.center) + (1.0 - share) * before + share * after;
  }
  /// `before`: a rotation vector beside the pose at the start.
  [[nodiscard]] Quaternion turn(const Quaternion& rest, const Vec3& before) const {
    if (share == 1.0) return Quaternion(target.rotation() * rest);
    return turn_by((1.0 - share) * before) * rotation * rest;
  }
  /// The pose that it is in: the next way starts with it.
  [[nodiscard]] Pose pose(const Vec3& turned_at_start) const;
};

/// The numbers of a live lead, read by name.
class LiveLead {
 public:
  /// `numbers`: of a support of so many nodes; `misfit` finds others.
  LiveLead(std::span<const double> numbers, std::size_t nodes) : numbers_(numbers), nodes_(nodes) {}
  [[nodiscard]] static std::size_t size(std::size_t nodes, std::size_t rotations);
  /// Empty, or what is wrong with the numbers.
  [[nodiscard]] static std::string misfit(std::span<const double> numbers, std::size_t nodes,
                                          std::size_t rotations);

  /// On the way back to its own path, or there.
  [[nodiscard]] bool is_released() const { return numbers_[0] == kReleased; }
  /// The way begins with the next step.
  [[nodiscard]] bool is_pending() const { return numbers_[1] != 0.0; }
  [[nodiscard]] bool is_over(double time) const { return !is_pending() && time >= numbers_[3]; }
  [[nodiscard]] Pose start() const { return pose(kStart); }
  [[nodiscard]] Pose target() const { return pose(kTarget); }
  /// Displacement of a node beside the pose at the start, and at the target.
  [[nodiscard]] Vec3 before(std::size_t node) const { return vector(kHead + 3 * node); }
  [[nodiscard]] Vec3 after(std::size_t node) const { return vector(kHead + 3 * (nodes_ + node)); }
  /// Rotation vector of a frame beside the pose at the start.
  [[nodiscard]] Vec3 before_turn(std::size_t rotation) const {
    return vector(kHead + 3 * (2 * nodes_ + rotation));
  }
  /// Where it stands; `target` is where the way ends at that time.
  [[nodiscard]] LivePlace at(double time, const Pose& target) const;

 private:
  friend class LiveLeadNumbers;
  static constexpr double kLed = 1.0;
  static constexpr double kReleased = 2.0;
  static constexpr std::size_t kStart = 4;    // after mode, pending, start and end of the way [s]
  static constexpr std::size_t kTarget = 14;  // a pose is centre, displacement, axis, angle
  static constexpr std::size_t kHead = 24;

  [[nodiscard]] double share(double time) const;
  [[nodiscard]] Pose pose(std::size_t i) const;
  [[nodiscard]] Vec3 vector(std::size_t i) const { return {numbers_[i], numbers_[i + 1], numbers_[i + 2]}; }

  std::span<const double> numbers_;
  std::size_t nodes_;
};

/// The same numbers, written by name.
class LiveLeadNumbers {
 public:
  LiveLeadNumbers(std::span<double> numbers, std::size_t nodes) : numbers_(numbers), nodes_(nodes) {}
  /// A way that begins with the next step; of `over` seconds, 0: of that step.
  void plan(bool released, double over);
  /// The next step begins at `time` and takes h.
  void begin(double time, double h);
  void set_start(const Pose& start) { set_pose(LiveLead::kStart, start); }
  void set_target(const Pose& target) { set_pose(LiveLead::kTarget, target); }
  void set_before(std::size_t node, const Vec3& value) { set_vector(LiveLead::kHead + 3 * node, value); }
  void set_after(std::size_t node, const Vec3& value) {
    set_vector(LiveLead::kHead + 3 * (nodes_ + node), value);
  }
  void set_before_turn(std::size_t rotation, const Vec3& value) {
    set_vector(LiveLead::kHead + 3 * (2 * nodes_ + rotation), value);
  }

 private:
  void set_pose(std::size_t i, const Pose& pose);
  void set_vector(std::size_t i, const Vec3& value);

  std::span<double> numbers_;
  std::size_t nodes_;
};

}  // namespace tissu
