#pragma once

/// The one virtual boundary of the forces: tens of calls a step, never one for each element.

#include <string_view>

#include "tissu/assembly/block_matrix.h"
#include "tissu/state/state.h"

namespace tissu {

/// What to add of a model's derivatives: position * df/dx + velocity * df/dv.
struct StiffnessScale {
  double position = 0.0;
  double velocity = 0.0;
  /// Of the matrix only, not of the product: each cell's share of -df/dx is replaced by the nearest positive
  /// semi-definite one, that of continuum elements point by point. df/dv is so as it is.
  bool definite = false;
};

enum class ForceKind { elastic, external };

class ForceModel {
 public:
  ForceModel() = default;
  virtual ~ForceModel() = default;
  ForceModel(const ForceModel&) = delete;
  ForceModel& operator=(const ForceModel&) = delete;

  /// The effect that it is, as profiles and plans name it.
  [[nodiscard]] virtual std::string_view effect() const = 0;
  /// Elastic forces and energies come from the body, external ones from its surroundings.
  [[nodiscard]] virtual ForceKind kind() const = 0;
  /// Its df/dx and df/dv are the same for every state.
  [[nodiscard]] virtual bool has_constant_stiffness() const { return false; }
  /// It has a stiffness at all.
  [[nodiscard]] virtual bool has_stiffness() const { return true; }

  /// Names the nodes it couples, once for each topology, …
  virtual void couple(SparsityBuilder& /*builder*/) const {}
  /// … and is told the pattern that came out of it.
  virtual void bind(const Sparsity& /*pattern*/) {}

  /// f += force [N] (moments [N m] in rotation blocks)
  virtual void add_force(const State& state, Reals f) const = 0;
  /// matrix += scale.position df/dx + scale.velocity df/dv
  virtual void add_stiffness(const State& /*state*/, StiffnessScale /*scale*/,
                             BlockMatrix& /*matrix*/) const {}
  /// out += (scale.position df/dx + scale.velocity df/dv) p
  virtual void add_product(const State& /*state*/, StiffnessScale /*scale*/, ConstReals /*p*/,
                           Reals /*out*/) const {}
  /// Stored energy [J]
  [[nodiscard]] virtual double energy(const State& /*state*/) const { return 0.0; }
};

}  // namespace tissu
