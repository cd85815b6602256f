#pragma once

/// Picinbono's expanded mass-tensor on linear tetrahedra with St-Venant–Kirchhoff: the energy as a quartic
/// polynomial in the displacements u of the four nodes, g_a the gradients of the shape functions,
///   W = V (1/2 u_a . B^ab u_b + (u_a . C^abc) (u_b . u_c) + D^abcd (u_a . u_b) (u_c . u_d)), summed,
///   B^ab   = lambda g_a (x) g_b + mu g_b (x) g_a + mu (g_a . g_b) I
///   C^abc  = lambda/2 g_a (g_b . g_c) + mu/2 (g_c (g_a . g_b) + g_b (g_a . g_c))
///   D^abcd = lambda/8 (g_a . g_b) (g_c . g_d) + mu/4 (g_a . g_d) (g_b . g_c)
/// with the constants that differ stored on the nodes, edges and faces of each tetrahedron (280 reals, as
/// Picinbono counts them) and six more on the tetrahedron itself. Picinbono, Delingette, Ayache, Nonlinear
/// and anisotropic elastic soft tissue models for medical simulation, 2001; as printed by Faure, 2014, eq.
/// 2.16, 2.17 and table 2.1, where the factor of B and the volume are wrong. Forces only, as he had them.

#include <array>
#include <cstdint>
#include <vector>

#include "tissu/base/vec.h"
#include "tissu/law/law.h"

namespace tissu::bench {

class Expanded {
 public:
  /// `cells` holds cell after cell of four node numbers into X [m].
  Expanded(std::vector<std::int32_t> cells, const std::vector<double>& X, Lame lame);
  /// f += force [N]
  void add_force(const double* x, double* f) const;

  using Vector = std::array<double, 3>;
  using Matrix = std::array<double, 9>;

  /// Every constant is multiplied by the volume. Indices of B, C and D as above.
  struct Constants {
    struct Node {  ///< p
      Matrix B;
      Vector C;
      double D;
    };
    struct Edge {  ///< p < j
      Matrix B;    ///< B^pj; B^jp is its transpose
      Vector C_ppj, C_jpp, C_jjp, C_pjj;
      double D_jppp, D_jjjp, D_jjpp, D_jpjp, D_pjjp;
    };
    struct Face {                  ///< three nodes a; b and c are the others
      std::array<Vector, 3> C;     ///< C^abc
      std::array<double, 3> D_bc;  ///< D^aabc
      std::array<double, 3> D_ab;  ///< D^abac + D^baac: met only as this sum, stored as two
      std::array<double, 3> D_ba;
    };
    std::array<Node, 4> node;
    std::array<Edge, 6> edge;
    std::array<Face, 4> face;
    double D[3][2];  ///< D^abcd of four different nodes: the pairs of the lambda term, those of the mu term
  };

 private:
  std::vector<std::int32_t> cells_;
  std::vector<double> X_;
  std::vector<Constants> constants_;
};

}  // namespace tissu::bench
