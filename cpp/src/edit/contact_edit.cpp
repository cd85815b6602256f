#include "contact_edit.h"

#include <algorithm>
#include <utility>

#include "body_surface.h"
#include "cut_edit.h"
#include "cut_surface.h"

namespace tissu {
namespace {

const SurfaceDescription* surface_of(const World& world, const std::string& body) {
  if (world.contact() == nullptr) return nullptr;
  const std::vector<SurfaceDescription>& all = world.contact()->description().bodies;
  const auto found = std::ranges::find(all, body, &SurfaceDescription::name);
  return found == all.end() ? nullptr : &*found;
}

}  // namespace

std::unique_ptr<ContactEdit> ContactEdit::make(const World& world, const std::string& body,
                                               const CutState& cut) {
  if (surface_of(world, body) == nullptr) return nullptr;
  return std::make_unique<ContactEdit>(world, body, cut);
}

ContactEdit::ContactEdit(const World& world, const std::string& body, const CutState& cut)
    : world_(world),
      body_(body),
      table_(cut.hosts, cut.material, kerf_depth(body, world.contact()->description())) {}

bool ContactEdit::follows_cells() const { return !has_own_mesh(*surface_of(world_, body_)); }

bool ContactEdit::refuses() const { return world_.contact()->description().travel; }

std::unique_ptr<Contact> ContactEdit::with(SurfaceDescription surface, ContactDescription description,
                                           ConstReals rest) const {
  std::vector<std::int32_t> first;
  first.reserve(description.bodies.size());
  for (const SurfaceDescription& one : description.bodies) {
    first.push_back(world_.body(one.name).first_node);
  }
  *std::ranges::find(description.bodies, body_, &SurfaceDescription::name) = std::move(surface);
  return world_.contact()->with_surfaces(std::move(description), first, rest, world_.frames());
}

std::unique_ptr<Contact> ContactEdit::of_material(const CutState& cut, const CutPlan& plan,
                                                  ConstReals rest) const {
  ContactDescription description = world_.contact()->description();
  part_pairs(description, body_, plan.first_node, copied_by(cut.hosts, plan), first_day_points(cut.hosts));
  return with(volume_surface(body_, cut.hosts, table_.surface()), std::move(description), rest);
}

std::vector<std::uint8_t> ContactEdit::changed(const Contact& contact) const {
  const SurfaceSet& surfaces = contact.surfaces();
  const auto own = std::ranges::find(surfaces.surfaces(), body_, &SurfaceSet::Surface::name);
  const std::int32_t first =
      surfaces.first_primitive()[static_cast<std::size_t>(own - surfaces.surfaces().begin())];
  std::vector<std::uint8_t> changed(surfaces.primitives().size(), 0);
  std::ranges::copy(table_.changed(), changed.begin() + first);
  return changed;
}

std::unique_ptr<Contact> ContactEdit::of_cells(const BodyDescription& body, ConstReals rest) const {
  return with(body_surface(body), world_.contact()->description(), rest);
}

}  // namespace tissu
