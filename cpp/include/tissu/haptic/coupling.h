#pragma once

/// The virtual coupling in joint space: a massless proxy q_p on springs K_c at the device's joints q_d.
///
///   g = g0 + G (q_d - q_ref) + A lambda,  A = W + G K_c^-1 G^T;   q_p = q_d + K_c^-1 G^T lambda
///   tau = K_c (q_p - q_d) = G^T lambda
///
/// Zilles and Salisbury's god object (1995) with an object that gives way. G^T A^-1 G <= K_c for any W >= 0
/// (Woodbury): one bound on K_c serves bone and liver.

#include "tissu/haptic/kinematics.h"
#include "tissu/haptic/local_model.h"
#include "tissu/haptic/patch_solver.h"

namespace tissu::haptic {

/// What is known of a device's joints: b [N m s, N m s, N m s, N s/m], f_c [N m, N m, N m, N], Delta [rad,
/// rad, rad, m].
struct JointFriction {
  Joints viscous{0.03, 0.03, 1e-3, 1.0};
  Joints coulomb{6e-3, 6e-3, 1e-3, 0.3};
};

/// The largest stiffness that the device's own friction keeps passive, times a margin:
///   K_i = 0.8 min(b_i / (T/2 + t_d), 2 f_i / Delta_i)
/// Colgate and Schenkel 1997 (t_d = 0: K < 2 b / T), Abbott and Okamura 2005; with a delay the linear limit
/// of stability. Throws ParameterError where a number is not finite, not above 0, or the delay is negative.
Joints passive_stiffness(const JointFriction& friction, const Joints& count_size, double period, double delay,
                         double margin = 0.8);

/// G of a model at q_ref, and g0: the rows of its contacts, then that of its blade.
struct ModelRows {
  int rows = 0;
  Eigen::Matrix<double, kMaxRows, 4> G = Eigen::Matrix<double, kMaxRows, 4>::Zero();
  Rows g0 = Rows::Zero();
};
ModelRows model_rows(const Kinematics& kinematics, const LocalModel& model) noexcept;

/// End stops: rows of their own, in the same solver, so that stops and contacts together show no more than
/// K_c. Pitch and roll stop at both ends, depth at its high end: at its low end the tool leaves. Own rotation
/// has no end. Rows: those of the model, then the stops. `shift` is added to b. `stiffness` is K_c, all above
/// 0.
void make_patch(const LocalModel& model, const ModelRows& rows, const JointLimits& limits,
                const Joints& stiffness, const Joints& q, const Rows& shift, Patch& patch) noexcept;
/// G^T lambda, stops included [N m, N m, N m, N].
Joints patch_torques(const ModelRows& rows, const Joints& q, const JointLimits& limits,
                     const Rows& lambda) noexcept;

}  // namespace tissu::haptic
