#include "tissu/model/frames/frames.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace tissu {
namespace {

constexpr std::size_t kLanes = FrameOrder::kLanes;
constexpr std::size_t kNine = FrameMaterial::kNine;
constexpr std::size_t kTangent = FrameMaterial::kTangent;

using Matrix9 = Eigen::Matrix<double, 9, 9>;

constexpr std::size_t packed(std::size_t r, std::size_t s) { return 9 * r - r * (r - 1) / 2 + (s - r); }

Matrix9 tangent_of(const double* A, std::size_t lane) {
  Matrix9 full;
  for (std::size_t r = 0; r < 9; ++r) {
    for (std::size_t s = r; s < 9; ++s) {
      const auto i = static_cast<Eigen::Index>(r);
      const auto j = static_cast<Eigen::Index>(s);
      full(i, j) = full(j, i) = A[packed(r, s) * kLanes + lane];
    }
  }
  return full;
}

Mat3 tensor_of(const double* values, std::size_t lane) {
  Mat3 F;
  for (int i = 0; i < 3; ++i) {
    for (int c = 0; c < 3; ++c) F(i, c) = values[static_cast<std::size_t>(3 * i + c) * kLanes + lane];
  }
  return F;
}

/// The nearest positive semi-definite tangent of each lane.
void make_definite(double* A) {
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const Eigen::SelfAdjointEigenSolver<Matrix9> solver(tangent_of(A, lane));
    if (solver.eigenvalues()(0) >= 0.0) continue;
    const Matrix9 mended = solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).asDiagonal() *
                           solver.eigenvectors().transpose();
    for (std::size_t r = 0; r < 9; ++r) {
      for (std::size_t s = r; s < 9; ++s)
        A[packed(r, s) * kLanes + lane] = mended(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(s));
    }
  }
}

/// Takes the stress out of the tangent, A_iJiL -= S_JL with S = F^-1 P: dE : C : dE is left.
void keep_material(const double* F, const double* P, double* A) {
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const Mat3 S = tensor_of(F, lane).inverse() * tensor_of(P, lane);
    if (!S.allFinite()) continue;  // flattened: nothing is known of S
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t J = 0; J < 3; ++J) {
        for (std::size_t L = J; L < 3; ++L)
          A[packed(3 * i + J, 3 * i + L) * kLanes + lane] -=
              0.5 *
              (S(static_cast<int>(J), static_cast<int>(L)) + S(static_cast<int>(L), static_cast<int>(J)));
      }
    }
  }
}

}  // namespace

ModelInfo Frames::info() {
  using enum Ability::Can;
  return {.name = "frames",
          .form = "frames of six degrees of freedom that carry integration points",
          .laws = {},
          .elements = {},
          .poisson = {yes, "of the law"},
          .rotation = {yes, "exact, except with hooke"},
          .strain = {yes, "the law's"},
          .inversion = {partly, "stable neo-Hooke"},
          .topology = {no, "points and frames stay"}};
}

template <class Function>
void Frames::for_pieces(Function&& f) const {
  const std::int32_t pieces = (order_.groups() + kPiece - 1) / kPiece;
  threads_.for_each(pieces,
                    [&](std::int32_t p) { f(p * kPiece, std::min(order_.groups(), (p + 1) * kPiece)); });
}

template <class Function>
void Frames::for_coloured(Function&& f) const {
  for (std::int32_t colour = 0; colour < order_.colours(); ++colour) {
    const std::int32_t first = order_.colour_begin[static_cast<std::size_t>(colour)];
    const std::int32_t last = order_.colour_begin[static_cast<std::size_t>(colour) + 1];
    threads_.for_each(last - first, [&](std::int32_t c) {
      const FrameOrder::Range chunk = order_.chunks[static_cast<std::size_t>(first + c)];
      for (std::int32_t begin = chunk.begin; begin < chunk.end; begin += kPiece)
        f(begin, std::min(chunk.end, begin + kPiece));
    });
  }
}

FrameView Frames::view() const {
  return {.neighbours = points_.neighbours,
          .frames = lanes_.data(),
          .coefficients = coefficients_.data(),
          .volumes = lane_volumes_.data(),
          .slots = slots_.data(),
          .shared = order_.shared.data()};
}

std::size_t Frames::shares_size() const {
  return static_cast<std::size_t>(order_.groups()) * static_cast<std::size_t>(points_.neighbours) * 6 *
         kLanes;
}

Frames::Room Frames::room(Scratch& scratch) const {
  double* const begin = scratch.reals(motion_size() + shares_size()).data();
  return {begin, begin + 12 * blocks_.size(), begin + motion_size()};
}

void Frames::gather(const State& state, double* motions) const {
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    double* q = motions + 12 * i;
    Eigen::Map<Vec3> origin(q);
    origin = tissu::block(ConstReals(state.positions), blocks_[i]);
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> rotation(q + 3);
    rotation = numbers_[i] < 0 ? Mat3(Mat3::Identity())
                               : state.rotations[static_cast<std::size_t>(numbers_[i])].toRotationMatrix();
  }
}

void Frames::add_shares(const double* shares, double scale, Reals to) const {
  const auto share_stride = 6 * kLanes;
  threads_.for_pieces(static_cast<std::int32_t>(blocks_.size()), [&](std::int32_t begin, std::int32_t end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      std::array<double, 6> sum{};
      for (auto s = order_.share_begin[i]; s < order_.share_begin[i + 1]; ++s) {
        const auto place = static_cast<std::size_t>(order_.share[static_cast<std::size_t>(s)]);
        const double* from = shares + place / kLanes * share_stride + place % kLanes;
        for (std::size_t c = 0; c < 6; ++c) sum[c] += from[c * kLanes];
      }
      tissu::block(to, blocks_[i]) += scale * Vec3(sum[0], sum[1], sum[2]);
      if (rotations_[i] >= 0) tissu::block(to, rotations_[i]) += scale * Vec3(sum[3], sum[4], sum[5]);
    }
  });
}

void Frames::add_force(const State& state, Scratch& scratch, Reals f) const {
  const Room work = room(scratch);
  gather(state, work.q);
  const auto stride = static_cast<std::size_t>(points_.neighbours) * 6 * kLanes;
  const bool tied = !tie_.empty();
  for_pieces([&](std::int32_t begin, std::int32_t end) {
    std::array<double, kPiece * kNine> F;
    std::array<double, kPiece * kNine> P;
    kernels_->gradient(view(), begin, end, work.q, F.data());
    for (std::int32_t g = begin; g < end; ++g) {
      const std::size_t at = static_cast<std::size_t>(g - begin) * kNine;
      material_.stress(g, F.data() + at, P.data() + at);
      if (tied) tie_.add_stress(view(), g, work.q, F.data() + at, P.data() + at);
    }
    double* shares = work.shares + static_cast<std::size_t>(begin) * stride;
    kernels_->force(view(), begin, end, work.q, P.data(), shares);
    for (std::int32_t g = tied ? begin : end; g < end; ++g, shares += stride)
      tie_.add_moments(view(), g, work.q, F.data() + static_cast<std::size_t>(g - begin) * kNine, shares);
  });
  add_shares(work.shares, 1.0, f);
}

void Frames::add_product(const State& state, Scratch& scratch, StiffnessScale scale, ConstReals p,
                         Reals out) const {
  if (scale.position == 0.0) return;
  const Room work = room(scratch);
  gather(state, work.q);
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    Eigen::Map<Vec3>(work.dq + 6 * i) = tissu::block(p, blocks_[i]);
    Eigen::Map<Vec3> turn(work.dq + 6 * i + 3);
    if (rotations_[i] < 0) {
      turn.setZero();
    } else {
      turn = tissu::block(p, rotations_[i]);
    }
  }
  const auto stride = static_cast<std::size_t>(points_.neighbours) * 6 * kLanes;
  const bool tied = !tie_.empty();
  for_pieces([&](std::int32_t begin, std::int32_t end) {
    std::array<double, kPiece * kNine> F;
    std::array<double, kPiece * kNine> P;
    std::array<double, kPiece * kNine> dF;
    std::array<double, kPiece * kNine> dP;
    kernels_->gradient(view(), begin, end, work.q, F.data());
    kernels_->gradient_change(view(), begin, end, work.q, work.dq, dF.data());
    for (std::int32_t g = begin; g < end; ++g) {
      const std::size_t at = static_cast<std::size_t>(g - begin) * kNine;
      material_.stress(g, F.data() + at, P.data() + at);
      material_.stress_change(g, F.data() + at, dF.data() + at, dP.data() + at);
      if (!tied) continue;
      tie_.add_stress(view(), g, work.q, F.data() + at, P.data() + at);
      tie_.add_stress_change(view(), g, work.q, F.data() + at, work.dq, dF.data() + at, dP.data() + at);
    }
    double* shares = work.shares + static_cast<std::size_t>(begin) * stride;
    kernels_->force_change(view(), begin, end, work.q, work.dq, P.data(), dP.data(), shares);
    for (std::int32_t g = tied ? begin : end; g < end; ++g, shares += stride) {
      const std::size_t at = static_cast<std::size_t>(g - begin) * kNine;
      tie_.add_moments_change(view(), g, work.q, F.data() + at, work.dq, dF.data() + at, shares);
    }
  });
  add_shares(work.shares, scale.position, out);
}

void Frames::add_stiffness(const State& state, Scratch& scratch, StiffnessScale scale,
                           BlockMatrix& matrix) const {
  if (scale.position == 0.0) return;
  const Room work = room(scratch);
  gather(state, work.q);
  const bool material = options_.tangent == "material";
  const bool turning = !material && !scale.definite;
  const bool tied = !tie_.empty();
  double* values = matrix.values();
  for_coloured([&](std::int32_t begin, std::int32_t end) {
    std::array<double, kPiece * kNine> F;
    std::array<double, kPiece * kNine> P;
    std::array<double, kPiece * kTangent> A;
    kernels_->gradient(view(), begin, end, work.q, F.data());
    for (std::int32_t g = begin; g < end; ++g) {
      const auto i = static_cast<std::size_t>(g - begin);
      material_.tangent(g, F.data() + i * kNine, A.data() + i * kTangent);
      if (turning || material) material_.stress(g, F.data() + i * kNine, P.data() + i * kNine);
      if (material) keep_material(F.data() + i * kNine, P.data() + i * kNine, A.data() + i * kTangent);
      if (scale.definite) make_definite(A.data() + i * kTangent);
      if (!tied) continue;
      tie_.add_tangent(view(), g, work.q, A.data() + i * kTangent);
      if (turning) tie_.add_stress(view(), g, work.q, F.data() + i * kNine, P.data() + i * kNine);
      tie_.add_stiffness(view(), g, work.q, F.data() + i * kNine, turning, scale.position, values);
    }
    kernels_->stiffness(view(), begin, end, work.q, A.data(), turning ? P.data() : nullptr, scale.position,
                        values);
  });
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    if (rotations_[i] >= 0) matrix.add_diagonal(rotations_[i], -scale.position * holds_[i]);
  }
}

void Frames::energies(double* q, double* of_lanes) const {
  for_pieces([&](std::int32_t begin, std::int32_t end) {
    std::array<double, kPiece * kNine> F;
    kernels_->gradient(view(), begin, end, q, F.data());
    for (std::int32_t g = begin; g < end; ++g) {
      const double* at = F.data() + static_cast<std::size_t>(g - begin) * kNine;
      double* to = of_lanes + static_cast<std::size_t>(g) * kLanes;
      material_.energy(g, at, to);
      if (!tie_.empty()) tie_.add_energy(view(), g, q, at, to);
    }
  });
}

double Frames::energy(const State& state, Scratch& scratch) const {
  const Reals work = scratch.reals(motion_size() + lane_volumes_.size());
  const Reals of_lanes = work.subspan(motion_size());
  std::ranges::fill(of_lanes, 0.0);
  gather(state, work.data());
  energies(work.data(), of_lanes.data());
  return std::inner_product(of_lanes.begin(), of_lanes.end(), lane_volumes_.begin(), 0.0);
}

}  // namespace tissu
