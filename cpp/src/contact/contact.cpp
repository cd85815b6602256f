#include "tissu/contact/contact.h"

#include <cmath>
#include <cstring>
#include <utility>

#include "tissu/base/error.h"

namespace tissu {

static_assert(std::is_trivially_copyable_v<ContactNumbers>);

ContactNumbers ContactTable::operator[](std::size_t i) const {
  ContactNumbers contact;
  std::memcpy(static_cast<void*>(&contact), numbers_.data() + i * kNumbers, sizeof contact);
  return contact;
}

void ContactTable::write(std::span<const ContactNumbers> contacts, std::vector<double>& numbers) {
  numbers.resize(contacts.size() * kNumbers);
  if (!contacts.empty()) std::memcpy(numbers.data(), contacts.data(), contacts.size_bytes());
}

void ContactTable::write(const ContactNumbers& contact, std::size_t i, std::vector<double>& numbers) {
  std::memcpy(numbers.data() + i * kNumbers, static_cast<const void*>(&contact), sizeof contact);
}

Mat3 stiffness_of(const ContactNumbers& contact) {
  const auto& [xx, yy, zz, yz, xz, xy] = contact.stiffness;
  Mat3 H;
  H << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  return H;
}

Contact::Contact(ContactDescription description, std::span<const std::int32_t> first_node, ConstReals rest,
                 std::span<const Frame> frames)
    : description_(std::move(description)), surfaces_(description_, first_node, rest, frames) {}

template <class Function>
void Contact::for_contacts(const State& state, Function&& f) const {
  const ContactTable all = table(state);
  for (std::size_t i = 0; i < all.size(); ++i) f(all[i]);
}

Vec3 Contact::carried_place(std::int32_t vertex, const State& state) const {
  const SurfaceVertex& v = surfaces_.vertices()[static_cast<std::size_t>(vertex)];
  if (v.rider >= 0) {
    Vec3 sum = Vec3::Zero();
    for (const RiderPart& part : surfaces_.parts(v)) {
      sum += part.weight * block(ConstReals(state.positions), part.row);
    }
    if (surfaces_.has_turning_riders()) sum += surfaces_.turned(v, state.rotations);
    return sum;
  }
  const SurfaceCarrier& carrier = surfaces_.carriers()[static_cast<std::size_t>(v.carrier)];
  return block(ConstReals(state.positions), carrier.row) + arm(vertex, carrier, state);
}

Vec3 Contact::reach(const ContactNumbers& contact, const State& state) const {
  Vec3 r = vector_of(contact.fixed);
  for (std::size_t k = 0; k < 4; ++k) {
    if (contact.vertex[k] < 0.0) continue;
    const auto v = static_cast<std::int32_t>(contact.vertex[k]);
    if (surfaces_.vertices()[static_cast<std::size_t>(v)].is_free()) r += contact.beta[k] * place(v, state);
  }
  if (surfaces_.has_rolling()) r += rolled(contact, state);
  return r;
}

namespace {

/// The way along the surface that what is round has rolled: as long as the arc between the normal, at which
/// it touched, and where that point of it is now.
Vec3 arc(const ContactNumbers& contact, bool is_of_first, const Vec3& offset) {
  const Vec3 n = vector_of(contact.normal);
  const Vec3 along = offset - n.dot(offset) * n;
  const double sine = along.norm();
  const double cosine = is_of_first ? -n.dot(offset) : n.dot(offset);
  if (sine == 0.0) return Vec3::Zero();
  return std::hypot(sine, cosine) * std::atan2(sine, cosine) / sine * along;
}

}  // namespace

Vec3 Contact::rolled(const ContactNumbers& contact, const State& state) const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    if (contact.vertex[k] < 0.0) continue;
    const auto v = static_cast<std::int32_t>(contact.vertex[k]);
    const std::int32_t frame = frame_of(contact, surfaces_.vertices()[static_cast<std::size_t>(v)]);
    if (frame < 0) continue;
    const Vec3 offset(contact.offset[3 * k], contact.offset[3 * k + 1], contact.offset[3 * k + 2]);
    sum += contact.beta[k] *
           arc(contact, contact.is_of_first(k), state.rotations[static_cast<std::size_t>(frame)] * offset);
  }
  return sum;
}

Vec3 Contact::motion(const ContactNumbers& contact, const State& state, ConstReals p) const {
  Vec3 sum = Vec3::Zero();
  for_parts(contact, state, [&](const CarriedPart& part) { sum += part.motion(block(p, part.row)); });
  return sum;
}

void Contact::scatter(const ContactNumbers& contact, const State& state, const Vec3& force, Reals f) const {
  for_parts(contact, state, [&](const CarriedPart& part) { block(f, part.row) += part.load(force); });
}

void Contact::add_force(const State& state, Scratch& /*scratch*/, Reals f) const {
  for_contacts(state, [&](const ContactNumbers& c) {
    const Vec3 moved = reach(c, state) - vector_of(c.place);
    scatter(c, state, vector_of(c.push) - stiffness_of(c) * moved, f);
  });
}

void Contact::take_force(const State& state, Reals f) const {
  for_contacts(state, [&](const ContactNumbers& c) { scatter(c, state, -vector_of(c.push), f); });
}

void Contact::add_product(const State& state, Scratch& /*scratch*/, StiffnessScale scale, ConstReals p,
                          Reals out) const {
  if (scale.position == 0.0) return;
  for_contacts(state, [&](const ContactNumbers& c) {
    scatter(c, state, -scale.position * (stiffness_of(c) * motion(c, state, p)), out);
  });
}

double Contact::energy(const State& state, Scratch& /*scratch*/) const {
  double sum = 0.0;
  for_contacts(state, [&](const ContactNumbers& c) {
    const Mat3 H = stiffness_of(c);
    if (H.isZero(0.0)) return;
    const Vec3 moved = reach(c, state) - vector_of(c.place);
    sum += 0.5 * moved.dot(H * moved) - vector_of(c.push).dot(moved);
  });
  return sum;
}

void Contact::claim_memory(MemoryPlaces& places) {
  place_ = places.claim(std::string(kMemory), 0);
  parts_ = places.claim("contact in parts", 0);
  for (const ObstacleDescription& obstacle : description_.obstacles) {
    leads_.push_back(places.claim("obstacle " + obstacle.surface.name, 0));
  }
}

/// A vertex that rows carry, among the couplings.
std::int32_t Contact::carry_rider(const SurfaceVertex& vertex, const State& state,
                                  Couplings& couplings) const {
  if (surfaces_.has_turning_riders()) {
    MergedTurningParts parts;
    for_rows_of(vertex, 1.0, state, [&](const CarriedPart& part) { parts.add(part); });
    return couplings.carry(parts.all());
  }
  MergedParts parts;
  for (const RiderPart& part : surfaces_.parts(vertex)) parts.add({part.row, part.weight});
  return couplings.carry(parts.all());
}

void Contact::add_couplings(const State& state, StiffnessScale scale, Couplings& couplings) const {
  if (scale.position == 0.0) return;
  for_contacts(state, [&](const ContactNumbers& c) {
    const Mat3 H = stiffness_of(c);
    if (H.isZero(0.0)) return;
    Coupling coupling{{0, 0, 0, 0}, {0.0, 0.0, 0.0, 0.0}, -scale.position * H, true};
    for (std::size_t k = 0; k < 4; ++k) {
      if (c.vertex[k] < 0.0) continue;
      const auto v = static_cast<std::int32_t>(c.vertex[k]);
      const SurfaceVertex& vertex = surfaces_.vertices()[static_cast<std::size_t>(v)];
      if (!vertex.is_free()) continue;
      coupling.vertex[k] = vertex.row;
      coupling.beta[k] = c.beta[k];
      if (rolls(c, vertex)) {
        coupling.vertex[k] = couplings.carry(
            std::array{CarriedPart{vertex.row, 1.0},
                       CarriedPart{surfaces_.roller(vertex).rotation, 1.0, outward(c, k), true}});
      }
      if (vertex.row >= 0) continue;
      if (vertex.rider >= 0) {
        coupling.vertex[k] = carry_rider(vertex, state, couplings);
        continue;
      }
      const SurfaceCarrier& carrier = surfaces_.carriers()[static_cast<std::size_t>(vertex.carrier)];
      coupling.vertex[k] =
          couplings.carry(std::array{CarriedPart{carrier.row, 1.0},
                                     CarriedPart{carrier.rotation, 1.0, arm(c, k, carrier, state), true}});
    }
    couplings.add(coupling);
  });
}

void Contact::carry_memory(const ForceModel& before, const Memory& then, Memory& now) const {
  const auto* contact = dynamic_cast<const Contact*>(&before);
  if (contact == nullptr) return;
  for (std::size_t i = 0; i < leads_.size() && i < contact->leads_.size(); ++i) {
    now[leads_[i]] = then[contact->leads_[i]];
  }
  ContactTable::write(carried_from(contact->surfaces_, ContactTable(then[contact->place_])), now[place_]);
}

void Contact::check_memory(const State& state) const {
  const std::vector<double>& numbers = state.memory[place_];
  if (numbers.size() % ContactTable::kNumbers != 0) {
    throw ParameterError("found " + std::to_string(numbers.size()) +
                         " numbers of contacts, which are not those of whole contacts.");
  }
  const std::size_t sums = state.memory[parts_].size();
  if (sums != 0 && sums != 6 * surfaces_.surfaces().size()) {
    throw ParameterError("found " + std::to_string(sums) +
                         " numbers of forces in the parts of a step, which are not six for each surface.");
  }
  const auto vertices = static_cast<double>(surfaces_.vertices().size());
  const auto edges = static_cast<double>(surfaces_.edges().size());
  const auto primitives = static_cast<double>(surfaces_.primitives().size());
  const auto obstacles = static_cast<double>(description_.obstacles.size());
  const auto whole = [](double x, double low, double end) {
    return x >= low && x < end && x == std::floor(x);
  };
  for_contacts(state, [&](const ContactNumbers& c) {
    bool known = whole(c.kind, 0.0, ContactNumbers::kPlane + 1.0);
    known = known && whole(c.point, 0.0, 1e4) &&
            whole(c.pair, 0.0, static_cast<double>(description_.pairs.size()));
    known = known && whole(c.a, 0.0, std::max(vertices, edges));
    known = known && whole(c.b, 0.0, std::max({vertices, edges, primitives, obstacles}));
    for (const double v : c.vertex) known = known && (v == -1.0 || whole(v, 0.0, vertices));
    if (!known) {
      throw ParameterError(
          "found a contact of features that this world has not; restore it in the world that it was "
          "taken from.");
    }
  });
  for (std::size_t i = 0; i < leads_.size(); ++i) {
    const std::string text = LiveLead::misfit(state.memory[leads_[i]], 0, 0);
    if (!state.memory[leads_[i]].empty() && !text.empty()) {
      throw ParameterError("the live lead of obstacle \"" + description_.obstacles[i].surface.name + "\" " +
                           text + ".");
    }
  }
}

Vec3 Contact::touched(const ContactNumbers& contact, std::size_t k, const State& state) const {
  const auto v = static_cast<std::int32_t>(contact.vertex[k]);
  const SurfaceVertex& vertex = surfaces_.vertices()[static_cast<std::size_t>(v)];
  if (!vertex.is_free()) {
    const std::int32_t obstacle = surfaces_.surfaces()[static_cast<std::size_t>(vertex.surface)].obstacle;
    const Vec3 at = place_of(obstacle, block(ConstReals(surfaces_.rest()), v), state, state.time);
    return vertex.radius > 0.0 ? Vec3(at + outward(contact, k)) : at;
  }
  if (rolls(contact, vertex)) return place(v, state) + outward(contact, k);
  if (vertex.carrier < 0) return place(v, state);
  const SurfaceCarrier& carrier = surfaces_.carriers()[static_cast<std::size_t>(vertex.carrier)];
  return block(ConstReals(state.positions), carrier.row) + arm(contact, k, carrier, state);
}

void Contact::add_part(double share, State& state) const {
  std::vector<double>& sums = state.memory[parts_];
  sums.resize(6 * surfaces_.surfaces().size(), 0.0);
  for (std::size_t s = 0; s < surfaces_.surfaces().size(); ++s) {
    const Wrench wrench = force_now(static_cast<std::int32_t>(s), state);
    block(Reals(sums), static_cast<std::int32_t>(2 * s)) += share * wrench.force;
    block(Reals(sums), static_cast<std::int32_t>(2 * s + 1)) += share * wrench.moment;
  }
}

Contact::Wrench Contact::force_on(std::int32_t surface, const State& state) const {
  const ConstReals sums(state.memory[parts_]);
  if (sums.empty()) return force_now(surface, state);
  return {block(sums, 2 * surface), block(sums, 2 * surface + 1)};
}

Contact::Wrench Contact::force_now(std::int32_t surface, const State& state) const {
  Wrench wrench;
  const auto bodies = static_cast<std::int32_t>(description_.bodies.size());
  Vec3 origin = Vec3::Zero();
  if (surface >= bodies) {
    const ObstacleDescription& obstacle = description_.obstacles[static_cast<std::size_t>(surface - bodies)];
    origin = place_of(surface - bodies, obstacle.origin, state, state.time);
  }
  const auto add = [&](const Vec3& force, const Vec3& place) {
    wrench.force += force;
    wrench.moment += (place - origin).cross(force);
  };
  for_contacts(state, [&](const ContactNumbers& c) {
    const Vec3 force = vector_of(c.push);
    if (c.kind == ContactNumbers::kPlane && static_cast<std::int32_t>(c.b) + bodies == surface) {
      add(-force, -vector_of(c.fixed));
    }
    for (std::size_t k = 0; k < 4; ++k) {
      if (c.vertex[k] < 0.0) continue;
      const auto v = static_cast<std::size_t>(c.vertex[k]);
      if (surfaces_.vertices()[v].surface == surface) add(c.beta[k] * force, touched(c, k, state));
    }
  });
  return wrench;
}

}  // namespace tissu
