#include "tissu/model/points/point_material.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tissu/base/error.h"
#include "tissu/model/law_constants.h"

namespace tissu {
namespace {

constexpr std::size_t kLanes = PointMaterial::kLanes;
constexpr int kMostStretches = 30;
constexpr double kStretchTolerance = 1e-13;

using Nine = std::array<double, PointMaterial::kNine>;

/// Entry (r, s) of the packed upper triangle.
constexpr std::size_t packed(std::size_t r, std::size_t s) {
  return r <= s ? 9 * r - r * (r - 1) / 2 + (s - r) : packed(s, r);
}

/// out = F S of one lane, S symmetric.
void times(const double* F, const Mat3& S, std::size_t lane, double* out) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      double sum = 0.0;
      for (std::size_t d = 0; d < 3; ++d)
        sum += F[(3 * i + d) * kLanes + lane] * S(static_cast<int>(d), static_cast<int>(c));
      out[(3 * i + c) * kLanes + lane] = sum;
    }
  }
}

double inner(const double* a, const double* b, std::size_t lane) {
  double sum = 0.0;
  for (std::size_t k = 0; k < 9; ++k) sum += a[k * kLanes + lane] * b[k * kLanes + lane];
  return sum;
}

}  // namespace

struct PointMaterial::Thin {
  std::array<double, kLanes> s;
  std::array<Mat3, kLanes> S;
  std::array<Mat3, kLanes> N;        ///< dS/ds
  Nine stretched;                    ///< F S
  Nine across;                       ///< F N
  Nine P;                            ///< P' at F S
  Nine change;                       ///< A' : (F N)
  std::array<double, kLanes> slope;  ///< (F N) : A' : (F N)
};

PointMaterial::PointMaterial(const ElasticBlock& block, const FramePoints& points,
                             std::span<const std::int32_t> lanes, Isa isa)
    : dimension_(points.dimension) {
  for (const LawUse& use : laws_of(block)) {
    (void)law_info(block, use);
    laws_.push_back(use.loaded ? use.loaded->kernels(3) : find_law_kernels(isa, use.law, 3));
    if (laws_.back() == nullptr) {
      throw ParameterError("body \"" + block.body + "\": the law \"" + use.law +
                           "\" has no form in three dimensions, which frames need.");
    }
  }
  const std::size_t groups = lanes.size() / kLanes;
  std::vector<std::int32_t> cells(lanes.begin(), lanes.end());
  if (!points.cells.empty()) {
    for (std::int32_t& cell : cells) cell = points.cells[static_cast<std::size_t>(cell)];
  }
  LawConstants laid = lay_law_constants(block, cells, 3);
  constants_ = std::move(laid.values);
  stride_ = laid.stride;
  if (dimension_ == 3) return;
  axes_.resize(groups * 3 * kLanes);
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c)
      axes_[(i / kLanes * 3 + c) * kLanes + i % kLanes] =
          points.axes[3 * static_cast<std::size_t>(lanes[i]) + c];
  }
}

void PointMaterial::law_stress(const double* constants, const double* F, double* P) const {
  std::fill_n(P, kNine, 0.0);
  for (const LawKernels* law : laws_) {
    law->stress(constants, 1, F, P);
    constants += static_cast<std::ptrdiff_t>(law->constants) * static_cast<std::ptrdiff_t>(kLanes);
  }
}

void PointMaterial::law_change(const double* constants, const double* F, const double* dF, double* dP) const {
  std::fill_n(dP, kNine, 0.0);
  for (const LawKernels* law : laws_) {
    law->stress_change(constants, 1, F, dF, dP);
    constants += static_cast<std::ptrdiff_t>(law->constants) * static_cast<std::ptrdiff_t>(kLanes);
  }
}

/// Newton's iteration for P'(F S) : (F N) = 0, from s = 1, no step beyond half or double.
void PointMaterial::find_stretch(std::int32_t group, const double* F, Thin& thin) const {
  const double* axes =
      axes_.data() + static_cast<std::ptrdiff_t>(group) * 3 * static_cast<std::ptrdiff_t>(kLanes);
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const Vec3 n(axes[lane], axes[kLanes + lane], axes[2 * kLanes + lane]);
    thin.N[lane] = n * n.transpose();
    if (dimension_ == 1) thin.N[lane] = Mat3::Identity() - thin.N[lane];
    thin.s[lane] = 1.0;
    times(F, thin.N[lane], lane, thin.across.data());
  }
  for (int i = 0; i < kMostStretches; ++i) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      thin.S[lane] = Mat3::Identity() + (thin.s[lane] - 1.0) * thin.N[lane];
      times(F, thin.S[lane], lane, thin.stretched.data());
    }
    law_stress(constants_of(group), thin.stretched.data(), thin.P.data());
    law_change(constants_of(group), thin.stretched.data(), thin.across.data(), thin.change.data());
    double farthest = 0.0;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      thin.slope[lane] = inner(thin.change.data(), thin.across.data(), lane);
      const double rest = inner(thin.P.data(), thin.across.data(), lane);
      const double s = thin.s[lane];
      const double to = s - rest / std::max(std::abs(thin.slope[lane]), 1e-300);
      thin.s[lane] = std::clamp(to, 0.5 * s, 2.0 * s);
      farthest = std::max(farthest, std::abs(thin.s[lane] - s) / s);
    }
    if (!(farthest > kStretchTolerance)) return;
  }
}

void PointMaterial::energy(std::int32_t group, const double* F, double* W) const {
  Thin thin;
  if (dimension_ < 3) {
    find_stretch(group, F, thin);
    F = thin.stretched.data();
  }
  const double* constants = constants_of(group);
  for (const LawKernels* law : laws_) {
    if (law->energy != nullptr) law->energy(constants, 1, F, W);
    constants += static_cast<std::ptrdiff_t>(law->constants) * static_cast<std::ptrdiff_t>(kLanes);
  }
}

void PointMaterial::stretch(std::int32_t group, const double* F, double* whole) const {
  std::copy_n(F, kNine, whole);
  if (dimension_ == 3) return;
  Thin thin;
  find_stretch(group, F, thin);
  std::ranges::copy(thin.stretched, whole);
}

void PointMaterial::stress(std::int32_t group, const double* F, double* P) const {
  if (dimension_ == 3) {
    law_stress(constants_of(group), F, P);
    return;
  }
  Thin thin;
  find_stretch(group, F, thin);
  for (std::size_t lane = 0; lane < kLanes; ++lane) times(thin.P.data(), thin.S[lane], lane, P);
}

/// dP = (A' : (dF S)) S + t ds,  t = (A' : (F N)) S + P' N,  ds = - t : dF / slope
void PointMaterial::stress_change(std::int32_t group, const double* F, const double* dF, double* dP) const {
  if (dimension_ == 3) {
    law_change(constants_of(group), F, dF, dP);
    return;
  }
  Thin thin;
  find_stretch(group, F, thin);
  Nine stretched;
  Nine change;
  Nine t;
  Nine more;
  for (std::size_t lane = 0; lane < kLanes; ++lane) times(dF, thin.S[lane], lane, stretched.data());
  law_change(constants_of(group), thin.stretched.data(), stretched.data(), change.data());
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    times(change.data(), thin.S[lane], lane, dP);
    times(thin.change.data(), thin.S[lane], lane, t.data());
    times(thin.P.data(), thin.N[lane], lane, more.data());
    for (std::size_t k = lane; k < kNine; k += kLanes) t[k] += more[k];
    const double ds = thin.slope[lane] == 0.0 ? 0.0 : -inner(t.data(), dF, lane) / thin.slope[lane];
    for (std::size_t k = lane; k < kNine; k += kLanes) dP[k] += ds * t[k];
  }
}

void PointMaterial::tangent(std::int32_t group, const double* F, double* A) const {
  std::fill_n(A, kTangent, 0.0);
  if (dimension_ == 3) {
    const double* constants = constants_of(group);
    for (const LawKernels* law : laws_) {
      law->tangent(constants, 1, F, A);
      constants += static_cast<std::ptrdiff_t>(law->constants) * static_cast<std::ptrdiff_t>(kLanes);
    }
    return;
  }
  Nine unit;
  Nine column;
  for (std::size_t s = 0; s < 9; ++s) {
    unit.fill(0.0);
    std::fill_n(unit.data() + s * kLanes, kLanes, 1.0);
    stress_change(group, F, unit.data(), column.data());
    for (std::size_t r = 0; r <= s; ++r)
      std::copy_n(column.data() + r * kLanes, kLanes, A + packed(r, s) * kLanes);
  }
}

}  // namespace tissu
