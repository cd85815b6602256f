#pragma once

/// The blocks of the matrix. In the cell's axes -df/dx is
///   H_ab = K_ab + V_a^T U_b + U_a^T V_b,  K_ab = lambda M_ab + mu M_ab^T + mu tr(M_ab) I,
///   M_ab = sum_g w_g grad_a (x) grad_b,
/// with U and V of spin.h for the exact tangent, none for the other. K is made of the gradients again each
/// time: kept, it would be 300 numbers of a hexahedron, and no less to turn.

#include "cell/kernels/semidefinite.h"
#include "corotational.h"

namespace tissu::TISSU_KERNELS {

/// w = sum_a U_a q_a. With s_a the node's share of the stresses, L_a w their change when the shape turns by
/// -w, c_a = -(force of k), Th w the change of t and Ps w that of D^T k with it:
///   V_a = E_a^T + (Th + Ps) U_a / 2,  E_a = -[s_a] - L_a - [c_a].
template <class Element, class Rule, template <class> class LawOf>
struct SpinBlocks {
  using Kernel = Corotational<Element, Rule, LawOf, true>;
  using Cell = typename Kernel::Cell;
  using Base = typename Kernel::Base;
  using Nodal = typename Kernel::Nodal;
  static constexpr int kNodes = Base::kNodes;

  Matrix U[kNodes];
  Matrix V[kNodes];

  TISSU_INLINE SpinBlocks(const CorotationalView& view, const Cell& cell) {
    const Spin spin = Kernel::spin_of(view, cell);
    Nodal f;
    Batch t[3];
    Batch k[3];
    Kernel::clear(t);
    Kernel::turned_force(cell, f, t);
    Base::close(f);
    spin.transposed(t, k);
    Kernel::add_spin_force(cell, spin, k, f);  // -s_a - c_a
    for (int a = 0; a < kNodes; ++a) {
      Batch g[3];
      cell.centre.rest_gradient(Kernel::Centre::kTable.dN[0][a], g);
      U[a] = spin.of_node(g);
      const Batch zero(0.0);
      const Batch(&v)[3] = f[a];
      V[a] = {{{zero, v[2], -v[1]}, {-v[2], zero, v[0]}, {v[1], -v[0], zero}}};  // [f_a]^T
    }
    Matrix second;
    add_turns(cell, spin, k, second);
    for (int a = 0; a < kNodes; ++a) {
      const Matrix half = product(second, U[a]);
      for (int i = 0; i < 9; ++i) V[a].m[i / 3][i % 3] += Batch(0.5) * half.m[i / 3][i % 3];
      U[a] = product_transposed(U[a], cell.R);
      V[a] = product_transposed(V[a], cell.R);
    }
  }

  /// V_a -= L_a^T, and Th + Ps, a column for each axis that the cell may turn about.
  TISSU_INLINE void add_turns(const Cell& cell, const Spin& spin, const Batch (&k)[3], Matrix& second) {
    Nodal none;
    Base::clear(none);
    for (int i = 0; i < 3; ++i) {
      const Batch w[3] = {Batch(i == 0 ? 1.0 : 0.0), Batch(i == 1 ? 1.0 : 0.0), Batch(i == 2 ? 1.0 : 0.0)};
      Nodal z;
      Nodal df;
      Batch column[3];
      Kernel::clear(column);
      Kernel::change_of_shape(cell, none, w, z);
      Kernel::change_with_shape(cell, z, df, column);
      Base::close(df);
      spin.add_change(Kernel::Centre::gradient(0, z, cell.centre), k, -1.0, column);
      for (int a = 0; a < kNodes; ++a) {
        for (int j = 0; j < 3; ++j) V[a](i, j) -= df[a][j];
      }
      for (int j = 0; j < 3; ++j) second(j, i) = column[j];
    }
  }

  /// block += s (V_a^T U_b + U_a^T V_b), column by column
  TISSU_INLINE void add_to(int a, int b, Batch s, Batch (&block)[9]) const {
    TISSU_UNROLL
    for (int j = 0; j < 3; ++j) {
      TISSU_UNROLL
      for (int i = 0; i < 3; ++i) {
        Batch sum(0.0);
        TISSU_UNROLL
        for (int k = 0; k < 3; ++k) sum += V[a](k, i) * U[b](k, j) + U[a](k, i) * V[b](k, j);
        block[3 * j + i] += s * sum;
      }
    }
  }
};

using CorotationalDefiniteLoop = decltype(CorotationalKernels::definite);

template <class Element, class Rule, template <class> class LawOf, bool kExact>
struct CorotationalStiffness : Corotational<Element, Rule, LawOf, kExact> {
  using Kernel = Corotational<Element, Rule, LawOf, kExact>;
  using Cell = typename Kernel::Cell;
  using Base = typename Kernel::Base;
  using Base::kFirst;
  using Base::kNodes;
  using Base::kPairs;
  using typename Kernel::Inverse;
  using Gradients = Batch[Rule::kPoints][kNodes][3];

  /// R grad_a at every point
  TISSU_INLINE static void turned_gradients(const Cell& cell, Gradients& grad) {
    for (int g = 0; g < Rule::kPoints; ++g) {
      const Matrix turn = cell.lanes.inverse_jacobian(g).transposed_after(cell.R);  // R J^-T
      for (int a = kFirst; a < kNodes; ++a) {
        const double(&dN)[3] = Base::kTable.dN[g][a];
        TISSU_UNROLL
        for (int i = 0; i < 3; ++i) {
          grad[g][a][i] = turn(i, 0) * dN[0] + turn(i, 1) * dN[1] + turn(i, 2) * dN[2];
        }
      }
    }
  }

  /// s K_ab, column by column, of s M_ab
  TISSU_INLINE static void elastic_block(const Cell& cell, const Matrix& M, Batch (&block)[9]) {
    const Batch lambda = cell.lanes.law.lambda;
    const Batch mu = cell.lanes.law.mu;
    const Batch trace = mu * (M(0, 0) + M(1, 1) + M(2, 2));
    TISSU_UNROLL
    for (int j = 0; j < 3; ++j) {
      TISSU_UNROLL
      for (int i = 0; i < 3; ++i) {
        block[3 * j + i] = lambda * M(i, j) + mu * M(j, i);
        if (i == j) block[3 * j + i] += trace;
      }
    }
  }

  TISSU_INLINE static void blocks_of(const Cell& cell, double scale, Batch (&K)[kPairs][9]) {
    Gradients grad;
    turned_gradients(cell, grad);
    int pair = 0;
    for (int b = kFirst; b < kNodes; ++b) {
      Batch weighted[Rule::kPoints][3];
      for (int g = 0; g < Rule::kPoints; ++g) {
        const Batch s = cell.lanes.weight(g) * Batch(-scale);
        for (int i = 0; i < 3; ++i) weighted[g][i] = s * grad[g][b][i];
      }
      for (int a = kFirst; a <= b; ++a, ++pair) {
        Matrix M;
        for (int k = 0; k < 9; ++k) M.m[k / 3][k % 3] = Batch(0.0);
        for (int g = 0; g < Rule::kPoints; ++g) {
          TISSU_UNROLL
          for (int i = 0; i < 3; ++i) {
            TISSU_UNROLL
            for (int j = 0; j < 3; ++j) M(i, j) += grad[g][a][i] * weighted[g][j];
          }
        }
        elastic_block(cell, M, K[pair]);
      }
    }
  }

  /// scale df/dx. A call, so that it is compiled once for the matrix and the definite one.
  [[gnu::noinline]] static void exact_blocks_of(const CorotationalView& view, const Cell& cell, double scale,
                                                Batch (&K)[kPairs][9]) {
    blocks_of(cell, scale, K);
    const SpinBlocks<Element, Rule, LawOf> spin(view, cell);
    int pair = 0;
    for (int b = kFirst; b < kNodes; ++b) {
      for (int a = kFirst; a <= b; ++a, ++pair) spin.add_to(a, b, Batch(-scale), K[pair]);
    }
  }
  TISSU_INLINE static void make_definite(double scale, Batch (&K)[kPairs][9]) {
    if constexpr (kFirst == 1) {
      static_assert(kNodes == 4);
      make_tetra_semidefinite(K);
    } else {
      make_cell_semidefinite<kNodes>(K);
    }
    for (auto& block : K) {
      for (Batch& entry : block) entry = Batch(-scale) * entry;
    }
  }

  template <bool kDefinite>
  static void stiffness(const CorotationalView& view, const Chunk& chunk, const double* x, double scale,
                        double* blocks) {
    PackedNodes positions;
    positions.load(chunk, x);
    for_batches(chunk, [&](std::int32_t group, int lane) {
      const Cell cell(view, positions, group, lane);
      Batch K[kPairs][9];
      if constexpr (kExact) {
        exact_blocks_of(view, cell, kDefinite ? -1.0 : scale, K);
      } else {
        blocks_of(cell, scale, K);
      }
      if constexpr (kDefinite) make_definite(scale, K);
      int pair = 0;
      for (int b = kFirst; b < kNodes; ++b) {
        for (int a = kFirst; a <= b; ++a, ++pair)
          scatter_pair<Base::kNodes>(cell.lanes.slots, a, b, K[pair], blocks);
      }
      if constexpr (Element::kAffine) scatter_first_node<Base::kNodes>(cell.lanes.slots, K, blocks);
    });
  }

  /// R K R^T has no negative eigenvalue.
  static constexpr CorotationalDefiniteLoop definite() {
    if constexpr (kExact) {
      return &stiffness<true>;
    } else {
      return nullptr;
    }
  }

  static constexpr CorotationalKernels table() {
    return {Element::kName,   Cell::MaterialLaw::kIsotropic,
            kExact,           &Kernel::force,
            &Kernel::product, &stiffness<false>,
            &Kernel::energy,  &Kernel::stress,
            definite()};
  }
};

/// The tables of an element: cells of one J, and others. The others are those of elements that need not be
/// affine, and of all with `small`, which has nothing beyond the approximate tangent.
template <class Element>
struct CorotationalTables {
  using Full = typename Element::Full;
  static constexpr int kCount = Element::kAffine ? 3 : 4;
  static constexpr CorotationalKernels all[] = {
      CorotationalStiffness<Element, Full, TurningHooke, false>::table(),
      CorotationalStiffness<Element, Full, TurningHooke, true>::table(),
      CorotationalStiffness<Element, Full, Hooke, false>::table(),
      CorotationalStiffness<Element, Full, Hooke, !Element::kAffine>::table(),
  };
};

}  // namespace tissu::TISSU_KERNELS
