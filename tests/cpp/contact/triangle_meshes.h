#pragma once

/// Triangle meshes for the comparison with FCL: random ones, and the organ of the examples.

#include <array>
#include <string>
#include <vector>

#include "../base/random.h"
#include "tissu/contact/description.h"
#include "tissu/state/state.h"

namespace tissu::test {

struct TriangleMesh {
  std::vector<Vec3> points;
  std::vector<std::array<std::int32_t, 3>> triangles;

  /// Turned about the origin, then moved.
  [[nodiscard]] TriangleMesh placed(const Quaternion& turn, const Vec3& by) const;
  /// Half the longest way across it.
  [[nodiscard]] double radius() const;
};

/// A closed ball of radius 1 with bumps of a fifth of that, of 12 n^2 triangles.
TriangleMesh bumpy_ball(int n, Random& random);
/// An open sheet of 2 n^2 triangles, one metre wide and crumpled; every tenth column is a thousandth as wide.
TriangleMesh crumpled_sheet(int n, Random& random);
/// The surface of examples/organ.vtu, a shape like a liver, in metres. Throws std::runtime_error where the
/// file is not what is expected.
TriangleMesh organ();

/// Two meshes as surfaces that meet.
struct TwoMeshes {
  TwoMeshes(const TriangleMesh& first, const TriangleMesh& second, double gap);
  ContactDescription description;
  std::vector<std::int32_t> first_row;
  State state;
};

}  // namespace tissu::test
