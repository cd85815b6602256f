#include "tissu/contact/contact_run.h"

#include <algorithm>

#include "hold_back.h"
#include "push_ahead.h"
#include "tissu/contact/candidates.h"

namespace tissu {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

}  // namespace

ContactRun::ContactRun(const Contact& contact, const FixedDofs& fixed) : contact_(contact) {
  const auto& vertices = contact.surfaces().vertices();
  for (const SurfaceVertex& vertex : vertices) {
    const bool given =
        vertex.carrier < 0 && (vertex.row < 0 || fixed.masks()[at(vertex.row)] == FixedDofs::kAllAxes);
    given_.push_back(given ? 1 : 0);
  }
  candidates_ = std::make_unique<Candidates>(contact.description(), contact.surfaces());
  held_ = std::make_unique<HoldBack>(contact.surfaces(), given_);
  ahead_ = std::make_unique<PushAhead>(contact, given_);
  begin_.resize(3 * vertices.size());
  from_ = now_ = begin_;
}

ContactRun::~ContactRun() = default;

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

void ContactRun::begin(const State& start, double end, ConstReals led) {
  start_ = &start;
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

/// Rows where `state` has them, obstacles where they are at the end of the step.
void ContactRun::gather(const State& state, std::vector<double>& places) const {
  const auto& vertices = contact_.surfaces().vertices();
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const auto number = static_cast<std::int32_t>(v);
    block(Reals(places), number) =
        vertices[v].is_free() ? contact_.place(number, state) : Vec3(block(ConstReals(from_), number));
  }
}

int ContactRun::hold_back(State& to) {
  gather(to, now_);
  least_share_ = 1.0;
  goal_ = now_;
  candidates_->cover(from_, now_);
  if (!contact_.description().travel) return 0;
  bend(to);
  if (!held_->find(*candidates_, planes_, from_, now_, bends_)) return 0;
  int rows = hold_back_carriers(to);
  const auto& vertices = contact_.surfaces().vertices();
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const auto number = static_cast<std::int32_t>(v);
    if (given_[v] != 0 || vertices[v].row < 0) continue;
    const double share = held_->share(number);
    if (share == 1.0) continue;
    least_share_ = std::min(least_share_, share);
    ++rows;
    const Vec3 from = block(ConstReals(from_), number);
    block(Reals(to.positions), vertices[v].row) = from + share * (block(ConstReals(now_), number) - from);
  }
  return rows;
}

/// |arm| theta^2 of what rigid bodies carry.
void ContactRun::bend(const State& to) {
  const SurfaceSet& surfaces = contact_.surfaces();
  if (surfaces.carriers().empty()) return;
  bends_.assign(given_.size(), 0.0);
  for (std::size_t v = 0; v < bends_.size(); ++v) {
    const std::int32_t carrier = surfaces.vertices()[v].carrier;
    if (carrier < 0) continue;
    const double turn = way_turned(surfaces.carriers()[at(carrier)], to).norm();
    bends_[v] = surfaces.arm(static_cast<std::int32_t>(v)).norm() * turn * turn;
  }
}

Vec3 ContactRun::way_turned(const SurfaceCarrier& carrier, const State& to) const {
  const auto frame = at(carrier.frame);
  return nearest_turn(to.rotations[frame] * start_->rotations[frame].conjugate(), Vec3::Zero());
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
    const Vec3 turn = share * way_turned(carrier, to);
    to.rotations[frame] = (turn_by(turn) * start_->rotations[frame]).normalized();
  }
  return rows;
}

void ContactRun::look(const State& at) {
  looked_at_ = &at;
  gather(at, now_);
  candidates_->cover(from_, now_);
  find();
  keep_multipliers();
  hand_over();
}

Vec3 ContactRun::gone(const ContactNumbers& contact) const {
  Vec3 before = reach(contact, begin_);
  if (contact.kind == ContactNumbers::kPlane) {
    const auto obstacle = static_cast<std::int32_t>(contact.b);
    before -= contact_.carried(obstacle, -vector_of(contact.fixed), *start_, end_, start_->time);
  }
  if (!contact_.surfaces().carriers().empty()) {
    before += contact_.rolled(contact, *start_) - contact_.rolled(contact, *looked_at_);
  }
  return vector_of(contact.place) - before;
}

std::size_t ContactRun::bytes() const {
  return candidates_->bytes() + (begin_.size() + from_.size() + now_.size()) * sizeof(double) +
         (contacts_.capacity() + looked_.capacity()) * sizeof(ContactNumbers);
}

}  // namespace tissu
