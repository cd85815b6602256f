#pragma once

/// The six edges of a tetrahedron, and how stiff they are to each other.
///
/// With l_e the length of edge e = (a, b) and g_a the gradient of node a's shape function at rest,
///   C = F^T F = sum_e C_e l_e^2,   C_e = -(g_a (x) g_b + g_b (x) g_a) / 2,
/// so that tr C_e = -g_a . g_b and, f being (c, d),
///   tr(C_e C_f) = ((g_a . g_c) (g_b . g_d) + (g_a . g_d) (g_b . g_c)) / 2.

namespace tissu {

/// From the first node to the second. Chendeb 2007, eq. 3.22.
inline constexpr int kTetraEdges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {2, 3}, {3, 1}};

/// Place of (e, f) in the upper triangle of a symmetric 6 x 6 matrix, row after row.
constexpr int edge_pair(int e, int f) { return e <= f ? e * 6 - e * (e - 1) / 2 + (f - e) : edge_pair(f, e); }
inline constexpr int kEdgePairs = 21;

/// H_ef = lambda tr(C_e) tr(C_f) + 2 mu tr(C_e C_f), where s_ab = g_a . g_b.
template <class T>
[[gnu::always_inline]] inline void edge_moduli(const T (&s)[4][4], T lambda, T mu, T (&H)[kEdgePairs]) {
#pragma GCC unroll 64
  for (int e = 0; e < 6; ++e) {
    const int a = kTetraEdges[e][0];
    const int b = kTetraEdges[e][1];
#pragma GCC unroll 64
    for (int f = e; f < 6; ++f) {
      const int c = kTetraEdges[f][0];
      const int d = kTetraEdges[f][1];
      H[edge_pair(e, f)] = lambda * (s[a][b] * s[c][d]) + mu * (s[a][c] * s[b][d] + s[a][d] * s[b][c]);
    }
  }
}

}  // namespace tissu
