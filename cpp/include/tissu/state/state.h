#pragma once

/// What a step changes: positions, velocities, rotations of frames, what models remember, time.

#include <cstdint>
#include <span>
#include <vector>

#include "tissu/base/vec.h"
#include "tissu/state/memory.h"

namespace tissu {

/// A rigid frame owns two 3-vectors of the unknown, its translation and its rotation.
struct Frame {
  std::int32_t block;     ///< of its origin
  std::int32_t rotation;  ///< of its rotation
  double mass;            ///< [kg]
  Mat3 inertia;           ///< about its origin, in its own axes [kg m2]
  bool alone = false;     ///< no model holds it to others: it turns freely
};

struct State {
  double time = 0.0;         ///< [s]
  double load_factor = 1.0;  ///< share of the external loads that acts: below 1 only while loads are stepped
  std::vector<double> positions;  ///< [m], three for each node or frame origin; zeros for a frame's rotation
  std::vector<double>
      velocities;  ///< [m/s]; a frame's rotation block holds its angular velocity in space [rad/s]
  /// [m/s] What viscosity strains by while a step is solved in which parts turn, and until it has ended;
  /// empty: the velocities. A simulation moves it to the state before its latest step.
  std::vector<double> straining;
  std::vector<Quaternion> rotations;  ///< one unit quaternion for each frame
  Memory memory;                      ///< what models remember; empty when none does
  double memory_time = 0.0;           ///< when the memory was written [s]

  /// Velocities that strain.
  [[nodiscard]] const std::vector<double>& strains_by() const {
    return straining.empty() ? velocities : straining;
  }
  [[nodiscard]] std::int32_t blocks() const { return static_cast<std::int32_t>(positions.size() / 3); }
};

/// A row of the unknown that takes over what another one has.
struct RowCopy {
  std::int32_t to = 0;
  std::int32_t from = 0;
  std::int32_t to_frame = -1;  ///< of a row that is the rotation of this frame; -1: it is none
  std::int32_t from_frame = -1;
};

/// values[to] = values[from], three numbers each.
void copy_rows(std::span<const RowCopy> copies, Reals values);
/// Positions, velocities and rotations.
void copy_rows(std::span<const RowCopy> copies, State& state);

/// exp(w), the rotation by |w| about w.
Quaternion turn_by(const Vec3& w);
/// The w with exp(w) = q that is nearest to `expected`: rotations are known up to whole turns only.
Vec3 nearest_turn(const Quaternion& q, const Vec3& expected);

/// to = from moved by h v: x + h v for translations, exp(h omega) R for rotations. Velocities are left.
/// A frame that is alone turns by exp(h w), w = I(R_m)^-1 I(R) omega with I in space and R_m = exp(h w / 2) R
/// in the middle (the midpoint rule on the group of rotations, for the momentum of omega): its energy is
/// bounded.
void move(const State& from, const std::vector<Frame>& frames, ConstReals v, double h, State& to);

/// Angular velocities at the end of a step whose angular momentum in space was R0 I R0^T omega: the momentum
/// is what a free frame keeps, so omega follows from it and the new rotation. `from` is the state before the
/// step.
void keep_angular_momentum(const State& from, const std::vector<Frame>& frames, State& to);

/// Inertia in space, R I R^T.
Mat3 spatial_inertia(const Frame& frame, const Quaternion& rotation);

}  // namespace tissu
