#pragma once

/// What frames at a point have in common: 6 x 6 blocks G_a^T A G_b, G_a = dF/dq_a.

#include "frames.h"

namespace tissu::TISSU_KERNELS {

class FrameStiffness {
 public:
  static constexpr int kMostNeighbours = 64;

  static void add(const FrameView& view, std::int32_t begin, std::int32_t end, const double* q,
                  const double* A, const double* P, double scale, double* blocks) {
    for (std::int32_t group = begin; group < end; ++group, A += FrameLoops::kTangent * kLanes) {
      for (int lane = 0; lane < kLanes; lane += kWidth) {
        add_group(view, group, lane, q, A + lane, scale, blocks);
        if (P != nullptr) add_turning(view, group, lane, q, P + lane, scale, blocks);
      }
      if (P != nullptr) P += 9 * kLanes;
    }
  }

 private:
  using Nine = FrameLoops::Nine;

  /// Entry (r, s) of the packed upper triangle.
  TISSU_INLINE static constexpr int packed(int r, int s) {
    return r <= s ? 9 * r - r * (r - 1) / 2 + (s - r) : packed(s, r);
  }
  /// G_a^T h: what a change of stress h gives the frame a; translations first.
  TISSU_INLINE static void pull(const Batch (&g)[3], const Nine& M, const Nine& h, Batch (&out)[6]) {
    for (int i = 0; i < 3; ++i) out[i] = h[3 * i] * g[0] + h[3 * i + 1] * g[1] + h[3 * i + 2] * g[2];
    Batch tau[3];
    FrameLoops::moment(M, h, tau);
    for (int i = 0; i < 3; ++i) out[3 + i] = tau[i];
  }
  /// h = A G_b e_j
  TISSU_INLINE static void push(const double* A, const Batch (&g)[3], const Nine& M, int j, Nine& h) {
    Batch d[9];
    for (Batch& value : d) value = Batch(0.0);
    if (j < 3) {
      for (int c = 0; c < 3; ++c) d[3 * j + c] = g[c];
    } else {  // e_j x M
      const int up = 3 * ((j - 3 + 1) % 3);
      const int down = 3 * ((j - 3 + 2) % 3);
      for (int c = 0; c < 3; ++c) {
        d[up + c] = -M[down + c];
        d[down + c] = M[up + c];
      }
    }
    const int skip = j < 3 ? -1 : 3 * (j - 3);
    for (int r = 0; r < 9; ++r) {
      Batch sum(0.0);
      if (j < 3) {
        for (int c = 0; c < 3; ++c) sum += Batch::load(A + packed(r, 3 * j + c) * kLanes) * g[c];
      } else {
        for (int s = 0; s < 9; ++s) {
          if (s >= skip && s < skip + 3) continue;
          sum += Batch::load(A + packed(r, s) * kLanes) * d[s];
        }
      }
      h[r] = sum;
    }
  }
  TISSU_INLINE static const std::int32_t* slots_of(const FrameView& view, std::int32_t group, int a, int b) {
    return view.slots +
           ((static_cast<std::ptrdiff_t>(group) * view.neighbours + a) * view.neighbours + b) * 4 * kLanes;
  }
  /// Lanes of one and the same place are added up before they are written.
  TISSU_INLINE static void scatter(double* blocks, const std::int32_t* slot, bool shared, const Nine& K) {
    if (!shared) {
      scatter_add_block(blocks, slot, K);
      return;
    }
    double* to = at(blocks, slot[0], 9);
    for (int k = 0; k < 9; ++k) {
      double sum = 0.0;
      for (int lane = 0; lane < kWidth; ++lane) sum += K[k].v[lane];
      to[k] += sum;
    }
  }
  /// The four 3 x 3 blocks of 6 x 6, each column by column, and those of the transposed pair.
  TISSU_INLINE static void scatter_pair(const FrameView& view, std::int32_t group, int lane, int a, int b,
                                        const Batch (&K)[6][6], double* blocks) {
    const bool shared = view.shared[group] != 0;
    for (int r = 0; r < 2; ++r) {
      for (int c = 0; c < 2; ++c) {
        Nine there;
        Nine back;
        for (int i = 0; i < 3; ++i) {
          for (int j = 0; j < 3; ++j) there[3 * j + i] = back[3 * i + j] = K[3 * c + j][3 * r + i];
        }
        scatter(blocks, slots_of(view, group, a, b) + (2 * r + c) * kLanes + lane, shared, there);
        if (a != b) scatter(blocks, slots_of(view, group, b, a) + (2 * c + r) * kLanes + lane, shared, back);
      }
    }
  }
  static void add_group(const FrameView& view, std::int32_t group, int lane, const double* q, const double* A,
                        double scale, double* blocks) {
    const Batch v =
        Batch(-scale) * Batch::load(view.volumes + static_cast<std::ptrdiff_t>(group) * kLanes + lane);
    Batch g[kMostNeighbours][3];
    Batch M[kMostNeighbours][9];
    for (int a = 0; a < view.neighbours; ++a) FrameLoops::lever(view, group, a, lane, q, g[a], M[a]);
    for (int b = 0; b < view.neighbours; ++b) {
      Nine h[6];
      for (int j = 0; j < 6; ++j) {
        push(A, g[b], M[b], j, h[j]);
        for (Batch& value : h[j]) value = v * value;
      }
      for (int a = 0; a <= b; ++a) {
        Batch K[6][6];  // [column][row]
        for (int j = 0; j < 6; ++j) pull(g[a], M[a], h[j], K[j]);
        scatter_pair(view, group, lane, a, b, K, blocks);
      }
    }
  }
  static void add_turning(const FrameView& view, std::int32_t group, int lane, const double* q,
                          const double* P, double scale, double* blocks) {
    const Batch v =
        Batch(-scale) * Batch::load(view.volumes + static_cast<std::ptrdiff_t>(group) * kLanes + lane);
    Nine p;
    FrameLoops::load_nine(P, p);
    for (Batch& value : p) value = v * value;
    for (int a = 0; a < view.neighbours; ++a) {
      Batch g[3];
      Nine M;
      Nine K;
      FrameLoops::lever(view, group, a, lane, q, g, M);
      FrameLoops::turning(M, p, K);
      scatter(blocks, slots_of(view, group, a, a) + 3 * kLanes + lane, view.shared[group] != 0, K);
    }
  }
};

}  // namespace tissu::TISSU_KERNELS
