#pragma once

/// Loads from outside: forces on nodes, and pressure on faces.

#include <array>
#include <string>
#include <vector>

#include "tissu/force/force_model.h"

namespace tissu {

/// A factor over time, linear between its times and held at its ends; 1 when it has no times.
struct History {
  std::vector<double> times;  ///< ascending [s]
  std::vector<double> factors;
  [[nodiscard]] double at(double time) const;
};

/// Forces that keep their direction (dead loads): point forces, and tractions summed into nodes.
class NodalLoad final : public ForceModel {
 public:
  NodalLoad(std::string name, std::vector<std::int32_t> nodes, std::vector<double> forces, History history);
  [[nodiscard]] std::string_view effect() const override { return name_; }
  [[nodiscard]] ForceKind kind() const override { return ForceKind::external; }
  [[nodiscard]] bool has_constant_stiffness() const override { return true; }
  [[nodiscard]] bool has_stiffness() const override { return false; }
  void add_force(const State& state, Reals f) const override;
  /// -sum f . x [J]
  [[nodiscard]] double energy(const State& state) const override;

 private:
  std::string name_;
  std::vector<std::int32_t> nodes_;
  std::vector<double> forces_;  ///< [N], three for each node
  History history_;
};

/// Pressure that stays normal to the faces it acts on: for the triangle (x0, x1, x2), outward by its winding,
/// f_a = -p/6 (x1 - x0) x (x2 - x0). Its stiffness is skew on an open surface; the symmetric part is used,
/// which is exact for a pressure on a closed surface or one whose rim is held.
class Pressure final : public ForceModel {
 public:
  Pressure(std::string name, std::vector<std::array<std::int32_t, 3>> triangles, double pressure,
           History history);
  [[nodiscard]] std::string_view effect() const override { return name_; }
  [[nodiscard]] ForceKind kind() const override { return ForceKind::external; }
  void couple(SparsityBuilder& builder) const override;
  void add_force(const State& state, Reals f) const override;
  void add_stiffness(const State& state, StiffnessScale scale, BlockMatrix& matrix) const override;
  void add_product(const State& state, StiffnessScale scale, ConstReals p, Reals out) const override;
  /// p times the volume between the faces and the origin [J]
  [[nodiscard]] double energy(const State& state) const override;

 private:
  [[nodiscard]] double pressure_at(const State& state) const;
  template <class Function>
  void for_blocks(const State& state, double scale, Function&& f) const;

  std::string name_;
  std::vector<std::array<std::int32_t, 3>> triangles_;
  double pressure_;  ///< [Pa]
  History history_;
};

}  // namespace tissu
