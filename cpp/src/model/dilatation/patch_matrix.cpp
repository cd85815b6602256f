#include "patch_matrix.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <utility>

namespace tissu {
namespace {
using Index = Eigen::Index;
}

void PatchMatrix::begin(std::int32_t nodes) {
  K_.setZero(3 * Index{nodes}, 3 * Index{nodes});
  m_.setZero(3 * Index{nodes});
  b_.setZero(3 * Index{nodes});
}

void PatchMatrix::add_cell(const std::uint8_t* places, int size, const double* blocks) {
  for (int b = 0; b < size; ++b) {
    for (int a = 0; a <= b; ++a, blocks += 9) {
      const Eigen::Map<const Eigen::Matrix3d> K(blocks);
      const Index row = 3 * Index{places[a]};
      const Index column = 3 * Index{places[b]};
      if (row <= column) {
        K_.block<3, 3>(row, column) += K;
      } else {
        K_.block<3, 3>(column, row) += K.transpose();
      }
    }
  }
}

void PatchMatrix::add_vectors(const std::uint8_t* places, int size, const double* m, const double* b) {
  for (int a = 0; a < size; ++a) {
    m_.segment<3>(3 * Index{places[a]}) += Eigen::Map<const Eigen::Vector3d>(m + 3 * Index{a});
    b_.segment<3>(3 * Index{places[a]}) += Eigen::Map<const Eigen::Vector3d>(b + 3 * Index{a});
  }
}

void PatchMatrix::close(double slope, double curvature) {
  m_ = slope * m_ + 0.5 * curvature * b_;
  for (Index column = 0; column < K_.cols(); ++column) {
    for (Index row = 0; row <= column; ++row) {
      K_(row, column) += m_[row] * b_[column] + b_[row] * m_[column];
      K_(column, row) = K_(row, column);
    }
  }
}

/// Most patches have none: a Cholesky factor of K with a diagonal moved by round-off shows it at a twentieth
/// of the price of the eigenvalues.
void PatchMatrix::make_definite() {
  constexpr double kRoundOff = 1e-12;
  const double largest = K_.diagonal().cwiseAbs().maxCoeff();
  if (!(largest > 0.0) || !K_.allFinite()) return;
  Matrix shifted = K_;
  shifted.diagonal().array() += kRoundOff * largest;
  if (Eigen::LLT<Eigen::Ref<Matrix>>(shifted).info() == Eigen::Success) return;
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(K_);
  for (Index i = 0; i < K_.cols() && eigen.eigenvalues()[i] < 0.0; ++i) {
    const auto mode = eigen.eigenvectors().col(i);
    const double eigenvalue = eigen.eigenvalues()[i];
    for (Index column = 0; column < K_.cols(); ++column) {
      K_.col(column) -= eigenvalue * mode[column] * mode;
    }
  }
}

void PatchMatrix::scatter(const std::int32_t* slots, double scale, double* blocks) const {
  for (Index row = 0; row < K_.rows(); row += 3) {
    for (Index column = 0; column < K_.cols(); column += 3, ++slots) {
      double* to = blocks + 9 * static_cast<std::ptrdiff_t>(*slots);
      for (Index j = 0; j < 3; ++j) {
        for (Index i = 0; i < 3; ++i) to[3 * j + i] += scale * K_(row + i, column + j);
      }
    }
  }
}

}  // namespace tissu
