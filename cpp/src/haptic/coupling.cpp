#include "tissu/haptic/coupling.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tissu/base/error.h"
#include "tissu/base/number_text.h"

namespace tissu::haptic {
namespace {

constexpr std::array<int, kStops> kStopped{0, 1, 3};  // pitch, roll, depth

/// A stop's row of G is sign e_i, its gap sign (q_i - end): the end that is nearer; of depth the high one.
struct Stop {
  int joint;
  double sign, end;
};

Stop stop_of(std::size_t i, const Joints& q, const JointLimits& limits) noexcept {
  const int joint = kStopped[i];
  const bool low = joint != 3 && q[joint] < 0.5 * (limits.low[joint] + limits.high[joint]);
  return {joint, low ? 1.0 : -1.0, low ? limits.low[joint] : limits.high[joint]};
}

Mat3 directions(const LocalContact& c) noexcept {
  Mat3 D;
  D.col(0) = c.normal;
  D.col(1) = c.tangent;
  D.col(2) = c.normal.cross(c.tangent);
  return D;
}

void require(const Joints& values, const char* name) {
  for (int i = 0; i < kJoints; ++i) {
    if (!(values[i] > 0.0) || !std::isfinite(values[i])) {
      throw ParameterError(std::string(name) + " must be finite and above 0; of axis " + std::to_string(i) +
                           " it is " + number_text(values[i]) + ".");
    }
  }
}

/// What of A comes from the coupling's springs: G K^-1 G^T of all rows.
void add_springs(const Eigen::Matrix<double, kMaxRows, 4>& G, const Joints& stiffness, int rows,
                 RowMatrix& A) noexcept {
  const Joints soft = stiffness.cwiseInverse();
  for (int j = 0; j < rows; ++j) {
    const Joints column = soft.cwiseProduct(G.row(j).transpose());
    for (int i = j; i < rows; ++i) {
      const double more = G.row(i).dot(column);
      A(i, j) += more;
      if (i != j) A(j, i) += more;
    }
  }
}

}  // namespace

Joints passive_stiffness(const JointFriction& friction, const Joints& count_size, double period, double delay,
                         double margin) {
  require(friction.viscous, "Viscous friction");
  require(friction.coulomb, "Coulomb friction");
  require(count_size, "The size of a count");
  if (!(period > 0.0) || !(delay >= 0.0) || !(margin > 0.0) || !std::isfinite(period + delay + margin)) {
    throw ParameterError("The period and the margin must be above 0 and the delay at least 0 s; they are " +
                         number_text(period) + ", " + number_text(margin) + " and " + number_text(delay) +
                         ".");
  }
  const Joints damped = friction.viscous / (0.5 * period + delay);
  const Joints held = 2.0 * friction.coulomb.cwiseQuotient(count_size);
  return margin * damped.cwiseMin(held);
}

ModelRows model_rows(const Kinematics& kinematics, const LocalModel& model) noexcept {
  ModelRows made;
  for (std::int32_t i = 0; i < model.contacts; ++i) {
    const LocalContact& c = model.contact[static_cast<std::size_t>(i)];
    const Mat3 D = directions(c);
    made.G.middleRows<3>(3 * i) = D.transpose() * kinematics.jacobian(model.q_ref, c.l);
    made.g0.segment<3>(3 * i) = D.transpose() * (kinematics.point(model.q_ref, c.l) - c.anchor);
  }
  made.rows = 3 * model.contacts;
  if (model.blade.present) {
    const BladeRow& blade = model.blade;
    made.G.row(made.rows) = blade.way.transpose() * kinematics.jacobian(model.q_ref, blade.l);
    made.g0[made.rows] = blade.way.dot(kinematics.point(model.q_ref, blade.l) - blade.anchor);
    ++made.rows;
  }
  return made;
}

void make_patch(const LocalModel& model, const ModelRows& rows, const JointLimits& limits,
                const Joints& stiffness, const Joints& q, const Rows& shift, Patch& patch) noexcept {
  const int contacts = 3 * model.contacts;
  Eigen::Matrix<double, kMaxRows, 4> G = rows.G;
  patch.rows = rows.rows + kStops;
  patch.blocks = 0;
  patch.A.topLeftCorner(patch.rows, patch.rows).setZero();
  patch.A.topLeftCorner(contacts, contacts) = model.W.topLeftCorner(contacts, contacts);
  patch.b = rows.g0 + rows.G * (q - model.q_ref);
  const auto add = [&](BlockKind kind, int row, double bound) {
    patch.block[static_cast<std::size_t>(patch.blocks++)] = {kind, row, bound};
  };
  for (std::int32_t i = 0; i < model.contacts; ++i) {
    add(BlockKind::cone, 3 * i, model.contact[static_cast<std::size_t>(i)].friction);
  }
  if (model.blade.present) {
    patch.A(contacts, contacts) = model.blade.compliance;
    add(BlockKind::bounded, contacts, model.blade.limit);
  }
  for (std::size_t i = 0; i < kStops; ++i) {
    const Stop stop = stop_of(i, q, limits);
    const int row = rows.rows + static_cast<int>(i);
    G.row(row).setZero();
    G(row, stop.joint) = stop.sign;
    patch.b[row] = stop.sign * (q[stop.joint] - stop.end);
    add(BlockKind::push, row, 0.0);
  }
  patch.b.head(patch.rows) += shift.head(patch.rows);
  add_springs(G, stiffness, patch.rows, patch.A);
}

Joints patch_torques(const ModelRows& rows, const Joints& q, const JointLimits& limits,
                     const Rows& lambda) noexcept {
  Joints tau = rows.G.topRows(rows.rows).transpose() * lambda.head(rows.rows);
  for (std::size_t i = 0; i < kStops; ++i) {
    const Stop stop = stop_of(i, q, limits);
    tau[stop.joint] += stop.sign * lambda[rows.rows + static_cast<int>(i)];
  }
  return tau;
}

}  // namespace tissu::haptic
