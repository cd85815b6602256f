/// What holds rotations of frames that no point feels, or ties them to the turn of the material.

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tissu/model/frames/frames.h"

namespace tissu {
namespace {

/// Of the stiffness that a point has against turning alone: what holds rotations that nothing depends on.
constexpr double kHold = 1e-6;

}  // namespace

void Frames::lay_holds() {
  holds_.assign(blocks_.size(), 0.0);
  // Directors of sheets and lines turn with their frames; half levers are tied.
  if (points_.dimension < 3 || options_.lever == "half") return;
  const auto k = static_cast<std::size_t>(points_.neighbours);
  std::array<double, FrameMaterial::kNine> F{};
  for (const std::size_t c : {0U, 4U, 8U}) std::fill_n(F.data() + c * kLanes, kLanes, 1.0);
  std::array<double, FrameMaterial::kTangent> A;
  for (std::size_t group = 0; group < order_.point.size() / kLanes; ++group) {
    material_.tangent(static_cast<std::int32_t>(group), F.data(), A.data());
    for (std::size_t i = 0; i < k * kLanes; ++i) {
      const std::size_t lane = i % kLanes;
      const double* B = coefficients_.data() + (group * k + i / kLanes) * 12 * kLanes + 3 * kLanes + lane;
      double square = 0.0;
      for (std::size_t c = 0; c < 9; ++c) square += B[c * kLanes] * B[c * kLanes];
      holds_[static_cast<std::size_t>(lanes_[group * k * kLanes + i])] +=
          kHold * std::abs(A[lane]) * square * lane_volumes_[group * kLanes + lane];
    }
  }
}

void Frames::lay_tie() {
  const auto k = static_cast<std::size_t>(points_.neighbours);
  const std::size_t groups = order_.point.size() / kLanes;
  AlignedVector<double> weights(groups * k * kLanes);
  std::vector<double> shear(groups * kLanes);
  std::array<double, FrameMaterial::kNine> F{};
  for (const std::size_t c : {0U, 4U, 8U}) std::fill_n(F.data() + c * kLanes, kLanes, 1.0);
  std::array<double, FrameMaterial::kTangent> A;
  // The diagonal of the packed tangent, but for the three stretches.
  constexpr std::array<std::size_t, 6> kShears = {9, 17, 24, 35, 39, 42};
  for (std::size_t i = 0; i < order_.point.size(); ++i) {
    const std::size_t lane = i % kLanes;
    if (lane == 0) material_.tangent(static_cast<std::int32_t>(i / kLanes), F.data(), A.data());
    for (const std::size_t entry : kShears) shear[i] += A[entry * kLanes + lane] / 6.0;
    if (order_.real[i] == 0) shear[i] = 0.0;
    const std::size_t point = static_cast<std::size_t>(order_.point[i]) * k;
    for (std::size_t a = 0; a < k; ++a)
      weights[(i / kLanes * k + a) * kLanes + lane] = points_.weights[point + a];
  }
  tie_ = RotationTie(std::move(weights), std::move(shear), points_.neighbours);
}

}  // namespace tissu
