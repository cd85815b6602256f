#include "tissu/solve/conjugate_gradient.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "tissu/base/error.h"

namespace tissu {
namespace {

/// A residual this many times the right-hand side: the matrix is singular, and x runs off along its kernel.
constexpr double kLost = 1e8;

double dot(const Threads& threads, std::int32_t rows, ConstReals a, ConstReals b,
           std::vector<double>& partial) {
  return threads.sum(rows, partial, [&](std::int32_t begin, std::int32_t end) {
    double sum = 0.0;
    for (auto i = 3 * static_cast<std::size_t>(begin); i < 3 * static_cast<std::size_t>(end); ++i)
      sum += a[i] * b[i];
    return sum;
  });
}

}  // namespace

ConjugateGradient::ConjugateGradient(Settings settings) : settings_(settings) {
  if (!(settings.tolerance > 0.0) || settings.iterations < 1) {
    throw ParameterError("conjugate gradient needs a positive tolerance and at least one iteration.");
  }
}

void ConjugateGradient::resize(std::size_t size) {
  for (auto* v : {&r_, &z_, &p_, &q_}) v->resize(size);
  inverse_.resize(3 * size);
  partial_square_.resize(static_cast<std::size_t>(Threads::pieces(static_cast<std::int32_t>(size / 3))));
}

void ConjugateGradient::invert_diagonal(const BlockMatrix& matrix) {
  matrix.threads().for_pieces(matrix.rows(), [&](std::int32_t begin, std::int32_t end) {
    for (std::int32_t i = begin; i < end; ++i) {
      const Mat3 D = matrix.diagonal_block(i);
      Eigen::Map<Mat3> inverse(inverse_.data() + 9 * static_cast<std::ptrdiff_t>(i));
      // A block that is not positive definite would turn the preconditioner; its diagonal, made positive,
      // will not.
      const bool definite =
          D(0, 0) > 0.0 && D.topLeftCorner<2, 2>().determinant() > 0.0 && D.determinant() > 0.0;
      if (definite) {
        inverse = D.inverse();
      } else {
        const Vec3 d = D.diagonal().cwiseAbs();
        inverse = Mat3((d.array() > 0.0).select(d.cwiseInverse(), Vec3::Zero()).asDiagonal());
      }
    }
  });
}

double ConjugateGradient::precondition(const Threads& threads, double& square) {
  const auto rows = static_cast<std::int32_t>(r_.size() / 3);
  const double rz = threads.sum(rows, partial_, [&](std::int32_t begin, std::int32_t end) {
    double sum = 0.0;
    double squares = 0.0;
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const double* m = inverse_.data() + 9 * i;
      const double* r = r_.data() + 3 * i;
      double* z = z_.data() + 3 * i;
      for (int k = 0; k < 3; ++k) z[k] = m[k] * r[0] + m[3 + k] * r[1] + m[6 + k] * r[2];
      sum += r[0] * z[0] + r[1] * z[1] + r[2] * z[2];
      squares += r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
    }
    partial_square_[static_cast<std::size_t>(begin / Threads::kPiece)] = squares;
    return sum;
  });
  square = 0.0;
  for (const double s : partial_square_) square += s;
  return rz;
}

SolveReport ConjugateGradient::solve(const BlockMatrix& matrix, ConstReals b, Reals x, double floor) {
  resize(b.size());
  invert_diagonal(matrix);
  const Threads& threads = matrix.threads();
  const std::int32_t rows = matrix.rows();
  SolveReport report;
  const double reference = std::max(std::sqrt(dot(threads, rows, b, b, partial_)), floor);
  if (reference == 0.0) {
    std::ranges::fill(x, 0.0);
    report.converged = true;
    return report;
  }

  matrix.multiply(x, r_);
  for (std::size_t i = 0; i < r_.size(); ++i) r_[i] = b[i] - r_[i];
  double square = 0.0;
  double rz = precondition(threads, square);
  std::ranges::copy(z_, p_.begin());
  while (true) {
    report.residual = std::sqrt(square) / reference;
    report.converged = report.residual <= settings_.tolerance;
    if (report.converged || report.iterations == settings_.iterations) break;
    if (!(report.residual < kLost)) {
      report.positive_definite = false;
      break;
    }
    matrix.multiply(p_, q_);
    const double curvature = dot(threads, rows, p_, q_, partial_);
    if (!(curvature > 0.0)) {
      report.positive_definite = false;
      break;
    }
    const double alpha = rz / curvature;
    threads.for_pieces(rows, [&](std::int32_t begin, std::int32_t end) {
      for (auto i = 3 * static_cast<std::size_t>(begin); i < 3 * static_cast<std::size_t>(end); ++i) {
        x[i] += alpha * p_[i];
        r_[i] -= alpha * q_[i];
      }
    });
    const double next = precondition(threads, square);
    const double beta = next / rz;
    rz = next;
    threads.for_pieces(rows, [&](std::int32_t begin, std::int32_t end) {
      for (auto i = 3 * static_cast<std::size_t>(begin); i < 3 * static_cast<std::size_t>(end); ++i) {
        p_[i] = z_[i] + beta * p_[i];
      }
    });
    ++report.iterations;
  }
  return report;
}

}  // namespace tissu
