#include "tissu/contact/penalty.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "tissu/base/index.h"

namespace tissu {
namespace {

constexpr double kSigma = 1.0 / 3.0;      ///< of the square of the bodies' largest frequency: s = 1
constexpr double kLeastOfLargest = 1e-6;  ///< of a mobility: that along the normal is not less
constexpr double kNearStop = 0.6;         ///< of the gap: stops are looked for from here

/// The largest area over mass of the free vertices of a surface [m2/kg].
double largest_area_over_mass(const SurfaceSet& surfaces, std::int32_t surface, const Mass& mass) {
  double largest = 0.0;
  const auto& of = surfaces.surfaces()[at(surface)];
  for (std::int32_t v = of.first_vertex; v < of.last_vertex; ++v) {
    const SurfaceVertex& vertex = surfaces.vertices()[at(v)];
    if (vertex.row >= 0) largest = std::max(largest, vertex.area / mass.nodal()[at(vertex.row)]);
    if (vertex.rider >= 0) {
      double inverse = 0.0;
      const std::span<const RiderPart> parts = surfaces.parts(vertex);
      const std::span<const RiderTurn> turns = surfaces.turns(vertex);
      for (std::size_t i = 0; i < parts.size(); ++i) {
        const double square = parts[i].weight * parts[i].weight;
        inverse += square / mass.nodal()[at(parts[i].row)];
        if (turns.empty() || turns[i].frame < 0) continue;
        const Mat3 turning = mass.frames()[at(turns[i].frame)].inertia.inverse();
        inverse += square * turns[i].arm.squaredNorm() * largest_of(turning);
      }
      largest = std::max(largest, vertex.area * inverse);
    }
    if (vertex.carrier < 0) continue;
    const Frame& frame = mass.frames()[at(surfaces.carriers()[at(vertex.carrier)].frame)];
    const double turning = surfaces.arm(v).squaredNorm() * largest_of(frame.inertia.inverse());
    largest = std::max(largest, vertex.area * (1.0 / frame.mass + turning));
  }
  return largest;
}

}  // namespace

PenaltyContact::PenaltyContact(const Contact& contact, const FixedDofs& fixed, const Mass& mass,
                               double frequency)
    : ImpulseContact(contact, fixed, mass), omega2_(kSigma * frequency * frequency) {
  shared_.assign(fixed.masks().size(), 0.0);
  const SurfaceSet& surfaces = contact.surfaces();
  for (const ContactPair& pair : contact.description().pairs) {
    zetas_.push_back(damping_of(pair));
    double square = omega2_;
    if (pair.stiffness) {
      // Two surfaces that face each other: as vertices of one and as corners of faces of the other.
      const bool obstacle = surfaces.surfaces()[at(pair.b)].obstacle >= 0;
      square = std::max(square, (obstacle ? 1.0 : 2.0) * *pair.stiffness *
                                    std::max(largest_area_over_mass(surfaces, pair.a, mass),
                                             largest_area_over_mass(surfaces, pair.b, mass)));
    }
    rates_.frequency = std::max(rates_.frequency, std::sqrt(square));
    rates_.damping = std::max(rates_.damping, 2.0 * zetas_.back() * std::sqrt(square));
  }
}

void PenaltyContact::begin_response() {
  ImpulseContact::begin_response();
  acted_.clear();
  stage_ = 2.0;
  stiffest_ = 0.0;
  near_stop_ = false;
}

void PenaltyContact::begin_blow(Blow& blow, double /*pushed*/) const {
  blow.apart = spring_stop(contact_, blow.contact);
  blow.restitution = 0.0;
}

void PenaltyContact::find_near() {
  near_.clear();
  const auto looked = run_.looked();
  for (std::size_t i = 0; i < looked.size(); ++i) {
    const ContactNumbers& c = looked[i];
    const double gap = pair_of(c).gap;
    if (run_.gap(i) >= gap) continue;
    const double range = spring_range(contact_, c);
    if (run_.gap(i) >= range) continue;
    near_stop_ = near_stop_ || -run_.gap(i) > (1.0 - kNearStop) * std::min(gap, c.apart);
    const double depth = range - run_.gap(i);
    const double s0 = range + std::min(gap, c.apart);
    near_.push_back({i, depth, s0, run_.weight(i) * depth / s0});
  }
}

void PenaltyContact::share_rows() {
  const auto each = [&](auto&& f) {
    for (const Near& near : near_) {
      run_.for_parts(run_.looked()[near.looked],
                     [&](const CarriedPart& part) { f(shared_[at(part.row)], near.share); });
    }
  };
  each([](double& sum, double /*share*/) { sum = 0.0; });
  each([](double& sum, double share) { sum += share; });
}

/// Its force, whose parts go into the contact: `force`, `drag` of the start of the step, k in `stiffness`.
Vec3 PenaltyContact::force_of(ContactNumbers& c, const Near& near, const State& at) {
  const Mat3 mobility = mass_.mobility(c, shared_) / near.share;
  const double w = largest_of(mobility);  // 1/a
  if (!(w > 0.0)) return Vec3::Zero();
  const ContactPair& pair = pair_of(c);
  const bool own = pair.stiffness && c.area > 0.0;
  const double k = own ? run_.weight(near.looked) * *pair.stiffness * c.area : omega2_ / w;
  stiffest_ = std::max(stiffest_, std::sqrt(k * w));
  const double zeta = zetas_[static_cast<std::size_t>(c.pair)];
  const double damper = 2.0 * zeta * std::sqrt(k / w);
  const Vec3 n = vector_of(c.normal);
  // Restitution is that of the motion along the normal: its damper takes the mobility along it.
  const double normal_damper = 2.0 * zeta * std::sqrt(k / std::max(n.dot(mobility * n), kLeastOfLargest * w));
  const Vec3 v = run_.rate(c, at.velocities) + run_.led(c) / h_;
  const double u = n.dot(v);
  c.force = std::max(
      0.0, spring_force(contact_.description().penalty, k, near.depth, near.range).force - normal_damper * u);
  c.stiffness[0] = k;
  if (!(pair.friction > 0.0)) return c.force * n;
  const Vec3 slid = run_.gone(c, at);
  const Vec3 held = vector_of(c.drag) - k * (slid - n.dot(slid) * n) - damper * (v - u * n);
  return c.force * n + on_disk(held, pair.friction * c.force);
}

void PenaltyContact::add_force(const State& state, double share, Reals f) {
  find_near();
  share_rows();
  for (const Near& near : near_) {
    ContactNumbers c = run_.looked()[near.looked];
    const Vec3 force = force_of(c, near, state);
    run_.for_parts(c, [&](const CarriedPart& part) { block(f, part.row) += part.load(force); });
    if (share == 0.0) continue;
    c.push = numbers_of(share * force);
    c.sliding = stage_;
    acted_.push_back(c);
  }
  stage_ += 1.0;
}

/// The mean of the stages' forces, and stops; what friction's spring holds at the end.
void PenaltyContact::keep(const State& end, std::vector<ContactNumbers>& kept) {
  ImpulseContact::keep(end, acted_);
  std::ranges::sort(acted_, {}, [](const ContactNumbers& c) { return std::tuple(c.key(), c.sliding); });
  for (const ContactNumbers& c : acted_) {
    if (kept.empty() || kept.back().key() != c.key()) {
      kept.push_back(c);
      continue;
    }
    const Vec3 sum = vector_of(kept.back().push) + vector_of(c.push);
    if (c.stiffness[0] > 0.0) kept.back() = c;
    kept.back().push = numbers_of(sum);
  }
  for (ContactNumbers& c : kept) {
    const Vec3 n = vector_of(c.normal);
    const Vec3 slid = run_.gone(c, end);
    const Vec3 drag = vector_of(c.drag) - c.stiffness[0] * (slid - n.dot(slid) * n);
    c.force = std::max(0.0, n.dot(vector_of(c.push)));
    const double bound = pair_of(c).friction * c.force;
    c.sliding = drag.norm() > bound && bound > 0.0 ? 1.0 : 0.0;
    c.drag = numbers_of(on_disk(drag, bound));
  }
  std::erase_if(kept, [](const ContactNumbers& c) { return !(c.force > 0.0); });
}

}  // namespace tissu
