#pragma once

/// What one tetrahedron gives to the constants of Picinbono's expanded energy,
///   W = sum 1/2 u_a . B^ab u_b + sum (u_a . C^abc) (u_b . u_c) + sum D^abcd (u_a . u_b) (u_c . u_d)      [J]
///   B^ab   = V (lambda g_a (x) g_b + mu g_b (x) g_a + mu (g_a . g_b) I)
///   C^abc  = V (lambda/2 g_a (g_b . g_c) + mu/2 (g_c (g_a . g_b) + g_b (g_a . g_c)))
///   D^abcd = V (lambda/8 (g_a . g_b) (g_c . g_d) + mu/4 (g_a . g_d) (g_b . g_c))
/// with g_a the gradients of the shape functions; terms stand with the set of nodes that they name. Each
/// constant is kept times the number of terms that it serves, and where two are met as a sum only, both are
/// kept, as published: 13 numbers on a node, 26 on an edge, 18 on a face, 6 on a tetrahedron. Hooke has B
/// only: 9 on a node and 9 on an edge.
///
/// Picinbono, Delingette, Ayache 2001; Faure 2014, eq. 2.16, 2.17 and table 2.1, where the volume and the
/// factor of B are wrong.

#include <array>

#include "tissu/base/vec.h"
#include "tissu/law/law.h"

namespace tissu {

/// A tetrahedron at rest.
struct TensorCell {
  std::array<Vec3, 4> g;
  double volume;
  Lame lame;
};

/// Adds the constants of a node (size 1), an edge (2), a face (3) or the tetrahedron itself (4), whose nodes
/// are the first of `at`, 0 to 3, to `to`; `linear`: only B.
void add_tensor_constants(const TensorCell& cell, const std::array<std::size_t, 4>& at, int size, bool linear,
                          double* to);

}  // namespace tissu
