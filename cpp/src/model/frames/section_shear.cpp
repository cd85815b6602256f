#include "tissu/model/frames/section_shear.h"

#include <array>

namespace tissu {
namespace {

constexpr std::size_t kLanes = SectionShear::kLanes;

Mat3 tensor_of(const double* values, std::size_t lane) {
  Mat3 F;
  for (int i = 0; i < 3; ++i) {
    for (int c = 0; c < 3; ++c) F(i, c) = values[static_cast<std::size_t>(3 * i + c) * kLanes + lane];
  }
  return F;
}

void add(const Mat3& P, std::size_t lane, double* to) {
  for (int i = 0; i < 3; ++i) {
    for (int c = 0; c < 3; ++c) to[static_cast<std::size_t>(3 * i + c) * kLanes + lane] += P(i, c);
  }
}

/// One shear of a point: its axis d and c.
struct Shear {
  Vec3 d;
  double c;
};

std::array<Shear, 2> shears_of(const SectionShear::Point& point) {
  return {Shear{point.own, point.c_own}, Shear{point.other, point.c_other}};
}

/// dg/dF
Mat3 slope(const Mat3& F, const Vec3& t, const Vec3& d) {
  return (F * d) * t.transpose() + (F * t) * d.transpose();
}

constexpr std::size_t packed(std::size_t r, std::size_t s) { return 9 * r - r * (r - 1) / 2 + (s - r); }

/// c (G (x) G + g I (x) (d t + t d)) of one lane
void add_tangent_of(const Mat3& F, const Vec3& t, const Shear& shear, std::size_t lane, double* A) {
  const Mat3 G = slope(F, t, shear.d);
  const double g = (F * t).dot(F * shear.d);
  const Mat3 both = shear.d * t.transpose() + t * shear.d.transpose();
  for (std::size_t r = 0; r < 9; ++r) {
    const auto i = static_cast<int>(r / 3);
    const auto J = static_cast<int>(r % 3);
    for (std::size_t s = r; s < 9; ++s) {
      const auto k = static_cast<int>(s / 3);
      const auto L = static_cast<int>(s % 3);
      A[packed(r, s) * kLanes + lane] += shear.c * (G(i, J) * G(k, L) + (i == k ? g * both(J, L) : 0.0));
    }
  }
}

}  // namespace

SectionShear::SectionShear(std::span<const Point> lanes) : lanes_(lanes.begin(), lanes.end()) {}

void SectionShear::add_energy(std::int32_t group, const double* F, double* W) const {
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const Mat3 at = tensor_of(F, lane);
    const Point& point = of_group(group)[lane];
    for (const Shear& shear : shears_of(point)) {
      const double g = (at * point.t).dot(at * shear.d);
      W[lane] += 0.5 * shear.c * g * g;
    }
  }
}

void SectionShear::add_stress(std::int32_t group, const double* F, double* P) const {
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const Mat3 at = tensor_of(F, lane);
    const Point& point = of_group(group)[lane];
    for (const Shear& shear : shears_of(point)) {
      const double g = (at * point.t).dot(at * shear.d);
      add(shear.c * g * slope(at, point.t, shear.d), lane, P);
    }
  }
}

void SectionShear::add_stress_change(std::int32_t group, const double* F, const double* dF,
                                     double* dP) const {
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const Mat3 at = tensor_of(F, lane);
    const Mat3 change = tensor_of(dF, lane);
    const Point& point = of_group(group)[lane];
    for (const Shear& shear : shears_of(point)) {
      const double g = (at * point.t).dot(at * shear.d);
      const Mat3 G = slope(at, point.t, shear.d);
      const double dg = G.cwiseProduct(change).sum();
      add(shear.c * (dg * G + g * slope(change, point.t, shear.d)), lane, dP);
    }
  }
}

void SectionShear::add_tangent(std::int32_t group, const double* F, double* A) const {
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const Mat3 at = tensor_of(F, lane);
    const Point& point = of_group(group)[lane];
    for (const Shear& shear : shears_of(point)) add_tangent_of(at, point.t, shear, lane, A);
  }
}

}  // namespace tissu
