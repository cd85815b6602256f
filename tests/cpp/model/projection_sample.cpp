#include "projection_sample.h"

#include <algorithm>

namespace tissu::test {

std::map<std::string, Mat3> deformations() {
  Random random(31);
  const Mat3 U = random.rotation().toRotationMatrix();
  const Mat3 V = random.rotation().toRotationMatrix();
  const auto of = [&](double a, double b, double c) { return Mat3(U * Vec3(a, b, c).asDiagonal() * V); };
  return {{"rest", Mat3::Identity()},
          {"stretched", of(1.02, 1.02, 1.02)},
          {"compressed", of(0.6, 0.5, 0.45)},
          {"drawn", of(1.5, 0.8, 0.7)},
          {"sheared", of(1.3, 1.0, 0.75)},
          {"halved", of(0.5, 0.5, 0.5)},
          {"inverted", of(1.1, 0.9, -0.4)},
          {"mirrored", of(0.7, 0.7, -0.7)},
          {"flat", of(1.2, 0.7, 0.0)},
          {"line", of(1.2, 0.0, 0.0)},
          {"point", Mat3::Zero()}};
}

State put(const std::vector<double>& positions, const std::string& name) {
  State state;
  state.positions = positions;
  state.velocities.assign(positions.size(), 0.0);
  if (name == "random") {
    Random random(8);
    for (double& x : state.positions) x += random.number(0.5);
    return state;
  }
  const Mat3 F = deformations().at(name);
  for (std::int32_t i = 0; i < state.blocks(); ++i) {
    block(Reals(state.positions), i) = F * block(ConstReals(positions), i);
  }
  return state;
}

std::vector<std::string> states() {
  std::vector<std::string> names = {"random"};
  for (const auto& [name, F] : deformations()) names.push_back(name);
  return names;
}

double least_share(const Eigen::MatrixXd& A) {
  const Eigen::VectorXd values = eigenvalues(A);
  const double largest = values.cwiseAbs().maxCoeff();
  return largest == 0.0 ? 0.0 : values[0] / largest;
}

void expect_definite(const Eigen::MatrixXd& A, const Eigen::MatrixXd& exact) {
  const double scale = std::max(A.cwiseAbs().maxCoeff(), exact.cwiseAbs().maxCoeff());
  EXPECT_LE((A - A.transpose()).cwiseAbs().maxCoeff(), 1e-13 * scale);
  EXPECT_GE(least_share(A) * A.cwiseAbs().maxCoeff(), -1e-12 * scale);
}

void expect_definite(const Eigen::MatrixXd& A) { expect_definite(A, A); }

void expect_near(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, double share,
                 const Eigen::MatrixXd& scale) {
  EXPECT_LE((A - B).cwiseAbs().maxCoeff(), share * scale.cwiseAbs().maxCoeff());
}

void expect_near(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, double share) {
  expect_near(A, B, share, B);
}

Eigen::MatrixXd turned(const Eigen::MatrixXd& A, const Mat3& R) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(A.rows(), A.rows());
  for (Eigen::Index i = 0; i < A.rows(); i += 3) all.block<3, 3>(i, i) = R;
  return all * A * all.transpose();
}

State turned(State state, const Mat3& R) {
  for (std::int32_t i = 0; i < state.blocks(); ++i) {
    block(Reals(state.positions), i) = R * block(ConstReals(state.positions), i);
  }
  return state;
}

}  // namespace tissu::test
