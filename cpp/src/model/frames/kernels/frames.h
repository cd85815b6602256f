#pragma once

/// Frames at eight points: the loops that FrameKernels names.

#include "tissu/base/batch.h"
#include "tissu/model/frames/frame_kernels.h"

namespace tissu::TISSU_KERNELS {

struct FrameLoops {
  static constexpr int kTangent = 45;

  using Nine = Batch[9];

  TISSU_INLINE static const std::int32_t* frames_of(const FrameView& view, std::int32_t group, int a) {
    return view.frames + (static_cast<std::ptrdiff_t>(group) * view.neighbours + a) * kLanes;
  }
  TISSU_INLINE static const double* coefficients_of(const FrameView& view, std::int32_t group, int a) {
    return view.coefficients + (static_cast<std::ptrdiff_t>(group) * view.neighbours + a) * 12 * kLanes;
  }
  /// `Count` numbers of a frame for each lane, from `first` on, of frames with `size` numbers each.
  template <int Count>
  TISSU_INLINE static void gather(const double* values, int size, int first, const std::int32_t* frames,
                                  Batch (&out)[Count]) {
    double lanes[Count][kWidth];
    for (int lane = 0; lane < kWidth; ++lane) {
      const double* from = at(values, frames[lane], size) + first;
      for (int c = 0; c < Count; ++c) lanes[c][lane] = from[c];
    }
    for (int c = 0; c < Count; ++c) out[c] = Batch::load(lanes[c]);
  }
  TISSU_INLINE static void load_nine(const double* values, Nine& out) {
    for (int k = 0; k < 9; ++k) out[k] = Batch::load(values + k * kLanes);
  }
  TISSU_INLINE static void store_nine(const Nine& values, double* to) {
    for (int k = 0; k < 9; ++k) values[k].store(to + k * kLanes);
  }
  /// M = R B
  TISSU_INLINE static void turned(const Nine& R, const Nine& B, Nine& M) {
    for (int i = 0; i < 3; ++i) {
      for (int c = 0; c < 3; ++c)
        M[3 * i + c] = R[3 * i] * B[c] + R[3 * i + 1] * B[3 + c] + R[3 * i + 2] * B[6 + c];
    }
  }
  /// g and M of one frame.
  TISSU_INLINE static void lever(const FrameView& view, std::int32_t group, int a, int lane, const double* q,
                                 Batch (&g)[3], Nine& M) {
    const double* coefficients = coefficients_of(view, group, a) + lane;
    Nine R;
    Nine B;
    gather<9>(q, 12, 3, frames_of(view, group, a) + lane, R);
    for (int c = 0; c < 3; ++c) g[c] = Batch::load(coefficients + c * kLanes);
    load_nine(coefficients + 3 * kLanes, B);
    turned(R, B, M);
  }
  /// sum_c m_c x p_c
  TISSU_INLINE static void moment(const Nine& M, const Nine& P, Batch (&out)[3]) {
    for (int i = 0; i < 3; ++i) {
      const int j = 3 * ((i + 1) % 3);
      const int k = 3 * ((i + 2) % 3);
      out[i] = Batch(0.0);
      for (int c = 0; c < 3; ++c) out[i] += M[j + c] * P[k + c] - M[k + c] * P[j + c];
    }
  }
  /// 1/2 (M P^T + P M^T) - (M : P) I: what the moment changes by when M turns and P stays, its symmetric
  /// part.
  TISSU_INLINE static void turning(const Nine& M, const Nine& P, Nine& out) {
    Batch sum(0.0);
    for (int k = 0; k < 9; ++k) sum += M[k] * P[k];
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        Batch value(0.0);
        for (int c = 0; c < 3; ++c) value += M[3 * i + c] * P[3 * j + c] + P[3 * i + c] * M[3 * j + c];
        out[3 * i + j] = Batch(0.5) * value;
      }
      out[4 * i] -= sum;
    }
  }

  static void gradient(const FrameView& view, std::int32_t begin, std::int32_t end, const double* q,
                       double* F);
  static void gradient_change(const FrameView& view, std::int32_t begin, std::int32_t end, const double* q,
                              const double* dq, double* dF);
  static void force(const FrameView& view, std::int32_t begin, std::int32_t end, const double* q,
                    const double* P, double* shares);
  static void force_change(const FrameView& view, std::int32_t begin, std::int32_t end, const double* q,
                           const double* dq, const double* P, const double* dP, double* shares);
};

inline void FrameLoops::gradient(const FrameView& view, std::int32_t begin, std::int32_t end, const double* q,
                                 double* F) {
  for (std::int32_t group = begin; group < end; ++group, F += 9 * kLanes) {
    for (int lane = 0; lane < kLanes; lane += kWidth) {
      Nine sum;
      for (Batch& value : sum) value = Batch(0.0);
      for (int a = 0; a < view.neighbours; ++a) {
        Batch x[3];
        Batch g[3];
        Nine M;
        gather<3>(q, 12, 0, frames_of(view, group, a) + lane, x);
        lever(view, group, a, lane, q, g, M);
        for (int i = 0; i < 3; ++i) {
          for (int c = 0; c < 3; ++c) sum[3 * i + c] += x[i] * g[c] + M[3 * i + c];
        }
      }
      store_nine(sum, F + lane);
    }
  }
}

inline void FrameLoops::gradient_change(const FrameView& view, std::int32_t begin, std::int32_t end,
                                        const double* q, const double* dq, double* dF) {
  for (std::int32_t group = begin; group < end; ++group, dF += 9 * kLanes) {
    for (int lane = 0; lane < kLanes; lane += kWidth) {
      Nine sum;
      for (Batch& value : sum) value = Batch(0.0);
      for (int a = 0; a < view.neighbours; ++a) {
        Batch d[6];
        Batch g[3];
        Nine M;
        gather<6>(dq, 6, 0, frames_of(view, group, a) + lane, d);
        lever(view, group, a, lane, q, g, M);
        for (int c = 0; c < 3; ++c) {
          sum[c] += d[0] * g[c] + d[4] * M[6 + c] - d[5] * M[3 + c];
          sum[3 + c] += d[1] * g[c] + d[5] * M[c] - d[3] * M[6 + c];
          sum[6 + c] += d[2] * g[c] + d[3] * M[3 + c] - d[4] * M[c];
        }
      }
      store_nine(sum, dF + lane);
    }
  }
}

inline void FrameLoops::force(const FrameView& view, std::int32_t begin, std::int32_t end, const double* q,
                              const double* P, double* shares) {
  for (std::int32_t group = begin; group < end; ++group, P += 9 * kLanes) {
    for (int lane = 0; lane < kLanes; lane += kWidth) {
      const Batch v = -Batch::load(view.volumes + static_cast<std::ptrdiff_t>(group) * kLanes + lane);
      Nine p;
      load_nine(P + lane, p);
      for (Batch& value : p) value = v * value;
      for (int a = 0; a < view.neighbours; ++a) {
        double* to = shares + (static_cast<std::ptrdiff_t>(group - begin) * view.neighbours + a) * 6 * kLanes;
        Batch g[3];
        Batch tau[3];
        Nine M;
        lever(view, group, a, lane, q, g, M);
        moment(M, p, tau);
        for (int i = 0; i < 3; ++i) {
          (p[3 * i] * g[0] + p[3 * i + 1] * g[1] + p[3 * i + 2] * g[2]).store(to + i * kLanes + lane);
          tau[i].store(to + (3 + i) * kLanes + lane);
        }
      }
    }
  }
}

inline void FrameLoops::force_change(const FrameView& view, std::int32_t begin, std::int32_t end,
                                     const double* q, const double* dq, const double* P, const double* dP,
                                     double* shares) {
  force(view, begin, end, q, dP, shares);
  if (P == nullptr) return;
  for (std::int32_t group = begin; group < end; ++group, P += 9 * kLanes) {
    for (int lane = 0; lane < kLanes; lane += kWidth) {
      const Batch v = -Batch::load(view.volumes + static_cast<std::ptrdiff_t>(group) * kLanes + lane);
      Nine p;
      load_nine(P + lane, p);
      for (Batch& value : p) value = v * value;
      for (int a = 0; a < view.neighbours; ++a) {
        double* to = shares + (static_cast<std::ptrdiff_t>(group - begin) * view.neighbours + a) * 6 * kLanes;
        Batch turn[3];
        Batch g[3];
        Nine M;
        Nine K;
        gather<3>(dq, 6, 3, frames_of(view, group, a) + lane, turn);
        lever(view, group, a, lane, q, g, M);
        turning(M, p, K);
        for (int i = 0; i < 3; ++i) {
          double* place = to + (3 + i) * kLanes + lane;
          (Batch::load(place) + K[3 * i] * turn[0] + K[3 * i + 1] * turn[1] + K[3 * i + 2] * turn[2])
              .store(place);
        }
      }
    }
  }
}

}  // namespace tissu::TISSU_KERNELS
