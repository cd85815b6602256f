#pragma once

/// Which constants of the expanded energy a node, an edge, a face and a tetrahedron have: the vectors C and
/// the numbers D of tissu/model/tensor_constants.h, and what they are multiplied with.

#include "tissu/base/batch.h"

namespace tissu::TISSU_KERNELS {

/// A vector c: its node and its pair.
struct TensorVector {
  int node;
  int pair;
};
/// A number Q: its two pairs, and how many stored numbers it is the sum of.
struct TensorNumber {
  int m;
  int n;
  int stored;
};

// Constants are stored in this order: B row by row, the vectors, the numbers. Arrays of length one stand for
// none where a count is zero.
struct NodePattern {
  static constexpr int kNodes = 1, kMatrices = 1, kPairs = 1, kVectors = 1, kNumbers = 1;
  static constexpr int pair[][2] = {{0, 0}};
  static constexpr TensorVector vector[] = {{0, 0}};
  static constexpr TensorNumber number[] = {{0, 0, 1}};
};
struct EdgePattern {  // pairs pp pj jj
  static constexpr int kNodes = 2, kMatrices = 1, kPairs = 3, kVectors = 4, kNumbers = 4;
  static constexpr int pair[][2] = {{0, 0}, {0, 1}, {1, 1}};
  static constexpr TensorVector vector[] = {{0, 1}, {1, 0}, {1, 1}, {0, 2}};
  static constexpr TensorNumber number[] = {{0, 1, 1}, {1, 2, 1}, {0, 2, 1}, {1, 1, 2}};
};
struct FacePattern {  // pairs aa bb cc bc ca ab
  static constexpr int kNodes = 3, kMatrices = 0, kPairs = 6, kVectors = 3, kNumbers = 6;
  static constexpr int pair[][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {2, 0}, {0, 1}};
  static constexpr TensorVector vector[] = {{0, 3}, {1, 4}, {2, 5}};
  static constexpr TensorNumber number[] = {{0, 3, 1}, {1, 4, 1}, {2, 5, 1}, {5, 4, 2}, {3, 5, 2}, {4, 3, 2}};
};
struct TetraPattern {  // pairs 01 23, 02 13, 03 12
  static constexpr int kNodes = 4, kMatrices = 0, kPairs = 6, kVectors = 0, kNumbers = 3;
  static constexpr int pair[][2] = {{0, 1}, {2, 3}, {0, 2}, {1, 3}, {0, 3}, {1, 2}};
  static constexpr TensorVector vector[] = {{0, 0}};
  static constexpr TensorNumber number[] = {{0, 1, 2}, {2, 3, 2}, {4, 5, 2}};
};
struct LinearNodePattern {
  static constexpr int kNodes = 1, kMatrices = 1, kPairs = 0, kVectors = 0, kNumbers = 0;
  static constexpr int pair[][2] = {{0, 0}};
  static constexpr TensorVector vector[] = {{0, 0}};
  static constexpr TensorNumber number[] = {{0, 0, 1}};
};
struct LinearEdgePattern : LinearNodePattern {
  static constexpr int kNodes = 2;
};

}  // namespace tissu::TISSU_KERNELS
