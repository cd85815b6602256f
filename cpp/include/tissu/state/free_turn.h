#pragma once

/// Frames that nothing turns while they move: their angular momenta in space stay.

#include <cstdint>
#include <span>
#include <vector>

#include "tissu/state/state.h"

namespace tissu {

/// The rotation of a frame after h, for the momentum of omega: exp(h w) R, w = I(R_m)^-1 I(R) omega with I in
/// space and R_m = exp(h w / 2) R in the middle (the midpoint rule on the group of rotations). The midpoint
/// is found by iteration, in halves where a turn is long or the iteration does not settle, as for slender
/// bodies.
Quaternion free_turn(const Frame& frame, const Quaternion& rotation, const Vec3& omega, double h);

/// The same to 1e-9 of w, in the axes of the frame, which takes less time while a turn is short.
Quaternion short_free_turn(const Frame& frame, const Quaternion& rotation, const Vec3& omega, double h);

/// The omega whose free turn in h is exp(turn) R.
Vec3 spin_of_free_turn(const Frame& frame, const Quaternion& rotation, const Vec3& turn, double h);

/// The omega of the same angular momentum in another rotation.
Vec3 spin_after(const Frame& frame, const Quaternion& from, const Vec3& omega, const Quaternion& to);

/// The w = I(R_1)^-1 I(R) omega at the end R_1 = exp(h w) R of a turn; omega itself where none is found.
Vec3 spin_at_end(const Frame& frame, const Quaternion& rotation, const Vec3& omega, double h);

/// `keep_angular_momentum` in fewer operations; frames that are alone have the same bits.
void carry_angular_momentum(const State& from, const std::vector<Frame>& frames, State& to);

/// `move`, in which every frame turns freely. A kick by the forces and such a drift are symplectic; a turn by
/// h omega would be explicit Euler for the gyroscopic part, by which slender frames gain energy. Where
/// `masks` hold a rotation, it turns by h omega.
void move_freely(const State& from, const std::vector<Frame>& frames, std::span<const std::uint8_t> masks,
                 ConstReals v, double h, State& to);

}  // namespace tissu
