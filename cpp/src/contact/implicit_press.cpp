/// How stiff contacts are, and with which force they press and rub.

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "tissu/base/index.h"
#include "tissu/contact/implicit_contact.h"

namespace tissu {
namespace {

constexpr double kStiff = 3.0;        ///< s: couplings over the block diagonal of the matrix
constexpr double kStiffRigid = 30.0;  ///< the same between rigid bodies, whose blocks are few
// Contacts that alternate between sticking and sliding come to rest when they are softer against sliding.
constexpr int kPatience = 4;     ///< so many alternations later …
constexpr double kSofter = 0.7;  ///< … by this for each, …
constexpr double kSoft = 0.17;   ///< … no further than here

void set_stiffness(ContactNumbers& contact, const Mat3& H) {
  contact.stiffness = {H(0, 0), H(1, 1), H(2, 2), H(1, 2), H(0, 2), H(0, 1)};
}

}  // namespace

/// sum_r N_r B_r A_rr^-1 B_r^T, without given degrees of freedom; B is beta of nodes.
Mat3 ImplicitContact::compliance(const ContactNumbers& contact, std::span<const double> blocks) const {
  Mat3 sum = Mat3::Zero();
  const bool soft_on_rigid = !contact_.surfaces().carriers().empty() && !is_rigid(contact);
  run_.for_parts(contact, [&](const CarriedPart& part) {
    const std::int32_t i = part.row;
    const Eigen::Map<const Mat3> A(blocks.data() + 9 * static_cast<std::ptrdiff_t>(i));
    Mat3 inverse = A.inverse();
    for (int axis = 0; axis < 3; ++axis) {
      if (((fixed_.masks()[at(i)] >> axis) & 1) == 0) continue;
      inverse.row(axis).setZero();
      inverse.col(axis).setZero();
    }
    const double count = soft_on_rigid && is_carrier(i) ? std::sqrt(counts_[at(i)]) : counts_[at(i)];
    sum += count * part.carried(inverse);
  });
  return sum;
}

/// A rigid body: what is soft presses on it in many contacts at the same two rows, of which each takes a
/// part.
bool ImplicitContact::is_carrier(std::int32_t row) const {
  const auto& carriers = contact_.surfaces().carriers();
  return std::ranges::any_of(carriers,
                             [&](const SurfaceCarrier& of) { return of.row == row || of.rotation == row; });
}

/// Nothing that it moves is deformed.
bool ImplicitContact::is_rigid(const ContactNumbers& contact) const {
  const SurfaceSet& surfaces = contact_.surfaces();
  if (surfaces.carriers().empty()) return false;
  return std::ranges::all_of(contact.vertex, [&](double vertex) {
    return vertex < 0.0 || !surfaces.vertices()[static_cast<std::size_t>(vertex)].is_soft();
  });
}

/// A rigid body, a sheet or a line.
bool ImplicitContact::stops_whole(const ContactNumbers& contact) const {
  const std::vector<SurfaceVertex>& vertices = contact_.surfaces().vertices();
  return std::ranges::any_of(contact.vertex, [&](double vertex) {
    return vertex >= 0.0 && vertices[static_cast<std::size_t>(vertex)].stops_whole();
  });
}

double ImplicitContact::stiffer(const ContactNumbers& contact) const {
  return whole_ > 1.0 && stops_whole(contact) ? whole_ : 1.0;
}

void ImplicitContact::find_stiffnesses(std::span<const double> blocks, double scale,
                                       std::span<const double> shares, std::vector<double>& stiffnesses) {
  const auto looked = run_.looked();
  const auto each = [&](auto&& f) {
    for (std::size_t i = 0; i < looked.size(); ++i) {
      if (!(shares[i] > 0.0)) continue;
      run_.for_parts(looked[i], [&](const CarriedPart& part) { f(counts_[at(part.row)], shares[i]); });
    }
  };
  each([](double& sum, double /*share*/) { sum = 0.0; });
  each([](double& sum, double share) { sum += share; });
  stiffnesses.assign(looked.size(), 0.0);
  for (std::size_t i = 0; i < looked.size(); ++i) {
    if (!(shares[i] > 0.0)) continue;
    const double largest = compliance(looked[i], blocks).cwiseAbs().rowwise().sum().maxCoeff();
    const double stiff = is_rigid(looked[i]) ? kStiffRigid : kStiff;
    if (largest > 0.0)
      stiffnesses[i] = stiff * stiffer(looked[i]) * run_.weight(i) * shares[i] / (largest * scale);
  }
}

double ImplicitContact::share_of_stiffness(std::size_t i) const {
  const ContactNumbers& contact = run_.looked()[i];
  const double times = stiffer(contact);
  if (is_rigid(contact)) return normal_ * kStiffRigid * times;
  return times > 1.0 ? normal_ * kStiff * times : 0.0;
}

/// Forces and stiffnesses at the places that were looked at; what does not press is dropped.
void ImplicitContact::press_all() {
  pressing_.clear();
  depth_ = 0.0;
  const int alternations = std::max(0, alternations_ - kPatience);
  const double tangent = tangent_ * std::max(kSoft, std::pow(kSofter, alternations));
  for (std::size_t i = 0; i < run_.looked().size(); ++i) {
    ContactNumbers c = run_.looked()[i];
    if (stiffnesses_[i] == 0.0) continue;
    const std::optional<double> force = press(i, c);
    if (!force) continue;
    const double friction = pair_of(c).friction;
    if (friction == 0.0) c.sliding = 0.0;
    if (friction > 0.0) {
      const double k = stiffnesses_[i] / stiffer(c);
      rub(c, friction * std::max(0.0, *force), tangent * k, tangent * (is_rigid(c) ? kStiffRigid : 0.0));
    }
    pressing_.push_back(c);
  }
}

void ImplicitContact::give(ContactNumbers& c, double force, double k) {
  const Vec3 n = vector_of(c.normal);
  c.push = numbers_of(force * n);
  set_stiffness(c, k * n * n.transpose());
}

/// Coulomb's friction of bound F: it sticks as a spring, or slides with the force F. It slides where the
/// force exceeds F that the spring will have after the system: a part 1 / (1 + share) of how far it slid is
/// left then.
void ImplicitContact::rub(ContactNumbers& c, double bound, double k, double share) {
  const Vec3 n = vector_of(c.normal);
  Vec3 slid = run_.gone(c);
  slid -= n.dot(slid) * n;
  const Vec3 drag = vector_of(c.drag);
  Vec3 force = drag - k / (1.0 + share) * slid;
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
    H = bound / (drag - k * slid).norm() * (H - k * along * along.transpose());
    c.sliding = 1.0;
  } else {
    force = drag - k * slid;
  }
  add(c, force, H);
}

void ImplicitContact::add(ContactNumbers& c, const Vec3& force, const Mat3& H) {
  c.push = numbers_of(vector_of(c.push) + force);
  set_stiffness(c, stiffness_of(c) + H);
}

}  // namespace tissu
