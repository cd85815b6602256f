#include "textbook.h"

#include <utility>

namespace tissu::bench {
namespace {

using Tensor = double[3][3];

/// sum_a u_a (x) grad_a
template <int kNodes>
void gradient(const double (&u)[kNodes][3], const double (&grad)[kNodes][3], Tensor& F) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      F[i][j] = 0.0;
      for (int a = 0; a < kNodes; ++a) F[i][j] += u[a][i] * grad[a][j];
    }
  }
}

/// A B
void multiply(const Tensor& A, const Tensor& B, Tensor& C) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      C[i][j] = 0.0;
      for (int k = 0; k < 3; ++k) C[i][j] += A[i][k] * B[k][j];
    }
  }
}

template <int kNodes>
void gather(const double* from, const std::int32_t* nodes, double (&to)[kNodes][3]) {
  for (int a = 0; a < kNodes; ++a) {
    for (int i = 0; i < 3; ++i) to[a][i] = from[3 * nodes[a] + i];
  }
}

/// f_a += s P grad_a
template <int kNodes>
void scatter(const Tensor& P, const double (&grad)[kNodes][3], double s, const std::int32_t* nodes,
             double* f) {
  for (int a = 0; a < kNodes; ++a) {
    for (int i = 0; i < 3; ++i) {
      double sum = 0.0;
      for (int j = 0; j < 3; ++j) sum += P[i][j] * grad[a][j];
      f[3 * nodes[a] + i] += s * sum;
    }
  }
}

/// dE = B_a du_a in Voigt's order 11 22 33 23 13 12, shears doubled.
void strain_rows(const Tensor& F, const double (&grad)[3], double (&B)[6][3]) {
  constexpr int kRow[6] = {0, 1, 2, 1, 0, 0};
  constexpr int kColumn[6] = {0, 1, 2, 2, 2, 1};
  for (int v = 0; v < 6; ++v) {
    for (int i = 0; i < 3; ++i) {
      B[v][i] = F[i][kRow[v]] * grad[kColumn[v]];
      if (v >= 3) B[v][i] += F[i][kColumn[v]] * grad[kRow[v]];
    }
  }
}

}  // namespace

template <int kNodes>
Textbook<kNodes>::Textbook(const ReferenceCell& reference, std::vector<std::int32_t> cells, ConstReals X,
                           Lame lame)
    : lame_(lame), points_per_cell_(reference.points.size()), cells_(std::move(cells)) {
  for (std::size_t e = 0; e < cells_.size() / kNodes; ++e) {
    for (const ReferenceCell::Point& at : reference.points) {
      Mat3 J = Mat3::Zero();
      for (std::size_t a = 0; a < kNodes; ++a) {
        const Eigen::Map<const Vec3> dN(at.gradients[a].data());
        J += block(X, cells_[e * kNodes + a]) * dN.transpose();
      }
      const Mat3 inverse = J.inverse();
      Point& point = points_.emplace_back();
      point.weight = at.weight * J.determinant();
      for (std::size_t a = 0; a < kNodes; ++a) {
        const Eigen::Map<const Vec3> dN(at.gradients[a].data());
        Eigen::Map<Vec3>(point.gradient[a]) = inverse.transpose() * dN;
      }
    }
  }
}

template <int kNodes>
void Textbook<kNodes>::bind(const Sparsity& pattern) {
  slots_.clear();
  for (std::size_t e = 0; e < cells_.size() / kNodes; ++e) {
    const std::int32_t* nodes = &cells_[e * kNodes];
    auto& slots = slots_.emplace_back();
    for (std::size_t a = 0; a < kNodes; ++a) {
      for (std::size_t b = 0; b < kNodes; ++b) slots[a * kNodes + b] = pattern.slot(nodes[a], nodes[b]);
    }
  }
}

template <int kNodes>
void Textbook<kNodes>::second_piola(const Tensor& F, Tensor& S) const {
  Tensor E;
  double trace = 0.0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      double C = 0.0;
      for (int k = 0; k < 3; ++k) C += F[k][i] * F[k][j];
      E[i][j] = 0.5 * (C - (i == j ? 1.0 : 0.0));
    }
    trace += E[i][i];
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) S[i][j] = 2.0 * lame_.mu * E[i][j] + (i == j ? lame_.lambda * trace : 0.0);
  }
}

template <int kNodes>
void Textbook<kNodes>::add_force(const double* x, double* f) const {
  for (std::size_t e = 0; e < cells_.size() / kNodes; ++e) {
    const std::int32_t* nodes = &cells_[e * kNodes];
    double u[kNodes][3];
    gather(x, nodes, u);
    for (std::size_t g = 0; g < points_per_cell_; ++g) {
      const Point& point = points_[e * points_per_cell_ + g];
      Tensor F;
      Tensor S;
      Tensor P;
      gradient(u, point.gradient, F);
      second_piola(F, S);
      multiply(F, S, P);
      scatter(P, point.gradient, -point.weight, nodes, f);
    }
  }
}

/// dP = dF S + F dS, dS = lambda tr(dE) I + 2 mu dE, dE = sym(F^T dF)
template <int kNodes>
void Textbook<kNodes>::add_product(const double* x, double scale, const double* p, double* out) const {
  for (std::size_t e = 0; e < cells_.size() / kNodes; ++e) {
    const std::int32_t* nodes = &cells_[e * kNodes];
    double u[kNodes][3];
    double du[kNodes][3];
    gather(x, nodes, u);
    gather(p, nodes, du);
    for (std::size_t g = 0; g < points_per_cell_; ++g) {
      const Point& point = points_[e * points_per_cell_ + g];
      Tensor F, dF, S, dS, dFS, dP;
      gradient(u, point.gradient, F);
      gradient(du, point.gradient, dF);
      second_piola(F, S);
      double trace = 0.0;
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
          double dE = 0.0;
          for (int k = 0; k < 3; ++k) dE += 0.5 * (F[k][i] * dF[k][j] + dF[k][i] * F[k][j]);
          dS[i][j] = 2.0 * lame_.mu * dE;
          if (i == j) trace += dE;
        }
      }
      for (int i = 0; i < 3; ++i) dS[i][i] += lame_.lambda * trace;
      multiply(dF, S, dFS);
      multiply(F, dS, dP);
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) dP[i][j] += dFS[i][j];
      }
      scatter(dP, point.gradient, -scale * point.weight, nodes, out);
    }
  }
}

template <int kNodes>
void Textbook<kNodes>::add_point(const Point& point, const double (&x)[kNodes][3], Blocks& K) const {
  double D[6][6] = {};
  for (int v = 0; v < 3; ++v) {
    for (int w = 0; w < 3; ++w) D[v][w] = lame_.lambda;
    D[v][v] += 2.0 * lame_.mu;
    D[v + 3][v + 3] = lame_.mu;
  }
  Tensor F, S;
  gradient(x, point.gradient, F);
  second_piola(F, S);
  double B[kNodes][6][3];
  for (int a = 0; a < kNodes; ++a) strain_rows(F, point.gradient[a], B[a]);
  for (int b = 0; b < kNodes; ++b) {
    double DB[6][3] = {};
    double Sg[3] = {};
    for (int v = 0; v < 6; ++v) {
      for (int w = 0; w < 6; ++w) {
        for (int k = 0; k < 3; ++k) DB[v][k] += D[v][w] * B[b][w][k];
      }
    }
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) Sg[i] += S[i][j] * point.gradient[b][j];
    }
    for (int a = 0; a < kNodes; ++a) {
      double geometric = 0.0;
      for (int j = 0; j < 3; ++j) geometric += point.gradient[a][j] * Sg[j];
      for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
          double sum = i == k ? geometric : 0.0;
          for (int v = 0; v < 6; ++v) sum += B[a][v][i] * DB[v][k];
          K[a][b][i][k] += point.weight * sum;
        }
      }
    }
  }
}

template <int kNodes>
void Textbook<kNodes>::add_stiffness(const double* x, double scale, double* blocks) const {
  for (std::size_t e = 0; e < cells_.size() / kNodes; ++e) {
    double u[kNodes][3];
    gather(x, &cells_[e * kNodes], u);
    Blocks K = {};
    for (std::size_t g = 0; g < points_per_cell_; ++g) add_point(points_[e * points_per_cell_ + g], u, K);
    for (std::size_t a = 0; a < kNodes; ++a) {
      for (std::size_t b = 0; b < kNodes; ++b) {
        double* to = blocks + 9 * static_cast<std::ptrdiff_t>(slots_[e][a * kNodes + b]);
        for (int k = 0; k < 3; ++k) {
          for (int i = 0; i < 3; ++i) to[3 * k + i] -= scale * K[a][b][i][k];
        }
      }
    }
  }
}

template class Textbook<4>;
template class Textbook<8>;

}  // namespace tissu::bench
