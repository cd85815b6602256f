#include "tissu/force/links.h"

#include <array>
#include <cmath>
#include <string>

#include "held_place.h"
#include "tissu/base/error.h"
#include "tissu/base/number_text.h"

namespace tissu {
namespace {

constexpr std::size_t kNumbers = 11;  ///< of a link

Vec3 arm(const State& state, const LinkPoint& point) { return lever_arm(state, point.frame, point.place); }

Vec3 position(const State& state, const LinkPoint& point) {
  return block(ConstReals(state.positions), point.block) + arm(state, point);
}

/// dp/dq p: what a motion p of the unknowns does to the point.
Vec3 motion(const State& state, const LinkPoint& point, ConstReals p) {
  Vec3 moved = block(p, point.block);
  if (point.frame >= 0) moved += block(p, point.block + 1).cross(arm(state, point));
  return moved;
}

void add_point_force(const State& state, const LinkPoint& point, const Vec3& force, Reals f) {
  block(f, point.block) += force;
  if (point.frame >= 0) block(f, point.block + 1) += arm(state, point).cross(force);
}

/// f_a, that on the other point is the opposite.
Vec3 pull(const State& state, const Link& link) {
  return link.stiffness * (position(state, link.b) - position(state, link.a));
}

/// Calls f(arm, force, row of the rotation) for each point of a link that is on a frame.
template <class Function>
void for_arms(const State& state, const Link& link, Function&& f) {
  const Vec3 force = pull(state, link);
  if (link.a.frame >= 0) f(arm(state, link.a), force, link.a.block + 1);
  if (link.b.frame >= 0) f(arm(state, link.b), Vec3(-force), link.b.block + 1);
}

LinkPoint point_at(const double* from) {
  return {static_cast<std::int32_t>(from[0]), static_cast<std::int32_t>(from[1]),
          Vec3(from[2], from[3], from[4])};
}

std::int32_t vertex_of(const State& state, const LinkPoint& point, Couplings& couplings) {
  if (point.frame < 0) return point.block;
  return couplings.carry(
      std::array{CarriedPart{point.block, 1.0}, CarriedPart{point.block + 1, 1.0, arm(state, point), true}});
}

}  // namespace

std::int32_t LinkTable::add(const LinkPoint& a, const LinkPoint& b, double stiffness) {
  if (!(stiffness > 0.0)) {
    throw ParameterError("a link's stiffness is " + number_text(stiffness) + " N/m; it must be positive.");
  }
  for (const LinkPoint& point : {a, b}) {
    numbers_.insert(numbers_.end(), {static_cast<double>(point.block), static_cast<double>(point.frame),
                                     point.place.x(), point.place.y(), point.place.z()});
  }
  numbers_.push_back(stiffness);
  return static_cast<std::int32_t>(size()) - 1;
}

std::size_t LinkTable::size() const { return numbers_.size() / kNumbers; }

template <class Function>
void Links::for_links(const State& state, Function&& f) const {
  const std::vector<double>& numbers = state.memory[place_];
  for (std::size_t i = 0; i < numbers.size(); i += kNumbers) {
    f(Link{point_at(&numbers[i]), point_at(&numbers[i + 5]), numbers[i + 10]});
  }
}

void Links::claim_memory(MemoryPlaces& places) { place_ = places.claim(std::string(kMemory), 0); }

void Links::carry_memory(const ForceModel& before, const Memory& then, Memory& now) const {
  if (const auto* links = dynamic_cast<const Links*>(&before)) now[place_] = then[links->place_];
}

void Links::check_memory(const State& state) const {
  const std::vector<double>& numbers = state.memory[place_];
  if (numbers.size() % kNumbers != 0) {
    throw ParameterError("found " + std::to_string(numbers.size()) + " numbers of links; a multiple of " +
                         std::to_string(kNumbers) + " is accepted.");
  }
  for (std::size_t i = 0; i < numbers.size(); i += kNumbers) {
    for (const std::size_t p : {i, i + 5}) {
      const auto frames = static_cast<double>(state.rotations.size());
      const std::int32_t blocks = state.blocks() - (numbers[p + 1] >= 0.0 ? 1 : 0);  // a frame has two
      if (is_whole(numbers[p], 0.0, blocks) && is_whole(numbers[p + 1], -1.0, frames)) continue;
      throw ParameterError("link " + std::to_string(i / kNumbers) + " holds block " +
                           number_text(numbers[p]) + " and frame " + number_text(numbers[p + 1]) +
                           "; the world has " + std::to_string(state.blocks()) + " blocks and " +
                           std::to_string(state.rotations.size()) + " frames.");
    }
    const double stiffness = numbers[i + 10];
    if (stiffness > 0.0 && std::isfinite(stiffness)) continue;
    throw ParameterError("link " + std::to_string(i / kNumbers) + " has a stiffness of " +
                         number_text(stiffness) + " N/m; it must be positive and finite.");
  }
}

void Links::add_force(const State& state, Scratch& /*scratch*/, Reals f) const {
  for_links(state, [&](const Link& link) {
    const Vec3 force = pull(state, link);
    add_point_force(state, link.a, force, f);
    add_point_force(state, link.b, -force, f);
  });
}

void Links::add_product(const State& state, Scratch& /*scratch*/, StiffnessScale scale, ConstReals p,
                        Reals out) const {
  for_links(state, [&](const Link& link) {
    const Vec3 force =
        scale.position * link.stiffness * (motion(state, link.b, p) - motion(state, link.a, p));
    add_point_force(state, link.a, force, out);
    add_point_force(state, link.b, -force, out);
    for_arms(state, link, [&](const Vec3& arm, const Vec3& acting, std::int32_t rotation) {
      add_turning(arm, acting, rotation, scale.position, p, out);
    });
  });
}

void Links::add_couplings(const State& state, StiffnessScale scale, Couplings& couplings) const {
  if (scale.position == 0.0) return;
  for_links(state, [&](const Link& link) {
    const std::int32_t a = vertex_of(state, link.a, couplings);
    const std::int32_t b = vertex_of(state, link.b, couplings);
    couplings.add({{a, b, 0, 0}, {-1.0, 1.0, 0.0, 0.0}, -scale.position * link.stiffness * Mat3::Identity()});
    for_arms(state, link, [&](const Vec3& arm, const Vec3& acting, std::int32_t rotation) {
      couple_turning(arm, acting, rotation, scale.position, couplings);
    });
  });
}

double Links::energy(const State& state, Scratch& /*scratch*/) const {
  double sum = 0.0;
  for_links(state, [&](const Link& link) {
    sum += 0.5 * link.stiffness * (position(state, link.b) - position(state, link.a)).squaredNorm();
  });
  return sum;
}

}  // namespace tissu
