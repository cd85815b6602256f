#pragma once

/// One text for every element, quadrature, law and instruction set: F from the nodes, the law at the point,
/// the force back to the nodes.  f_a = -sum_g w_g P grad_a,  K_ab = sum_g w_g grad_a . dP/dF . grad_b.

#include "packed.h"
#include "tissu/law/tensor.h"

namespace tissu::TISSU_KERNELS {

/// dN_a/dxi_k at every point, as numbers the compiler folds into the code.
template <class Element, class Rule>
struct GradientTable {
  double dN[Rule::kPoints][Element::kNodes][3];
  constexpr GradientTable() : dN{} {
    for (int g = 0; g < Rule::kPoints; ++g) {
      const auto gradients = Element::gradients(Rule::points[static_cast<unsigned>(g)].xi);
      TISSU_UNROLL
      for (int a = 0; a < Element::kNodes; ++a) {
        TISSU_UNROLL
        for (int k = 0; k < 3; ++k)
          dN[g][a][k] = gradients[static_cast<unsigned>(a)][static_cast<unsigned>(k)];
      }
    }
  }
};

template <class Element, class Rule, template <class> class LawOf>
struct Elastic {
  using Tensor = Tensor2<Batch>;
  using MaterialLaw = LawOf<Batch>;
  static constexpr int kNodes = Element::kNodes;
  static constexpr int kRest = 10;
  static constexpr int kConstants = static_cast<int>(sizeof(MaterialLaw) / sizeof(Batch));
  static constexpr GradientTable<Element, Rule> kTable{};

  /// The lanes of one batch of a group.
  struct Lanes {
    const std::uint16_t* places;
    const std::int32_t* slots;
    const double* rest;
    int point_stride;  ///< of `rest`
    const double* weights;
    MaterialLaw law;

    TISSU_INLINE Lanes(const ElasticView& view, std::int32_t group, int lane)
        : places(view.places + static_cast<std::ptrdiff_t>(group) * kNodes * kLanes + lane),
          slots(view.slots + static_cast<std::ptrdiff_t>(group) * kNodes * kNodes * kLanes + lane),
          rest(view.rest + static_cast<std::ptrdiff_t>(group) * view.rest_points * kRest * kLanes + lane),
          point_stride(view.rest_points == 1 ? 0 : kRest * kLanes),
          weights(view.weights) {
      const double* constants = view.constants + group * view.constants_stride + lane;
      Batch* values = reinterpret_cast<Batch*>(&law);
      TISSU_UNROLL
      for (int c = 0; c < kConstants; ++c) values[c] = Batch::load(constants + c * kLanes);
    }
    TISSU_INLINE void gather_all(const PackedNodes& from, Batch (&to)[kNodes][3]) const {
      TISSU_UNROLL
      for (int a = 0; a < kNodes; ++a) gather_packed(from.values, places + a * kLanes, to[a]);
    }
    TISSU_INLINE void scatter_all(PackedNodes& to, const Batch (&from)[kNodes][3]) const {
      TISSU_UNROLL
      for (int a = 0; a < kNodes; ++a) scatter_packed(to.values, places + a * kLanes, from[a]);
    }
    TISSU_INLINE Tensor inverse_jacobian(int point) const {
      Tensor Jinv;
      TISSU_UNROLL
      for (int k = 0; k < 9; ++k)
        Jinv.m[k / 3][k % 3] = Batch::load(rest + point * point_stride + k * kLanes);
      return Jinv;
    }
    TISSU_INLINE Batch weight(int point) const {
      const Batch volume = Batch::load(rest + point * point_stride + 9 * kLanes);
      return Rule::kPoints == 1 ? volume : volume * Batch(weights[point]);
    }
  };

  /// sum_a u_a (x) dN_a/dxi, times J^-1: F when u = x, dF when u is a change of x.
  TISSU_INLINE static Tensor gradient(int point, const Batch (&u)[kNodes][3], const Tensor& Jinv) {
    Tensor G;
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) {
      TISSU_UNROLL
      for (int k = 0; k < 3; ++k) {
        Batch sum = u[0][i] * kTable.dN[point][0][k];
        TISSU_UNROLL
        for (int a = 1; a < kNodes; ++a) {
          if (!__builtin_constant_p(kTable.dN[point][a][k]) || kTable.dN[point][a][k] != 0.0) {
            sum += u[a][i] * kTable.dN[point][a][k];
          }
        }
        G(i, k) = sum;
      }
    }
    return tissu::product(G, Jinv);
  }

  /// f_a += s P J^-T dN_a/dxi
  TISSU_INLINE static void spread(int point, const Tensor& P, const Tensor& Jinv, Batch s,
                                  Batch (&f)[kNodes][3]) {
    Tensor H = tissu::product_transposed(P, Jinv);
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) {
      TISSU_UNROLL
      for (int k = 0; k < 3; ++k) H(i, k) = H(i, k) * s;
    }
    TISSU_UNROLL
    for (int a = 0; a < kNodes; ++a) {
      TISSU_UNROLL
      for (int i = 0; i < 3; ++i) {
        TISSU_UNROLL
        for (int k = 0; k < 3; ++k) {
          if (!__builtin_constant_p(kTable.dN[point][a][k]) || kTable.dN[point][a][k] != 0.0) {
            f[a][i] += H(i, k) * kTable.dN[point][a][k];
          }
        }
      }
    }
  }

  TISSU_INLINE static void clear(Batch (&f)[kNodes][3]) {
    TISSU_UNROLL
    for (int a = 0; a < kNodes; ++a) {
      TISSU_UNROLL
      for (int i = 0; i < 3; ++i) f[a][i] = Batch(0.0);
    }
  }

  static void force(const ElasticView& view, const Chunk& chunk, const double* x, double* f) {
    PackedNodes positions;
    PackedNodes sums;
    positions.load(chunk, x);
    sums.clear(chunk);
    for (std::int32_t group = chunk.begin; group < chunk.end; ++group) {
      for (int lane = 0; lane < kLanes; lane += kWidth) {
        const Lanes lanes(view, group, lane);
        Batch position[kNodes][3];
        Batch result[kNodes][3];
        lanes.gather_all(positions, position);
        clear(result);
        for (int g = 0; g < Rule::kPoints; ++g) {
          const Tensor Jinv = lanes.inverse_jacobian(g);
          const Tensor F = gradient(g, position, Jinv);
          spread(g, lanes.law.stress(F), Jinv, -lanes.weight(g), result);
        }
        lanes.scatter_all(sums, result);
      }
    }
    sums.add_to(chunk, f);
  }

  static void product(const ElasticView& view, const Chunk& chunk, const double* x, double scale,
                      const double* p, double* out) {
    PackedNodes positions;
    PackedNodes changes;
    PackedNodes sums;
    positions.load(chunk, x);
    changes.load(chunk, p);
    sums.clear(chunk);
    for (std::int32_t group = chunk.begin; group < chunk.end; ++group) {
      for (int lane = 0; lane < kLanes; lane += kWidth) {
        const Lanes lanes(view, group, lane);
        Batch position[kNodes][3];
        Batch change[kNodes][3];
        Batch result[kNodes][3];
        lanes.gather_all(positions, position);
        lanes.gather_all(changes, change);
        clear(result);
        for (int g = 0; g < Rule::kPoints; ++g) {
          const Tensor Jinv = lanes.inverse_jacobian(g);
          const Tensor F = gradient(g, position, Jinv);
          const Tensor dF = gradient(g, change, Jinv);
          spread(g, lanes.law.stress_change(F, dF), Jinv, lanes.weight(g) * Batch(-scale), result);
        }
        lanes.scatter_all(sums, result);
      }
    }
    sums.add_to(chunk, out);
  }

  /// grad_a N at a point: J^-T dN_a/dxi
  TISSU_INLINE static void rest_gradients(int point, const Tensor& Jinv, Batch (&grad)[kNodes][3]) {
    TISSU_UNROLL
    for (int a = 0; a < kNodes; ++a) {
      TISSU_UNROLL
      for (int j = 0; j < 3; ++j) {
        Batch sum = Jinv(0, j) * kTable.dN[point][a][0];
        TISSU_UNROLL
        for (int k = 1; k < 3; ++k) sum += Jinv(k, j) * kTable.dN[point][a][k];
        grad[a][j] = sum;
      }
    }
  }

  /// half(i, J, k) = A_iJkL grad_b[L]
  TISSU_INLINE static void contract(const Tangent<Batch>& A, const Batch (&grad)[3], Batch (&half)[3][3][3]) {
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) {
      TISSU_UNROLL
      for (int J = 0; J < 3; ++J) {
        TISSU_UNROLL
        for (int k = 0; k < 3; ++k) {
          half[i][J][k] = A(i, J, k, 0) * grad[0] + A(i, J, k, 1) * grad[1] + A(i, J, k, 2) * grad[2];
        }
      }
    }
  }

  /// Adds the block (a, b) and, when a != b, its transpose as (b, a). `block` is column by column.
  TISSU_INLINE static void scatter_pair(const Lanes& lanes, int a, int b, const Batch (&block)[9],
                                        double* blocks) {
    scatter_add_block(blocks, lanes.slots + (a * kNodes + b) * kLanes, block);
    if (a == b) return;
    const Batch transposed[9] = {block[0], block[3], block[6], block[1], block[4],
                                 block[7], block[2], block[5], block[8]};
    scatter_add_block(blocks, lanes.slots + (b * kNodes + a) * kLanes, transposed);
  }

  static constexpr int kFirst =
      Element::kAffine ? 1 : 0;  ///< node 0 of an affine cell follows from the others
  static constexpr int kPairs = (kNodes - kFirst) * (kNodes - kFirst + 1) / 2;

  TISSU_INLINE static void point_stiffness(const Lanes& lanes, int g, const Batch (&position)[kNodes][3],
                                           double scale, Batch (&K)[kPairs][9]) {
    const Tensor Jinv = lanes.inverse_jacobian(g);
    Tangent<Batch> A = lanes.law.tangent(gradient(g, position, Jinv));
    const Batch s = lanes.weight(g) * Batch(-scale);
    for (Batch& a : A.a) a = a * s;
    Batch grad[kNodes][3];
    rest_gradients(g, Jinv, grad);
    int pair = 0;
    for (int b = kFirst; b < kNodes; ++b) {
      Batch half[3][3][3];
      contract(A, grad[b], half);
      for (int a = kFirst; a <= b; ++a, ++pair) {
        TISSU_UNROLL
        for (int k = 0; k < 3; ++k) {
          TISSU_UNROLL
          for (int i = 0; i < 3; ++i) {
            K[pair][3 * k + i] +=
                half[i][0][k] * grad[a][0] + half[i][1][k] * grad[a][1] + half[i][2][k] * grad[a][2];
          }
        }
      }
    }
  }

  /// Block (0, b) = -sum_a (a, b) of an affine cell, because its gradients sum to zero.
  TISSU_INLINE static void scatter_first_node(const Lanes& lanes, const Batch (&K)[kPairs][9],
                                              double* blocks) {
    Batch corner[9];
    for (Batch& entry : corner) entry = Batch(0.0);
    for (int b = 1; b < kNodes; ++b) {
      Batch row[9];
      for (Batch& entry : row) entry = Batch(0.0);
      TISSU_UNROLL
      for (int a = 1; a < kNodes; ++a) {
        const int high = a < b ? b : a;
        const int low = a < b ? a : b;
        const Batch(&block)[9] = K[(high - 1) * high / 2 + low - 1];
        TISSU_UNROLL
        for (int c = 0; c < 9; ++c) row[c] -= a <= b ? block[c] : block[(c % 3) * 3 + c / 3];
      }
      TISSU_UNROLL
      for (int c = 0; c < 9; ++c) corner[c] -= row[c];
      scatter_pair(lanes, 0, b, row, blocks);
    }
    scatter_pair(lanes, 0, 0, corner, blocks);
  }

  static void stiffness(const ElasticView& view, const Chunk& chunk, const double* x, double scale,
                        double* blocks) {
    PackedNodes positions;
    positions.load(chunk, x);
    for (std::int32_t group = chunk.begin; group < chunk.end; ++group) {
      for (int lane = 0; lane < kLanes; lane += kWidth) {
        const Lanes lanes(view, group, lane);
        Batch position[kNodes][3];
        Batch K[kPairs][9];
        lanes.gather_all(positions, position);
        for (auto& block : K) {
          for (Batch& entry : block) entry = Batch(0.0);
        }
        for (int g = 0; g < Rule::kPoints; ++g) point_stiffness(lanes, g, position, scale, K);
        int pair = 0;
        for (int b = kFirst; b < kNodes; ++b) {
          for (int a = kFirst; a <= b; ++a, ++pair) scatter_pair(lanes, a, b, K[pair], blocks);
        }
        if constexpr (Element::kAffine) scatter_first_node(lanes, K, blocks);
      }
    }
  }

  static void energy(const ElasticView& view, const Chunk& chunk, const double* x, double* energies) {
    PackedNodes positions;
    positions.load(chunk, x);
    for (std::int32_t group = chunk.begin; group < chunk.end; ++group) {
      for (int lane = 0; lane < kLanes; lane += kWidth) {
        const Lanes lanes(view, group, lane);
        Batch position[kNodes][3];
        lanes.gather_all(positions, position);
        Batch sum(0.0);
        for (int g = 0; g < Rule::kPoints; ++g) {
          sum += lanes.weight(g) * lanes.law.energy(gradient(g, position, lanes.inverse_jacobian(g)));
        }
        double* to = energies + static_cast<std::ptrdiff_t>(group) * kLanes + lane;
        (Batch::load(to) + sum).store(to);
      }
    }
  }

  /// sigma = P F^T / det F, weighted with the rest volume.
  static void stress(const ElasticView& view, const Chunk& chunk, const double* x, double* stresses,
                     double* ratios) {
    constexpr int row[6] = {0, 1, 2, 1, 0, 0};
    constexpr int column[6] = {0, 1, 2, 2, 2, 1};
    PackedNodes positions;
    positions.load(chunk, x);
    for (std::int32_t group = chunk.begin; group < chunk.end; ++group) {
      for (int lane = 0; lane < kLanes; lane += kWidth) {
        const Lanes lanes(view, group, lane);
        Batch position[kNodes][3];
        lanes.gather_all(positions, position);
        Batch volume(0.0);
        Batch ratio(0.0);
        Batch sum[6];
        for (Batch& s : sum) s = Batch(0.0);
        for (int g = 0; g < Rule::kPoints; ++g) {
          const Tensor F = gradient(g, position, lanes.inverse_jacobian(g));
          const Batch J = determinant(F);
          const Tensor tau = tissu::product_transposed(lanes.law.stress(F), F);
          const Batch w = lanes.weight(g);
          volume += w;
          ratio += w * J;
          TISSU_UNROLL
          for (int s = 0; s < 6; ++s)
            sum[s] += w / J * (tau(row[s], column[s]) + tau(column[s], row[s])) * Batch(0.5);
        }
        double* to = stresses + static_cast<std::ptrdiff_t>(group) * 6 * kLanes + lane;
        TISSU_UNROLL
        for (int s = 0; s < 6; ++s) (sum[s] / volume).store(to + s * kLanes);
        (ratio / volume).store(ratios + static_cast<std::ptrdiff_t>(group) * kLanes + lane);
      }
    }
  }

  static constexpr ElasticKernels table(std::string_view quadrature) {
    return {Element::kName, MaterialLaw::kName, quadrature, kNodes,  3,
            &force,         &product,           &stiffness, &energy, &stress};
  }
};

}  // namespace tissu::TISSU_KERNELS
