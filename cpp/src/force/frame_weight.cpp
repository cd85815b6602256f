#include "tissu/force/frame_weight.h"

#include <utility>

#include "held_place.h"

namespace tissu {

FrameWeight::FrameWeight(const std::vector<Frame>& frames, const std::vector<Vec3>& moments,
                         Vec3 acceleration)
    : acceleration_(std::move(acceleration)) {
  for (std::size_t k = 0; k < frames.size(); ++k) {
    if (!moments[k].isZero()) moments_.push_back({frames[k].rotation, k, moments[k]});
  }
}

void FrameWeight::add_force(const State& state, Scratch& /*scratch*/, Reals f) const {
  const Vec3 g = state.load_factor * acceleration_;
  for (const Moment& moment : moments_) {
    block(f, moment.rotation) += (state.rotations[moment.frame] * moment.c).cross(g);
  }
}

Mat3 FrameWeight::turning(const State& state, const Moment& moment) const {
  const Vec3 g = state.load_factor * acceleration_;
  return turning_arm(state.rotations[moment.frame] * moment.c, g);
}

void FrameWeight::add_stiffness(const State& state, Scratch& /*scratch*/, StiffnessScale scale,
                                BlockMatrix& matrix) const {
  if (scale.position == 0.0 || scale.definite) return;
  for (const Moment& moment : moments_)
    matrix.add(moment.rotation, moment.rotation, scale.position * turning(state, moment));
}

void FrameWeight::add_product(const State& state, Scratch& /*scratch*/, StiffnessScale scale, ConstReals p,
                              Reals out) const {
  if (scale.position == 0.0) return;
  for (const Moment& moment : moments_)
    block(out, moment.rotation) += scale.position * (turning(state, moment) * block(p, moment.rotation));
}

double FrameWeight::energy(const State& state, Scratch& /*scratch*/) const {
  double sum = 0.0;
  for (const Moment& moment : moments_) sum -= acceleration_.dot(state.rotations[moment.frame] * moment.c);
  return state.load_factor * sum;
}

}  // namespace tissu
