#include "tissu/haptic/tool_motion.h"

#include <cmath>

namespace tissu::haptic {

Inertia::Inertia(const ToolInertia& tool, const Joints& q) noexcept : axial_(tool.axial) {
  const double u = std::tan(q[0]);
  const double cb = std::cos(q[1]);
  const double sb = std::sin(q[1]);
  const double t = u * cb;
  const double sec2 = 1.0 + u * u;
  D_ = 1.0 + t * t;
  ta_ = sec2 * cb;
  tb_ = -u * sb;
  Da_ = 2.0 * t * ta_;
  Db_ = 2.0 * t * tb_;
  cosine2_ = 1.0 / D_;
  sine_ = t / std::sqrt(D_);
  sine_t_ = cosine2_ / std::sqrt(D_);
  A_ = cb * sec2 / D_;
  B_ = -u * sb / D_;
  Aa_ = 2.0 * u * sec2 * cb / D_ - A_ * Da_ / D_;
  Ab_ = -sb * sec2 / D_ - A_ * Db_ / D_;
  Ba_ = -sec2 * sb / D_ - B_ * Da_ / D_;
  Bb_ = -u * cb / D_ - B_ * Db_ / D_;
  const double arm = q[3] - tool.centre;
  P_ = tool.mass * arm * arm + tool.across + tool.held * q[3] * q[3];
  Pr_ = 2.0 * tool.mass * arm + 2.0 * tool.held * q[3];
  M_ = tool.cradle.asDiagonal();
  M_(0, 0) += P_ * A_ * A_;
  M_(1, 1) += P_ * (B_ * B_ + cosine2_) + axial_ * sine_ * sine_;
  M_(0, 1) = M_(1, 0) = P_ * A_ * B_;
  M_(2, 2) += axial_;
  M_(1, 2) = M_(2, 1) = -axial_ * sine_;
  M_(3, 3) += tool.mass + tool.held;
}

Joints Inertia::slope(const Joints& v) const noexcept {
  const double tilt = A_ * v[0] + B_ * v[1];  // a'.
  const double spin = v[2] - v[1] * sine_;
  const double b2 = v[1] * v[1];
  const auto along = [&](double A, double B, double D, double t) {
    return P_ * (tilt * (A * v[0] + B * v[1]) - 0.5 * b2 * D / (D_ * D_)) -
           axial_ * spin * v[1] * sine_t_ * t;
  };
  return {along(Aa_, Ba_, Da_, ta_), along(Ab_, Bb_, Db_, tb_), 0.0,
          0.5 * Pr_ * (tilt * tilt + cosine2_ * b2)};
}

}  // namespace tissu::haptic
