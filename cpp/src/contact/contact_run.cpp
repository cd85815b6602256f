#include "tissu/contact/contact_run.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hold_back.h"
#include "push_ahead.h"
#include "tissu/contact/candidates.h"

namespace tissu {
namespace {

constexpr double kAlternates = 1e-2;  ///< inadmissible share of the forces
constexpr double kFloor = 1e-3;       ///< of the load on a body

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }
std::array<double, 3> numbers_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

ContactRun::ContactRun(const Contact& contact, const FixedDofs& fixed) : contact_(contact), fixed_(fixed) {
  const auto& vertices = contact.surfaces().vertices();
  for (const SurfaceVertex& vertex : vertices) {
    const bool given = vertex.row < 0 || fixed.masks()[at(vertex.row)] == FixedDofs::kAllAxes;
    given_.push_back(given ? 1 : 0);
  }
  candidates_ = std::make_unique<Candidates>(contact.description(), contact.surfaces());
  held_ = std::make_unique<HoldBack>(contact.surfaces(), given_);
  ahead_ = std::make_unique<PushAhead>(contact, given_);
  begin_.resize(3 * vertices.size());
  from_ = now_ = begin_;
  counts_.assign(fixed.masks().size(), 0);
  forces_.assign(3 * fixed.masks().size(), 0.0);
  refusals_ = forces_;
  floors_.assign(contact.surfaces().surfaces().size(), 0.0);
  sizes_ = others_ = changes_ = floors_;
}

ContactRun::~ContactRun() = default;

std::int32_t ContactRun::row(double vertex) const {
  return vertex < 0.0 ? -1 : contact_.surfaces().vertices()[static_cast<std::size_t>(vertex)].row;
}

/// r of a contact, of vertices at these places.
Vec3 ContactRun::reach(const ContactNumbers& contact, ConstReals places) const {
  Vec3 r = Vec3::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    if (contact.vertex[k] >= 0.0) {
      r += contact.beta[k] * block(places, static_cast<std::int32_t>(contact.vertex[k]));
    }
  }
  return r;
}

void ContactRun::begin(const State& start, double end, ConstReals led, ConstReals load) {
  start_ = &start;
  alternations_ = 0;
  std::ranges::fill(floors_, 0.0);
  if (!load.empty()) sum_squares(load, floors_);
  for (double& floor : floors_) floor = kFloor * std::sqrt(floor);
  end_ = end;
  const ContactTable before = contact_.table(start);
  contacts_.resize(before.size());
  for (std::size_t i = 0; i < before.size(); ++i) contacts_[i] = before[i];
  contact_.place_vertices(start, start.time, begin_);
  from_ = begin_;
  held_->forget();
  ahead_->push({start, start.time, end, led}, *candidates_, from_, planes_);
  now_ = from_;
}

double ContactRun::half_edges_led(const State& start, double end) const {
  return ahead_->parts_of({start, start.time, end, {}});
}

void ContactRun::set_matrix(std::span<const double> blocks, double scale) {
  blocks_ = blocks;
  scale_ = scale;
}

void ContactRun::set_stiffer(double normal, double tangent) {
  normal_ = normal;
  tangent_ = tangent;
}

/// Rows where `state` has them, obstacles where they are at the end of the step.
void ContactRun::gather(const State& state, std::vector<double>& places) const {
  const auto& vertices = contact_.surfaces().vertices();
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const auto number = static_cast<std::int32_t>(v);
    block(Reals(places), number) = vertices[v].row >= 0
                                       ? Vec3(block(ConstReals(state.positions), vertices[v].row))
                                       : Vec3(block(ConstReals(from_), number));
  }
}

int ContactRun::hold_back(State& to) {
  gather(to, now_);
  least_share_ = 1.0;
  goal_ = now_;
  candidates_->cover(from_, now_);
  if (!contact_.description().travel) return 0;
  if (!held_->find(*candidates_, planes_, from_, now_)) return 0;
  int rows = 0;
  const auto& vertices = contact_.surfaces().vertices();
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const auto number = static_cast<std::int32_t>(v);
    if (given_[v] != 0) continue;
    const double share = held_->share(number);
    if (share == 1.0) continue;
    least_share_ = std::min(least_share_, share);
    ++rows;
    const Vec3 from = block(ConstReals(from_), number);
    block(Reals(to.positions), vertices[v].row) = from + share * (block(ConstReals(now_), number) - from);
  }
  return rows;
}

double ContactRun::look(const State& at) {
  gather(at, now_);
  candidates_->cover(from_, now_);
  find();
  keep_multipliers();
  hand_over();
  stiffen();
  press();
  return change();
}

void ContactRun::scatter(const ContactNumbers& contact, const Vec3& force, Reals f) const {
  for (std::size_t k = 0; k < 4; ++k) {
    const std::int32_t i = row(contact.vertex[k]);
    if (i >= 0) block(f, i) += contact.beta[k] * force;
  }
}

void ContactRun::sum_squares(ConstReals forces, std::vector<double>& squares) const {
  std::ranges::fill(squares, 0.0);
  for (const SurfaceVertex& vertex : contact_.surfaces().vertices()) {
    if (vertex.row >= 0) squares[at(vertex.surface)] += block(forces, vertex.row).squaredNorm();
  }
}

void ContactRun::add_squares(const ContactNumbers& contact, double square,
                             std::vector<double>& squares) const {
  for (std::size_t k = 0; k < 4; ++k) {
    if (row(contact.vertex[k]) < 0) continue;
    const auto v = static_cast<std::size_t>(contact.vertex[k]);
    squares[at(contact_.surfaces().vertices()[v].surface)] += contact.beta[k] * contact.beta[k] * square;
  }
}

double ContactRun::largest_share(ConstReals parts, ConstReals wholes) const {
  double largest = 0.0;
  for (std::size_t s = 0; s < parts.size(); ++s) {
    if (parts[s] > 0.0)
      largest = std::max(largest, std::sqrt(parts[s]) / std::max(floors_[s], std::sqrt(wholes[s])));
  }
  return largest;
}

/// Of the body where it is largest: |change of the forces on rows| / |forces|, from those of the latest solve
/// to those of the latest look.
double ContactRun::change() {
  std::ranges::fill(forces_, 0.0);
  std::ranges::fill(sizes_, 0.0);
  std::ranges::fill(others_, 0.0);
  for (const ContactNumbers& c : contacts_) {
    const Vec3 force = c.force * vector_of(c.normal) + vector_of(c.drag);
    add_squares(c, force.squaredNorm(), sizes_);
    scatter(c, -force, forces_);
  }
  for (const ContactNumbers& c : looked_) {
    add_squares(c, vector_of(c.push).squaredNorm(), others_);
    scatter(c, vector_of(c.push), forces_);
  }
  sum_squares(forces_, changes_);
  for (std::size_t s = 0; s < sizes_.size(); ++s) sizes_[s] = std::max(sizes_[s], others_[s]);
  return largest_share(changes_, sizes_);
}

void ContactRun::update(const State& end) {
  std::ranges::fill(forces_, 0.0);
  std::ranges::fill(refusals_, 0.0);
  for (ContactNumbers& c : contacts_) {
    Vec3 r = vector_of(c.fixed);
    for (std::size_t k = 0; k < 4; ++k) {
      const std::int32_t i = row(c.vertex[k]);
      if (i >= 0) r += c.beta[k] * block(ConstReals(end.positions), i);
    }
    const Vec3 f = vector_of(c.push) - stiffness_of(c) * (r - vector_of(c.place));
    const Vec3 n = vector_of(c.normal);
    const double normal = n.dot(f);
    c.force = std::max(0.0, normal);
    Vec3 drag = f - normal * n;
    const double friction = contact_.description().pairs[static_cast<std::size_t>(c.pair)].friction;
    const double bound = friction * c.force;
    if (drag.norm() > bound) drag *= bound > 0.0 ? bound / drag.norm() : 0.0;
    c.drag = numbers_of(drag);
    const Vec3 left = c.force * n + drag;
    scatter(c, left, forces_);
    scatter(c, f - left, refusals_);
  }
  sum_squares(forces_, sizes_);
  sum_squares(refusals_, changes_);
  inadmissible_ = largest_share(changes_, sizes_);
  alternations_ = inadmissible() > kAlternates ? alternations_ + 1 : std::max(0, alternations_ - 1);
}

void ContactRun::write(State& state) const { ContactTable::write(contacts_, contact_.numbers(state)); }

void ContactRun::finish(State& end) {
  least_gap_ = std::numeric_limits<double>::infinity();
  gather(end, now_);
  for (ContactNumbers& c : contacts_) {
    const Vec3 n = vector_of(c.normal);
    Vec3 r = vector_of(c.fixed);
    for (std::size_t k = 0; k < 4; ++k) {
      const std::int32_t i = row(c.vertex[k]);
      if (i >= 0) r += c.beta[k] * block(ConstReals(end.positions), i);
    }
    c.push = numbers_of(c.force * n + vector_of(c.drag));
    c.place = numbers_of(r);
    c.stiffness = {};
    least_gap_ = std::min(least_gap_, n.dot(r) / c.apart);
  }
  write(end);
}

std::size_t ContactRun::bytes() const {
  return candidates_->bytes() + (begin_.size() + from_.size() + now_.size()) * sizeof(double) +
         (contacts_.capacity() + looked_.capacity()) * sizeof(ContactNumbers);
}

}  // namespace tissu
