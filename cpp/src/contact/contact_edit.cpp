/// A contact after an edit of its bodies: other surfaces, and what is left of what it remembers.

#include <utility>

#include "tissu/contact/contact.h"
#include "tissu/contact/surface_change.h"

namespace tissu {

/// Numbers of vertices, edges and triangles are those of one topology: contacts take those of the other.
std::vector<ContactNumbers> Contact::carried_from(const SurfaceSet& before, const ContactTable& then) const {
  std::vector<ContactNumbers> kept;
  if (then.size() == 0) return kept;
  const SurfaceChange change(before, surfaces_);
  for (std::size_t i = 0; i < then.size(); ++i) {
    ContactNumbers c = then[i];
    if (c.pair < static_cast<double>(description_.pairs.size()) && change.carry(c)) kept.push_back(c);
  }
  return kept;
}

std::unique_ptr<Contact> Contact::with_surfaces(ContactDescription description,
                                                std::span<const std::int32_t> first_node, ConstReals rest,
                                                std::span<const Frame> frames) const {
  auto other = std::make_unique<Contact>(std::move(description), first_node, rest, frames);
  other->place_ = place_;
  other->parts_ = parts_;
  other->leads_ = leads_;
  return other;
}

void Contact::exchange_surfaces(Contact& other) {
  std::swap(description_, other.description_);
  std::swap(surfaces_, other.surfaces_);
}

void Contact::follow(const Contact& before, State& state) const {
  ContactTable::write(carried_from(before.surfaces_, table(state)), numbers(state));
  state.memory[parts_].clear();
}

}  // namespace tissu
