#include "tissu/model/edges/tensor_constants.h"

namespace tissu {
namespace {

/// B, C and D of one tetrahedron.
struct Formulae {
  const TensorCell& of;

  [[nodiscard]] double dot(std::size_t a, std::size_t b) const { return of.g[a].dot(of.g[b]); }
  void add_matrix(std::size_t a, std::size_t b, double*& to) const {
    const Mat3 B =
        of.volume * (of.lame.lambda * of.g[a] * of.g[b].transpose() +
                     of.lame.mu * of.g[b] * of.g[a].transpose() + of.lame.mu * dot(a, b) * Mat3::Identity());
    for (int k = 0; k < 9; ++k) *to++ += B(k / 3, k % 3);
  }
  void add_vector(double times, std::size_t a, std::size_t b, std::size_t c, double*& to) const {
    const Vec3 C = of.volume * (of.lame.lambda / 2.0 * of.g[a] * dot(b, c) +
                                of.lame.mu / 2.0 * (of.g[c] * dot(a, b) + of.g[b] * dot(a, c)));
    for (int k = 0; k < 3; ++k) *to++ += times * C[k];
  }
  void add_scalar(double times, std::size_t a, std::size_t b, std::size_t c, std::size_t d,
                  double*& to) const {
    *to++ += times * of.volume *
             (of.lame.lambda / 8.0 * dot(a, b) * dot(c, d) + of.lame.mu / 4.0 * dot(a, d) * dot(b, c));
  }
};

using Local = std::array<std::size_t, 4>;

void add_node(const Formulae& of, const Local& at, double* to) {
  const auto p = at[0];
  of.add_vector(1.0, p, p, p, to);
  of.add_scalar(2.0, p, p, p, p, to);
}

void add_edge(const Formulae& of, const Local& at, double* to) {
  const auto [p, j, unused, neither] = at;
  of.add_vector(2.0, p, p, j, to);
  of.add_vector(1.0, j, p, p, to);
  of.add_vector(2.0, j, j, p, to);
  of.add_vector(1.0, p, j, j, to);
  of.add_scalar(4.0, j, p, p, p, to);
  of.add_scalar(4.0, j, j, j, p, to);
  of.add_scalar(2.0, j, j, p, p, to);
  of.add_scalar(4.0, j, p, j, p, to);
  of.add_scalar(4.0, p, j, j, p, to);
}

void add_face(const Formulae& of, const Local& at, double* to) {
  const auto each = [&](auto&& f) {
    for (std::size_t i = 0; i < 3; ++i) f(at[i], at[(i + 1) % 3], at[(i + 2) % 3]);
  };
  each([&](auto a, auto b, auto c) { of.add_vector(2.0, a, b, c, to); });
  each([&](auto a, auto b, auto c) { of.add_scalar(4.0, a, a, b, c, to); });
  each([&](auto a, auto b, auto c) {
    of.add_scalar(4.0, a, b, a, c, to);
    of.add_scalar(4.0, b, a, a, c, to);
  });
}

void add_tetra(const Formulae& of, const Local& at, double* to) {
  const auto [a, b, c, d] = at;
  // Beside (u_a . u_b) (u_c . u_d) stand D^abcd and D^bacd; likewise for the two other ways to pair four
  // nodes.
  of.add_scalar(4.0, a, b, c, d, to);
  of.add_scalar(4.0, b, a, c, d, to);
  of.add_scalar(4.0, a, c, b, d, to);
  of.add_scalar(4.0, c, a, b, d, to);
  of.add_scalar(4.0, a, d, b, c, to);
  of.add_scalar(4.0, d, a, b, c, to);
}

}  // namespace

void add_tensor_constants(const TensorCell& cell, const std::array<std::size_t, 4>& at, int size, bool linear,
                          double* to) {
  const Formulae of{cell};
  if (size <= 2) of.add_matrix(at[0], at[size == 1 ? 0 : 1], to);
  if (linear) return;
  if (size == 1) add_node(of, at, to);
  if (size == 2) add_edge(of, at, to);
  if (size == 3) add_face(of, at, to);
  if (size == 4) add_tetra(of, at, to);
}

}  // namespace tissu
