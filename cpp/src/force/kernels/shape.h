#pragma once

/// The loops over elements of N nodes and reference dimension M, for any quadrature and any law: at each
/// point the law is called for the eight elements of a group. Next to elastic.h, which is compiled for one
/// element, quadrature and law and keeps F in registers, it costs a pass through the first-level cache.

#include "tissu/base/batch.h"
#include "tissu/force/elastic_kernels.h"

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

  static void gather_nodes(const ElasticView& view, std::int32_t group, const double* from, Nodal& to) {
    const std::int32_t* nodes = view.nodes + static_cast<std::ptrdiff_t>(group) * N * kLanes;
    for (int a = 0; a < N; ++a) {
      for (int lane = 0; lane < kLanes; lane += kWidth) {
        Batch x[3];
        gather(from, nodes + a * kLanes + lane, x);
        for (int i = 0; i < 3; ++i) x[i].store(&to[a][i][lane]);
      }
    }
  }
  static void scatter_nodes(const ElasticView& view, std::int32_t group, const Nodal& from, double* to) {
    const std::int32_t* nodes = view.nodes + static_cast<std::ptrdiff_t>(group) * N * kLanes;
    for (int a = 0; a < N; ++a) {
      for (int lane = 0; lane < kLanes; lane += kWidth) {
        const Batch f[3] = {Batch::load(&from[a][0][lane]), Batch::load(&from[a][1][lane]),
                            Batch::load(&from[a][2][lane])};
        scatter_add(to, nodes + a * kLanes + lane, f);
      }
    }
  }
  static const double* rest_of(const ElasticView& view, std::int32_t group, int point) {
    return view.rest + (static_cast<std::ptrdiff_t>(group) * view.points + point) * kRest * kLanes;
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

  template <class Array>
  TISSU_INLINE static void clear(Array& values) {
    __builtin_memset(&values, 0, sizeof values);
  }

  /// Calls f(law, its constants) for each law of a group.
  template <class Function>
  TISSU_INLINE static void for_laws(const ElasticView& view, std::int32_t group, Function&& f) {
    const double* constants = view.constants + group * view.constants_stride;
    for (int l = 0; l < view.law_count; ++l) {
      f(*view.laws[l], constants);
      constants += static_cast<std::ptrdiff_t>(view.laws[l]->constants) * kLanes;
    }
  }

  static void force(const ElasticView& view, GroupRange range, const double* x, double* f) {
    alignas(64) Nodal position;
    alignas(64) Nodal result;
    alignas(64) Point F;
    alignas(64) Point P;
    for (std::int32_t group = range.begin; group < range.end; ++group) {
      gather_nodes(view, group, x, position);
      clear(result);
      for (int g = 0; g < view.points; ++g) {
        const double* rest = rest_of(view, group, g);
        gradient(gradients_of(view, g), rest, position, F);
        clear(P);
        for_laws(view, group, [&](const LawKernels& law, const double* c) { law.stress(c, 1, F[0], P[0]); });
        spread(gradients_of(view, g), rest, -1.0, P, result);
      }
      scatter_nodes(view, group, result, f);
    }
  }

  static void product(const ElasticView& view, GroupRange range, const double* x, double scale,
                      const double* p, double* out) {
    alignas(64) Nodal position;
    alignas(64) Nodal change;
    alignas(64) Nodal result;
    alignas(64) Point F;
    alignas(64) Point dF;
    alignas(64) Point dP;
    for (std::int32_t group = range.begin; group < range.end; ++group) {
      gather_nodes(view, group, x, position);
      gather_nodes(view, group, p, change);
      clear(result);
      for (int g = 0; g < view.points; ++g) {
        const double* rest = rest_of(view, group, g);
        gradient(gradients_of(view, g), rest, position, F);
        gradient(gradients_of(view, g), rest, change, dF);
        clear(dP);
        for_laws(view, group, [&](const LawKernels& law, const double* c) {
          law.stress_change(c, 1, F[0], dF[0], dP[0]);
        });
        spread(gradients_of(view, g), rest, -scale, dP, result);
      }
      scatter_nodes(view, group, result, out);
    }
  }

  static void stiffness(const ElasticView& view, GroupRange range, const double* x, double scale,
                        double* blocks) {
    alignas(64) Nodal position;
    alignas(64) Point F;
    alignas(64) PointTangent A;
    alignas(64) double K[kPairs][9][kLanes];
    for (std::int32_t group = range.begin; group < range.end; ++group) {
      gather_nodes(view, group, x, position);
      clear(K);
      for (int g = 0; g < view.points; ++g) {
        const double* rest = rest_of(view, group, g);
        gradient(gradients_of(view, g), rest, position, F);
        clear(A);
        for_laws(view, group, [&](const LawKernels& law, const double* c) { law.tangent(c, 1, F[0], A[0]); });
        for (int lane = 0; lane < kLanes; lane += kWidth) {
          Batch B[3][M][3][M];
          pull_back(rest, -scale, lane, A, B);
          add_pairs(gradients_of(view, g), B, lane, K);
        }
      }
      scatter_pairs(view, group, K, blocks);
    }
  }

  static void energy(const ElasticView& view, GroupRange range, const double* x, double* energies) {
    alignas(64) Nodal position;
    alignas(64) Point F;
    alignas(64) double W[kLanes];
    for (std::int32_t group = range.begin; group < range.end; ++group) {
      double* to = energies + static_cast<std::ptrdiff_t>(group) * kLanes;
      gather_nodes(view, group, x, position);
      for (int g = 0; g < view.points; ++g) {
        const double* rest = rest_of(view, group, g);
        gradient(gradients_of(view, g), rest, position, F);
        clear(W);
        for_laws(view, group, [&](const LawKernels& law, const double* c) { law.energy(c, 1, F[0], W); });
        for (int lane = 0; lane < kLanes; ++lane) to[lane] += rest[M * M * kLanes + lane] * W[lane];
      }
    }
  }

  /// sigma = P F^T / det F of a volume, weighted with the rest volume.
  static void stress(const ElasticView& view, GroupRange range, const double* x, double* stresses,
                     double* ratios) {
    static_assert(M == 3);
    constexpr int row[6] = {0, 1, 2, 1, 0, 0};
    constexpr int column[6] = {0, 1, 2, 2, 2, 1};
    alignas(64) Nodal position;
    alignas(64) Point F;
    alignas(64) Point P;
    for (std::int32_t group = range.begin; group < range.end; ++group) {
      alignas(64) double sum[7][kLanes];
      double volume[kLanes];
      clear(sum);
      clear(volume);
      gather_nodes(view, group, x, position);
      for (int g = 0; g < view.points; ++g) {
        const double* rest = rest_of(view, group, g);
        gradient(gradients_of(view, g), rest, position, F);
        clear(P);
        for_laws(view, group, [&](const LawKernels& law, const double* c) { law.stress(c, 1, F[0], P[0]); });
        for (int l = 0; l < kLanes; ++l) {
          const auto at = [&](int i, int j) { return F[3 * i + j][l]; };
          const double J = at(0, 0) * (at(1, 1) * at(2, 2) - at(1, 2) * at(2, 1)) -
                           at(0, 1) * (at(1, 0) * at(2, 2) - at(1, 2) * at(2, 0)) +
                           at(0, 2) * (at(1, 0) * at(2, 1) - at(1, 1) * at(2, 0));
          const double w = rest[9 * kLanes + l];
          volume[l] += w;
          sum[6][l] += w * J;
          for (int s = 0; s < 6; ++s) {
            double tau = 0.0;
            for (int j = 0; j < 3; ++j) {
              tau +=
                  0.5 * (P[3 * row[s] + j][l] * at(column[s], j) + P[3 * column[s] + j][l] * at(row[s], j));
            }
            sum[s][l] += w / J * tau;
          }
        }
      }
      double* to = stresses + static_cast<std::ptrdiff_t>(group) * 6 * kLanes;
      for (int l = 0; l < kLanes; ++l) {
        for (int s = 0; s < 6; ++s) to[s * kLanes + l] = sum[s][l] / volume[l];
        ratios[static_cast<std::ptrdiff_t>(group) * kLanes + l] = sum[6][l] / volume[l];
      }
    }
  }

  static constexpr ElasticKernels table() {
    return {"", "", "", N, M, &force, &product, &stiffness, &energy, &stress};
  }
};

}  // namespace tissu::TISSU_KERNELS
