#include "tissu/model/frames/frame_material.h"

#include <array>
#include <string>
#include <vector>

#include "tissu/base/error.h"
#include "tissu/base/number_text.h"

namespace tissu {
namespace {

constexpr std::size_t kLanes = PointMaterial::kLanes;

/// A_iJkL a_i b_J a_k b_L of one lane, from the packed upper triangle.
double along(const double* A, std::size_t lane, const Vec3& a, const Vec3& b) {
  double sum = 0.0;
  for (std::size_t r = 0; r < 9; ++r) {
    for (std::size_t s = r; s < 9; ++s) {
      const double pair = a[static_cast<int>(r / 3)] * b[static_cast<int>(r % 3)] *
                          a[static_cast<int>(s / 3)] * b[static_cast<int>(s % 3)];
      sum += (r == s ? 1.0 : 2.0) * pair * A[(9 * r - r * (r - 1) / 2 + (s - r)) * kLanes + lane];
    }
  }
  return sum;
}

/// Poisson's ratio of a law at rest from its stiffness along the rod and in shear: the former is Young's
/// modulus, or that without strain across where a point does not thin.
double poisson_of(double stiffness, double shear, int dimension) {
  return dimension == 3 ? (stiffness - 2.0 * shear) / (2.0 * (stiffness - shear))
                        : stiffness / (2.0 * shear) - 1.0;
}

/// The shares of G that the points on one axis of the section have: of shear along this axis and the other.
struct Shares {
  double own;
  double other;
};

/// Points on both axes have J / (I1 + I2) of what twist shears them by, and what lacks of k along the axis.
Shares shares_of(const ElasticBlock& block, const SectionConstants& section, double k) {
  const double twist = section.torsion / (section.inertia_up + section.inertia_across);
  const Shares shares{2.0 * k - twist, twist};
  if (shares.own > 0.0 && shares.other > 0.0) return shares;
  throw ParameterError("body \"" + block.body + "\" has lines with a section of torsion constant " +
                       number_text(twist) + " (I_up + I_across) and shear factor " + number_text(k) +
                       "; a constant above zero and below twice the shear factor is accepted.");
}

}  // namespace

FrameMaterial::FrameMaterial(const ElasticBlock& block, const FramePoints& points,
                             std::span<const std::int32_t> lanes, Isa isa)
    : law_(block, points, lanes, isa) {
  if (points.sections.empty()) return;
  std::array<double, kNine> rest{};
  for (const std::size_t c : {0U, 4U, 8U}) std::fill_n(rest.data() + c * kLanes, kLanes, 1.0);
  std::array<double, kTangent> A;
  std::vector<SectionShear::Point> laid(lanes.size());
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const std::size_t lane = i % kLanes;
    if (lane == 0) law_.tangent(static_cast<std::int32_t>(i / kLanes), rest.data(), A.data());
    const FramePoints::OnSection& on = points.sections[static_cast<std::size_t>(lanes[i])];
    const Vec3 t = tissu::block(ConstReals(points.axes), lanes[i]);
    const Vec3 other = t.cross(on.axis);
    const double G = along(A.data(), lane, on.axis, t);
    const double G_other = along(A.data(), lane, other, t);
    const double poisson = poisson_of(along(A.data(), lane, t, t), G, points.dimension);
    const SectionConstants section = section_constants(block.section, on.area, poisson);
    const Shares shares = shares_of(block, section, on.is_up ? section.shear_up : section.shear_across);
    laid[i] = {t, on.axis, other, (shares.own - 1.0) * G, (shares.other - 1.0) * G_other};
  }
  shear_ = SectionShear(laid);
}

}  // namespace tissu
