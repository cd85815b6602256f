/// How far vertices may leave the straight ways between where they are and where they go, and the ways of
/// rotations that are cut.

#include <algorithm>
#include <cmath>

#include "hold_back.h"
#include "tissu/base/index.h"
#include "tissu/contact/candidates.h"
#include "tissu/contact/contact_run.h"

namespace tissu {
namespace {

constexpr double kOffChord = 0.125;  ///< of |arm| theta^2: how far an arc is off its chord at most

}  // namespace

double ContactRun::longest_way(const State& to) const {
  const auto& vertices = contact_.surfaces().vertices();
  double square = 0.0;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (!vertices[v].is_free()) continue;
    const auto number = static_cast<std::int32_t>(v);
    square = std::max(square, (contact_.place(number, to) - block(ConstReals(from_), number)).squaredNorm());
  }
  return std::sqrt(square);
}

void ContactRun::measure_ways(const State& to) {
  sway(to);
  if (contact_.description().travel) bend(to);
  add_arcs();
}

/// A vertex at sum w (x + R l) whose rows go shares s of their ways d, which the turning of R l is a part of,
/// is off its own way, which is sum w d, by |sum w (s - 1/2) (d - sum w d)| <= sum |w| |d - sum w d| / 2, and
/// more where weights below zero let shares of it exceed 0 to 1. A body that moves as if it were rigid has
/// one d, and so no such sway.
void ContactRun::sway(const State& to) {
  const SurfaceSet& surfaces = contact_.surfaces();
  if (!surfaces.has_riders()) return;
  const auto& vertices = surfaces.vertices();
  sways_.assign(vertices.size(), 0.0);
  const auto way_of = [&](std::int32_t mover) {
    return Vec3(block(ConstReals(now_), mover) - block(ConstReals(from_), mover));
  };
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (vertices[v].rider < 0) continue;
    const Vec3 way = way_of(static_cast<std::int32_t>(v));
    const std::span<const RiderPart> parts = surfaces.parts(vertices[v]);
    const std::span<const RiderTurn> turns = surfaces.turns(vertices[v]);
    double weights = 0.0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      Vec3 own = way_of(parts[i].mover);
      if (!turns.empty() && turns[i].frame >= 0) {
        const auto frame = at(turns[i].frame);
        own += to.rotations[frame] * turns[i].arm - from_turned_[frame] * turns[i].arm;
      }
      weights += std::abs(parts[i].weight);
      sways_[v] += 0.5 * std::abs(parts[i].weight) * (own - way).norm();
    }
    sways_[v] += 0.5 * std::max(0.0, weights - 1.0) * way.norm();
  }
}

/// |arm| theta^2 of what rigid bodies and frames carry.
void ContactRun::bend(const State& to) {
  const SurfaceSet& surfaces = contact_.surfaces();
  if (surfaces.rotations().empty()) return;
  const auto& vertices = surfaces.vertices();
  bends_.assign(vertices.size(), 0.0);
  const auto square_of = [&](std::int32_t frame) { return way_turned(frame, to).squaredNorm(); };
  for (std::size_t v = 0; v < bends_.size(); ++v) {
    if (vertices[v].carrier >= 0) {
      const double square = square_of(surfaces.carriers()[at(vertices[v].carrier)].frame);
      bends_[v] = surfaces.arm(static_cast<std::int32_t>(v)).norm() * square;
    }
    if (vertices[v].rider < 0) continue;
    const std::span<const RiderTurn> turns = surfaces.turns(vertices[v]);
    for (std::size_t i = 0; i < turns.size(); ++i) {
      if (turns[i].frame < 0) continue;
      const double weight = std::abs(surfaces.parts(vertices[v])[i].weight);
      bends_[v] += weight * turns[i].arm.norm() * square_of(turns[i].frame);
    }
  }
}

/// A search covers the arcs of what frames carry, too.
void ContactRun::add_arcs() {
  leaves_ = sways_;
  if (bends_.empty() || !contact_.surfaces().has_turning_riders()) return;
  const auto& vertices = contact_.surfaces().vertices();
  for (std::size_t v = 0; v < leaves_.size(); ++v) {
    if (vertices[v].rider >= 0) leaves_[v] += kOffChord * bends_[v];
  }
}

Vec3 ContactRun::way_turned(std::int32_t frame, const State& to) const {
  return nearest_turn(to.rotations[at(frame)] * from_turned_[at(frame)].conjugate(), Vec3::Zero());
}

int ContactRun::hold_back_carriers(State& to) {
  int rows = 0;
  for (const auto& surface : contact_.surfaces().surfaces()) {
    if (surface.carrier < 0) continue;
    const double share = held_->share(surface.first_vertex);
    if (share == 1.0) continue;
    least_share_ = std::min(least_share_, share);
    ++rows;
    const SurfaceCarrier& carrier = contact_.surfaces().carriers()[at(surface.carrier)];
    const Vec3 pushed =
        block(ConstReals(from_), surface.first_vertex) - block(ConstReals(begin_), surface.first_vertex);
    const Vec3 from = block(ConstReals(start_->positions), carrier.row) + pushed;
    auto place = block(Reals(to.positions), carrier.row);
    place = Vec3(from + share * (place - from));
    const auto frame = at(carrier.frame);
    const Vec3 turn = share * way_turned(carrier.frame, to);
    to.rotations[frame] = (turn_by(turn) * from_turned_[frame]).normalized();
  }
  return rows;
}

/// A frame goes one share of its way and of its turn, or what it carries would go elsewhere.
int ContactRun::hold_back_rotations(State& to) {
  int rows = 0;
  for (const SurfaceRotation& of : contact_.surfaces().rotations()) {
    if (of.mover < 0 || given_[at(of.mover)] != 0 || is_row_given(of.row)) continue;
    const double share = held_->share(of.mover);
    if (share == 1.0) continue;
    least_share_ = std::min(least_share_, share);
    ++rows;
    const auto frame = at(of.frame);
    const Vec3 turn = share * way_turned(of.frame, to);
    to.rotations[frame] = (turn_by(turn) * from_turned_[frame]).normalized();
  }
  return rows;
}

}  // namespace tissu
