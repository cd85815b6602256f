#include "expanded.h"

#include <utility>

namespace tissu::bench {
namespace {

using Constants = Expanded::Constants;
using Vector = Expanded::Vector;
using Matrix = Expanded::Matrix;

constexpr std::size_t kEdges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
constexpr std::size_t kFaces[4][3] = {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}};
/// The node that makes a pair with `p` in each of the three ways to cut four nodes into two pairs.
constexpr std::size_t kPartner[4][3] = {{1, 2, 3}, {0, 3, 2}, {3, 0, 1}, {2, 1, 0}};

/// B^ij, C^ijk and D^ijkl of one tetrahedron, times its volume.
struct Formulae {
  std::array<Vec3, 4> g;
  Lame lame;
  double volume;

  [[nodiscard]] double dot(std::size_t a, std::size_t b) const { return g[a].dot(g[b]); }
  [[nodiscard]] Matrix b(std::size_t i, std::size_t j) const {
    const Mat3 m = volume * (lame.lambda * g[i] * g[j].transpose() + lame.mu * g[j] * g[i].transpose() +
                             lame.mu * dot(i, j) * Mat3::Identity());
    Matrix rows;
    for (int n = 0; n < 9; ++n) rows[static_cast<std::size_t>(n)] = m(n / 3, n % 3);
    return rows;
  }
  [[nodiscard]] Vector c(std::size_t i, std::size_t j, std::size_t k) const {
    const Vec3 v = volume * (lame.lambda / 2.0 * g[i] * dot(j, k) +
                             lame.mu / 2.0 * (g[k] * dot(i, j) + g[j] * dot(i, k)));
    return {v.x(), v.y(), v.z()};
  }
  [[nodiscard]] double d(std::size_t i, std::size_t j, std::size_t k, std::size_t l) const {
    return volume * (lame.lambda / 8.0 * dot(i, j) * dot(k, l) + lame.mu / 4.0 * dot(i, l) * dot(j, k));
  }
};

Constants constants_of(const Formulae& of) {
  Constants k;
  for (std::size_t p = 0; p < 4; ++p) k.node[p] = {of.b(p, p), of.c(p, p, p), of.d(p, p, p, p)};
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [p, j] = kEdges[e];
    k.edge[e] = {of.b(p, j),       of.c(p, p, j),    of.c(j, p, p),    of.c(j, j, p),    of.c(p, j, j),
                 of.d(j, p, p, p), of.d(j, j, j, p), of.d(j, j, p, p), of.d(j, p, j, p), of.d(p, j, j, p)};
  }
  for (std::size_t f = 0; f < 4; ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t a = kFaces[f][i];
      const std::size_t b = kFaces[f][(i + 1) % 3];
      const std::size_t c = kFaces[f][(i + 2) % 3];
      k.face[f].C[i] = of.c(a, b, c);
      k.face[f].D_bc[i] = of.d(a, a, b, c);
      k.face[f].D_ab[i] = of.d(a, b, a, c);
      k.face[f].D_ba[i] = of.d(b, a, a, c);
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    // D^abcd has the pairs (a b) (c d) in the lambda term, (a d) (b c) in that of mu.
    const std::size_t b = kPartner[0][i];
    for (std::size_t other = 0; other < 2; ++other) {
      const std::size_t d = kPartner[0][(i + 1 + other) % 3];
      k.D[i][other] = of.d(0, b, 6 - b - d, d);
    }
  }
  return k;
}

/// What the four nodes give: u, their products, and -f while it grows.
struct Element {
  double u[4][3];
  double q[4][4];
  double r[4][3];

  void add(std::size_t p, double s, const double* v) {
    for (int i = 0; i < 3; ++i) r[p][i] += s * v[i];
  }
  [[nodiscard]] double along(const Vector& C, std::size_t j) const {
    return C[0] * u[j][0] + C[1] * u[j][1] + C[2] * u[j][2];
  }
};

void add_node(const Constants::Node& k, std::size_t p, Element& e) {
  for (std::size_t i = 0; i < 3; ++i) {
    e.r[p][i] += k.B[3 * i] * e.u[p][0] + k.B[3 * i + 1] * e.u[p][1] + k.B[3 * i + 2] * e.u[p][2];
  }
  e.add(p, e.q[p][p], k.C.data());
  e.add(p, 2.0 * e.along(k.C, p) + 4.0 * k.D * e.q[p][p], e.u[p]);
}

/// The constants of an edge as node p sees them, j being the other end.
struct EdgeEnd {
  const Vector& C_ppj;
  const Vector& C_jpp;
  const Vector& C_jjp;
  const Vector& C_pjj;
  double D_jppp, D_jjjp, D_jjpp, D_both;
};

void add_end(const EdgeEnd& k, std::size_t p, std::size_t j, Element& e) {
  const double jj = e.q[j][j];
  const double pj = e.q[p][j];
  const double pp = e.q[p][p];
  e.add(p, jj, k.C_pjj.data());
  e.add(p, 2.0 * pj, k.C_ppj.data());
  e.add(p, 2.0 * e.along(k.C_jpp, j) + 4.0 * (2.0 * k.D_jppp * pj + k.D_jjpp * jj), e.u[p]);
  e.add(p,
        2.0 * (e.along(k.C_ppj, p) + e.along(k.C_jjp, j)) +
            4.0 * (k.D_jppp * pp + k.D_both * pj + k.D_jjjp * jj),
        e.u[j]);
}

void add_edge(const Constants::Edge& k, std::size_t p, std::size_t j, Element& e) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t m = 0; m < 3; ++m) {
      e.r[p][i] += k.B[3 * i + m] * e.u[j][m];
      e.r[j][m] += k.B[3 * i + m] * e.u[p][i];
    }
  }
  const double both = k.D_jpjp + k.D_pjjp;
  add_end({k.C_ppj, k.C_jpp, k.C_jjp, k.C_pjj, k.D_jppp, k.D_jjjp, k.D_jjpp, both}, p, j, e);
  add_end({k.C_jjp, k.C_pjj, k.C_ppj, k.C_jpp, k.D_jjjp, k.D_jppp, k.D_jjpp, both}, j, p, e);
}

void add_face(const Constants::Face& k, const std::size_t (&node)[3], Element& e) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t ij = (i + 1) % 3;
    const std::size_t ik = (i + 2) % 3;
    const std::size_t p = node[i];
    const std::size_t j = node[ij];
    const std::size_t l = node[ik];
    const double jl = e.q[j][l];
    const double both_p = k.D_ab[i] + k.D_ba[i];
    const double both_j = k.D_ab[ij] + k.D_ba[ij];
    const double both_l = k.D_ab[ik] + k.D_ba[ik];
    e.add(p, 2.0 * jl, k.C[i].data());
    e.add(p, 8.0 * k.D_bc[i] * jl, e.u[p]);
    e.add(p, 2.0 * e.along(k.C[ik], l) + 4.0 * (both_p * e.q[p][l] + both_j * jl + k.D_bc[ik] * e.q[l][l]),
          e.u[j]);
    e.add(p, 2.0 * e.along(k.C[ij], j) + 4.0 * (both_p * e.q[p][j] + both_l * jl + k.D_bc[ij] * e.q[j][j]),
          e.u[l]);
  }
}

void add_whole(const double (&D)[3][2], Element& e) {
  for (std::size_t p = 0; p < 4; ++p) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t l = kPartner[p][i];
      const std::size_t j = kPartner[p][(i + 1) % 3];
      const std::size_t k = kPartner[p][(i + 2) % 3];
      e.add(p, 4.0 * (D[i][0] + D[i][1]) * e.q[j][k], e.u[l]);
    }
  }
}

}  // namespace

Expanded::Expanded(std::vector<std::int32_t> cells, const std::vector<double>& X, Lame lame)
    : cells_(std::move(cells)), X_(X) {
  for (std::size_t e = 0; e < cells_.size(); e += 4) {
    Mat3 J;
    for (std::size_t a = 1; a < 4; ++a) {
      J.col(static_cast<int>(a) - 1) =
          block(ConstReals(X_), cells_[e + a]) - block(ConstReals(X_), cells_[e]);
    }
    const Mat3 inverse = J.inverse();
    Formulae of{{}, lame, J.determinant() / 6.0};
    of.g[0] = Vec3::Zero();
    for (std::size_t a = 1; a < 4; ++a) {
      of.g[a] = inverse.row(static_cast<int>(a) - 1).transpose();
      of.g[0] -= of.g[a];
    }
    constants_.push_back(constants_of(of));
  }
}

void Expanded::add_force(const double* x, double* f) const {
  for (std::size_t c = 0; c < constants_.size(); ++c) {
    const Constants& k = constants_[c];
    const std::int32_t* nodes = &cells_[4 * c];
    Element e = {};
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t i = 0; i < 3; ++i) {
        const auto at = 3 * static_cast<std::size_t>(nodes[a]) + i;
        e.u[a][i] = x[at] - X_[at];
      }
    }
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = a; b < 4; ++b) {
        e.q[a][b] = e.u[a][0] * e.u[b][0] + e.u[a][1] * e.u[b][1] + e.u[a][2] * e.u[b][2];
        e.q[b][a] = e.q[a][b];
      }
    }
    for (std::size_t p = 0; p < 4; ++p) add_node(k.node[p], p, e);
    for (std::size_t i = 0; i < 6; ++i) add_edge(k.edge[i], kEdges[i][0], kEdges[i][1], e);
    for (std::size_t i = 0; i < 4; ++i) add_face(k.face[i], kFaces[i], e);
    add_whole(k.D, e);
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t i = 0; i < 3; ++i) f[3 * static_cast<std::size_t>(nodes[a]) + i] -= e.r[a][i];
    }
  }
}

}  // namespace tissu::bench
