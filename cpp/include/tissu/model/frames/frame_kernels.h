#pragma once

/// The loops of frames over their points, compiled for each instruction set. A law stands between them: they
/// turn frames into F, and P into forces.
///
///   F = sum_a x_a (x) g_a + R_a B_a,   M_a = R_a B_a,   dF = sum_a dx_a (x) g_a + dtheta_a x M_a
///   f_a = - v P g_a,   tau_a = - v sum_c m_c x p_c      (columns of M_a and P)

#include <cstddef>
#include <cstdint>

#include "tissu/base/isa.h"

namespace tissu {

/// What the loops read. Points stand in groups of eight lanes; lanes that only pad have no volume.
struct FrameView {
  int neighbours;              ///< k
  const std::int32_t* frames;  ///< [group][k][8], numbers among the frames of the model
  const double* coefficients;  ///< [group][k][12][8]: g, then B row by row
  const double* volumes;       ///< [group][8]
  const std::int32_t* slots;   ///< [group][a][b][4][8], blocks of the matrix: xx, xt, tx, tt
  const std::uint8_t* shared;  ///< [group], all lanes have the same frames
};

/// Groups begin to end - 1; arrays over groups begin with group `begin`.
struct FrameKernels {
  /// F [group][9][8] of frames q [frame][12]: origin, then rotation row by row.
  void (*gradient)(const FrameView&, std::int32_t begin, std::int32_t end, const double* q, double* F);
  /// dF of dq [frame][6]
  void (*gradient_change)(const FrameView&, std::int32_t begin, std::int32_t end, const double* q,
                          const double* dq, double* dF);
  /// shares [group][k][6][8] = -v (P g, sum_c m_c x p_c)
  void (*force)(const FrameView&, std::int32_t begin, std::int32_t end, const double* q, const double* P,
                double* shares);
  /// What shares change by for dP and dq; P null: without the geometric part.
  void (*force_change)(const FrameView&, std::int32_t begin, std::int32_t end, const double* q,
                       const double* dq, const double* P, const double* dP, double* shares);
  /// blocks += scale * df/dq, from tangents A [group][45][8] and, unless null, stresses P [group][9][8].
  void (*stiffness)(const FrameView&, std::int32_t begin, std::int32_t end, const double* q, const double* A,
                    const double* P, double scale, double* blocks);
};

const FrameKernels* find_frame_kernels(Isa isa);

}  // namespace tissu
