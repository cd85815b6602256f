#include "tissu/contact/body_forces.h"

#include <algorithm>
#include <cmath>

#include "tissu/base/index.h"

namespace tissu {
namespace {

constexpr double kFloor = 1e-3;    ///< of the load on a body
constexpr double kNothing = 1e-8;  ///< of the gap: what a force moves that is round-off

}  // namespace

BodyForces::BodyForces(const Contact& contact, std::size_t rows) : contact_(contact) {
  forces_.assign(3 * rows, 0.0);
  refusals_ = forces_;
  floors_.assign(contact.surfaces().surfaces().size(), 0.0);
  sizes_ = others_ = roundings_ = changes_ = floors_;
  const SurfaceSet& surfaces = contact.surfaces();
  for (const auto& surface : surfaces.surfaces()) {
    if (surface.carrier < 0) continue;
    double lever = 0.0;
    for (std::int32_t v = surface.first_vertex; v < surface.last_vertex; ++v) {
      lever = std::max(lever, surfaces.arm(v).norm() + surfaces.vertices()[at(v)].radius);
    }
    levers_.push_back(lever);
  }
}

void BodyForces::begin(const State& start, ConstReals load) {
  start_ = &start;
  std::ranges::fill(floors_, 0.0);
  if (!load.empty()) sum_squares(load, floors_);
  for (double& floor : floors_) floor = kFloor * std::sqrt(floor);
}

void BodyForces::scatter(const ContactNumbers& contact, const Vec3& force, Reals f) const {
  contact_.for_parts(contact, *start_,
                     [&](const CarriedPart& part) { block(f, part.row) += part.load(force); });
}

/// Moments count as the forces that have them at the longest lever.
void BodyForces::sum_squares(ConstReals forces, std::vector<double>& squares) const {
  std::ranges::fill(squares, 0.0);
  for (const SurfaceVertex& vertex : contact_.surfaces().vertices()) {
    if (vertex.row >= 0) squares[at(vertex.surface)] += block(forces, vertex.row).squaredNorm();
  }
  for (const auto& inner : contact_.surfaces().inner_rows()) {
    squares[at(inner.surface)] += block(forces, inner.row).squaredNorm();
  }
  const auto& surfaces = contact_.surfaces().surfaces();
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    if (surfaces[s].carrier < 0) continue;
    const SurfaceCarrier& carrier = contact_.surfaces().carriers()[at(surfaces[s].carrier)];
    const double lever = levers_[at(surfaces[s].carrier)];
    squares[s] += block(forces, carrier.row).squaredNorm();
    if (lever > 0.0) squares[s] += block(forces, carrier.rotation).squaredNorm() / (lever * lever);
  }
}

void BodyForces::add_squares(const ContactNumbers& contact, double square,
                             std::vector<double>& squares) const {
  for (std::size_t k = 0; k < 4; ++k) {
    if (contact.vertex[k] < 0.0) continue;
    const SurfaceVertex& vertex = contact_.surfaces().vertices()[static_cast<std::size_t>(contact.vertex[k])];
    if (vertex.is_free()) squares[at(vertex.surface)] += contact.beta[k] * contact.beta[k] * square;
  }
}

double BodyForces::largest_share(ConstReals parts, ConstReals wholes) const {
  double largest = 0.0;
  for (std::size_t s = 0; s < parts.size(); ++s) {
    if (parts[s] > 0.0)
      largest = std::max(largest, std::sqrt(parts[s]) / std::max(floors_[s], std::sqrt(wholes[s])));
  }
  return largest;
}

double BodyForces::round_off(const ContactNumbers& contact) const {
  const Vec3 n = vector_of(contact.normal);
  const double gap = contact_.description().pairs[static_cast<std::size_t>(contact.pair)].gap;
  return kNothing * gap * n.dot(stiffness_of(contact) * n);
}

double BodyForces::change(std::span<const ContactNumbers> solved, std::span<const ContactNumbers> looked) {
  std::ranges::fill(forces_, 0.0);
  std::ranges::fill(sizes_, 0.0);
  std::ranges::fill(others_, 0.0);
  std::ranges::fill(roundings_, 0.0);
  for (const ContactNumbers& c : solved) {
    const Vec3 force = c.force * vector_of(c.normal) + vector_of(c.drag);
    add_squares(c, force.squaredNorm(), sizes_);
    scatter(c, -force, forces_);
  }
  for (const ContactNumbers& c : looked) {
    add_squares(c, vector_of(c.push).squaredNorm(), others_);
    scatter(c, vector_of(c.push), forces_);
    const double rounding = round_off(c);
    add_squares(c, rounding * rounding, roundings_);
  }
  sum_squares(forces_, changes_);
  for (std::size_t s = 0; s < sizes_.size(); ++s)
    sizes_[s] = std::max({sizes_[s], others_[s], roundings_[s]});
  return largest_share(changes_, sizes_);
}

void BodyForces::clear() {
  std::ranges::fill(forces_, 0.0);
  std::ranges::fill(refusals_, 0.0);
}

void BodyForces::add(const ContactNumbers& contact, const Vec3& given, const Vec3& taken_off) {
  scatter(contact, given, forces_);
  scatter(contact, taken_off, refusals_);
}

double BodyForces::taken_off() {
  sum_squares(forces_, sizes_);
  sum_squares(refusals_, changes_);
  return largest_share(changes_, sizes_);
}

}  // namespace tissu
