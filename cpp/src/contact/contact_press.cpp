/// How stiff contacts are, and with which force they press and rub.

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "tissu/contact/contact_run.h"

namespace tissu {
namespace {

constexpr double kStiff = 3.0;  ///< s: couplings over the block diagonal of the matrix
// Contacts that alternate between sticking and sliding come to rest when they are softer against sliding.
constexpr int kPatience = 4;     ///< so many alternations later …
constexpr double kSofter = 0.7;  ///< … by this for each, …
constexpr double kSoft = 0.17;   ///< … no further than here

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }
std::array<double, 3> numbers_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

void set_stiffness(ContactNumbers& contact, const Mat3& H) {
  contact.stiffness = {H(0, 0), H(1, 1), H(2, 2), H(1, 2), H(0, 2), H(0, 1)};
}

}  // namespace

/// sum_r N_r beta_r^2 A_rr^-1, without given degrees of freedom.
Mat3 ContactRun::compliance(const ContactNumbers& contact) const {
  Mat3 sum = Mat3::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    const std::int32_t i = row(contact.vertex[k]);
    if (i < 0 || contact.beta[k] == 0.0) continue;
    const Eigen::Map<const Mat3> A(blocks_.data() + 9 * static_cast<std::ptrdiff_t>(i));
    Mat3 inverse = A.inverse();
    for (int axis = 0; axis < 3; ++axis) {
      if (((fixed_.masks()[at(i)] >> axis) & 1) == 0) continue;
      inverse.row(axis).setZero();
      inverse.col(axis).setZero();
    }
    sum += counts_[at(i)] * contact.beta[k] * contact.beta[k] * inverse;
  }
  return sum;
}

void ContactRun::stiffen() {
  const auto for_rows = [&](auto&& f) {
    for (std::size_t i = 0; i < looked_.size(); ++i) {
      if (!may_press(i)) continue;
      for (std::size_t k = 0; k < 4; ++k) {
        const std::int32_t r = row(looked_[i].vertex[k]);
        if (r >= 0 && looked_[i].beta[k] != 0.0) f(counts_[at(r)]);
      }
    }
  };
  for_rows([](std::int32_t& count) { count = 0; });
  for_rows([](std::int32_t& count) { ++count; });
  stiffnesses_.assign(looked_.size(), 0.0);
  for (std::size_t i = 0; i < looked_.size(); ++i) {
    if (!may_press(i)) continue;
    const double largest = compliance(looked_[i]).cwiseAbs().rowwise().sum().maxCoeff();
    if (largest > 0.0) stiffnesses_[i] = kStiff * weights_[i] / (largest * scale_);
  }
}

/// Forces and stiffnesses at the places that were looked at; what does not press is dropped.
void ContactRun::press() {
  std::size_t kept = 0;
  depth_ = 0.0;
  const int alternations = std::max(0, alternations_ - kPatience);
  const double tangent = tangent_ * std::max(kSoft, std::pow(kSofter, alternations));
  for (std::size_t i = 0; i < looked_.size(); ++i) {
    const double k = normal_ * stiffnesses_[i];
    const double t = looked_[i].force - k * gaps_[i];
    if (k == 0.0 || !(t > 0.0 || predicted_[i] != 0)) continue;
    ContactNumbers c = looked_[i];
    const Vec3 n = vector_of(c.normal);
    c.push = numbers_of(t * n);
    set_stiffness(c, k * n * n.transpose());
    const ContactPair& pair = contact_.description().pairs[static_cast<std::size_t>(c.pair)];
    const double friction = pair.friction;
    if (friction == 0.0) c.sliding = 0.0;
    if (friction > 0.0) {
      rub(c, n, friction * std::max(t, 0.0), vector_of(c.place), tangent * stiffnesses_[i]);
    }
    depth_ = std::max(depth_, -gaps_[i] / std::min(c.apart, pair.gap));
    looked_[kept++] = c;
  }
  looked_.resize(kept);
}

/// Coulomb's friction of bound F: it sticks as a spring, or slides with the force F.
void ContactRun::rub(ContactNumbers& c, const Vec3& n, double bound, const Vec3& place, double k) const {
  Vec3 before = reach(c, begin_);
  if (c.kind == ContactNumbers::kPlane) {
    const auto obstacle = static_cast<std::int32_t>(c.b);
    before -= contact_.carried(obstacle, -vector_of(c.fixed), *start_, end_, start_->time);
  }
  Vec3 slid = place - before;
  slid -= n.dot(slid) * n;
  const Vec3 drag = vector_of(c.drag);
  Vec3 force = drag - k * slid;
  Mat3 H = k * (Mat3::Identity() - n * n.transpose());
  // Where the bound alone turned the sliding round, it stops: it sticks from where the step began.
  const bool turned = c.sliding != 0.0 && force.dot(drag) < 0.0;
  c.sliding = 0.0;
  const double size = force.norm();
  if (turned) {
    force = -k * slid;
  } else if (size > bound) {
    const Vec3 along = force / size;
    force = bound * along;
    H = bound / size * (H - k * along * along.transpose());
    c.sliding = 1.0;
  }
  c.push = numbers_of(vector_of(c.push) + force);
  set_stiffness(c, stiffness_of(c) + H);
}

}  // namespace tissu
