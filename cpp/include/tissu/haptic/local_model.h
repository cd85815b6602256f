#pragma once

/// What the slow step publishes of the tissue under a tool: a few contacts and how far they give way.

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "tissu/base/vec.h"
#include "tissu/haptic/kinematics.h"

namespace tissu::haptic {

inline constexpr int kMaxContacts = 8;
/// W, as much of it as there are contacts: (3 m, 3 m) [m/N].
using Compliance = Eigen::Matrix<double, 3 * kMaxContacts, 3 * kMaxContacts>;

/// A contact or a candidate. Positions and directions in the port's frame, l in the tool's axes (tip at 0).
struct LocalContact {
  Vec3 l = Vec3::Zero();  ///< the tool's point [m]
  Vec3 anchor =
      Vec3::Zero();  ///< x_c^0 = x_c + W lambda: where the tissue's point is without any contact force [m]
  Vec3 normal = Vec3::UnitZ();   ///< out of the tissue, towards the tool
  Vec3 tangent = Vec3::UnitX();  ///< of unit length, across the normal; the other one is normal x tangent
  double friction = 0.0;         ///< mu
  Vec3 force = Vec3::Zero();  ///< lambda (normal, two tangents) of the slow step [N]: where the solver starts
};

/// What a blade has to overcome along its way: |lambda| <= limit, toughness J_c [N/m] times the width that it
/// cuts [m].
struct BladeRow {
  bool present = false;
  Vec3 l = Vec3::Zero();       ///< the middle of what cuts, in the tool's axes [m]
  Vec3 way = Vec3::UnitZ();    ///< unit vector of its motion, port's frame
  Vec3 anchor = Vec3::Zero();  ///< where the cut ends now [m]
  double compliance = 0.0;     ///< of the tissue along the way [m/N]
  double limit = 0.0;          ///< J_c w [N]
};

/// The tissue as the ticks see it until the next one comes. For contact rows in the order (normal, tangent,
/// normal x tangent) of each contact, the tissue's points are at anchor - W lambda, lambda being the forces
/// on the tool.
///
/// q_ref are the joints of the tool that the slow step had (the proxy, not the device): with them, a hand
/// that is still gives the slow step's lambda to round-off, however deep the dent.
struct LocalModel {
  std::uint64_t stamp = 0;    ///< counts up; 0: no model yet
  std::int64_t time_ns = 0;   ///< when it was published, by the clock of the ticks [ns]
  std::uint64_t tag = 0;      ///< of the tool that it was made for
  std::int32_t contacts = 0;  ///< m, at most kMaxContacts
  Joints q_ref = Joints::Zero();
  std::array<LocalContact, kMaxContacts> contact{};
  Compliance W = Compliance::Zero();
  BladeRow blade{};
};

/// Whether every number that a tick reads is finite, and the counts are in their bounds.
bool is_finite(const LocalModel& model) noexcept;
/// Makes W symmetric and adds 1e-9 of its trace to the diagonal, so that round-off cannot make it
/// indefinite.
void settle_compliance(LocalModel& model) noexcept;
/// One sentence for what is wrong with a model, or nothing: throws ParameterError. For what publishes it, not
/// for ticks.
void check(const LocalModel& model);

}  // namespace tissu::haptic
