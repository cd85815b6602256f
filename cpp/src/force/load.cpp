#include "tissu/force/load.h"

#include <utility>

#include "tissu/assembly/fixed_dofs.h"

namespace tissu {
namespace {

/// [a]x, the matrix of b -> a x b
Mat3 cross_matrix(const Vec3& a) {
  Mat3 m;
  m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return m;
}

}  // namespace

double History::at(double time) const { return interpolate(times, factors, time, 1.0); }

NodalLoad::NodalLoad(std::string name, std::vector<std::int32_t> nodes, std::vector<double> forces,
                     History history)
    : name_(std::move(name)),
      nodes_(std::move(nodes)),
      forces_(std::move(forces)),
      history_(std::move(history)) {}

void NodalLoad::add_force(const State& state, Reals f) const {
  const double factor = state.load_factor * history_.at(state.time);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    block(f, nodes_[i]) += factor * block(ConstReals(forces_), static_cast<std::int32_t>(i));
  }
}

double NodalLoad::energy(const State& state) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    sum -= block(ConstReals(forces_), static_cast<std::int32_t>(i))
               .dot(block(ConstReals(state.positions), nodes_[i]));
  }
  return history_.at(state.time) * sum;
}

Pressure::Pressure(std::string name, std::vector<std::array<std::int32_t, 3>> triangles, double pressure,
                   History history)
    : name_(std::move(name)),
      triangles_(std::move(triangles)),
      pressure_(pressure),
      history_(std::move(history)) {}

double Pressure::pressure_at(const State& state) const {
  return state.load_factor * pressure_ * history_.at(state.time);
}

void Pressure::couple(SparsityBuilder& builder) const {
  for (const auto& triangle : triangles_) builder.add_cells(triangle, 3);
}

void Pressure::add_force(const State& state, Reals f) const {
  const double p = pressure_at(state);
  const ConstReals x(state.positions);
  for (const auto& t : triangles_) {
    const Vec3 twice_area = (block(x, t[1]) - block(x, t[0])).cross(block(x, t[2]) - block(x, t[0]));
    for (const std::int32_t node : t) block(f, node) -= p / 6.0 * twice_area;
  }
}

/// d(x0 x x1 + x1 x x2 + x2 x x0)/dx_k = [x_(k+2) - x_(k+1)]x, the same for the forces of all three nodes;
/// the symmetric part of the 9 x 9 stiffness has the blocks (B_k - B_a) / 2 with B antisymmetric.
template <class Function>
void Pressure::for_blocks(const State& state, double scale, Function&& f) const {
  const double p = scale * pressure_at(state);
  const ConstReals x(state.positions);
  for (const auto& t : triangles_) {
    std::array<Mat3, 3> B;
    for (std::size_t k = 0; k < 3; ++k) {
      B[k] = -p / 6.0 * cross_matrix(block(x, t[(k + 2) % 3]) - block(x, t[(k + 1) % 3]));
    }
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (a != k) f(t[a], t[k], Mat3(0.5 * (B[k] - B[a])));
      }
    }
  }
}

void Pressure::add_stiffness(const State& state, StiffnessScale scale, BlockMatrix& matrix) const {
  for_blocks(state, scale.position,
             [&](std::int32_t a, std::int32_t k, const Mat3& B) { matrix.add(a, k, B); });
}

void Pressure::add_product(const State& state, StiffnessScale scale, ConstReals p, Reals out) const {
  for_blocks(state, scale.position,
             [&](std::int32_t a, std::int32_t k, const Mat3& B) { block(out, a) += B * block(p, k); });
}

double Pressure::energy(const State& state) const {
  const ConstReals x(state.positions);
  double six_volumes = 0.0;
  for (const auto& t : triangles_) six_volumes += block(x, t[0]).dot(block(x, t[1]).cross(block(x, t[2])));
  return pressure_ * history_.at(state.time) * six_volumes / 6.0;
}

}  // namespace tissu
