#pragma once

/// Structures of shell elements: a mesh, what is held, what pulls, and equilibrium by Newton's method. Nodes
/// have six freedoms in the order of an element's.

#include <Eigen/SparseCore>
#include <functional>
#include <string>
#include <vector>

#include "shell_sample.h"

namespace tissu::test {

struct ShellMesh {
  std::vector<Vec3> nodes;
  std::vector<std::array<int, 3>> cells;

  int node(const Vec3& near) const;
};

/// A grid of nx x ny squares, each cut in two along the diagonals in turn, at place(x, y), x and y in [0, 1].
ShellMesh grid(int nx, int ny, const std::function<Vec3(double, double)>& place);

class ShellStructure {
 public:
  ShellMesh mesh;
  std::vector<ShellElement> elements;
  std::vector<Vec3> positions;
  std::vector<Mat3> rotations;
  Eigen::VectorXd load;    ///< [N], [N m]
  std::vector<char> held;  ///< of each freedom

  ShellStructure(ShellMesh given, const ShellSection& section);
  Eigen::Index freedoms() const { return 6 * static_cast<Eigen::Index>(mesh.nodes.size()); }

  /// Holds some freedoms ("xyz" of translation, "XYZ" of rotation) of the nodes that `where` names.
  void hold(const std::string& which, const std::function<bool(const Vec3&)>& where);
  ShellPose pose(std::size_t e) const;
  /// What is out of balance under `share` of the load; nothing where it is held.
  Eigen::VectorXd residual(double share) const;
  /// -d(residual)/d(freedoms). `skew`: with what an element's symmetric stiffness leaves out.
  Eigen::SparseMatrix<double> stiffness(bool skew = false) const;
  /// Displacements and rotations under the load, linear at rest, where those held are as in `given`.
  Eigen::VectorXd linear_answer(const Eigen::VectorXd& given);
  /// Displacements and rotations under the load, linear at rest.
  Eigen::VectorXd linear_answer() const;
  /// Newton's method under `share` of the load; the number of steps, or -1.
  int balance(double share, double tolerance, int most);
};

}  // namespace tissu::test
