#include "tissu/contact/contact_run.h"

#include <algorithm>
#include <cmath>

#include "hold_back.h"
#include "push_ahead.h"
#include "tissu/base/index.h"
#include "tissu/contact/candidates.h"

namespace tissu {

ContactRun::ContactRun(const Contact& contact, const FixedDofs& fixed) : contact_(contact), fixed_(fixed) {
  const SurfaceSet& surfaces = contact.surfaces();
  list_given();
  list_round();
  candidates_ = std::make_unique<Candidates>(contact.description(), contact.surfaces());
  if (std::ranges::any_of(contact.description().pairs, [](const ContactPair& p) { return p.a == p.b; })) {
    together_ =
        std::make_unique<Candidates>(contact.description(), contact.surfaces(), Candidates::Ways::together);
  }
  held_ = std::make_unique<HoldBack>(contact.surfaces(), given_);
  ahead_ = std::make_unique<PushAhead>(contact, led_);
  begin_.resize(3 * surfaces.mover_count());
  from_ = now_ = begin_;
}

ContactRun::~ContactRun() = default;

bool ContactRun::is_row_given(std::int32_t row) const {
  return fixed_.masks()[at(row)] == FixedDofs::kAllAxes;
}

/// A frame whose place is given may still turn what it carries.
void ContactRun::list_given() {
  const SurfaceSet& surfaces = contact_.surfaces();
  for (const SurfaceVertex& vertex : surfaces.vertices()) {
    bool given = vertex.carrier < 0 && (vertex.row < 0 || is_row_given(vertex.row));
    if (vertex.rider >= 0) {
      given = std::ranges::all_of(surfaces.parts(vertex),
                                  [&](const RiderPart& part) { return is_row_given(part.row); });
    }
    led_.push_back(given ? 1 : 0);
  }
  for (const auto& inner : surfaces.inner_rows()) led_.push_back(is_row_given(inner.row) ? 1 : 0);
  given_ = led_;
  for (const SurfaceRotation& of : surfaces.rotations()) {
    if (of.mover >= 0 && !is_row_given(of.row)) given_[at(of.mover)] = 0;
  }
  if (!surfaces.has_turning_riders()) return;
  for (std::size_t v = 0; v < surfaces.vertices().size(); ++v) {
    const SurfaceVertex& vertex = surfaces.vertices()[v];
    if (vertex.rider < 0 || given_[v] == 0) continue;
    const bool turns = std::ranges::any_of(surfaces.turns(vertex), [&](const RiderTurn& turn) {
      return turn.frame >= 0 && !is_row_given(turn.row);
    });
    if (turns) given_[v] = 0;
  }
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

void ContactRun::begin(const State& start, double end, const State& led) {
  start_ = &start;
  end_ = end;
  const ContactTable before = contact_.table(start);
  contacts_.resize(before.size());
  for (std::size_t i = 0; i < before.size(); ++i) contacts_[i] = before[i];
  contact_.place_vertices(start, start.time, begin_);
  gather_inner_rows(start, begin_);
  from_ = begin_;
  from_turned_ = start.rotations;
  turn_led();
  if (contact_.surfaces().has_turning_riders()) {
    for (const SurfaceRotation& of : contact_.surfaces().rotations()) {
      if (is_row_given(of.row)) from_turned_[at(of.frame)] = led.rotations[at(of.frame)];
    }
  }
  held_->forget();
  ahead_->push({start, start.time, end, led.positions, from_turned_}, *candidates_, from_, planes_);
  now_ = from_;
}

double ContactRun::half_edges_led(const State& start, double end) const {
  return ahead_->parts_of({start, start.time, end, {}, {}});
}

/// Rows where `state` has them, obstacles where they are at the end of the step.
void ContactRun::gather(const State& state, std::vector<double>& places) const {
  const auto& vertices = contact_.surfaces().vertices();
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const auto number = static_cast<std::int32_t>(v);
    block(Reals(places), number) =
        vertices[v].is_free() ? contact_.place(number, state) : Vec3(block(ConstReals(from_), number));
  }
  gather_inner_rows(state, places);
}

void ContactRun::gather_inner_rows(const State& state, std::vector<double>& places) const {
  auto number = static_cast<std::int32_t>(contact_.surfaces().vertices().size());
  for (const auto& inner : contact_.surfaces().inner_rows()) {
    block(Reals(places), number++) = block(ConstReals(state.positions), inner.row);
  }
}

int ContactRun::hold_back(State& to) {
  gather(to, now_);
  least_share_ = 1.0;
  goal_ = now_;
  const bool travels = contact_.description().travel;
  measure_ways(to);
  if (together_ != nullptr) {
    held_->release();
    together_->cover(from_, now_, leaves_);
    if (!travels || held_->is_free(*together_, planes_, from_, now_, bends_, sways_)) return 0;
  }
  candidates_->cover(from_, now_, leaves_);
  if (!travels || !held_->find(*candidates_, planes_, from_, now_, bends_, sways_)) return 0;
  int rows = hold_back_carriers(to) + hold_back_rotations(to);
  const auto hold = [&](std::size_t mover, std::int32_t row) {
    const auto number = static_cast<std::int32_t>(mover);
    const double share = held_->share(number);
    if (given_[mover] != 0 || share == 1.0) return;
    least_share_ = std::min(least_share_, share);
    ++rows;
    const Vec3 from = block(ConstReals(from_), number);
    block(Reals(to.positions), row) = from + share * (block(ConstReals(now_), number) - from);
  };
  const auto& vertices = contact_.surfaces().vertices();
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (vertices[v].row >= 0) hold(v, vertices[v].row);
  }
  const auto& inner = contact_.surfaces().inner_rows();
  for (std::size_t i = 0; i < inner.size(); ++i) hold(vertices.size() + i, inner[i].row);
  return rows;
}

void ContactRun::stand(State& at) const {
  const SurfaceSet& surfaces = contact_.surfaces();
  for (std::size_t v = 0; v < surfaces.vertices().size(); ++v) {
    const std::int32_t row = surfaces.vertices()[v].row;
    if (row >= 0) block(Reals(at.positions), row) = block(ConstReals(from_), static_cast<std::int32_t>(v));
  }
  auto mover = static_cast<std::int32_t>(surfaces.vertices().size());
  for (const auto& inner : surfaces.inner_rows()) {
    block(Reals(at.positions), inner.row) = block(ConstReals(from_), mover++);
  }
  for (const auto& surface : surfaces.surfaces()) {
    if (surface.carrier < 0) continue;
    const Vec3 pushed =
        block(ConstReals(from_), surface.first_vertex) - block(ConstReals(begin_), surface.first_vertex);
    block(Reals(at.positions), surfaces.carriers()[static_cast<std::size_t>(surface.carrier)].row) += pushed;
  }
  for (const SurfaceRotation& of : surfaces.rotations()) {
    const auto frame = static_cast<std::size_t>(of.frame);
    if (of.mover >= 0) at.rotations[frame] = from_turned_[frame];
  }
}

void ContactRun::look(const State& at, bool holds_on) {
  looked_at_ = &at;
  holds_on_ = holds_on;
  gather(at, now_);
  near().cover(from_, now_);
  find();
  keep_multipliers();
  if (begins_late_) rest_where_begun();
  hand_over();
  if (opens_by_shares_ && share_ < 1.0) open_slowly();
}

Candidates& ContactRun::near() {
  return together_ == nullptr || !held_->stopped().empty() ? *candidates_ : *together_;
}

Vec3 ContactRun::gone(const ContactNumbers& contact) const {
  Vec3 before = reach(contact, begin_);
  if (contact.kind == ContactNumbers::kPlane) {
    const auto obstacle = static_cast<std::int32_t>(contact.b);
    before -= contact_.carried(obstacle, -vector_of(contact.fixed), *start_, end_, start_->time);
  }
  if (contact_.surfaces().has_rolling()) {
    before += contact_.rolled(contact, *start_) - contact_.rolled(contact, *looked_at_);
  }
  if (turns_led_) before -= turned_by(contact);
  return vector_of(contact.place) - before;
}

std::size_t ContactRun::bytes() const {
  return candidates_->bytes() + (together_ != nullptr ? together_->bytes() : 0) +
         (begin_.size() + from_.size() + now_.size()) * sizeof(double) +
         (contacts_.capacity() + looked_.capacity()) * sizeof(ContactNumbers);
}

}  // namespace tissu
