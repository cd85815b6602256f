#include "tissu/model/frames/rotation_tie.h"

#include <Eigen/Core>
#include <array>
#include <utility>

namespace tissu {
namespace {

constexpr std::size_t kLanes = RotationTie::kLanes;
constexpr double kShare = 0.5;  ///< of G: |s|^2 is twice the square of the skew part of M^T F - F^T M

using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using ThreeByNine = Eigen::Matrix<double, 3, 9>;
using NineByThree = Eigen::Matrix<double, 9, 3>;

Mat3 cross_of(const Vec3& v) {
  Mat3 C;
  C << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return C;
}

Mat3 tensor_of(const double* values, std::size_t lane) {
  Mat3 F;
  for (int i = 0; i < 3; ++i) {
    for (int c = 0; c < 3; ++c) F(i, c) = values[static_cast<std::size_t>(3 * i + c) * kLanes + lane];
  }
  return F;
}

void add_tensor(const Mat3& P, std::size_t lane, double* to) {
  for (int i = 0; i < 3; ++i) {
    for (int c = 0; c < 3; ++c) to[static_cast<std::size_t>(3 * i + c) * kLanes + lane] += P(i, c);
  }
}

std::int32_t frame_at(const FrameView& view, std::int32_t group, int a, std::size_t lane) {
  return view.frames[(static_cast<std::ptrdiff_t>(group) * view.neighbours + a) *
                         static_cast<std::ptrdiff_t>(kLanes) +
                     static_cast<std::ptrdiff_t>(lane)];
}

Mat3 rotation_at(const FrameView& view, std::int32_t group, int a, std::size_t lane, const double* q) {
  return Eigen::Map<const RowMajor>(q + 12 * frame_at(view, group, a, lane) + 3);
}

const double* coefficients_of(const FrameView& view, std::int32_t group, int a) {
  return view.coefficients + (static_cast<std::ptrdiff_t>(group) * view.neighbours + a) * 12 *
                                 static_cast<std::ptrdiff_t>(kLanes);
}

Vec3 turn_at(const FrameView& view, std::int32_t group, int a, std::size_t lane, const double* dq) {
  return Eigen::Map<const Vec3>(dq + 6 * frame_at(view, group, a, lane) + 3);
}

double volume_at(const FrameView& view, std::int32_t group, std::size_t lane) {
  return view.volumes[static_cast<std::size_t>(group) * kLanes + lane];
}

/// sum_k m_k x f_k over the rows.
Vec3 axial(const Mat3& M, const Mat3& F) {
  Vec3 s = Vec3::Zero();
  for (int k = 0; k < 3; ++k) s += Vec3(M.row(k)).cross(Vec3(F.row(k)));
  return s;
}

/// The tensor of rows a_k x s.
Mat3 rows_across(const Mat3& A, const Vec3& s) {
  Mat3 result;
  for (int k = 0; k < 3; ++k) result.row(k) = Vec3(A.row(k)).cross(s);
  return result;
}

/// What Q = dW/dM makes about a frame of rotation R: sum_c r_c x q_c over the columns.
Vec3 moment(const Mat3& R, const Mat3& Q) {
  Vec3 tau = Vec3::Zero();
  for (int c = 0; c < 3; ++c) tau += Vec3(R.col(c)).cross(Vec3(Q.col(c)));
  return tau;
}

/// What that moment changes by when R turns and Q stays, its symmetric part.
Mat3 turning(const Mat3& R, const Mat3& Q) {
  const Mat3 product = R * Q.transpose();
  return 0.5 * (product + product.transpose()) - product.trace() * Mat3::Identity();
}

/// ds/dF, rows of M in cross products; ds/dM is minus the same of F.
ThreeByNine slope(const Mat3& M) {
  ThreeByNine S;
  for (int k = 0; k < 3; ++k) S.block<3, 3>(0, 3 * k) = cross_of(M.row(k));
  return S;
}

/// d(R B)/dtheta, row after row, of a tensor R B = T.
NineByThree turned(const Mat3& T) {
  NineByThree D;
  for (int j = 0; j < 3; ++j) {
    const RowMajor change = cross_of(Vec3::Unit(j)) * T;
    D.col(j) = Eigen::Map<const Eigen::Matrix<double, 9, 1>>(change.data());
  }
  return D;
}

/// The coefficients by which F follows the place of a frame: dF_ic / dx_i.
Vec3 by_place_of(const FrameView& view, std::int32_t group, int a, std::size_t lane) {
  const double* from = coefficients_of(view, group, a);
  return {from[lane], from[kLanes + lane], from[2 * kLanes + lane]};
}

/// dF/dtheta of a frame of rotation R.
NineByThree by_turn_of(const FrameView& view, std::int32_t group, int a, std::size_t lane, const Mat3& R) {
  return turned(R * tensor_of(coefficients_of(view, group, a) + 3 * kLanes, lane));
}

}  // namespace

struct RotationTie::Lane {
  Mat3 M = Mat3::Zero();
  Mat3 F;
  Vec3 s;
  double stiffness = 0.0;

  [[nodiscard]] Mat3 stress() const { return -stiffness * rows_across(M, s); }
  [[nodiscard]] Mat3 turning_stress() const { return stiffness * rows_across(F, s); }
  /// Of changes of M, F and s.
  [[nodiscard]] Mat3 stress_change(const Mat3& dM, const Vec3& ds) const {
    return -stiffness * (rows_across(dM, s) + rows_across(M, ds));
  }
  [[nodiscard]] Mat3 turning_stress_change(const Mat3& dF, const Vec3& ds) const {
    return stiffness * (rows_across(dF, s) + rows_across(F, ds));
  }
};

RotationTie::Lane RotationTie::lane_of(const FrameView& view, std::int32_t group, std::size_t lane,
                                       const double* q, const double* F) const {
  Lane result;
  for (int a = 0; a < neighbours_; ++a)
    result.M += weight(group, a, lane) * rotation_at(view, group, a, lane, q);
  result.F = tensor_of(F, lane);
  result.s = axial(result.M, result.F);
  result.stiffness = kShare * shear_[static_cast<std::size_t>(group) * kLanes + lane];
  return result;
}

void RotationTie::add_energy(const FrameView& view, std::int32_t group, const double* q, const double* F,
                             double* W) const {
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const Lane at = lane_of(view, group, lane, q, F);
    W[lane] += 0.5 * at.stiffness * at.s.squaredNorm();
  }
}

void RotationTie::add_stress(const FrameView& view, std::int32_t group, const double* q, const double* F,
                             double* P) const {
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    add_tensor(lane_of(view, group, lane, q, F).stress(), lane, P);
}

void RotationTie::add_moments(const FrameView& view, std::int32_t group, const double* q, const double* F,
                              double* shares) const {
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const Mat3 Q = lane_of(view, group, lane, q, F).turning_stress();
    for (int a = 0; a < neighbours_; ++a) {
      const double scale = -volume_at(view, group, lane) * weight(group, a, lane);
      const Vec3 tau = scale * moment(rotation_at(view, group, a, lane, q), Q);
      for (int i = 0; i < 3; ++i) shares[static_cast<std::size_t>(6 * a + 3 + i) * kLanes + lane] += tau[i];
    }
  }
}

void RotationTie::add_stress_change(const FrameView& view, std::int32_t group, const double* q,
                                    const double* F, const double* dq, const double* dF, double* dP) const {
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const Lane at = lane_of(view, group, lane, q, F);
    Mat3 dM = Mat3::Zero();
    for (int a = 0; a < neighbours_; ++a) {
      dM += weight(group, a, lane) * cross_of(turn_at(view, group, a, lane, dq)) *
            rotation_at(view, group, a, lane, q);
    }
    const Vec3 ds = axial(dM, at.F) + axial(at.M, tensor_of(dF, lane));
    add_tensor(at.stress_change(dM, ds), lane, dP);
  }
}

void RotationTie::add_moments_change(const FrameView& view, std::int32_t group, const double* q,
                                     const double* F, const double* dq, const double* dF,
                                     double* shares) const {
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const Lane at = lane_of(view, group, lane, q, F);
    Mat3 dM = Mat3::Zero();
    for (int a = 0; a < neighbours_; ++a) {
      dM += weight(group, a, lane) * cross_of(turn_at(view, group, a, lane, dq)) *
            rotation_at(view, group, a, lane, q);
    }
    const Mat3 change = tensor_of(dF, lane);
    const Mat3 Q = at.turning_stress();
    const Mat3 dQ = at.turning_stress_change(change, axial(dM, at.F) + axial(at.M, change));
    for (int a = 0; a < neighbours_; ++a) {
      const Mat3 R = rotation_at(view, group, a, lane, q);
      const double scale = -volume_at(view, group, lane) * weight(group, a, lane);
      const Vec3 tau = scale * (moment(R, dQ) + turning(R, Q) * turn_at(view, group, a, lane, dq));
      for (int i = 0; i < 3; ++i) shares[static_cast<std::size_t>(6 * a + 3 + i) * kLanes + lane] += tau[i];
    }
  }
}

void RotationTie::add_tangent(const FrameView& view, std::int32_t group, const double* q, double* A) const {
  const std::array<double, 9 * kLanes> none{};
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const Lane at = lane_of(view, group, lane, q, none.data());
    const ThreeByNine S = slope(at.M);
    const Eigen::Matrix<double, 9, 9> H = at.stiffness * S.transpose() * S;
    std::size_t entry = 0;
    for (int r = 0; r < 9; ++r) {
      for (int s = r; s < 9; ++s) A[entry++ * kLanes + lane] += H(r, s);
    }
  }
}

/// The matrix of one lane, without d2W/dF2: for each two frames a and b
///   X_ab = c dF/dq_a^T (MF^T dM/dtheta_b),   X_ba^T,   and   c (ds/dtheta_a)^T ds/dtheta_b of M alone.
struct RotationTie::LaneMatrix {
  struct Frame {
    Vec3 by_place;        ///< dF_ic / dx_i
    NineByThree by_turn;  ///< dF/dtheta
    NineByThree across;   ///< c MF^T dM/dtheta
    Mat3 of_s;            ///< ds/dtheta of M alone
  };
  /// X_ab: rows of the place and of the turn of a.
  struct Mixed {
    Mat3 place;
    Mat3 turn;
  };

  double c = 0.0;  ///< of the blocks
  std::vector<Frame> frames;

  /// `whole`: with what s itself makes. The frames are then to be set.
  void set(const Lane& at, double scale, bool whole) {
    c = scale * at.stiffness;
    in_M_ = -slope(at.F);
    MF_ = in_M_.transpose() * slope(at.M);
    if (!whole) return;
    for (int row = 0; row < 9; row += 3) MF_.block<3, 3>(row, row) -= cross_of(at.s);
  }
  void set_frame(Frame& frame, const NineByThree& of_M) const {
    frame.across.noalias() = c * MF_.transpose().lazyProduct(of_M);
    frame.of_s.noalias() = in_M_.lazyProduct(of_M);
  }
  [[nodiscard]] Mixed mixed(const Frame& a, const Frame& b) const {
    Mixed X;
    for (int i = 0; i < 3; ++i)
      X.place.row(i).noalias() = a.by_place.transpose().lazyProduct(b.across.middleRows<3>(3 * i));
    X.turn.noalias() = a.by_turn.transpose().lazyProduct(b.across);
    return X;
  }
  /// Adds what a frame has in common with another one; slots of xx, xt, tx and tt.
  static void add(const Mixed& X, const Mixed& back, const Mat3& common, const std::int32_t* slots,
                  double* blocks) {
    const auto to = [&](std::size_t part) {
      return Eigen::Map<Mat3>(blocks + 9 * static_cast<std::ptrdiff_t>(slots[part * kLanes]));
    };
    to(1) += X.place;
    to(2) += back.place.transpose();
    to(3) += X.turn + back.turn.transpose() + common;
  }

 private:
  ThreeByNine in_M_;  ///< ds/dM
  Eigen::Matrix<double, 9, 9> MF_;
};

void RotationTie::add_stiffness(const FrameView& view, std::int32_t group, const double* q, const double* F,
                                bool whole, double scale, double* blocks) const {
  const auto k = static_cast<std::size_t>(neighbours_);
  LaneMatrix matrix;
  matrix.frames.resize(k);
  std::vector<Mat3> turns(k, Mat3::Zero());
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const double volume = volume_at(view, group, lane);
    if (volume == 0.0) continue;
    const Lane at = lane_of(view, group, lane, q, F);
    matrix.set(at, -scale * volume, whole);
    for (std::size_t a = 0; a < k; ++a) {
      const int number = static_cast<int>(a);
      const Mat3 R = rotation_at(view, group, number, lane, q);
      const double w = weight(group, number, lane);
      LaneMatrix::Frame& frame = matrix.frames[a];
      frame.by_place = by_place_of(view, group, number, lane);
      frame.by_turn = by_turn_of(view, group, number, lane, R);
      matrix.set_frame(frame, w * turned(R));
      if (whole) turns[a] = -scale * volume * w * turning(R, at.turning_stress());
    }
    const std::int32_t* slots = view.slots + static_cast<std::size_t>(group) * k * k * 4 * kLanes + lane;
    const auto slots_of = [&](std::size_t a, std::size_t b) { return slots + (a * k + b) * 4 * kLanes; };
    for (std::size_t a = 0; a < k; ++a) {
      const LaneMatrix::Frame& one = matrix.frames[a];
      const Mat3 own = matrix.c * one.of_s.transpose() * one.of_s + turns[a];
      const LaneMatrix::Mixed X = matrix.mixed(one, one);
      LaneMatrix::add(X, X, own, slots_of(a, a), blocks);
      for (std::size_t b = a + 1; b < k; ++b) {
        const LaneMatrix::Frame& other = matrix.frames[b];
        const LaneMatrix::Mixed there = matrix.mixed(one, other);
        const LaneMatrix::Mixed back = matrix.mixed(other, one);
        const Mat3 common = matrix.c * one.of_s.transpose() * other.of_s;
        LaneMatrix::add(there, back, common, slots_of(a, b), blocks);
        LaneMatrix::add(back, there, common.transpose(), slots_of(b, a), blocks);
      }
    }
  }
}

}  // namespace tissu
