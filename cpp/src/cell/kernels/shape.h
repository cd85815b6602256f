#pragma once

/// What a point of an element of N nodes and reference dimension M asks of the nodes, whatever the quadrature
/// and the law: F, the force that a stress gives back to them, and the blocks of the matrix.

#include "packed.h"

namespace tissu::TISSU_KERNELS {

template <int N, int M>
struct Shape {
  static constexpr int kEntries = 3 * M;  ///< of F and P
  static constexpr int kTangent = kEntries * (kEntries + 1) / 2;
  static constexpr int kRest = M * M + 1;
  static constexpr int kPairs = N * (N + 1) / 2;

  using Nodal = double[N][3][kLanes];
  using Point = double[kEntries][kLanes];
  using PointTangent = double[kTangent][kLanes];

  static void gather_nodes(const ElasticView& view, std::int32_t group, const PackedNodes& from, Nodal& to) {
    const std::uint16_t* places = view.places + static_cast<std::ptrdiff_t>(group) * N * kLanes;
    for (int a = 0; a < N; ++a) {
      for (int lane = 0; lane < kLanes; lane += kWidth) {
        Batch x[3];
        gather_packed(from.values, places + a * kLanes + lane, x);
        for (int i = 0; i < 3; ++i) x[i].store(&to[a][i][lane]);
      }
    }
  }
  static void scatter_nodes(const ElasticView& view, std::int32_t group, const Nodal& from, PackedNodes& to) {
    const std::uint16_t* places = view.places + static_cast<std::ptrdiff_t>(group) * N * kLanes;
    for (int a = 0; a < N; ++a) {
      for (int lane = 0; lane < kLanes; lane += kWidth) {
        const Batch f[3] = {Batch::load(&from[a][0][lane]), Batch::load(&from[a][1][lane]),
                            Batch::load(&from[a][2][lane])};
        scatter_packed(to.values, places + a * kLanes + lane, f);
      }
    }
  }
  /// J^-1 and the volume at a point; the same at all points where the view holds one.
  static const double* rest_of(const ElasticView& view, std::int32_t group, int point) {
    const int at = view.rest_points == 1 ? 0 : point;
    return view.rest + (static_cast<std::ptrdiff_t>(group) * view.rest_points + at) * kRest * kLanes;
  }
  static const double* gradients_of(const ElasticView& view, int point) {
    return view.gradients + static_cast<std::ptrdiff_t>(point) * N * M;
  }
  TISSU_INLINE static void load_inverse(const double* rest, int lane, Batch (&Jinv)[M][M]) {
    for (int k = 0; k < M; ++k) {
      for (int j = 0; j < M; ++j) Jinv[k][j] = Batch::load(rest + (k * M + j) * kLanes + lane);
    }
  }

  /// F = (sum_a u_a (x) dN_a/dxi) J^-1
  static void gradient(const double* dN, const double* rest, const Nodal& u, Point& F) {
    for (int lane = 0; lane < kLanes; lane += kWidth) {
      Batch G[3][M];
      for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < M; ++k) G[i][k] = Batch(0.0);
      }
      for (int a = 0; a < N; ++a) {
        for (int i = 0; i < 3; ++i) {
          const Batch x = Batch::load(&u[a][i][lane]);
          for (int k = 0; k < M; ++k) G[i][k] += x * Batch(dN[a * M + k]);
        }
      }
      Batch Jinv[M][M];
      load_inverse(rest, lane, Jinv);
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < M; ++j) {
          Batch sum = G[i][0] * Jinv[0][j];
          for (int k = 1; k < M; ++k) sum += G[i][k] * Jinv[k][j];
          sum.store(F[i * M + j] + lane);
        }
      }
    }
  }

  /// f_a += scale w P J^-T dN_a/dxi
  static void spread(const double* dN, const double* rest, double scale, const Point& P, Nodal& f) {
    for (int lane = 0; lane < kLanes; lane += kWidth) {
      Batch Jinv[M][M];
      load_inverse(rest, lane, Jinv);
      const Batch w = Batch::load(rest + M * M * kLanes + lane) * Batch(scale);
      Batch H[3][M];
      for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < M; ++k) {
          Batch sum = Batch::load(P[i * M] + lane) * Jinv[k][0];
          for (int j = 1; j < M; ++j) sum += Batch::load(P[i * M + j] + lane) * Jinv[k][j];
          H[i][k] = sum * w;
        }
      }
      for (int a = 0; a < N; ++a) {
        for (int i = 0; i < 3; ++i) {
          Batch sum = Batch::load(&f[a][i][lane]);
          for (int k = 0; k < M; ++k) sum += H[i][k] * Batch(dN[a * M + k]);
          sum.store(&f[a][i][lane]);
        }
      }
    }
  }

  static constexpr int tangent_index(int row, int column) {
    return row <= column ? row * kEntries - row * (row - 1) / 2 + (column - row) : tangent_index(column, row);
  }

  /// The tangent pulled back to the reference cell, scale w J^-1 A J^-T, once for all pairs of nodes of a
  /// point.
  static void pull_back(const double* rest, double scale, int lane, const PointTangent& A,
                        Batch (&B)[3][M][3][M]) {
    Batch Jinv[M][M];
    load_inverse(rest, lane, Jinv);
    const Batch w = Batch::load(rest + M * M * kLanes + lane) * Batch(scale);
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) {
        Batch half[M][M];  // A_iJkL J^-1_nL, indices J and n
        for (int J = 0; J < M; ++J) {
          for (int n = 0; n < M; ++n) {
            Batch sum(0.0);
            for (int L = 0; L < M; ++L) {
              sum += Batch::load(A[tangent_index(i * M + J, k * M + L)] + lane) * Jinv[n][L];
            }
            half[J][n] = sum * w;
          }
        }
        for (int m = 0; m < M; ++m) {
          for (int n = 0; n < M; ++n) {
            Batch sum = Jinv[m][0] * half[0][n];
            for (int J = 1; J < M; ++J) sum += Jinv[m][J] * half[J][n];
            B[i][m][k][n] = sum;
          }
        }
      }
    }
  }

  /// K_ab += dN_a . B . dN_b for a <= b; K is [pair][3 k + i][8].
  static void add_pairs(const double* dN, const Batch (&B)[3][M][3][M], int lane, double (*K)[9][kLanes]) {
    for (int b = 0; b < N; ++b) {
      Batch half[3][M][3];
      for (int i = 0; i < 3; ++i) {
        for (int m = 0; m < M; ++m) {
          for (int k = 0; k < 3; ++k) {
            Batch sum = B[i][m][k][0] * Batch(dN[b * M]);
            for (int n = 1; n < M; ++n) sum += B[i][m][k][n] * Batch(dN[b * M + n]);
            half[i][m][k] = sum;
          }
        }
      }
      for (int a = 0; a <= b; ++a, ++K) {
        for (int k = 0; k < 3; ++k) {
          for (int i = 0; i < 3; ++i) {
            double* to = (*K)[3 * k + i] + lane;
            Batch sum = Batch::load(to);
            for (int m = 0; m < M; ++m) sum += half[i][m][k] * Batch(dN[a * M + m]);
            sum.store(to);
          }
        }
      }
    }
  }

  /// The axes that laws work in at a point, [3][3][8]: tangents in the first M columns. Null: those of space.
  static const double* frame_of(const ElasticView& view, std::int32_t group, int point) {
    if (M == 3 || view.frames == nullptr) return nullptr;
    const int at = view.rest_points == 1 ? 0 : point;
    return view.frames + (static_cast<std::ptrdiff_t>(group) * view.rest_points + at) * 9 * kLanes;
  }
  /// F = Q^T F
  static void turn_in(const ElasticView& view, std::int32_t group, int point, Point& F) {
    if (const double* Q = frame_of(view, group, point)) turn(Q, 1, 3, F);
  }
  /// P = Q P
  static void turn_out(const ElasticView& view, std::int32_t group, int point, Point& P) {
    if (const double* Q = frame_of(view, group, point)) turn(Q, 3, 1, P);
  }
  /// A_ij = sum_p Q[row_stride i + column_stride p] A_pj
  static void turn(const double* Q, int row_stride, int column_stride, Point& A) {
    for (int lane = 0; lane < kLanes; lane += kWidth) {
      for (int j = 0; j < M; ++j) {
        Batch sum[3];
        for (int i = 0; i < 3; ++i) {
          sum[i] = Batch(0.0);
          for (int p = 0; p < 3; ++p) {
            sum[i] += Batch::load(Q + (row_stride * i + column_stride * p) * kLanes + lane) *
                      Batch::load(A[p * M + j] + lane);
          }
        }
        for (int i = 0; i < 3; ++i) sum[i].store(A[i * M + j] + lane);
      }
    }
  }
  /// B_imkn = Q_ip Q_kq B_pmqn
  static void turn_out(const ElasticView& view, std::int32_t group, int point, int lane,
                       Batch (&B)[3][M][3][M]) {
    const double* frame = frame_of(view, group, point);
    if (frame == nullptr) return;
    const auto Q = [&](int i, int p) { return Batch::load(frame + (3 * i + p) * kLanes + lane); };
    for (int m = 0; m < M; ++m) {
      for (int n = 0; n < M; ++n) {
        Batch half[3][3];
        for (int i = 0; i < 3; ++i) {
          for (int q = 0; q < 3; ++q) {
            half[i][q] = Q(i, 0) * B[0][m][q][n] + Q(i, 1) * B[1][m][q][n] + Q(i, 2) * B[2][m][q][n];
          }
        }
        for (int i = 0; i < 3; ++i) {
          for (int k = 0; k < 3; ++k) {
            B[i][m][k][n] = half[i][0] * Q(k, 0) + half[i][1] * Q(k, 1) + half[i][2] * Q(k, 2);
          }
        }
      }
    }
  }

  /// The size of a piece of material now beside its size at rest: det F, or sqrt(det F^T F) below three
  /// dimensions.
  static double volume_ratio(const Point& F, int l) {
    const auto at = [&](int i, int j) { return F[M * i + j][l]; };
    if constexpr (M == 1) {
      return __builtin_sqrt(at(0, 0) * at(0, 0) + at(1, 0) * at(1, 0) + at(2, 0) * at(2, 0));
    } else {
      const double n[3] = {at(1, 0) * at(2, 1) - at(2, 0) * at(1, 1),
                           at(2, 0) * at(0, 1) - at(0, 0) * at(2, 1),
                           at(0, 0) * at(1, 1) - at(1, 0) * at(0, 1)};
      if constexpr (M == 2) {
        return __builtin_sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
      } else {
        return n[0] * at(0, 2) + n[1] * at(1, 2) + n[2] * at(2, 2);
      }
    }
  }

  static void scatter_pairs(const ElasticView& view, std::int32_t group, const double (*K)[9][kLanes],
                            double* blocks) {
    const std::int32_t* slots = view.slots + static_cast<std::ptrdiff_t>(group) * N * N * kLanes;
    for (int b = 0; b < N; ++b) {
      for (int a = 0; a <= b; ++a, ++K) {
        for (int lane = 0; lane < kLanes; lane += kWidth) {
          Batch block[9];
          for (int c = 0; c < 9; ++c) block[c] = Batch::load((*K)[c] + lane);
          scatter_add_block(blocks, slots + (a * N + b) * kLanes + lane, block);
          if (a == b) continue;
          const Batch transposed[9] = {block[0], block[3], block[6], block[1], block[4],
                                       block[7], block[2], block[5], block[8]};
          scatter_add_block(blocks, slots + (b * N + a) * kLanes + lane, transposed);
        }
      }
    }
  }
};

}  // namespace tissu::TISSU_KERNELS
