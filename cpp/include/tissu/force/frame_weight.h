#pragma once

#include <vector>

#include "tissu/force/force_model.h"

namespace tissu {

/// The moment of the weight of what frames carry beside their origins: R_i c_i x g with c_i = sum_s w_is m_s
/// l_is. With `Gravity` at the origins it is the weight of the points, f_s = m_s g.
class FrameWeight final : public ForceModel {
 public:
  /// `moments`: c of each frame in its own axes [kg m]; acceleration [m/s2]
  FrameWeight(const std::vector<Frame>& frames, const std::vector<Vec3>& moments, Vec3 acceleration);

  [[nodiscard]] std::string_view effect() const override { return "gravity"; }
  [[nodiscard]] ForceKind kind() const override { return ForceKind::external; }
  void add_force(const State& state, Scratch& scratch, Reals f) const override;
  /// The symmetric part, 1/2 (r g^T + g r^T) - (r . g) I with r = R c; none of it in a definite matrix.
  void add_stiffness(const State& state, Scratch& scratch, StiffnessScale scale,
                     BlockMatrix& matrix) const override;
  void add_product(const State& state, Scratch& scratch, StiffnessScale scale, ConstReals p,
                   Reals out) const override;
  [[nodiscard]] double energy(const State& state, Scratch& scratch) const override;

 private:
  struct Moment {
    std::int32_t rotation;
    std::size_t frame;
    Vec3 c;
  };
  [[nodiscard]] Mat3 turning(const State& state, const Moment& moment) const;
  std::vector<Moment> moments_;
  Vec3 acceleration_;
};

}  // namespace tissu
