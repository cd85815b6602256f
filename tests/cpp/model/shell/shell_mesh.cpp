#include "shell_mesh.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <utility>

namespace tissu::test {

int ShellMesh::node(const Vec3& near) const {
  int best = 0;
  for (int i = 0; i < static_cast<int>(nodes.size()); ++i) {
    if ((nodes[static_cast<std::size_t>(i)] - near).norm() <
        (nodes[static_cast<std::size_t>(best)] - near).norm())
      best = i;
  }
  return best;
}

ShellMesh grid(int nx, int ny, const std::function<Vec3(double, double)>& place) {
  ShellMesh mesh;
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i)
      mesh.nodes.push_back(place(static_cast<double>(i) / nx, static_cast<double>(j) / ny));
  }
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const int a = j * (nx + 1) + i;
      const int b = a + nx + 1;
      if ((i + j) % 2 == 0) {
        mesh.cells.push_back({a, a + 1, b + 1});
        mesh.cells.push_back({a, b + 1, b});
      } else {
        mesh.cells.push_back({a, a + 1, b});
        mesh.cells.push_back({a + 1, b + 1, b});
      }
    }
  }
  return mesh;
}

ShellStructure::ShellStructure(ShellMesh given, const ShellSection& section) : mesh(std::move(given)) {
  for (const auto& cell : mesh.cells) {
    elements.emplace_back(
        Corners{mesh.nodes[static_cast<std::size_t>(cell[0])], mesh.nodes[static_cast<std::size_t>(cell[1])],
                mesh.nodes[static_cast<std::size_t>(cell[2])]},
        section);
  }
  positions = mesh.nodes;
  rotations.assign(mesh.nodes.size(), Mat3::Identity());
  load = Eigen::VectorXd::Zero(freedoms());
  held.assign(static_cast<std::size_t>(freedoms()), 0);
}

void ShellStructure::hold(const std::string& which, const std::function<bool(const Vec3&)>& where) {
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    if (!where(mesh.nodes[n])) continue;
    for (const char axis : which) held[6 * n + std::string("xyzXYZ").find(axis)] = 1;
  }
}

ShellPose ShellStructure::pose(std::size_t e) const {
  ShellPose result;
  for (std::size_t a = 0; a < 3; ++a) {
    result.positions[a] = positions[static_cast<std::size_t>(mesh.cells[e][a])];
    result.rotations[a] = rotations[static_cast<std::size_t>(mesh.cells[e][a])];
  }
  return result;
}

Eigen::VectorXd ShellStructure::residual(double share) const {
  Eigen::VectorXd r = share * load;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const Vec18 f = elements[e].force(pose(e));
    for (int a = 0; a < 3; ++a)
      r.segment<6>(6 * mesh.cells[e][static_cast<std::size_t>(a)]) += f.segment<6>(6 * a);
  }
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    if (held[static_cast<std::size_t>(i)] != 0) r[i] = 0.0;
  }
  return r;
}

Eigen::SparseMatrix<double> ShellStructure::stiffness(bool skew) const {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    Mat18 K = elements[e].stiffness(pose(e));
    if (skew) {
      const Vec18 f = elements[e].force(pose(e));
      for (int a = 3; a < 18; a += 6) K.block<3, 3>(a, a) += 0.5 * cross_matrix(f.segment<3>(a));
    }
    for (int i = 0; i < 18; ++i) {
      for (int j = 0; j < 18; ++j) {
        const int row = 6 * mesh.cells[e][static_cast<std::size_t>(i / 6)] + i % 6;
        const int column = 6 * mesh.cells[e][static_cast<std::size_t>(j / 6)] + j % 6;
        if (held[static_cast<std::size_t>(row)] == 0 && held[static_cast<std::size_t>(column)] == 0)
          entries.emplace_back(row, column, K(i, j));
      }
    }
  }
  for (int i = 0; i < static_cast<int>(freedoms()); ++i) {
    if (held[static_cast<std::size_t>(i)] != 0) entries.emplace_back(i, i, 1.0);
  }
  Eigen::SparseMatrix<double> K(freedoms(), freedoms());
  K.setFromTriplets(entries.begin(), entries.end());
  return K;
}

Eigen::VectorXd ShellStructure::linear_answer(const Eigen::VectorXd& given) {
  std::vector<char> none(held.size(), 0);
  std::swap(held, none);
  Eigen::VectorXd r = load - stiffness() * given;
  std::swap(held, none);
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    if (held[static_cast<std::size_t>(i)] != 0) r[i] = 0.0;
  }
  return given + Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(stiffness()).solve(r);
}

Eigen::VectorXd ShellStructure::linear_answer() const {
  return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(stiffness()).solve(residual(1.0));
}

int ShellStructure::balance(double share, double tolerance, int most) {
  for (int step = 0; step <= most; ++step) {
    const Eigen::VectorXd r = residual(share);
    if (r.norm() < tolerance) return step;
    if (!(r.norm() < 1e20)) return -1;
    const Eigen::SparseLU<Eigen::SparseMatrix<double>> factor(stiffness(true));
    const Eigen::VectorXd p = factor.solve(r);
    for (std::size_t n = 0; n < positions.size(); ++n) {
      positions[n] += p.segment<3>(6 * static_cast<Eigen::Index>(n));
      rotations[n].applyOnTheLeft(turn(p.segment<3>(6 * static_cast<Eigen::Index>(n) + 3)));
    }
  }
  return -1;
}

}  // namespace tissu::test
