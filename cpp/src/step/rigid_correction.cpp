#include "tissu/step/rigid_correction.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "rigid_motions.h"

namespace tissu {
namespace {

constexpr double kLeast = 1e-5;    ///< of what moves or acts: less is not corrected
constexpr double kFarthest = 0.1;  ///< [rad] or of the size: what is left of far turns is not of second order

}  // namespace

void RigidCorrection::prepare(const World& world, const PartBalance& balance) {
  world_ = &world;
  balance_ = &balance;
  corrected_.clear();
  moving_.clear();
  for (std::size_t k = 0; k < balance.parts().size(); ++k) {
    const ConnectedPart& part = balance.parts()[k];
    if (!part.is_held || RigidMotions(world, part, world.rest_state()).count() > 0) moving_.push_back(k);
  }
  const std::size_t size = moving_.empty() ? 0 : static_cast<std::size_t>(3 * world.blocks());
  motion_.resize(size);
  product_.resize(size);
}

bool RigidCorrection::correct(const State& at, double push, double move, ConstReals residual,
                              ConstReals momentum_change, Reals v) {
  corrected_.clear();
  for (const std::size_t k : moving_) {
    const ConnectedPart& part = balance_->parts()[k];
    const RigidMotions rigid(*world_, part, at);
    if (rigid.count() == 0) continue;
    const RigidMotions::Amounts left = rigid.on_motions(residual);
    const double size = rigid.size(left);
    const double acts = balance_->acting(k, momentum_change);
    if (!(size > kLeast * (rigid.size(rigid.momenta(v)) + acts / std::sqrt(part.mass)))) continue;
    const Eigen::LDLT<RigidMotions::Masses> matrix(rigid.mass() +
                                                   rigid.held(push * move, scratch_, motion_, product_));
    if (!matrix.isPositive()) continue;
    const RigidMotions::Amounts velocities = matrix.solve(left);
    if (!(move * rigid.rate(velocities) <= kFarthest)) continue;
    rigid.add(velocities, v);
    corrected_.push_back({&part, size});
  }
  return !corrected_.empty();
}

int RigidCorrection::take_back(const State& at, ConstReals residual, ConstReals before, Reals v) const {
  int count = 0;
  for (const Corrected& one : corrected_) {
    const RigidMotions rigid(*world_, *one.part, at);
    if (rigid.size(rigid.on_motions(residual)) < one.left) continue;
    for (const std::int32_t node : one.part->nodes) block(v, node) = block(before, node);
    for (const std::int32_t k : one.part->frames) {
      const std::int32_t row = world_->frames()[static_cast<std::size_t>(k)].rotation;
      block(v, row) = block(before, row);
    }
    ++count;
  }
  return count;
}

}  // namespace tissu
