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
using NineBySix = Eigen::Matrix<double, 9, 6>;

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

/// dF/dq of a frame, whose coefficients stand in the view.
NineBySix motion_of(const FrameView& view, std::int32_t group, int a, std::size_t lane, const Mat3& R) {
  const double* from = view.coefficients + (static_cast<std::ptrdiff_t>(group) * view.neighbours + a) * 12 *
                                               static_cast<std::ptrdiff_t>(kLanes);
  NineBySix D = NineBySix::Zero();
  for (int i = 0; i < 3; ++i) {
    for (int c = 0; c < 3; ++c) D(3 * i + c, i) = from[static_cast<std::size_t>(c) * kLanes + lane];
  }
  D.rightCols<3>() = turned(R * tensor_of(from + 3 * kLanes, lane));
  return D;
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

/// The matrix of one lane, without d2W/dF2.
struct RotationTie::LaneMatrix {
  const Lane& at;
  double c;  ///< of the blocks
  bool whole;
  std::vector<NineBySix> of_F;    ///< dF/dq of each frame
  std::vector<NineByThree> of_M;  ///< dM/dtheta
  ThreeByNine in_M;               ///< ds/dM
  Eigen::Matrix<double, 9, 9> MF;

  LaneMatrix(const Lane& lane, double scale, bool with_s, std::size_t frames)
      : at(lane), c(scale * lane.stiffness), whole(with_s), of_F(frames), of_M(frames), in_M(-slope(lane.F)) {
    MF = in_M.transpose() * slope(at.M);
    if (!whole) return;
    for (int row = 0; row < 9; row += 3) MF.block<3, 3>(row, row) -= cross_of(at.s);
  }

  /// Adds what the frames a and b have in common; slots of xx, xt, tx and tt.
  void add_pair(std::size_t a, std::size_t b, const std::int32_t* slots, double* blocks) const {
    const Eigen::Matrix<double, 6, 3> up = c * of_F[a].transpose() * (MF.transpose() * of_M[b]);
    const Eigen::Matrix<double, 3, 6> down = c * of_M[a].transpose() * (MF * of_F[b]);
    const auto to = [&](std::size_t part) {
      return Eigen::Map<Mat3>(blocks + 9 * static_cast<std::ptrdiff_t>(slots[part * kLanes]));
    };
    to(1) += up.topRows<3>();
    to(2) += down.leftCols<3>();
    to(3) += up.bottomRows<3>() + down.rightCols<3>() + c * (in_M * of_M[a]).transpose() * (in_M * of_M[b]);
  }
};

void RotationTie::add_stiffness(const FrameView& view, std::int32_t group, const double* q, const double* F,
                                bool whole, double scale, double* blocks) const {
  const auto k = static_cast<std::size_t>(neighbours_);
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const double volume = volume_at(view, group, lane);
    if (volume == 0.0) continue;
    const Lane at = lane_of(view, group, lane, q, F);
    LaneMatrix matrix(at, -scale * volume, whole, k);
    std::vector<Mat3> turns(k, Mat3::Zero());
    for (std::size_t a = 0; a < k; ++a) {
      const int frame = static_cast<int>(a);
      const Mat3 R = rotation_at(view, group, frame, lane, q);
      const double w = weight(group, frame, lane);
      matrix.of_F[a] = motion_of(view, group, frame, lane, R);
      matrix.of_M[a] = w * turned(R);
      if (whole) turns[a] = -scale * volume * w * turning(R, at.turning_stress());
    }
    const std::int32_t* slots = view.slots + static_cast<std::size_t>(group) * k * k * 4 * kLanes + lane;
    for (std::size_t pair = 0; pair < k * k; ++pair, slots += 4 * kLanes) {
      matrix.add_pair(pair / k, pair % k, slots, blocks);
      if (pair / k == pair % k)
        Eigen::Map<Mat3>(blocks + 9 * static_cast<std::ptrdiff_t>(slots[3 * kLanes])) += turns[pair / k];
    }
  }
}

}  // namespace tissu
