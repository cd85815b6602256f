#include "tissu/state/free_turn.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>

namespace tissu {
namespace {

constexpr int kMiddles = 12;
constexpr double kSameSpin = 1e-14;
constexpr double kNearSpin = 1e-9;  ///< what may be left of the change after kMiddles
constexpr double kMostTurn = 0.5;   ///< of one turn by the midpoint rule [rad]
constexpr int kMostHalvings = 16;
constexpr int kMostNewton = 30;
constexpr double kSettled = 1e-9;  ///< of a short turn: what the next iteration would change
constexpr double kSeries = 0.01;   ///< [rad^2]: below it series of three terms do

Quaternion turn_in_halves(const Frame& frame, const Quaternion& rotation, const Vec3& omega, double h,
                          int halvings) {
  const Vec3 momentum = spatial_inertia(frame, rotation) * omega;
  Vec3 w = omega;
  double change = std::numeric_limits<double>::infinity();
  bool fits = halvings == kMostHalvings || h * omega.norm() <= kMostTurn;
  for (int i = 0; i < kMiddles && fits && change > kSameSpin * kSameSpin * w.squaredNorm(); ++i) {
    const Vec3 next = spatial_inertia(frame, turn_by(0.5 * h * w) * rotation).inverse() * momentum;
    change = (next - w).squaredNorm();
    w = next;
    fits = halvings == kMostHalvings || h * w.norm() <= 2.0 * kMostTurn;
  }
  if (halvings == kMostHalvings || (fits && change <= kNearSpin * kNearSpin * w.squaredNorm()))
    return (turn_by(h * w) * rotation).normalized();
  const Quaternion middle = turn_in_halves(frame, rotation, omega, 0.5 * h, halvings + 1);
  const Vec3 then = spatial_inertia(frame, middle).inverse() * momentum;
  return turn_in_halves(frame, middle, then, 0.5 * h, halvings + 1);
}

/// exp(turn) x to 1e-13
Vec3 turned(const Vec3& turn, const Vec3& x) {
  const double square = turn.squaredNorm();
  double sine = 1.0 - square * (1.0 / 6.0 - square * (1.0 / 120.0 - square * (1.0 / 5040.0)));
  double cosine = 0.5 - square * (1.0 / 24.0 - square * (1.0 / 720.0 - square * (1.0 / 40320.0)));
  if (square > kSeries) {
    const double angle = std::sqrt(square);
    sine = std::sin(angle) / angle;
    cosine = (1.0 - std::cos(angle)) / square;
  }
  const Vec3 across = turn.cross(x);
  return x + sine * across + cosine * turn.cross(across);
}

/// exp(turn)
Quaternion short_turn(const Vec3& turn) {
  const double square = 0.25 * turn.squaredNorm();
  if (square > kSeries) return turn_by(turn);
  const double sine = 1.0 - square * (1.0 / 6.0 - square * (1.0 / 120.0 - square * (1.0 / 5040.0)));
  const double cosine = 1.0 - square * (0.5 - square * (1.0 / 24.0 - square * (1.0 / 720.0)));
  const Vec3 vector = 0.5 * sine * turn;
  return {cosine, vector.x(), vector.y(), vector.z()};
}

/// The same about each axis.
bool is_round(const Mat3& inertia) {
  const Mat3 rest = inertia - inertia(0, 0) * Mat3::Identity();
  return rest.cwiseAbs().maxCoeff() <= kSettled * inertia(0, 0);
}

}  // namespace

Quaternion free_turn(const Frame& frame, const Quaternion& rotation, const Vec3& omega, double h) {
  return turn_in_halves(frame, rotation, omega, h, 0);
}

Quaternion short_free_turn(const Frame& frame, const Quaternion& rotation, const Vec3& omega, double h) {
  if (is_round(frame.inertia)) return (short_turn(h * omega) * rotation).normalized();
  // In the axes of the frame at the start, I w = exp(-h w / 2) I omega.
  const Mat3 inverse = frame.inertia.inverse();
  Vec3 w = rotation.conjugate() * omega;
  const Vec3 momentum = frame.inertia * w;
  double change = 0.0;
  bool settled = false;
  for (int i = 0; i < kMiddles && !settled; ++i) {
    if (!(h * w.norm() <= kMostTurn)) break;
    const Vec3 next = inverse * turned(-0.5 * h * w, momentum);
    const double before = change;
    change = (next - w).squaredNorm();
    w = next;
    settled = change * change <= kSettled * kSettled * w.squaredNorm() * before;
  }
  if (!settled) return free_turn(frame, rotation, omega, h);
  return (rotation * short_turn(h * w)).normalized();
}

Vec3 spin_of_free_turn(const Frame& frame, const Quaternion& rotation, const Vec3& turn, double h) {
  const Vec3 w = turn / h;
  const Vec3 momentum = spatial_inertia(frame, turn_by(0.5 * turn) * rotation) * w;
  return spatial_inertia(frame, rotation).inverse() * momentum;
}

/// In the axes of the frame at the start, I w = exp(-h w) I omega: by Newton's method, with the derivative
/// for short turns, I - h [I w]x, which is never singular.
Vec3 spin_at_end(const Frame& frame, const Quaternion& rotation, const Vec3& omega, double h) {
  Vec3 w = rotation.conjugate() * omega;
  const Vec3 momentum = frame.inertia * w;
  for (int i = 0; i < kMostNewton; ++i) {
    const Vec3 now = turned(-h * w, momentum);
    Mat3 slope = frame.inertia;
    for (int axis = 0; axis < 3; ++axis) slope.col(axis) -= h * now.cross(Vec3::Unit(axis));
    const Vec3 change = slope.inverse() * (now - frame.inertia * w);
    w += change;
    if (change.norm() <= kSettled * w.norm()) return rotation * w;
  }
  return omega;
}

void carry_angular_momentum(const State& from, const std::vector<Frame>& frames, State& to) {
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const Frame& frame = frames[k];
    if (frame.inertia(0, 0) == 0.0) continue;  // no cell has it, and it is held
    auto omega = block(Reals(to.velocities), frame.rotation);
    if (frame.alone) {
      const Vec3 momentum = spatial_inertia(frame, from.rotations[k]) * omega;
      omega = spatial_inertia(frame, to.rotations[k]).inverse() * momentum;
    } else {
      omega = spin_after(frame, from.rotations[k], omega, to.rotations[k]);
    }
  }
}

Vec3 spin_after(const Frame& frame, const Quaternion& from, const Vec3& omega, const Quaternion& to) {
  const Mat3 start = from.toRotationMatrix();
  const Mat3 end = to.toRotationMatrix();
  const Vec3 momentum = start * (frame.inertia * (start.transpose() * omega));
  return end * (frame.inertia.inverse() * (end.transpose() * momentum));
}

void move_freely(const State& from, const std::vector<Frame>& frames, std::span<const std::uint8_t> masks,
                 ConstReals v, double h, State& to) {
  for (std::size_t i = 0; i < from.positions.size(); ++i) to.positions[i] = from.positions[i] + h * v[i];
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const Frame& frame = frames[k];
    block(Reals(to.positions), frame.rotation).setZero();
    const Vec3 omega = block(v, frame.rotation);
    const bool held = masks[static_cast<std::size_t>(frame.rotation)] != 0 || frame.inertia(0, 0) == 0.0;
    if (omega.isZero(0.0)) {
      to.rotations[k] = from.rotations[k];  // to the bit, in however many parts
    } else if (frame.alone) {
      to.rotations[k] = free_turn(frame, from.rotations[k], omega, h);
    } else if (held) {
      to.rotations[k] = (turn_by(h * omega) * from.rotations[k]).normalized();
    } else {
      to.rotations[k] = short_free_turn(frame, from.rotations[k], omega, h);
    }
  }
}

}  // namespace tissu
