#pragma once

/// One cell, the states that it is put in, and what is asked of its definite matrix.

#include <gtest/gtest.h>

#include <map>

#include "../base/eigenvalues.h"
#include "../cell/reference_nodes.h"
#include "../force/verbs.h"
#include "../world/sample_worlds.h"

namespace tissu::test {

constexpr StiffnessScale kExact = {-1.0, 0.0, false};
constexpr StiffnessScale kDefinite = {-1.0, 0.0, true};

/// x = F X of all nodes, by name. `stretched` is so little strained that every law's tangent is definite.
std::map<std::string, Mat3> deformations();

/// A state of nodes that are at `positions` at rest; `random`: every node by itself, to half a unit.
State put(const std::vector<double>& positions, const std::string& name);

std::vector<std::string> states();

/// The least eigenvalue over the largest; zero of a matrix of zeros.
double least_share(const Eigen::MatrixXd& A);

/// Symmetric, and no eigenvalue below round-off, which is that of `exact`: where all of it is negative,
/// nothing but its round-off is left.
void expect_definite(const Eigen::MatrixXd& A, const Eigen::MatrixXd& exact);
void expect_definite(const Eigen::MatrixXd& A);

/// To a share of the largest entry of `scale`.
void expect_near(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, double share,
                 const Eigen::MatrixXd& scale);
void expect_near(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, double share);

/// R A R^T with the same rotation for every node.
Eigen::MatrixXd turned(const Eigen::MatrixXd& A, const Mat3& R);

State turned(State state, const Mat3& R);

}  // namespace tissu::test
